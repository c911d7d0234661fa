/* Sensors: what they read, and what they say of its error. */
#include <math.h>

#include "api.h"

enum { rows = 6, sensors = rows * rows * rows, bands = 3 };

/* A grid of sensors in the box of the scene, facing in many directions. */
static void place(hrad_solver* solver, double* xyz, double* normal) {
  double low[3] = {1e30, 1e30, 1e30}, high[3] = {-1e30, -1e30, -1e30};
  hrad_patch patch = {.struct_size = sizeof patch};
  for (int64_t p = 0; p < patch_count(solver); ++p) {
    assert_ok(hrad_get_patch(solver, p, &patch));
    for (int i = 0; i < 9; ++i) {
      low[i % 3] = fmin(low[i % 3], patch.corners_xyz[i]);
      high[i % 3] = fmax(high[i % 3], patch.corners_xyz[i]);
    }
  }
  for (int k = 0; k < sensors; ++k) {
    const int at[3] = {k % rows, k / rows % rows, k / (rows * rows)};
    for (int axis = 0; axis < 3; ++axis) {
      xyz[3 * k + axis] = low[axis] + (high[axis] - low[axis]) * (at[axis] + 0.5) / rows;
      normal[3 * k + axis] = (k * (axis + 3) * 7919) % 17 - 8.25;
    }
  }
}

static void read_at(hrad_solver* solver, double accuracy, const double* xyz, const double* normal,
                    double* irradiance, double* error) {
  assert_ok(hrad_set_double(solver, "accuracy", accuracy));
  assert_ok(hrad_query_sensors(solver, sensors, xyz, normal, irradiance, error));
}

static double norm(const double* value) {
  double sum = 0;
  for (int b = 0; b < bands; ++b) sum += value[b] * value[b];
  return sqrt(sum);
}

/* The same light read with few rays and with many: they differ by what the errors say, and the
 * errors are what the accuracy allows. */
static void standard_errors_are_kept_and_true(void** state) {
  static double xyz[3 * sensors], normal[3 * sensors];
  static double few[bands * sensors], many[bands * sensors], of_few[bands * sensors],
      of_many[bands * sensors];
  hrad_solver* solver = NULL;
  double squares = 0, brightest = 0;
  int known = 0, far = 0, compared = 0;
  (void)state;
  assert_ok(hrad_create(&solver));
  assert_ok(hrad_make_scene(solver, "cornell"));
  assert_ok(hrad_set_double(solver, "accuracy", 0.1));
  assert_ok(hrad_solve(solver));
  place(solver, xyz, normal);
  read_at(solver, 0.1, xyz, normal, few, of_few);
  read_at(solver, 0.012, xyz, normal, many, of_many);
  for (int k = 0; k < sensors; ++k)
    known += norm(of_few + bands * k) <= 0.025 * norm(few + bands * k);
  assert_true(known > sensors * 8 / 10);
  for (int k = 0; k < sensors; ++k) brightest = fmax(brightest, norm(many + bands * k));
  /* Where next to nothing arrives a ray or two tell of it, and no error. */
  for (int i = 0; i < bands * sensors; ++i) {
    const double error = hypot(of_few[i], of_many[i]);
    const double apart = fabs(few[i] - many[i]);
    if (norm(many + i / bands * bands) < 0.01 * brightest) continue;
    ++compared;
    squares += apart * apart / (error * error);
    far += apart > 5 * error;
  }
  assert_true(compared > bands * sensors / 2);
  assert_in_range((int64_t)(100 * sqrt(squares / compared)), 70, 140);
  assert_int_equal(far, 0);
  hrad_destroy(&solver);
}

/* One lamp that faces a sensor among many that shine elsewhere: it is not missed. */
static void a_lamp_among_many_is_found(void** state) {
  const double xyz[6] = {0, 0, 0, 0, 0, 0}, normal[6] = {0, 0, 1, 0, 0, -1};
  hrad_solver* solver = NULL;
  double h[2], error[2];
  int32_t lamp;
  (void)state;
  assert_ok(hrad_create(&solver));
  assert_ok(hrad_set_int(solver, "bands", 1));
  lamp = add_gray(solver, 0, 5, 0);
  add_square(solver, 0, 0, 1, 0.05, 1, lamp);
  for (int k = 0; k < 200; ++k) add_square(solver, 50 + k, 0, 1, 0.05, 0, lamp);
  assert_ok(hrad_solve(solver));
  assert_ok(hrad_query_sensors(solver, 2, xyz, normal, h, error));
  /* 0.01 m2 at 1 m: E A / pi, but for the lamp's width. */
  assert_near(h[0], 5 * 0.01 / 3.14159265358979, 0.01 * h[0] + 4 * error[0]);
  assert_true(error[0] < 0.01 * h[0]);
  assert_true(h[1] == 0 && error[1] == 0);
  hrad_destroy(&solver);
}

/* A normal need not have length 1, however far from it. */
static void only_the_direction_of_a_normal_counts(void** state) {
  const double xyz[3] = {0.3, 0.4, 0.5};
  double wanted[bands], h[bands], length;
  hrad_solver* solver = NULL;
  (void)state;
  assert_ok(hrad_create(&solver));
  assert_ok(hrad_make_scene(solver, "cornell"));
  assert_ok(hrad_set_double(solver, "accuracy", 0.2));
  assert_ok(hrad_solve(solver));
  {
    const double normal[3] = {0, 1, 1};
    assert_ok(hrad_query_sensors(solver, 1, xyz, normal, wanted, NULL));
  }
  assert_true(wanted[0] > 0);
  for (length = 1e-300; length < 1e305; length *= 1e50) {
    const double normal[3] = {0, length, length};
    assert_ok(hrad_query_sensors(solver, 1, xyz, normal, h, NULL));
    assert_memory_equal(h, wanted, sizeof h);
  }
  hrad_destroy(&solver);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(standard_errors_are_kept_and_true),
                                     cmocka_unit_test(a_lamp_among_many_is_found),
                                     cmocka_unit_test(only_the_direction_of_a_normal_counts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
