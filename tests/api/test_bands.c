/* One, two and sixteen bands; bands of very different magnitude; two-sided patches and blockers. */
#include <stdlib.h>

#include "api.h"

/* A unit room with a lamp below its ceiling. emission: bands values. Patches 0 .. 11 are the room,
 * 12 and 13 the lamp. */
static hrad_solver* lit_room(int32_t bands, const double* emission) {
  hrad_solver* solver = new_solver();
  hrad_material lamp = {sizeof lamp, NULL, emission, 0, "lamp"};
  int32_t number = -1;
  assert_ok(hrad_set_int(solver, "bands", bands));
  assert_ok(hrad_set_double(solver, "accuracy", 0.1));
  add_room(solver, add_gray(solver, 0.5, 0, 0));
  assert_ok(hrad_add_material(solver, &lamp, &number));
  add_square(solver, 0.5, 0.5, 0.9, 0.15, 1, number);
  return solver;
}

static double* radiosity_of(const hrad_solver* solver, int32_t bands) {
  const int64_t patches = patch_count(solver);
  double* out = malloc((size_t)(patches * bands) * sizeof *out);
  assert_ok(hrad_query_patches(solver, HRAD_RADIOSITY, HRAD_FRONT, 0, patches, out));
  return out;
}

/* What bands of the same reflectance have is in proportion to what they emit. */
static void check_proportions(int32_t bands, const double* emission) {
  hrad_solver* solver = lit_room(bands, emission);
  double emitted[16], absorbed[16], *b;
  assert_ok(hrad_solve(solver));
  b = radiosity_of(solver, bands);
  for (int64_t p = 0; p < 14; ++p) {
    const double first = b[p * bands] / emission[0];
    assert_true(first > 0);
    for (int32_t k = 0; k < bands; ++k)
      assert_near(b[p * bands + k] / emission[k], first, 1e-4 * first);
  }
  assert_ok(hrad_power_balance(solver, emitted, absorbed, NULL, NULL));
  for (int32_t k = 0; k < bands; ++k) {
    assert_near(emitted[k], 0.09 * emission[k], 1e-6 * emission[k]);
    assert_near(absorbed[k] / emission[k], absorbed[0] / emission[0],
                1e-4 * absorbed[0] / emission[0]);
  }
  free(b);
  hrad_destroy(&solver);
}

static void bands_are_proportional(void** state) {
  static const double few[3] = {1e-6, 1, 1e6};
  double many[16];
  (void)state;
  check_proportions(1, few + 1);
  check_proportions(2, few);
  check_proportions(3, few);
  for (int k = 0; k < 16; ++k) many[k] = k + 1;
  check_proportions(16, many);
}

/* A band that is dark stays dark beside one that is lit. */
static void dark_bands_stay_dark(void** state) {
  const double emission[2] = {0, 5};
  hrad_solver* solver = lit_room(2, emission);
  double* b;
  (void)state;
  assert_ok(hrad_solve(solver));
  b = radiosity_of(solver, 2);
  for (int64_t p = 0; p < 14; ++p) {
    assert_true(b[2 * p] == 0);
    assert_true(b[2 * p + 1] > 0);
  }
  free(b);
  hrad_destroy(&solver);
}

/* One band gives what each of several equal ones does. */
static void number_of_bands_is_no_light(void** state) {
  const double emission[5] = {3, 3, 3, 3, 3};
  hrad_solver *one = lit_room(1, emission), *five = lit_room(5, emission);
  double *b1, *b5, power = 0, difference = 0;
  (void)state;
  assert_ok(hrad_solve(one));
  assert_ok(hrad_solve(five));
  b1 = radiosity_of(one, 1);
  b5 = radiosity_of(five, 5);
  for (int64_t p = 0; p < 12; ++p) {
    power += b1[p] * b1[p];
    difference += (b1[p] - b5[5 * p]) * (b1[p] - b5[5 * p]);
  }
  assert_true(sqrt(difference / power) < 0.2); /* each within 0.1 of the truth */
  free(b1);
  free(b5);
  hrad_destroy(&one);
  hrad_destroy(&five);
}

/* A glowing two-sided sheet in the middle of a room emits on both sides and has both radiosities.
 */
static void two_sided_patches_have_two_sides(void** state) {
  hrad_solver* solver = new_solver();
  double front[6], back[6], emitted[3], absorbed[3], absorbed_back[3], escaped[3];
  int64_t leaves = -1;
  int backs = 0;
  (void)state;
  assert_ok(hrad_set_double(solver, "accuracy", 0.1));
  add_room(solver, add_gray(solver, 0.5, 0, 0));
  add_square(solver, 0.5, 0.5, 0.5, 0.2, 0, add_gray(solver, 0.3, 4, HRAD_TWO_SIDED));
  assert_ok(hrad_query_patches(solver, HRAD_EMISSION, HRAD_BACK, 12, 2, back));
  assert_true(back[0] == 4 && back[5] == 4);
  assert_ok(hrad_solve(solver));
  assert_ok(hrad_query_patches(solver, HRAD_RADIOSITY, HRAD_FRONT, 12, 2, front));
  assert_ok(hrad_query_patches(solver, HRAD_RADIOSITY, HRAD_BACK, 12, 2, back));
  for (int i = 0; i < 6; ++i) { /* the room is the same above and below */
    assert_true(front[i] > 4 && back[i] > 4);
    assert_near(front[i], back[i], 0.1 * front[i]);
  }
  assert_ok(hrad_power_balance(solver, emitted, absorbed, absorbed_back, escaped));
  assert_near(emitted[0], 2 * 4 * 0.16, 1e-6);
  assert_near(absorbed[0] + absorbed_back[0] + escaped[0], emitted[0], 0.1 * emitted[0]);
  assert_ok(hrad_leaf_count(solver, &leaves));
  for (int64_t i = 0; i < leaves; ++i) {
    int64_t patch = -1;
    int32_t side = -1;
    assert_ok(hrad_query_leaves(solver, i, 1, &patch, NULL, &side, NULL, NULL, NULL));
    if (side == HRAD_BACK) {
      assert_true(patch == 12 || patch == 13);
      ++backs;
    }
  }
  assert_true(backs >= 2);
  hrad_destroy(&solver);
}

/* A blocker under the lamp darkens the floor, and has no values itself. */
static void blockers_only_block(void** state) {
  const double emission[3] = {1, 1, 1};
  hrad_solver *free_room = lit_room(3, emission), *blocked_room = lit_room(3, emission);
  double *free_b, *blocked_b, free_floor, blocked_floor, absorbed_back[3];
  (void)state;
  add_square(blocked_room, 0.5, 0.5, 0.5, 0.3, 0, add_gray(blocked_room, 0.5, 0, HRAD_BLOCKER));
  assert_ok(hrad_solve(free_room));
  assert_ok(hrad_solve(blocked_room));
  free_b = radiosity_of(free_room, 3);
  blocked_b = radiosity_of(blocked_room, 3);
  free_floor = free_b[0] + free_b[3];
  blocked_floor = blocked_b[0] + blocked_b[3];
  assert_true(blocked_floor < 0.8 * free_floor && blocked_floor > 0);
  for (int32_t quantity = HRAD_RADIOSITY; quantity <= HRAD_NET_FLUX; ++quantity)
    for (int32_t side = HRAD_FRONT; side <= HRAD_BACK; ++side) {
      double out[6];
      assert_ok(hrad_query_patches(blocked_room, quantity, side, 14, 2, out));
      for (int i = 0; i < 6; ++i) assert_true(out[i] == 0);
    }
  assert_ok(hrad_power_balance(blocked_room, NULL, NULL, absorbed_back, NULL));
  assert_true(absorbed_back[0] > 0.1 * 0.09);
  free(free_b);
  free(blocked_b);
  hrad_destroy(&free_room);
  hrad_destroy(&blocked_room);
}

/* A dropped patch has no values and changes nothing. */
static void dropped_patches_are_dark(void** state) {
  const double emission[3] = {1, 1, 1}, line[9] = {0.2, 0.2, 0.5, 0.5, 0.5, 0.5, 0.8, 0.8, 0.5};
  const int64_t corners[3] = {0, 1, 2};
  hrad_solver* solver = lit_room(3, emission);
  double out[3];
  (void)state;
  assert_ok(hrad_add_patches(solver, 3, line, 1, corners, NULL));
  assert_ok(hrad_solve(solver));
  for (int32_t quantity = HRAD_RADIOSITY; quantity <= HRAD_NET_FLUX; ++quantity) {
    assert_ok(hrad_query_patches(solver, quantity, HRAD_FRONT, 14, 1, out));
    assert_true(out[0] == 0 && out[1] == 0 && out[2] == 0);
  }
  hrad_destroy(&solver);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bands_are_proportional),
      cmocka_unit_test(dark_bands_stay_dark),
      cmocka_unit_test(number_of_bands_is_no_light),
      cmocka_unit_test(two_sided_patches_have_two_sides),
      cmocka_unit_test(blockers_only_block),
      cmocka_unit_test(dropped_patches_are_dark),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
