// Which points are sealed: in contacts, inside solids; and which are not, however close they look.
#include <memory>
#include <vector>

#include "scene/load.h"
#include "support/check.h"
#include "visibility/brute_force.h"
#include "visibility/exposure.h"

namespace {

using namespace hrad;
using namespace hrad_test;

struct Setup {
  explicit Setup(Scene s)
      : scene(std::move(s)),
        team(1),
        engine(make_visibility_engine(scene, "builtin", "auto", team)),
        exposure(scene, *engine) {}

  // Whether the point of the front (side 0) or back of any patch from `first` on that lies there is
  // sealed; fails where no patch with this normal does.
  bool sealed_at(Vec3 point, Vec3 normal, int32_t side = 0, int64_t first = 0) const {
    for (int64_t p = first; p < scene.patch_count(); ++p) {
      const Triangle t = scene.triangle(p);
      const Vec3 n = t.area_vector();
      if (dot(normalized(n), normal) < 0.999) continue;
      if (std::fabs(dot(point - t.a, normalized(n))) > 1e-9) continue;
      const double u = dot(cross(point - t.a, t.c - t.a), n) / dot(n, n);
      const double v = dot(cross(t.b - t.a, point - t.a), n) / dot(n, n);
      if (u < 0 || v < 0 || u + v > 1) continue;
      const bool sealed = exposure.sealed(p, side, point);
      // What can't be sealed needn't be asked, but must say so when it is.
      CHECK(exposure.can_be_sealed(p, side) || !sealed);
      return sealed;
    }
    CHECK(!"a patch at the point");
    return false;
  }

  Scene scene;
  ThreadTeam team;
  std::unique_ptr<VisibilityEngine> engine;
  Exposure exposure;
};

constexpr Vec3 up{0, 0, 1}, down{0, 0, -1}, east{1, 0, 0};

// A box of 1 x 1 x 1 on the floor of a room of 4 x 4 x 3.
Scene box_on_a_floor(double gap = 0) {
  Scene scene;
  add_box(scene, {0, 0, 0}, {4, 4, 3}, true);
  add_box(scene, {1, 1, gap}, {2, 2, 1 + gap});
  return scene;
}

void pressed_surfaces_are_sealed_where_they_meet() {
  const Setup s(box_on_a_floor());
  Random random(71);
  int covered = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 p{random.between(0, 4), random.between(0, 4), 0};
    const bool below = p.x > 1 && p.x < 2 && p.y > 1 && p.y < 2;
    CHECK(s.sealed_at(p, up) == below);
    covered += below;
  }
  CHECK(covered > 50);
  CHECK(s.sealed_at({1.3, 1.6, 0}, down));    // the bottom of the box
  CHECK(!s.sealed_at({1.3, 1.6, 1}, up));     // its top
  CHECK(!s.sealed_at({2, 1.6, 0.01}, east));  // its side, just above the floor
  CHECK(!s.sealed_at({1.5, 1.5, 3}, down));   // the ceiling
}

void a_gap_is_no_contact() {
  // Of a radius of some 3.2: contact is below 3.2e-6.
  const Setup apart(box_on_a_floor(1e-4));
  CHECK(!apart.sealed_at({1.3, 1.6, 0}, up));
  CHECK(!apart.sealed_at({1.3, 1.6, 1e-4}, down));
  const Setup close(box_on_a_floor(1e-6));
  CHECK(close.sealed_at({1.3, 1.6, 0}, up));
  CHECK(close.sealed_at({1.3, 1.6, 1e-6}, down));
}

// Two boxes side by side, one against the other.
void walls_in_contact_are_sealed() {
  Scene scene;
  add_box(scene, {0, 0, 0}, {1, 1, 1});
  add_box(scene, {1, 0.25, 0.25}, {2, 0.75, 0.75});
  const Setup s(std::move(scene));
  CHECK(s.sealed_at({1, 0.5, 0.3}, east));
  CHECK(!s.sealed_at({1, 0.1, 0.3}, east));
  CHECK(s.sealed_at({1, 0.5, 0.3}, -east));
  CHECK(!s.sealed_at({2, 0.5, 0.3}, east));
}

// The two sides of a sheet made of coincident triangles both see out.
void sheet_twins_are_not_sealed() {
  Scene scene;
  const Vec3 a{0, 0, 1}, b{1, 0, 1}, c{0, 1, 1};
  add_triangle(scene, a, b, c);
  add_triangle(scene, a, c, b);
  add_triangle(scene, {-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
  const Setup s(std::move(scene));
  CHECK(!s.sealed_at({0.2, 0.3, 1}, up));
  CHECK(!s.sealed_at({0.2, 0.3, 1}, down));
}

// A floor of two layers seen from above: only one of them sees. The higher one; without a
// difference a lamp, then a sheet, then the first.
void of_two_layers_one_is_sealed() {
  const auto layers = [](double height, bool lamp) {
    Scene scene;
    add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_triangle(scene, {-1, -1, height}, {3, -1, height}, {-1, 3, height});
    if (lamp) scene.emission[static_cast<size_t>(scene.bands)] = 1;
    return scene;
  };
  const Vec3 in_both{0.2, 0.2, 0}, in_one{0.7, 0.7, 0};
  for (double height : {0.0, -1e-7}) {
    const Setup s(layers(height, false));
    CHECK(!s.exposure.can_be_sealed(0, 0));
    CHECK(s.exposure.sealed(1, 0, in_both));
    CHECK(!s.exposure.sealed(1, 0, in_one));
  }
  for (const auto& [height, lamp] : {std::pair(1e-7, false), std::pair(0.0, true)}) {
    const Setup s(layers(height, lamp));
    CHECK(s.exposure.sealed(0, 0, in_both));
    CHECK(!s.exposure.can_be_sealed(1, 0));
  }
}

void neighbours_in_a_room_seal_nothing() {
  Scene scene;
  add_box(scene, {0, 0, 0}, {4, 4, 3}, true);
  const Setup s(std::move(scene));
  Random random(72);
  for (int64_t p = 0; p < s.scene.patch_count(); ++p)
    for (int k = 0; k < 50; ++k) {
      const Triangle t = s.scene.triangle(p);
      CHECK(!s.exposure.sealed(p, 0, point_on(t, random)));
      CHECK(!s.exposure.can_be_sealed(p, 0));
      CHECK(!s.exposure.sealed(p, 0, t.a) && !s.exposure.sealed(p, 0, (t.a + t.b) * 0.5));
    }
}

// A post that runs through a table top: what lies inside the other solid is sealed.
void what_lies_inside_a_solid_is_sealed() {
  Scene scene;
  add_box(scene, {0, 0, 1}, {2, 2, 1.2});          // the top
  add_box(scene, {0.9, 0.9, 0}, {1.1, 1.1, 1.5});  // the post
  const Setup s(std::move(scene));
  CHECK(s.sealed_at({1.1, 1, 1.1}, east, 0, 12));   // the post within the top
  CHECK(!s.sealed_at({1.1, 1, 0.5}, east, 0, 12));  // below
  CHECK(!s.sealed_at({1.1, 1, 1.3}, east, 0, 12));  // above
  CHECK(s.sealed_at({1, 1, 1.2}, up));              // the top within the post
  CHECK(!s.sealed_at({0.5, 0.4, 1.2}, up));
  CHECK(!s.sealed_at({1, 1, 1.5}, up, 0, 12));
}

// Only a closed solid has an inside: an open box is a sheet that one can look into.
void an_open_box_has_no_inside() {
  Scene scene;
  add_box(scene, {0, 0, 0}, {1, 1, 1});
  scene.flags[0] |= patch_dropped;
  add_triangle(scene, {0.4, 0.4, 0.5}, {0.6, 0.4, 0.5}, {0.5, 0.6, 0.5});
  const Setup s(std::move(scene));
  CHECK(!s.sealed_at({0.5, 0.45, 0.5}, up));
  Scene closed;
  add_box(closed, {0, 0, 0}, {1, 1, 1});
  add_triangle(closed, {0.4, 0.4, 0.5}, {0.6, 0.4, 0.5}, {0.5, 0.6, 0.5});
  const Setup t(std::move(closed));
  CHECK(t.sealed_at({0.5, 0.45, 0.5}, up));
}

// Nor does the room itself, whose fronts look inward, seal what stands in it.
void a_room_does_not_seal_its_furniture() {
  const Setup s(box_on_a_floor(0.5));
  Random random(73);
  for (int64_t p = 12; p < 24; ++p)
    for (int k = 0; k < 50; ++k)
      CHECK(!s.exposure.sealed(p, 0, point_on(s.scene.triangle(p), random)));
}

void two_sided_patches_are_sealed_by_side() {
  // A two-sided sheet lies on the floor of a room: its underside is sealed, and the floor under it.
  Scene scene;
  add_box(scene, {0, 0, 0}, {4, 4, 3}, true);
  Material paper;
  paper.two_sided = true;
  const int32_t material = scene.add_material(paper);
  const int32_t first = scene.add_vertex({1, 1, 0});
  scene.add_vertex({2, 1, 0});
  scene.add_vertex({1, 2, 0});
  scene.add_patch(first, first + 1, first + 2, material);
  const Setup s(std::move(scene));
  const Vec3 p{1.3, 1.4, 0};
  CHECK(!s.exposure.sealed(12, 0, p));
  CHECK(s.exposure.sealed(12, 1, p));
  CHECK(s.exposure.can_be_sealed(12, 1));
  CHECK(s.sealed_at(p, up));
  CHECK(!s.sealed_at({3, 3, 0}, up));
}

void what_exchanges_nothing_is_never_asked() {
  Scene scene = box_on_a_floor();
  for (uint8_t& flag : scene.flags) flag |= patch_blocker;
  const Setup s(std::move(scene));
  for (int64_t p = 0; p < s.scene.patch_count(); ++p)
    for (int32_t side : {0, 1}) CHECK(!s.exposure.can_be_sealed(p, side));
  // The back of a one-sided patch is none of its sides.
  const Setup t(box_on_a_floor());
  for (int64_t p = 0; p < t.scene.patch_count(); ++p) CHECK(!t.exposure.can_be_sealed(p, 1));
}

void blockers_seal_what_they_press_on() {
  Scene scene = box_on_a_floor();
  for (size_t p = 12; p < 24; ++p) scene.flags[p] |= patch_blocker;
  const Setup s(std::move(scene));
  CHECK(s.sealed_at({1.3, 1.6, 0}, up));
  CHECK(!s.sealed_at({0.3, 1.6, 0}, up));
}

// What a part of a side says is what the whole side says.
void parts_agree_with_the_whole() {
  Scene scene;
  make_builtin_scene(scene, "furnished-room");
  const Setup s(std::move(scene));
  Random random(74);
  int sealed = 0, exposed = 0, clear = 0;
  for (int64_t p = 0; p < s.scene.patch_count(); ++p) {
    if (!s.exposure.can_be_sealed(p, 0)) continue;
    const Triangle whole = s.scene.triangle(p);
    for (int k = 0; k < 20; ++k) {
      const Vec3 a = point_on(whole, random), b = point_on(whole, random);
      const Triangle element{a, b, point_on(whole, random)};
      Exposure::Part part(s.exposure, p, 0, element);
      clear += !part.can_be_sealed();
      for (int m = 0; m < 10; ++m) {
        const Vec3 point = point_on(element, random);
        const bool is = s.exposure.sealed(p, 0, point);
        CHECK_EQUAL(part.sealed(point), is);
        (is ? sealed : exposed) += 1;
      }
    }
  }
  CHECK(sealed > 100 && exposed > 100 && clear > 100);
}

// However thin: a post of a thousandth of the floor.
void the_pressed_share_is_exact() {
  Scene scene;
  add_box(scene, {0, 0, 0}, {10, 10, 3}, true);
  add_box(scene, {4, 1, 0}, {4.1, 2, 1});
  const Setup s(std::move(scene));
  double pressed = 0;
  for (int64_t p = 0; p < 12; ++p) {
    const Triangle t = s.scene.triangle(p);
    Exposure::Part part(s.exposure, p, 0, t);
    CHECK_EQUAL(part.can_be_sealed(), part.pressed_share() > 0);
    pressed += part.pressed_share() * length(t.area_vector()) / 2;
  }
  CHECK_NEAR(pressed, 0.1, 1e-9);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(pressed_surfaces_are_sealed_where_they_meet),
      HRAD_TEST(a_gap_is_no_contact),
      HRAD_TEST(walls_in_contact_are_sealed),
      HRAD_TEST(sheet_twins_are_not_sealed),
      HRAD_TEST(of_two_layers_one_is_sealed),
      HRAD_TEST(neighbours_in_a_room_seal_nothing),
      HRAD_TEST(what_lies_inside_a_solid_is_sealed),
      HRAD_TEST(an_open_box_has_no_inside),
      HRAD_TEST(a_room_does_not_seal_its_furniture),
      HRAD_TEST(two_sided_patches_are_sealed_by_side),
      HRAD_TEST(what_exchanges_nothing_is_never_asked),
      HRAD_TEST(blockers_seal_what_they_press_on),
      HRAD_TEST(parts_agree_with_the_whole),
      HRAD_TEST(the_pressed_share_is_exact),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
