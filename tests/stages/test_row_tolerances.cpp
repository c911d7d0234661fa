// What the mesh of rows is fine for: light that varies along narrow patches, and light that is
// there, however much more goes where it does nothing.
#include <cmath>
#include <vector>

#include "stages/rows_bench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// A black room of 4 x 3 x 2.5 with a lamp under the ceiling and a screen under that; a strip stands
// upright by a wall, as narrow as a cable, of which the screen hides the most.
constexpr double lamp_height = 2.4, strip_height = 2.4;

Scene room_with_a_strip() {
  Scene scene;
  add_box(scene, {0, 0, 0}, {4, 3, 2.5}, true);
  const int32_t black = scene.add_material({"black", {0, 0, 0}, {0, 0, 0}});
  const int32_t lamp = scene.add_material({"lamp", {0, 0, 0}, {50, 50, 50}});
  const auto rectangle = [&](Vec3 a, Vec3 b, Vec3 c, int32_t material) {
    const int32_t first = scene.add_vertex(a);
    scene.add_vertex(b);
    scene.add_vertex(c);
    scene.add_vertex(a + c - b);
    scene.add_patch(first, first + 1, first + 2, material);
    scene.add_patch(first, first + 2, first + 3, material);
  };
  rectangle({1.9, 1.6, lamp_height}, {2.1, 1.6, lamp_height}, {2.1, 1.4, lamp_height}, lamp);
  rectangle({1.2, 0.5, 2}, {1.2, 2.5, 2}, {3.6, 2.5, 2}, black);
  rectangle({0.1, 1.5, 0.02}, {0.1, 1.504, 0.02}, {0.1, 1.504, strip_height}, black);
  set_light(scene, 0, 12, 0, 0);
  return scene;
}

// Irradiance of the strip at a height by the lamp, sampled finely.
double light_on_the_strip(const Rows& rows, double z) {
  constexpr int n = 64;
  const VisibilityEngine& engine = *rows.bench.engine;
  const Vec3 x{0.1, 1.502, z}, normal{1, 0, 0}, down{0, 0, -1};
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 y{1.9 + 0.2 * (i + 0.5) / n, 1.4 + 0.2 * (j + 0.5) / n, lamp_height};
      const Vec3 d = y - x;
      const double square = dot(d, d);
      SegmentPacket packet;
      packet.set(0, x + normal * engine.offset() - engine.center(),
                 y + down * engine.offset() - engine.center());
      packet.active = 1;
      if (engine.blocked(packet) == 0)
        sum += dot(d, normal) * -dot(d, down) / (pi * square * square);
    }
  return 50 * 0.2 * 0.2 * sum / (n * n);
}

void light_along_a_strip_is_followed() {
  Rows rows(room_with_a_strip());
  CHECK(rows.link());
  const State& state = rows.bench.state;
  const int64_t strip = rows.bench.scene.patch_count() - 2;
  double found = 0, area = 0, wanted = 0;
  int64_t leaves = 0;
  for (NodeId leaf : state.forest.leaves()) {
    const Node& node = state.forest.nodes[leaf];
    if (state.forest.surfaces[node.surface].patch < strip) continue;
    const double a = state.forest.area(node);
    for (const Link& link : state.direct.mean[leaf].links()) found += a * link.weight * 50;
    area += a;
    ++leaves;
  }
  constexpr int heights = 400;
  for (int k = 0; k < heights; ++k)
    wanted +=
        light_on_the_strip(rows, 0.02 + (strip_height - 0.02) * (k + 0.5) / heights) / heights;
  CHECK(wanted > 0.005);
  CHECK(leaves >= 32);
  CHECK_NEAR(found / area, wanted, 0.1 * wanted);
}

// The length of narrow patches divides no more of them than a scene can bear.
void very_many_strips_stay_whole() {
  Scene scene;
  add_box(scene, {0, 0, 0}, {4, 3, 2.5}, true);
  const int64_t first = scene.patch_count();
  const int32_t grey = scene.add_material({"grey", {0.5, 0.5, 0.5}, {0, 0, 0}});
  for (int k = 0; k < 20000; ++k) {
    const double x = 0.5 + 3.0 * k / 20000;
    const int32_t a = scene.add_vertex({x, 0.5, 1});
    scene.add_vertex({x + 1e-5, 0.5, 1});
    scene.add_vertex({x, 2.5, 1});
    scene.add_patch(a, a + 1, a + 2, grey);
  }
  set_light(scene, 0, first, 0, 0.5);
  set_light(scene, 0, 1, 10, 0.5);
  Rows rows(std::move(scene));
  rows.settings.rays_of_cell = rows.settings.least_rays = 4;
  CHECK(rows.link());
  CHECK(rows.bench.state.cells.size() < 60000);
}

int64_t leaves_of_room(const Rows& rows, int64_t patches) {
  int64_t count = 0;
  const Forest& forest = rows.bench.state.forest;
  for (NodeId leaf : forest.leaves())
    count += forest.surfaces[forest.nodes[leaf].surface].patch < patches;
  return count;
}

// A lamp in a closed black box brings nothing, but has forty times the power of the other one.
void power_that_does_nothing_coarsens_nothing() {
  const auto room = [](bool with_hidden_lamp) {
    Scene scene = room_with_lamp();
    if (with_hidden_lamp) {
      const int64_t box = scene.patch_count();
      add_box(scene, {5, 0, 0}, {6, 1, 1}, true);
      set_light(scene, box, 12, 0, 0);
      set_light(scene, box, 2, 300, 0);
    }
    return scene;
  };
  Rows alone(room(false)), with(room(true));
  with.settings.cell_area = alone.settings.cell_area;
  CHECK(alone.link() && with.link());
  const int64_t patches = alone.bench.scene.patch_count();
  CHECK(leaves_of_room(alone, patches) > 1500);
  CHECK(leaves_of_room(with, patches) > 0.5 * leaves_of_room(alone, patches));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(light_along_a_strip_is_followed),
      HRAD_TEST(very_many_strips_stay_whole),
      HRAD_TEST(power_that_does_nothing_coarsens_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
