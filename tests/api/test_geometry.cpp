// Geometry that no one should make and everyone does: without area, doubled, as thin as a hair, in
// the same place, one through the other, the wrong way round, a million times smaller than its
// neighbours. No number that is none, no endless solve, and the balance holds but for what is
// sealed.
#include "api/geometry.h"

using hrad_test::dark;
using hrad_test::lamp;
using hrad_test::Place;
using hrad_test::room;
using hrad_test::Scene;
using hrad_test::Solution;
using hrad_test::two_sided;

namespace {

// What an empty room gives, for comparison.
double mean_of_room(const Solution& solution) {
  double sum = 0;
  for (int i = 0; i < 12; ++i) sum += solution.radiosity[i] / 12;
  return sum;
}

double empty_room() {
  static const double mean = [] {
    Solution solution;
    solution.solve(room());
    CHECK_NEAR(solution.balance(), 1, 0.03);
    CHECK_NEAR(solution.escaped, 0, 1e-6);
    return mean_of_room(solution);
  }();
  return mean;
}

// What adds no surface changes nothing.
void without_area_and_doubled() {
  Scene scene = room();
  const Place p{.5, .5, .5}, q{.6, .5, .5}, r{.7, .5, .5};
  for (int32_t material : {dark, lamp, two_sided}) {
    scene.triangle(p, p, p, material);
    scene.triangle(p, q, q, material);
    scene.triangle(p, q, r, material);
  }
  scene.box({0, 0, 0}, {1, 1, 1}, lamp);
  scene.flip_last(12);
  Solution solution;
  solution.solve(scene);
  CHECK_NEAR(mean_of_room(solution), empty_room(), 1e-12);
  CHECK_NEAR(solution.balance(), 1, 0.03);
  CHECK_EQUAL(solution.count_diagnostics("9 patches without area are dropped"), 1);
  CHECK_EQUAL(solution.count_diagnostics("12 patches that repeat an earlier one"), 1);
  for (size_t i = 14; i < solution.radiosity.size(); ++i) CHECK_EQUAL(solution.radiosity[i], 0.0);
}

void slivers_and_needles() {
  Scene scene = room();
  for (int i = 0; i < 30; ++i) {
    const double width = 1e-6 * (i + 1), x = .1 + i * .02;
    scene.quad({x, .1, .4}, {width, 0, 0}, {0, .8, 0}, i % 2 ? two_sided : dark);
    const double thin = std::pow(10, -0.3 * i);
    scene.triangle({.5, .5, .7}, {.9, .4 + i * .01, .7}, {.9, .4 + i * .01 + thin * .01, .7},
                   i % 3);
  }
  Solution solution;
  solution.solve(scene);
  CHECK_NEAR(solution.balance(), 1, 0.03 + solution.sealed);
}

// Two floors in the same plane, both facing up: light that falls on them is counted once.
void one_floor_on_another() {
  for (double height : {0.0, 1e-9, 5e-7}) {
    Scene scene = room();
    scene.quad({.1, .1, height}, {.8, 0, 0}, {0, .8, 0}, dark);
    Solution solution;
    solution.solve(scene);
    CHECK_NEAR(solution.balance(), 1, 0.03);
    CHECK_NEAR(solution.sealed, .64 / 6.8, 0.01);
  }
  // A lamp that is let into the ceiling shines, whichever comes first.
  for (bool lamp_first : {false, true}) {
    Scene scene;
    if (lamp_first) scene.quad({.3, .3, 1}, {0, .4, 0}, {.4, 0, 0}, lamp);
    scene.box({0, 0, 0}, {1, 1, 1}, dark);
    scene.flip_last(12);
    if (!lamp_first) scene.quad({.3, .3, 1}, {0, .4, 0}, {.4, 0, 0}, lamp);
    Solution solution;
    solution.solve(scene);
    CHECK_NEAR(solution.balance(), 1, 0.03);
    CHECK(solution.absorbed > 0.95);
  }
}

void pressed_together_and_stacked() {
  Scene scene = room();
  scene.quad({.2, .2, 0}, {0, .6, 0}, {.6, 0, 0}, dark);  // face down on the floor
  Solution contact;
  contact.solve(scene);
  CHECK_NEAR(contact.balance(), 1, 0.03 + 2 * contact.sealed);
  CHECK_NEAR(contact.sealed, .72 / 6.52, 0.01);
  scene = room();
  for (int i = 0; i < 40; ++i) {
    scene.quad({.2, .2, .3 + i * 1e-9}, {.6, 0, 0}, {0, .6, 0}, i % 3 ? dark : two_sided);
    if (i % 2) scene.flip_last(2);
  }
  Solution stack;
  stack.solve(scene);
  CHECK(stack.sealed > 0.5);
  CHECK_NEAR(stack.balance(), 1, 0.03 + stack.sealed);
}

void sheets_and_what_goes_through_them() {
  Scene scene = room();
  scene.quad({.2, .2, .5}, {.6, 0, 0}, {0, .6, 0}, dark);
  scene.quad({.2, .2, .5}, {.6, 0, 0}, {0, .6, 0}, dark);
  scene.flip_last(2);
  Solution sheet;
  sheet.solve(scene);
  CHECK_EQUAL(sheet.count_diagnostics("2 pairs of coincident patches of opposite winding"), 1);
  CHECK_NEAR(sheet.balance(), 1, 0.05);
  scene = room();
  scene.box({.5, .5, -.2}, {1.3, .8, .4}, dark);
  scene.box({.2, .2, .2}, {.6, .6, .6}, dark);
  scene.box({.4, .4, .1}, {.7, .7, .5}, dark);
  Solution boxes;
  boxes.solve(scene);
  CHECK(boxes.sealed > 0);
  CHECK_NEAR(boxes.balance(), 1, 0.05 + boxes.sealed);
}

void the_wrong_way_round() {
  Scene inside_out;
  inside_out.box({0, 0, 0}, {1, 1, 1}, dark);
  inside_out.quad({.3, .3, .9}, {0, .4, 0}, {.4, 0, 0}, lamp);
  Solution wrong;
  wrong.solve(inside_out);
  CHECK_NEAR(wrong.absorbed_back, 1, 0.01);
  CHECK_NEAR(wrong.balance(), 1, 0.01);
  CHECK_EQUAL(wrong.count_diagnostics("backs of one-sided patches"), 1);
  CHECK_EQUAL(wrong.count_diagnostics("--flip, --two-sided"), 1);
  Scene some;
  some.box({0, 0, 0}, {1, 1, 1}, dark);
  some.flip_last(6);
  some.quad({.3, .3, .9}, {0, .4, 0}, {.4, 0, 0}, lamp);
  Solution half;
  half.solve(some);
  CHECK_NEAR(half.balance(), 1, 0.03);
  CHECK(half.absorbed_back > 0.1);
  CHECK_EQUAL(half.count_diagnostics("backs of one-sided patches"), 1);
  // Told before the solve, and not told of a room that is as it should be.
  Solution before, good;
  inside_out.add_to(before.solver);
  CHECK_EQUAL(before.count_diagnostics("backs of one-sided patches"), 0);
  CHECK_EQUAL(hrad_partition(before.solver), HRAD_OK);
  CHECK_EQUAL(before.count_diagnostics("backs of one-sided patches"), 1);
  Scene furnished = room();
  furnished.box({.2, .2, 0}, {.6, .6, .6}, dark);
  good.solve(furnished);
  CHECK_EQUAL(good.count_diagnostics("backs of one-sided patches"), 0);
}

// Areas from 1 to 1e-13 and back.
void very_small_beside_large() {
  Scene scene = room();
  for (double size : {1e-3, 1e-5, 3.2e-7})
    scene.quad({.5, .5, .5}, {size, 0, 0}, {0, size, 0}, dark);
  Solution specks;
  specks.solve(scene);
  CHECK_NEAR(mean_of_room(specks), empty_room(), 0.01 * empty_room());
  CHECK_NEAR(specks.balance(), 1, 0.03);
  CHECK_EQUAL(specks.count_diagnostics("2 patches are smaller than what can be told apart"), 1);
  // A lamp so small, of the power of one W.
  constexpr double side = 3.2e-7;
  Scene speck;
  speck.box({0, 0, 0}, {1, 1, 1}, dark);
  speck.flip_last(12);
  speck.quad({.5, .5, .5}, {side, 0, 0}, {0, side, 0}, lamp);
  Solution bright;
  bright.solve(speck, 1 / (side * side));
  CHECK_NEAR(bright.balance(), 1, 0.03);
  CHECK_NEAR(bright.absorbed, 1, 0.03);
  // One patch far away makes the room a point: said, and nothing worse.
  scene = room();
  scene.quad({-5e6, 0, 0}, {1, 0, 0}, {0, 1, 0}, dark);
  Solution far;
  far.solve(scene);
  CHECK_EQUAL(far.count_diagnostics("smaller than what can be told apart"), 1);
  CHECK_NEAR(far.balance(), 1, 0.03);
}

// The solution doesn't depend on the unit, or on where the origin lies.
void scale_and_origin() {
  for (double factor : {1e-6, 1e6}) {
    Scene scene = room();
    scene.scale_and_move(factor, {});
    Solution solution;
    solution.solve(scene);
    CHECK_NEAR(mean_of_room(solution), empty_room(), 1e-3 * empty_room());
  }
  for (double far : {4649776.2, 3e8}) {  // the first as in maps
    Scene scene = room();
    scene.scale_and_move(1, {500000.5, far, -far});
    Solution solution;
    solution.solve(scene);
    CHECK_NEAR(mean_of_room(solution), empty_room(), 1e-2 * empty_room());
    CHECK_NEAR(solution.balance(), 1, 0.03);
  }
}

// By every method, up to the largest and the smallest scenes that are taken.
void every_method_at_every_scale() {
  for (const char* linking : {"pairs", "clusters", "rows"})
    for (double factor : {1e-7, 1.0, 5e9, 5e10}) {
      Scene scene = room();
      scene.scale_and_move(factor, {});
      Solution solution;
      CHECK_EQUAL(hrad_set_text(solution.solver, "linking", linking), HRAD_OK);
      solution.solve(scene);
      CHECK_NEAR(mean_of_room(solution), empty_room(), 0.03 * empty_room());
      CHECK_NEAR(solution.balance(), 1, 0.05);
    }
}

void check_refused(const Scene& scene, const char* reason) {
  Solution solution;
  scene.add_to(solution.solver);
  CHECK_EQUAL(hrad_solve(solution.solver), HRAD_ERROR_SCENE);
  CHECK(std::string(hrad_error_message()).find(reason) != std::string::npos);
  int64_t patches = 0;
  CHECK_EQUAL(hrad_scene_size(solution.solver, &patches, nullptr), HRAD_OK);
  CHECK_EQUAL(patches, scene.size());
}

void sizes_that_no_ray_can_serve() {
  for (double factor : {1e-20, 1e-9, 1e12, 1e25}) {
    Scene scene = room();
    scene.scale_and_move(factor, {});
    check_refused(scene, "choose another unit");
  }
  for (double far : {1e11, 1e13}) {
    Scene scene = room();
    scene.scale_and_move(1, {far, 0, 0});
    check_refused(scene, "move it to the origin");
  }
}

// Scenes in which nothing happens.
void nothing_to_solve() {
  const Place p{.5, .5, .5};
  Scene dropped, single, blind = room();
  dropped.triangle(p, p, p, lamp);
  Solution none;
  none.solve(dropped);
  CHECK_EQUAL(none.balance(), 0.0);
  single.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, lamp);
  Solution alone;
  alone.solve(single);
  CHECK_NEAR(alone.escaped, 1, 1e-12);
  CHECK_EQUAL(alone.radiosity[0], 1.0);
  Solution night;
  night.solve(blind, 0);
  for (double value : night.radiosity) CHECK_EQUAL(value, 0.0);
  CHECK_EQUAL(night.count_diagnostics("no patch emits"), 1);
}

void emission_of_any_size() {
  for (double emission : {1e-30, 1e30}) {
    Solution solution;
    solution.solve(room(), emission);
    CHECK_NEAR(mean_of_room(solution) / emission, empty_room(), 1e-3 * empty_room());
  }
  Solution solution;
  hrad_material m{};
  m.struct_size = sizeof m;
  double emission[3] = {0, 0, 0};
  m.emission = emission;
  for (double wrong : {1e-31, 1e31, 1e300, -1.0, double(INFINITY), double(NAN)}) {
    emission[1] = wrong;
    CHECK_EQUAL(hrad_add_material(solution.solver, &m, nullptr), HRAD_ERROR_ARGUMENT);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(without_area_and_doubled),
      HRAD_TEST(slivers_and_needles),
      HRAD_TEST(one_floor_on_another),
      HRAD_TEST(pressed_together_and_stacked),
      HRAD_TEST(sheets_and_what_goes_through_them),
      HRAD_TEST(the_wrong_way_round),
      HRAD_TEST(very_small_beside_large),
      HRAD_TEST(scale_and_origin),
      HRAD_TEST(every_method_at_every_scale),
      HRAD_TEST(sizes_that_no_ray_can_serve),
      HRAD_TEST(nothing_to_solve),
      HRAD_TEST(emission_of_any_size),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
