// The Monte Carlo reference against closed forms and furnaces, before it judges the library.
#include "physics/monte_carlo.h"
#include "physics/solids.h"
#include "physics/view_factors.h"
#include "support/check.h"

using namespace physics;

namespace {

// The estimate agrees with the exact value within 4 standard errors, and those are small.
void check_estimate(const Estimate& e, double exact, double largest_error) {
  const double deviation = std::sqrt(e.variance[0]);
  CHECK(deviation < largest_error);
  CHECK_NEAR(e.mean[0], exact, 4 * deviation + 1e-12);
}

void the_tree_finds_the_nearest_of_all() {
  std::vector<Surface> surfaces;
  Random random(5);
  const auto point = [&] { return Vector{random.uniform(), random.uniform(), random.uniform()}; };
  for (int i = 0; i < 300; ++i) {
    const Vector a = point();
    surfaces.push_back(triangle(a, a + point() * 0.2, a + point() * 0.2, gray(0.5), gray(0)));
  }
  const RayTree tree(surfaces);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector from = point(), to = point(), direction = normalized(to - from);
    // By brute force: trees of one triangle.
    Hit wanted;
    for (int64_t k = 0; k < 300; ++k) {
      const Hit hit = RayTree({surfaces[k]}).nearest(from, direction);
      if (hit.t < wanted.t) wanted = hit, wanted.surface = k;
    }
    const Hit found = tree.nearest(from, direction);
    CHECK_EQUAL(found.surface, wanted.surface);
    CHECK_EQUAL(found.back, wanted.back);
    CHECK_EQUAL(tree.blocked(from, to), wanted.t < length(to - from));
    hits += found.surface >= 0;
  }
  CHECK(hits > 500 && hits < 2000);
}

void view_factors() {
  // Upright emitter on the shared edge, and one that faces the receiver; the receiver's halves are
  // averaged.
  std::vector<Surface> scene;
  add_polygon(scene, parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), gray(0), gray(0));
  const Polygon upright = parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  const Polygon facing = parallelogram({0, 0, 0.5}, {0, 1, 0}, {1, 0, 0});
  const std::pair<Polygon, double> cases[] = {{upright, shared_edge_rectangles(1, 1, 1)},
                                              {facing, coaxial_rectangles(1, 1, 0.5)}};
  for (const auto& [emitter, exact] : cases) {
    std::vector<Surface> with = scene;
    add_polygon(with, emitter, gray(0), gray(1));
    const MonteCarlo reference(with, 1);
    double mean = 0, variance = 0;
    for (int i = 0; i < 2; ++i) {
      const Estimate e = reference.over_side({i, 0}, 32, 2000);
      mean += 0.5 * e.mean[0];
      variance += 0.25 * e.variance[0];
    }
    CHECK(std::sqrt(variance) < 0.001);
    CHECK_NEAR(mean, exact, 4 * std::sqrt(variance));
    const Vector p = with[0].at(0.5, 0.25);
    check_estimate(reference.at_point({0, 0}, 0.5, 0.25, 32, 1000),
                   point_to_polygon(p, {0, 0, 1}, emitter), 0.002);
    // The back sees nothing.
    CHECK_EQUAL(reference.over_side({0, 1}, 4, 100).mean[0], 0.0);
  }
}

// A room whose surfaces all leave 1: E = 1 - rho, with a different rho on every surface.
void a_furnace_of_many_reflectances() {
  std::vector<Surface> scene;
  Random random(3);
  const auto add = [&](const std::vector<Polygon>& faces, bool sheet) {
    for (const Polygon& f : faces) {
      Spectrum reflectance, emission;
      for (int b = 0; b < 3; ++b) {
        reflectance[b] = 0.9 * random.uniform();
        emission[b] = 1 - reflectance[b];
      }
      const size_t first = scene.size();
      add_polygon(scene, f, reflectance, emission);
      for (size_t i = first; i < scene.size(); ++i) scene[i].two_sided = sheet;
    }
  };
  add(box_faces({0, 0, 0}, {3, 4, 2}, true), false);
  add(box_faces({1, 1, 0}, {2, 2, 1}, false), false);  // stands on the floor
  add(sphere_faces({2.2, 3, 1}, 0.4, 1, false), false);
  add({parallelogram({0.2, 2.5, 0.5}, {1, 0, 0.3}, {0, 0.5, 0.5})}, true);
  const MonteCarlo reference(scene, 2);
  int64_t sealed = 0;
  for (int64_t i = 0; i < static_cast<int64_t>(scene.size()); ++i) {
    for (int side = 0; side < scene[i].sides(); ++side) {
      const Estimate e = reference.at_point({i, side}, 0.3, 0.3, 16, 250);
      if (e.black + e.escaped == 1) {
        CHECK_EQUAL(sum(e.mean), 0.0);
        ++sealed;
        continue;
      }
      CHECK_EQUAL(e.black + e.escaped, 0.0);
      for (int b = 0; b < 3; ++b) CHECK_NEAR(e.mean[b], 1, 5 * std::sqrt(e.variance[b]) + 1e-9);
      CHECK(e.variance[0] < 1e-3);
    }
  }
  // The bottom of the box, and the floor beneath it: at (1.8, 1.2).
  CHECK_EQUAL(sealed, 3);
  CHECK_EQUAL(reference.at_point({8, 0}, 0.3, 0.3, 8, 100).black, 1.0);
  CHECK_EQUAL(reference.at_point({8, 0}, 0.7, 0.1, 8, 100).black, 0.0);
}

// Two wide plates close together leave (E1 + rho1 E2) / (1 - rho1 rho2); bands don't mix.
void plates_close_together() {
  std::vector<Surface> scene;
  Spectrum reflectance, lit;
  reflectance[0] = 0.8, reflectance[1] = 0.3, reflectance[2] = 0;
  lit[0] = 1, lit[1] = 2;
  add_polygon(scene, parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), reflectance, gray(0));
  add_polygon(scene, parallelogram({0, 0, 0.002}, {0, 1, 0}, {1, 0, 0}), gray(0.5), lit);
  const MonteCarlo reference(scene, 4);
  const Estimate e = reference.at_point({0, 0}, 0.45, 0.1, 32, 2000);
  for (int b = 0; b < 2; ++b) {
    const double exact = lit[b] / (1 - 0.5 * reflectance[b]);
    CHECK(e.variance[b] < 1e-4 * exact * exact);
    CHECK_NEAR(e.mean[b], exact, 4 * std::sqrt(e.variance[b]) + 1e-4 * exact);
  }
  CHECK_EQUAL(e.mean[2] + e.mean[3], 0.0);
}

// A blocker hides one half of an emitter and gives nothing back.
void a_blocker_hides() {
  std::vector<Surface> scene;
  add_polygon(scene, parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), gray(0.5), gray(0));
  add_polygon(scene, parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0}), gray(0), gray(1));
  add_polygon(scene, parallelogram({0, 0, 0.5}, {0.5, 0, 0}, {0, 1, 0}), gray(0), gray(0));
  scene[4].blocker = scene[5].blocker = true;
  const MonteCarlo reference(scene, 6);
  const Vector p = scene[0].at(0.5, 0.25);  // (0.75, 0.25): the blocker's shadow ends at x = 0.25
  check_estimate(
      reference.at_point({0, 0}, 0.5, 0.25, 32, 1000),
      point_to_polygon(p, {0, 0, 1}, parallelogram({0.25, 0, 1}, {0, 1, 0}, {0.75, 0, 0})), 0.002);
  CHECK_EQUAL(scene[4].sides(), 0);
}

// Coincident triangles of opposite winding make a sheet: each shows its own front.
void a_sheet_of_two_windings() {
  std::vector<Surface> scene;
  const Vector a = {0, 0, 0}, b = {1, 0, 0}, c = {0, 1, 0}, up = {0, 0, 1};
  scene.push_back(triangle(a, b, c, gray(0.5), gray(1)));
  scene.push_back(triangle(c, b, a, gray(0.5), gray(3)));
  scene.push_back(triangle(a + up, c + up, b + up, gray(0), gray(0)));
  scene.push_back(triangle(a - up, b - up, c - up, gray(0), gray(0)));
  const MonteCarlo reference(scene, 7);
  const Polygon sheet = {a, b, c}, under = {c, b, a};
  check_estimate(reference.at_point({2, 0}, 0.3, 0.3, 32, 500),
                 point_to_polygon(scene[2].at(0.3, 0.3), {0, 0, -1}, sheet), 0.002);
  check_estimate(reference.at_point({3, 0}, 0.3, 0.3, 32, 500),
                 3 * point_to_polygon(scene[3].at(0.3, 0.3), {0, 0, 1}, under), 0.006);
}

void sides_share_the_paths_by_need() {
  std::vector<Surface> scene;
  for (const Polygon& f : box_faces({0, 0, 0}, {2, 2, 2}, true))
    add_polygon(scene, f, gray(0.5), gray(scene.empty() ? 1 : 0));
  const MonteCarlo reference(scene, 8);
  const std::vector<Side> sides = {{4, 0}, {5, 0}, {8, 0}};
  const std::vector<Estimate> few = reference.over_sides(sides, 20000);
  const std::vector<Estimate> many = reference.over_sides(sides, 320000);
  for (size_t i = 0; i < sides.size(); ++i) {
    CHECK(many[i].variance[0] < few[i].variance[0] / 3);
    CHECK_NEAR(few[i].mean[0], many[i].mean[0],
               4 * std::sqrt(few[i].variance[0] + many[i].variance[0]));
  }
  // The same seed gives the same numbers.
  CHECK_EQUAL(reference.over_sides(sides, 20000)[1].mean[0], few[1].mean[0]);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(the_tree_finds_the_nearest_of_all),
      HRAD_TEST(view_factors),
      HRAD_TEST(a_furnace_of_many_reflectances),
      HRAD_TEST(plates_close_together),
      HRAD_TEST(a_blocker_hides),
      HRAD_TEST(a_sheet_of_two_windings),
      HRAD_TEST(sides_share_the_paths_by_need),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
