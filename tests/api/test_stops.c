/* Progress, and solves that are stopped: they go on to the same bits, and tell nothing that was not
 * measured. */
#include <stdlib.h>

#include "solves.h"

struct counting {
  const char* stage;      /* the last one */
  int64_t calls, stop_at; /* stop_at < 0: never */
  double fraction, seconds;
  int wrong;
};

static int32_t count(const hrad_progress* progress, void* user) {
  static const char* const stages[] = {"initial", "linking", "refine", "sweep", "measure"};
  struct counting* counting = user;
  int known = 0;
  for (size_t i = 0; i < sizeof stages / sizeof *stages; ++i)
    known |= strcmp(progress->stage, stages[i]) == 0;
  counting->wrong |= !known || progress->struct_size != sizeof *progress ||
                     !(progress->fraction >= counting->fraction && progress->fraction <= 1) ||
                     !(progress->seconds >= counting->seconds) || progress->iteration < 0;
  counting->stage = progress->stage;
  counting->fraction = progress->fraction;
  counting->seconds = progress->seconds;
  return ++counting->calls == counting->stop_at;
}

static void progress_is_told(void** state) {
  struct counting counting = {.stop_at = -1}, again = {.stop_at = -1};
  hrad_solver* solver = prepared("cornell", 0.1, 1);
  (void)state;
  assert_ok(hrad_set_progress(solver, count, &counting));
  assert_ok(hrad_solve(solver));
  assert_true(counting.calls > 0);
  assert_false(counting.wrong);
  assert_string_equal(counting.stage, "measure");
  /* Nothing is left to do. */
  assert_ok(hrad_set_progress(solver, count, &again));
  assert_ok(hrad_solve(solver));
  assert_false(again.wrong);
  assert_string_equal(again.stage, "initial");
  assert_true(again.fraction == 1);
  assert_true(hash_of(solver) == cornell_hash(1));
  hrad_destroy(&solver);
}

/* Stopped at its first, second, ... report and then let go on, it ends in the same bits. */
static void stopped_solves_go_on(void** state) {
  const uint64_t uninterrupted = cornell_hash(1);
  (void)state;
  for (int64_t stop_at = 1; stop_at <= 4; ++stop_at) {
    struct counting counting = {.stop_at = stop_at};
    hrad_solver* solver = prepared("cornell", 0.1, 2);
    hrad_status status;
    uint64_t ignored;
    assert_ok(hrad_set_progress(solver, count, &counting));
    status = hrad_solve(solver);
    if (counting.calls < stop_at) { /* done before */
      assert_int_equal(status, HRAD_OK);
    } else {
      assert_int_equal(status, HRAD_STOPPED);
      /* The queries answer from the last whole round, or STATE when there is none. */
      status = hrad_state_hash(solver, &ignored);
      assert_true(status == HRAD_OK || status == HRAD_ERROR_STATE);
      assert_ok(hrad_set_progress(solver, NULL, NULL));
      assert_ok(hrad_solve(solver));
    }
    assert_true(hash_of(solver) == uninterrupted);
    hrad_destroy(&solver);
  }
}

static int32_t request(const hrad_progress* progress, void* user) {
  (void)progress;
  hrad_request_stop(*(hrad_solver**)user);
  return 0;
}

static void request_stops_a_running_solve(void** state) {
  hrad_solver* solver = prepared("cornell", 0.1, 1);
  (void)state;
  assert_ok(hrad_set_progress(solver, request, &solver));
  assert_status(hrad_solve(solver), HRAD_STOPPED);
  assert_ok(hrad_set_progress(solver, NULL, NULL));
  assert_ok(hrad_solve(solver)); /* the flag was taken back */
  assert_true(hash_of(solver) == cornell_hash(1));
  hrad_destroy(&solver);
}

/* The wish ends with the solve that it was for, also with one that fails. */
static void a_wish_to_stop_ends_with_the_solve(void** state) {
  hrad_solver* solver = new_solver();
  (void)state;
  hrad_request_stop(solver);
  assert_status(hrad_solve(solver), HRAD_ERROR_SCENE);
  assert_ok(hrad_make_scene(solver, "furnace"));
  assert_ok(hrad_set_double(solver, "accuracy", 0.4));
  assert_ok(hrad_solve(solver));
  hrad_destroy(&solver);
}

static int32_t stop_in_a_sweep(const hrad_progress* progress, void* user) {
  (void)user;
  return strcmp(progress->stage, "sweep") == 0;
}

/* What a solve that was stopped had not measured is not told, nor what was measured of another
 * light. */
static void nothing_is_told_that_was_not_measured(void** state) {
  hrad_solver* solver = prepared("cornell", 0.1, 1);
  hrad_stats stats = {.struct_size = sizeof stats};
  double power[BANDS] = {-7}, *light;
  int64_t patches = patch_count(solver), k;
  int refine;
  (void)state;
  assert_ok(hrad_set_progress(solver, stop_in_a_sweep, NULL));
  assert_status(hrad_solve(solver), HRAD_STOPPED);
  assert_fails(hrad_power_balance(solver, power, NULL, NULL, NULL), HRAD_ERROR_STATE, "hrad_solve");
  assert_true(power[0] == -7);
  for (refine = 1; refine >= 0; --refine) {
    assert_ok(hrad_set_progress(solver, NULL, NULL));
    assert_ok(hrad_set_int(solver, "refine", 1));
    assert_ok(hrad_solve(solver));
    assert_ok(hrad_power_balance(solver, power, NULL, NULL, NULL));
    light = calloc((size_t)(BANDS * patches), sizeof *light);
    assert_ok(hrad_query_patches(solver, HRAD_EMISSION, HRAD_FRONT, 0, patches, light));
    for (k = 0; k < BANDS * patches; ++k) light[k] *= 3;
    assert_ok(hrad_set_emission(solver, 0, patches, light));
    free(light);
    assert_ok(hrad_set_int(solver, "refine", refine));
    assert_ok(hrad_set_progress(solver, stop_in_a_sweep, NULL));
    assert_status(hrad_solve(solver), HRAD_STOPPED);
    assert_status(hrad_power_balance(solver, power, NULL, NULL, NULL), HRAD_ERROR_STATE);
    assert_ok(hrad_get_stats(solver, &stats));
    assert_true(stats.error_estimate < 0);
  }
  hrad_destroy(&solver);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(progress_is_told),
      cmocka_unit_test(stopped_solves_go_on),
      cmocka_unit_test(request_stops_a_running_solve),
      cmocka_unit_test(a_wish_to_stop_ends_with_the_solve),
      cmocka_unit_test(nothing_is_told_that_was_not_measured),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
