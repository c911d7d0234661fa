// Many emitters seen as one from afar.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "links/form_factor.h"
#include "links/lit.h"

namespace {

using namespace hrad;
using namespace hrad_test;

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
      HRAD_TEST(groups_hold_every_emitter_once),
      HRAD_TEST(groups_shine_alike),
      HRAD_TEST(a_cube_sees_every_lamp_once),
      HRAD_TEST(groups_bring_what_their_lamps_bring),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
