// Light straight from emitters, against Lambert's formula, and who counts as one.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "links/direct_light.h"
#include "links/form_factor.h"
#include "links/lit.h"

namespace {

using namespace hrad;
using namespace hrad_test;

double exact(const Scene& scene, Vec3 x, Vec3 normal) {
  return point_to_triangle(x, normal, scene.triangle(2)) +
         point_to_triangle(x, normal, scene.triangle(3));
}

void unoccluded_light_is_lamberts() {
  for (double side : {1e-6, 0.01, 0.05, 0.15, 0.3, 2.0, 6.0}) {
    Lit lit(floor_and_lamp(side));
    CHECK_EQUAL(lit.emitters.all().size(), size_t{1});
    for (const Vec3& x : {Vec3{0.1, 0.2, 0}, Vec3{1, -0.7, 0}, Vec3{4.9, 4.8, 0}}) {
      const double wanted = side < 1e-3 ? side * side / pi / std::pow(dot(x, x) + 1, 2)
                                        : exact(lit.bench.scene, x, up);
      CHECK_NEAR(lit.at(x, up), wanted, 2e-3 * wanted);
    }
  }
}

void behind_a_horizon_there_is_none() {
  Lit lit(floor_and_lamp(0.3));
  CHECK_EQUAL(lit.at({0.1, 0.2, 0}, -up), 0.0);  // looks away
  CHECK_EQUAL(lit.at({0.1, 0.2, 2}, -up), 0.0);  // sees its back
  // A wall through the middle of the lamp sees one half of it, whichever way it looks.
  const Vec3 x{0, 3, 0.5}, left{-1, 0, 0};
  CHECK_NEAR(lit.at(x, left) + lit.at(x, -left), 2 * exact(lit.bench.scene, x, left),
             0.02 * exact(lit.bench.scene, x, left));
}

// A plate hides all of the lamp with x < 0; the mean over points of the floor below its edge.
void half_a_lamp_is_hidden() {
  Scene scene = floor_and_lamp(0.5);
  add_quad(scene, {-3, -3, 0.999}, {3, 0, 0}, {0, 6, 0});
  Lit lit(scene);
  double sum = 0, wanted = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 x{0, -2 + 0.02 * k, 0};
    sum += lit.at(x, up, static_cast<uint64_t>(k));
    wanted += exact(lit.bench.scene, x, up) / 2;
  }
  CHECK_NEAR(sum, wanted, 0.01 * wanted);
}

// Half way up to the lamp a plate hides all with x < 0: from a point of the floor as much of the
// lamp is seen as lies beyond the point mirrored. RMS over the penumbra, relative to the lamp.
void a_penumbra_has_no_steps() {
  for (double side : {0.5, 2.0}) {  // afar, and so near that its parts are sampled
    Scene scene = floor_and_lamp(side);
    add_quad(scene, {-5, -5, 0.5}, {5, 0, 0}, {0, 10, 0});
    Lit strong(scene);
    const Emitter& lamp = strong.emitters.all().front();
    Lit weak(scene, 0.05 * lamp.brightness * Emitters::rough_factor(lamp, {0, 0.3, 0}, up));
    constexpr int points = 100;
    double of_strong = 0, of_weak = 0, all = 0;
    for (int k = 0; k < points; ++k) {
      const double seen = side * (k + 0.5) / points;
      const Vec3 x{seen - side / 2, 0.3, 0};
      Scene part;
      add_quad(part, {side / 2 - seen, -side / 2, 1}, {0, side, 0}, {seen, 0, 0});
      const double wanted =
          point_to_triangle(x, up, part.triangle(0)) + point_to_triangle(x, up, part.triangle(1));
      of_strong += std::pow(strong.at(x, up) - wanted, 2);
      of_weak += std::pow(weak.at(x, up) - wanted, 2);
      all += std::pow(exact(scene, x, up), 2);
      CHECK(strong.rays <= 128 && weak.rays <= 32);
    }
    CHECK(std::sqrt(of_strong / all) < 0.02);
    CHECK(std::sqrt(of_weak / all) < 0.06);
    // What is wholly seen or hidden needs no closer look.
    strong.at({3, 0.3, 0}, up);
    CHECK(strong.rays <= 32);
    strong.at({-3, 0.3, 0}, up);
    CHECK(strong.rays <= 32);
  }
}

// A plate pressed against the lamp from x on: what is left shines, not so many sixteenths of it;
// how much is left is measured to a fiftieth.
void what_is_sealed_of_a_lamp_sends_nothing() {
  for (double x : {0.14, 0.12, 0.06, 0.0}) {
    Scene scene = floor_and_lamp(0.3), rest;
    add_box(scene, {x, -1, 0.9999}, {1, 1, 1});
    add_quad(rest, {-0.15, -0.15, 1}, {0, 0.3, 0}, {x + 0.15, 0, 0});
    for (const Vec3& place : {Vec3{0.1, 0.2, 0}, Vec3{1, -0.7, 0}, Vec3{-2, 1, 0}}) {
      Lit lit(scene);
      const double wanted = point_to_triangle(place, up, rest.triangle(0)) +
                            point_to_triangle(place, up, rest.triangle(1));
      CHECK_NEAR(lit.at(place, up), wanted, 0.02 * wanted);
    }
  }
}

// A lamp that is pressed against another surface all over is none.
void a_sealed_lamp_is_no_emitter() {
  Scene scene = floor_and_lamp(0.3);
  add_box(scene, {-1, -1, 0.99}, {1, 1, 1});
  CHECK(Lit(scene).emitters.all().empty());
}

// Weak light takes one ray: any single answer is all or nothing, their mean is right.
void few_rays_are_unbiased() {
  Scene scene = floor_and_lamp(0.5);
  add_quad(scene, {-3, -3, 0.999}, {3, 0, 0}, {0, 6, 0});
  Lit lit(scene, 1e6);
  const Vec3 x{0, 1.5, 0};
  double sum = 0, squares = 0;
  constexpr int keys = 4000;
  for (int k = 0; k < keys; ++k) {
    const double value = lit.at(x, up, static_cast<uint64_t>(k));
    CHECK_EQUAL(lit.rays, int64_t{1});
    sum += value;
    squares += value * value;
  }
  const double mean = sum / keys, error = std::sqrt((squares / keys - mean * mean) / keys);
  const double wanted = exact(lit.bench.scene, x, up) / 2;
  CHECK_NEAR(mean, wanted, 4 * error + 0.02 * wanted);
}

// What shines no brighter than all else is left to the rays.
void a_furnace_has_no_bright_emitters() {
  Scene scene = builtin_scene("furnace");
  Lit lit(scene);
  CHECK_EQUAL(lit.emitters.all().size(), size_t{0});
}

// Faces of one polygon are one emitter; those in another plane or of another colour are not.
void faces_are_joined() {
  Scene scene;
  add_quad(scene, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
  add_quad(scene, {0, 0, 3}, {0, 1, 0}, {1, 0, 0});
  add_quad(scene, {5, 0, 3}, {0, 1, 0}, {1, 0, 0.5});
  make_last_emit(scene, 4, 100);
  add_quad(scene, {9, 0, 3}, {0, 1, 0}, {1, 0, 0});
  make_last_emit(scene, 1, 70);
  make_last_emit(scene, 1, 90);
  const Lit lit(scene);
  CHECK_EQUAL(lit.emitters.of_node(0), -1);
  CHECK_EQUAL(lit.emitters.of_node(2), lit.emitters.of_node(3));
  CHECK(lit.emitters.of_node(2) != lit.emitters.of_node(4));
  CHECK_EQUAL(lit.emitters.of_node(4), lit.emitters.of_node(5));
  for (const Emitter& e : lit.emitters.all())
    for (size_t k = 0; k < Emitter::point_count; ++k)
      CHECK(length(e.point(k) - e.center) <= e.radius * (1 + 1e-6));
}

// A cube of the grid knows every emitter that is sampled at one of its points.
void the_grid_misses_none() {
  for (double least : {1e-3, 1.0, 30.0}) {
    Lit lit(floor_and_lamp(0.4), 1, least);
    const Emitter& lamp = lit.emitters.all().front();
    Random random(3);
    int bright = 0, dim = 0;
    for (int k = 0; k < 4000; ++k) {
      const Vec3 center = random.in_cube(6), direction = normalized(random.in_cube(1));
      const double radius = 0.1 + random.unit();
      const Vec3 x = center + random.in_cube(1) * (radius / 1.7321);
      const bool is = lit.emitters.is_sampled(lamp, Emitters::rough_factor(lamp, x, direction));
      (is ? bright : dim) += 1;
      if (is) CHECK(lit.emitters.is_sampled(lamp, Emitters::largest_factor(lamp, center, radius)));
    }
    CHECK(bright > 20 && dim > 20);
  }
}

// From under a lid no pilot ray meets the lamp; beside it some do.
void pilot_rays_tell_what_is_hidden() {
  Scene scene = floor_and_lamp(0.3);
  add_quad(scene, {-5, -5, 0.5}, {5, 0, 0}, {0, 10, 0});
  Lit lit(scene);
  const OrientedPoint under{{-2.5, 0.3, 0}, up}, beside{{2.5, 0.3, 0}, up};
  open(lit.grid, {under, beside}, lit.bench);
  CHECK_EQUAL(lit.grid.at(under).size(), size_t{1});
  CHECK(lit.grid.at(under).front().hidden);
  CHECK(!lit.grid.at(beside).front().hidden);
}

// What may come all the same from a weak lamp that no pilot ray met is left to the receiver's rays:
// both by its cube alone and by all that lie around it.
void what_is_hidden_and_weak_has_no_links() {
  Scene scene = floor_and_lamp(0.3);
  add_quad(scene, {-5, -5, 0.5}, {5, 0, 0}, {0, 10, 0});
  const OrientedPoint under{{-2.5, 0.3, 0}, up}, beside{{2.5, 0.3, 0}, up};
  const Lit any(scene);
  const Emitter& lamp = any.emitters.all().front();
  const double light =
      lamp.brightness * lamp.brightness * Emitters::rough_factor(lamp, under.place, up);
  Lit lit(scene, 1e-6, light / 4);
  open(lit.grid, {under, beside}, lit.bench);
  CHECK(lit.emitters.bright(lamp, under.place, up));
  CHECK(lit.grid.at(under).empty());
  CHECK(!lit.grid.by_links(0, under, lit.grid.at(under)));
  CHECK_EQUAL(lit.grid.at(beside).size(), size_t{1});
  CHECK(lit.grid.by_links(0, beside, lit.grid.at(beside)));
  // Strong as it is, it keeps its links, and its few rays, where it is hidden.
  Lit strong(scene, 1e-6, light / 100);
  open(strong.grid, {under, beside}, strong.bench);
  CHECK(strong.grid.by_links(0, under, strong.grid.at(under)));
}

// From the edge of a lid half of the lamp is seen, though no pilot ray met it from farther below:
// one ray for every eighth key, and the mean of all is right.
void what_is_hidden_is_looked_at_by_chance() {
  Scene scene = floor_and_lamp(0.3);
  add_quad(scene, {-5, -5, 0.5}, {5, 0, 0}, {0, 10, 0});
  Lit lit(scene, 1e6);
  const Vec3 x{-0.001, 0.3, 0};
  open(lit.grid, {{{-0.6, 0.3, 0}, up}}, lit.bench);
  CHECK(lit.grid.at({x, up}).front().hidden);
  const double wanted = exact(lit.bench.scene, x, up) / 2;
  double sum = 0, squares = 0, traced = 0;
  constexpr int keys = 20000;
  for (int k = 0; k < keys; ++k) {
    const double value = lit.at(x, up, static_cast<uint64_t>(k));
    CHECK(lit.rays <= 1);
    traced += static_cast<double>(lit.rays);
    sum += value;
    squares += value * value;
  }
  const double mean = sum / keys, error = std::sqrt((squares / keys - mean * mean) / keys);
  CHECK_NEAR(mean, wanted, 4 * error + 0.02 * wanted);
  CHECK(error < 0.1 * wanted);
  CHECK_NEAR(traced / keys, 0.125, 0.01);
  // A mesh is shown no more than the lamp brings.
  int seen = 0;
  for (uint64_t key = 0; key < 200; ++key) {
    std::vector<Link> links;
    lit.light.sample({x, up}, key, links);
    double shown = 0;
    for (const Link& link : links)
      shown += static_cast<double>(link.weight) * lit.expected.of_node[link.source];
    const double light =
        lit.light.light_of({x, up}, {links.data(), links.size()}, lit.expected.of_node);
    CHECK_NEAR(light, 0.125 * shown, 1e-12 * shown);
    seen += shown > 0;
  }
  CHECK(seen > 3 && seen < 40);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(unoccluded_light_is_lamberts),
      HRAD_TEST(behind_a_horizon_there_is_none),
      HRAD_TEST(half_a_lamp_is_hidden),
      HRAD_TEST(a_penumbra_has_no_steps),
      HRAD_TEST(what_is_sealed_of_a_lamp_sends_nothing),
      HRAD_TEST(a_sealed_lamp_is_no_emitter),
      HRAD_TEST(few_rays_are_unbiased),
      HRAD_TEST(a_furnace_has_no_bright_emitters),
      HRAD_TEST(faces_are_joined),
      HRAD_TEST(the_grid_misses_none),
      HRAD_TEST(pilot_rays_tell_what_is_hidden),
      HRAD_TEST(what_is_hidden_and_weak_has_no_links),
      HRAD_TEST(what_is_hidden_is_looked_at_by_chance),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
