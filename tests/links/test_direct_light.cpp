// Light straight from emitters, against Lambert's formula, and who counts as one.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "links/direct_light.h"
#include "links/form_factor.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

void open(LightGrid& grid, const std::vector<OrientedPoint>& points, Workbench& bench) {
  int64_t rays = 0;
  const auto opener = [&](std::vector<LightGrid::Opened>& cubes,
                          const std::function<void(size_t)>& find) {
    return bench.team.for_each(static_cast<int64_t>(cubes.size()),
                               [&](int64_t k, int) { find(static_cast<size_t>(k)); });
  };
  CHECK(grid.open(points, bench.team, bench.comm, opener, rays));
}

State& with_exposed_shares(Workbench& bench) {
  const LinkSampler sampler = bench.sampler();
  for (Node& node : bench.state.forest.nodes) node.exposed = sampler.exposed_share(node);
  return bench.state;
}

// A scene with its emitters as linking by rows sees them.
struct Lit {
  explicit Lit(Scene s, double noise = 1e-6, double least_bright = 1e-9)
      : bench(std::move(s)),
        expected(expected_brightness(with_exposed_shares(bench))),
        emitters(bench.state.forest, bench.exposure, expected.of_node, least_bright),
        grid(emitters, *bench.engine, 0.7, 8 * noise),
        light(bench.state.forest, *bench.engine, emitters, grid, noise) {}

  double at(Vec3 x, Vec3 normal, uint64_t key = 1) {
    open(grid, {{x, normal}}, bench);
    std::vector<Link> links;
    rays = light.sample({x, normal}, key, links);
    double sum = 0;
    for (const Link& link : links) sum += link.weight;
    return sum;
  }

  Workbench bench;
  Brightness expected;
  Emitters emitters;
  LightGrid grid;
  DirectLight light;
  int64_t rays = 0;
};

// The same with groups.
struct LitByGroups : Lit {
  explicit LitByGroups(Scene s, double noise) : Lit(std::move(s), noise) {
    emitters.join(bench.state.forest, bench.exposure);
  }
};

void make_last_emit(Scene& scene, int64_t patches, double emission) {
  const size_t first = scene.emission.size() - static_cast<size_t>(patches * scene.bands);
  for (size_t k = first; k < scene.emission.size(); ++k) scene.emission[k] = emission;
}

// A floor of side 10 under a square lamp of side `side` at height 1, which shines down.
Scene floor_and_lamp(double side) {
  Scene scene;
  add_quad(scene, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0});
  add_quad(scene, {-side / 2, -side / 2, 1}, {0, side, 0}, {side, 0, 0});
  make_last_emit(scene, 2, 100);
  return scene;
}

double exact(const Scene& scene, Vec3 x, Vec3 normal) {
  return point_to_triangle(x, normal, scene.triangle(2)) +
         point_to_triangle(x, normal, scene.triangle(3));
}

const Vec3 up{0, 0, 1};

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

// Lamps in two rows over one end of a long floor, in two heights; a plate hides one row from most
// of the floor.
Scene floor_and_many_lamps() {
  Scene scene;
  add_quad(scene, {0, -2, 0}, {60, 0, 0}, {0, 4, 0});
  for (int k = 0; k < 24; ++k) {
    add_quad(scene, {0.7 * (k / 2), k % 2 ? 1.0 : -1.0, 3 + 0.1 * (k % 3)}, {0, 0.2, 0},
             {0.2, 0, 0});
    make_last_emit(scene, 2, 100);
  }
  add_quad(scene, {0, 0, 2.9}, {12, 0, 0}, {0, 5, 0});
  return scene;
}

// The same with a plate pressed against a quarter of each lamp.
Scene floor_and_many_pressed_lamps() {
  Scene scene = floor_and_many_lamps();
  for (int k = 0; k < 24; ++k) {
    const Vec3 low{0.7 * (k / 2) + 0.15, k % 2 ? 1.0 : -1.0, 3 + 0.1 * (k % 3)};
    add_box(scene, low - Vec3{0, 0, 1e-4}, low + Vec3{0.05, 0.2, 0});
  }
  return scene;
}

// Groups fall into smaller ones and single emitters, each in one; lamps of another plane apart.
void groups_hold_every_emitter_once() {
  LitByGroups lit(floor_and_many_lamps(), 1e-3);
  const std::vector<Emitter>& all = lit.emitters.all();
  std::vector<int> met(all.size(), 0);
  std::vector<int32_t> stack = lit.emitters.tops();
  int groups = 0;
  while (!stack.empty()) {
    const int32_t number = stack.back();
    stack.pop_back();
    ++met[number];
    const Emitter& e = all[number];
    std::vector<int32_t> below;
    for (int32_t part : e.parts) {
      CHECK_EQUAL(all[part].group, number);
      stack.push_back(part);
      if (all[part].members.empty())
        below.push_back(part);
      else
        below.insert(below.end(), all[part].members.begin(), all[part].members.end());
    }
    if (e.members.empty()) {
      CHECK_EQUAL(e.cluster, -1);
      continue;
    }
    ++groups;
    std::sort(below.begin(), below.end());
    CHECK(below == e.members);
    CHECK_EQUAL(lit.emitters.of_node(e.cluster), number);
    double area = 0;
    for (int32_t member : e.members) area += all[member].area;
    CHECK_NEAR(e.area, area, 1e-12);
    CHECK_NEAR(lit.bench.state.forest.area(lit.bench.state.forest.nodes[e.cluster]), area, 1e-9);
  }
  CHECK(groups > 8);
  for (int count : met) CHECK_EQUAL(count, 1);
}

// Every other lamp twice as bright: none shares a group with one that is not.
void groups_shine_alike() {
  Scene scene = floor_and_many_lamps();
  for (size_t patch = 2; patch < 50; ++patch)
    if (patch / 2 % 2 == 0)
      for (int b = 0; b < scene.bands; ++b) scene.emission[patch * scene.bands + b] *= 2;
  LitByGroups lit(scene, 1e-3);
  int groups = 0;
  for (const Emitter& e : lit.emitters.all())
    for (int32_t member : e.members) {
      CHECK_EQUAL(lit.emitters.all()[member].brightness, e.brightness);
      ++groups;
    }
  CHECK(groups > 0);
}

// What a cube looks at, groups and single lamps together, is every lamp once.
void a_cube_sees_every_lamp_once() {
  LitByGroups lit(floor_and_many_lamps(), 1e-3);
  int groups = 0, singles = 0;
  for (double x : {1.0, 9.0, 20.0, 45.0}) {
    const OrientedPoint point{{x, -0.5, 0}, up};
    open(lit.grid, {point}, lit.bench);
    std::vector<int> met(lit.emitters.all().size(), 0);
    for (const LightGrid::Candidate& candidate : lit.grid.at(point)) {
      const Emitter& e = lit.emitters.all()[candidate.emitter];
      (e.members.empty() ? singles : groups) += 1;
      if (e.members.empty()) ++met[candidate.emitter];
      for (int32_t member : e.members) ++met[member];
    }
    for (size_t e = 0; e < 24; ++e) {
      CHECK_EQUAL(met[e], 1);
      CHECK(lit.grid.by_links(static_cast<int32_t>(e), point, lit.grid.at(point)));
    }
  }
  CHECK(groups > 4 && singles > 4);
}

// Whether by one ray or by sixteen, a group brings on the average what its lamps bring.
void bring_what_their_lamps_bring(const Scene& scene) {
  for (double x : {9.0, 20.0, 45.0}) {
    const Vec3 place{x, -0.5, 0};
    Lit single(scene, 1e-6);
    const double wanted = single.at(place, up);
    for (double noise : {1e6, 0.02}) {
      LitByGroups lit(scene, noise);
      double sum = 0, squares = 0;
      constexpr int keys = 3000;
      for (int k = 0; k < keys; ++k) {
        const double value = lit.at(place, up, static_cast<uint64_t>(k));
        sum += value;
        squares += value * value;
      }
      const double mean = sum / keys, error = std::sqrt((squares / keys - mean * mean) / keys);
      CHECK_NEAR(mean, wanted, 4 * error + 0.02 * wanted);
      CHECK(lit.rays < single.rays);
    }
  }
}

void groups_bring_what_their_lamps_bring() {
  bring_what_their_lamps_bring(floor_and_many_lamps());
  bring_what_their_lamps_bring(floor_and_many_pressed_lamps());
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
      HRAD_TEST(groups_hold_every_emitter_once),
      HRAD_TEST(groups_shine_alike),
      HRAD_TEST(a_cube_sees_every_lamp_once),
      HRAD_TEST(groups_bring_what_their_lamps_bring),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
