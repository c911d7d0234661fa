// Closed solids: what has an inside, and how large it is.
#include "scene/solids.h"
#include "support/check.h"

using hrad::Scene;
using hrad::Solids;
using hrad::Vec3;

namespace {

// Adds the 12 triangles of a box, each with vertices of its own; fronts outward, or inward.
void add_box(Scene& scene, Vec3 low, Vec3 high, bool outward = true, int32_t material = 0) {
  const int corners[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                              {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto& triangle : corners) {
    int32_t v[3];
    for (int k = 0; k < 3; ++k) {
      const int i = triangle[k];
      v[k] = scene.add_vertex(
          {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    }
    scene.add_patch(v[0], v[outward ? 1 : 2], v[outward ? 2 : 1], material);
  }
}

Scene empty_scene() {
  Scene scene;
  scene.add_material({});
  hrad::Material blocker, two_sided;
  blocker.blocker = true;
  two_sided.two_sided = true;
  scene.add_material(blocker);
  scene.add_material(two_sided);
  return scene;
}

void check_components(const Solids& solids, const std::vector<double>& volumes) {
  CHECK_EQUAL(solids.closed.size(), volumes.size());
  CHECK_EQUAL(solids.volume.size(), volumes.size());
  CHECK_EQUAL(solids.box.size(), volumes.size());
  for (size_t i = 0; i < volumes.size(); ++i) {
    CHECK_EQUAL(solids.closed[i] != 0, volumes[i] != 0);
    CHECK_NEAR(solids.volume[i], volumes[i], 1e-12 * std::fabs(volumes[i]));
  }
}

void boxes_inside_out_and_outside_in() {
  Scene scene = empty_scene();
  add_box(scene, {0, 0, 0}, {5, 4, 3}, false);
  add_box(scene, {1, 1, 1}, {2, 3, 1.5});
  add_box(scene, {3, 3, 1}, {4, 3.5, 2}, true, 1);
  const Solids solids = hrad::find_solids(scene);
  check_components(solids, {-60, 1, 0.5});
  for (int i = 0; i < 36; ++i) CHECK_EQUAL(solids.component[i], i / 12);
  CHECK_EQUAL(solids.box[1].low.x, 1.0);
  CHECK_EQUAL(solids.box[1].high.y, 3.0);
}

void one_wrong_patch_opens_a_solid() {
  Scene missing = empty_scene();
  add_box(missing, {0, 0, 0}, {1, 1, 1});
  missing.flags[5] |= hrad::patch_dropped;
  Solids solids = hrad::find_solids(missing);
  check_components(solids, {0});
  CHECK_EQUAL(solids.component[5], -1);
  CHECK_EQUAL(solids.component[4], 0);

  Scene turned = empty_scene();
  add_box(turned, {0, 0, 0}, {1, 1, 1});
  std::swap(turned.corners[7][0], turned.corners[7][1]);
  check_components(hrad::find_solids(turned), {0});

  Scene two_sided = empty_scene();
  add_box(two_sided, {0, 0, 0}, {1, 1, 1});
  two_sided.flags[3] |= hrad::patch_two_sided;
  check_components(hrad::find_solids(two_sided), {0});

  Scene fin = empty_scene();
  add_box(fin, {0, 0, 0}, {1, 1, 1});
  const int32_t tip = fin.add_vertex({0, 0, 2});
  fin.add_patch(fin.corners[4][0], fin.corners[4][1], tip, 0);
  check_components(hrad::find_solids(fin), {0});
}

void solids_that_touch_stay_apart() {
  Scene scene = empty_scene();
  add_box(scene, {0, 0, 0}, {1, 1, 1});
  add_box(scene, {1, 1, 0}, {2, 2, 1});  // along an edge
  add_box(scene, {2, 2, 1}, {4, 3, 2});  // in a corner
  add_box(scene, {0, 0, 1}, {1, 1, 3});  // on the first one, face to face
  check_components(hrad::find_solids(scene), {1, 1, 2, 2});
}

void rooms_and_furniture_in_contact() {
  // Two rooms with a common wall: one large room, and a sheet that divides it.
  Scene rooms = empty_scene();
  add_box(rooms, {0, 0, 0}, {1, 1, 1}, false);
  add_box(rooms, {1, 0, 0}, {3, 1, 1}, false);
  check_components(hrad::find_solids(rooms), {-3, 0});
  // Four boxes around one edge, and a stack whose contact is cut along the other diagonal.
  Scene boxes = empty_scene();
  for (int i = 0; i < 4; ++i)
    add_box(boxes, {i % 2 - 1.0, i / 2 - 1.0, 0}, {i % 2 + 0.0, i / 2 + 0.0, 1});
  check_components(hrad::find_solids(boxes), {1, 1, 1, 1});
  Scene stack = empty_scene();
  add_box(stack, {0.1, 0.1, 0.1}, {0.7, 0.9, 0.3});
  add_box(stack, {0.1, 0.1, 0.3}, {0.7, 0.9, 0.8});
  const auto first = stack.corners[12], second = stack.corners[13];  // corners 0 2 1 and 1 2 3
  stack.corners[12] = {first[0], first[1], second[2]};
  stack.corners[13] = {first[0], second[2], first[2]};
  const Solids stacked = hrad::find_solids(stack);
  CHECK_EQUAL(stacked.closed.size(), size_t{2});
  CHECK_NEAR(stacked.volume[0], 0.096, 1e-15);
  CHECK_NEAR(stacked.volume[1], 0.24, 1e-15);
}

void sheets_are_no_solids() {
  Scene scene = empty_scene();
  const int32_t a = scene.add_vertex({0, 0, 0}), b = scene.add_vertex({1, 0, 0.3}),
                c = scene.add_vertex({1, 1, 0.7}), d = scene.add_vertex({0, 1, 0.1});
  scene.add_patch(a, b, c, 0);
  scene.add_patch(a, c, d, 0);
  scene.add_patch(a, c, b, 0);
  scene.add_patch(a, d, c, 0);
  const Solids solids = hrad::find_solids(scene);
  for (uint8_t closed : solids.closed) CHECK_EQUAL(closed, 0);
  for (double volume : solids.volume) CHECK_EQUAL(volume, 0.0);
}

void a_thin_plate_is_a_solid() {
  Scene scene = empty_scene();
  add_box(scene, {100, 100, 100}, {101, 101, 100.0001});
  const Solids solids = hrad::find_solids(scene);
  CHECK_EQUAL(solids.closed[0], 1);
  CHECK_NEAR(solids.volume[0], 1e-4, 1e-13);
}

void components_are_numbered_by_their_lowest_patch() {
  Scene scene = empty_scene();
  add_box(scene, {0, 0, 0}, {1, 1, 1});
  add_box(scene, {2, 0, 0}, {3, 1, 1});
  // Interleave the two.
  Scene mixed = scene;
  for (int i = 0; i < 12; ++i) {
    mixed.corners[2 * i] = scene.corners[12 + i];
    mixed.corners[2 * i + 1] = scene.corners[i];
  }
  const Solids solids = hrad::find_solids(mixed);
  check_components(solids, {1, 1});
  for (int i = 0; i < 24; ++i) CHECK_EQUAL(solids.component[i], i % 2);
  CHECK_EQUAL(solids.box[0].low.x, 2.0);
}

void an_empty_scene() {
  const Solids solids = hrad::find_solids(Scene{});
  CHECK(solids.component.empty() && solids.closed.empty());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(boxes_inside_out_and_outside_in),
      HRAD_TEST(one_wrong_patch_opens_a_solid),
      HRAD_TEST(solids_that_touch_stay_apart),
      HRAD_TEST(rooms_and_furniture_in_contact),
      HRAD_TEST(sheets_are_no_solids),
      HRAD_TEST(a_thin_plate_is_a_solid),
      HRAD_TEST(components_are_numbered_by_their_lowest_patch),
      HRAD_TEST(an_empty_scene),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
