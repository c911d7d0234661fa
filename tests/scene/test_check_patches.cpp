// Patches that can't take part: without area, or repeating an earlier one.
#include "base/hash.h"
#include "scene_folder.h"

using hrad::patch_dropped;
using hrad::Scene;
using hrad::Vec3;
using hrad_test::count_diagnostics;

namespace {

// A scene of triangles with vertices of their own.
struct Made {
  Scene scene;
  Made() { scene.add_material({}); }
  void add(Vec3 a, Vec3 b, Vec3 c) {
    const int32_t i = scene.add_vertex(a), j = scene.add_vertex(b), k = scene.add_vertex(c);
    scene.add_patch(i, j, k, 0);
  }
  std::string dropped() const {
    std::string flags;
    for (uint8_t f : scene.flags) flags += f & patch_dropped ? '1' : '0';
    return flags;
  }
};

const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, 0, 1};

void a_good_scene_stays() {
  Made m;
  m.add(a, b, c);
  m.add(a, b, d);
  hrad::check_patches(m.scene, 0);
  CHECK(m.dropped() == "00");
  CHECK(m.scene.diagnostics.empty());
  Scene empty;
  hrad::check_patches(empty, 0);
  CHECK(empty.diagnostics.empty());
}

void without_area() {
  Made m;
  m.add(a, b, c);
  m.add(a, a, b);                                             // two corners in one place
  m.add(c, c, c);                                             // all three
  m.add({.1, .1, .1}, {.2, .2, .2}, {.3, .3, .3});            // on a line, to the last bits
  m.add({1e5, .1, 0}, {1e5 + .1, .2, 0}, {1e5 + .2, .3, 0});  // on a line, far away
  m.add({0, 0, 0}, {1e-13, 0, 0}, {0, 1e-13, 0});             // a point for a scene of this size
  m.add({0, 0, 0}, {1, 0, 0}, {.5, 1e-10, 0});                // thin, but not nothing
  m.scene.add_patch(0, 0, 1, 0);                              // by number
  m.add({1e5, 0, 0}, {1e5, 1e-5, 0}, {1e5, 0, 1e-5});         // small and far away
  hrad::check_patches(m.scene, 0);
  // The large coordinates make the scene large: 1e-13 would be a point in any case.
  CHECK(m.dropped() == "011111010");
  CHECK_EQUAL(count_diagnostics(m.scene, "6 patches without area are dropped (first: patch 1"), 1);
}

void small_scenes_are_scenes() {
  Made m;
  const double s = 1e-20;
  m.add(a * s, b * s, c * s);
  m.add(a * s, b * s, b * (2 * s));
  hrad::check_patches(m.scene, 0);
  CHECK(m.dropped() == "01");
}

void repetitions() {
  Made m;
  m.add(a, b, c);
  m.add(b, c, a);  // the same, begun elsewhere
  m.add(b, c, d);
  m.add(c, a, b);             // the same again
  m.add({-0.0, 0, 0}, b, c);  // -0 is 0
  m.scene.add_patch(0, 1, 2, 0);
  hrad::check_patches(m.scene, 0);
  CHECK(m.dropped() == "010111");
  CHECK_EQUAL(count_diagnostics(m.scene,
                                "4 patches that repeat an earlier one are dropped (first: "
                                "patch 1, as 0)"),
              1);
  CHECK_EQUAL(m.scene.diagnostics.size(), size_t{1});
}

void sheets_stay() {
  Made m;
  m.add(b, c, d);
  m.add(a, b, c);
  m.add(a, c, b);
  m.add(d, c, b);
  m.add(c, b, a);  // repeats patch 2, not patch 1
  hrad::check_patches(m.scene, 0);
  CHECK(m.dropped() == "00001");
  CHECK_EQUAL(count_diagnostics(m.scene, "(first: patch 4, as 2)"), 1);
  CHECK_EQUAL(count_diagnostics(m.scene, "2 pairs of coincident patches of opposite winding"), 1);
  CHECK_EQUAL(count_diagnostics(m.scene, "patches 1 and 2"), 1);
}

void earlier_patches_count_but_are_not_told_again() {
  Made m;
  m.add(a, b, c);
  m.add(a, b, c);
  m.add(a, a, c);
  m.add(d, c, b);
  m.add(b, c, d);
  hrad::check_patches(m.scene, 0);
  CHECK(m.dropped() == "01100");
  m.scene.diagnostics.clear();
  m.add(b, c, d);
  m.add(c, b, a);
  hrad::check_patches(m.scene, 5);
  CHECK(m.dropped() == "0110010");
  CHECK_EQUAL(m.scene.diagnostics.size(), size_t{2});
  CHECK_EQUAL(count_diagnostics(m.scene, "1 patches that repeat"), 1);
  CHECK_EQUAL(count_diagnostics(m.scene, "1 pairs of"), 1);
}

// Against the definition, pair by pair.
void random_triangles() {
  Made m;
  const Vec3 points[] = {a, b, c, d};
  for (int i = 0; i < 200; ++i)
    m.add(points[hrad::mix(i, 1) % 4], points[hrad::mix(i, 2) % 4], points[hrad::mix(i, 3) % 4]);
  hrad::check_patches(m.scene, 0);
  const auto same = [](Vec3 p, Vec3 q) { return p.x == q.x && p.y == q.y && p.z == q.z; };
  for (int64_t i = 0; i < 200; ++i) {
    const hrad::Triangle t = m.scene.triangle(i);
    bool wanted = same(t.a, t.b) || same(t.b, t.c) || same(t.c, t.a);
    for (int64_t j = 0; j < i; ++j) {
      const hrad::Triangle u = m.scene.triangle(j);
      wanted = wanted || (same(t.a, u.a) && same(t.b, u.b) && same(t.c, u.c)) ||
               (same(t.a, u.b) && same(t.b, u.c) && same(t.c, u.a)) ||
               (same(t.a, u.c) && same(t.b, u.a) && same(t.c, u.b));
    }
    CHECK_EQUAL(m.scene.has(i, patch_dropped), wanted);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(a_good_scene_stays),
      HRAD_TEST(without_area),
      HRAD_TEST(small_scenes_are_scenes),
      HRAD_TEST(repetitions),
      HRAD_TEST(sheets_stay),
      HRAD_TEST(earlier_patches_count_but_are_not_told_again),
      HRAD_TEST(random_triangles),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
