/* Solves that go on: after a change of light, with another number of threads, beside another
 * solver. The hash says whether the bits are the same. */
#include <pthread.h>
#include <stdlib.h>

#include "solves.h"

static void threads_do_not_change_a_bit(void** state) {
  const uint64_t alone = cornell_hash(1);
  (void)state;
  assert_true(cornell_hash(2) == alone);
  assert_true(cornell_hash(3) == alone);
}

static void result_parameters_and_scene_change_the_hash(void** state) {
  const uint64_t alone = cornell_hash(1);
  hrad_solver* solver = prepared("cornell", 0.12, 1);
  (void)state;
  assert_ok(hrad_solve(solver));
  assert_true(hash_of(solver) != alone);
  hrad_destroy(&solver);
  solver = prepared("furnace", 0.1, 1);
  assert_ok(hrad_solve(solver));
  assert_true(hash_of(solver) != alone);
  hrad_destroy(&solver);
}

struct calling {
  hrad_solver* solver;
  int calls, wrong;
};

/* Everything that a callback must not call. */
static int32_t call_back(const hrad_progress* progress, void* user) {
  struct calling* calling = user;
  hrad_solver *solver = calling->solver, *same = solver;
  hrad_stats stats = {.struct_size = sizeof stats};
  int64_t whole = -7;
  double real[BANDS] = {-7};
  (void)progress;
  ++calling->calls;
  calling->wrong |= hrad_solve(solver) != HRAD_ERROR_STATE;
  calling->wrong |= strlen(hrad_error_message()) == 0;
  calling->wrong |= hrad_set_int(solver, "threads", 1) != HRAD_ERROR_STATE;
  calling->wrong |= hrad_get_int(solver, "threads", &whole) != HRAD_ERROR_STATE;
  calling->wrong |= hrad_get_stats(solver, &stats) != HRAD_ERROR_STATE;
  calling->wrong |= hrad_scene_size(solver, &whole, NULL) != HRAD_ERROR_STATE;
  calling->wrong |=
      hrad_query_patches(solver, HRAD_EMISSION, HRAD_FRONT, 0, 1, real) != HRAD_ERROR_STATE;
  calling->wrong |= hrad_set_progress(solver, NULL, NULL) != HRAD_ERROR_STATE;
  calling->wrong |= hrad_set_log(solver, NULL, NULL, 0) != HRAD_ERROR_STATE;
  hrad_destroy(&same); /* does nothing here */
  calling->wrong |= same != solver || whole != -7 || real[0] != -7;
  return 0;
}

static void log_back(int32_t level, const char* message, void* user) {
  struct calling* calling = user;
  calling->wrong |= level > HRAD_LOG_DEBUG || strlen(message) == 0;
  call_back(NULL, user);
}

static void callbacks_can_not_call_back(void** state) {
  hrad_solver* solver = prepared("cornell", 0.1, 1);
  struct calling calling = {solver, 0, 0};
  (void)state;
  assert_ok(hrad_set_progress(solver, call_back, &calling));
  assert_ok(hrad_solve(solver));
  assert_true(calling.calls > 0);
  assert_false(calling.wrong);
  assert_true(hash_of(solver) == cornell_hash(1));
  hrad_destroy(&solver);
}

static void the_log_function_can_not_call_back(void** state) {
  hrad_solver* solver = new_solver();
  struct calling calling = {solver, 0, 0};
  const int32_t material = add_gray(solver, 0.5, 1, 0);
  (void)state;
  assert_ok(hrad_set_log(solver, log_back, &calling, HRAD_LOG_DEBUG));
  add_room(solver, material);
  assert_int_equal(calling.calls, 0);
  add_room(solver, material); /* it is told that these patches repeat others */
  assert_int_equal(calling.calls, 1);
  assert_false(calling.wrong);
  assert_int_equal(patch_count(solver), 24);
  hrad_destroy(&solver);
}

struct work {
  const char* scene;
  uint64_t hash;
  hrad_status status;
};

static void* solve_elsewhere(void* user) {
  struct work* work = user;
  hrad_solver* solver = NULL;
  work->status = hrad_create(&solver);
  if (work->status == HRAD_OK) work->status = hrad_make_scene(solver, work->scene);
  if (work->status == HRAD_OK) work->status = hrad_set_double(solver, "accuracy", 0.1);
  if (work->status == HRAD_OK) work->status = hrad_set_int(solver, "threads", 2);
  if (work->status == HRAD_OK) work->status = hrad_solve(solver);
  if (work->status == HRAD_OK) work->status = hrad_state_hash(solver, &work->hash);
  hrad_destroy(&solver);
  return NULL;
}

static void solvers_work_side_by_side(void** state) {
  struct work work[3] = {{"cornell", 0, 0}, {"furnace", 0, 0}, {"cornell", 0, 0}};
  pthread_t threads[3];
  (void)state;
  for (int i = 0; i < 3; ++i)
    assert_int_equal(pthread_create(&threads[i], NULL, solve_elsewhere, &work[i]), 0);
  for (int i = 0; i < 3; ++i) assert_int_equal(pthread_join(threads[i], NULL), 0);
  for (int i = 0; i < 3; ++i) assert_int_equal(work[i].status, HRAD_OK);
  assert_true(work[0].hash == cornell_hash(1));
  assert_true(work[0].hash == work[2].hash && work[0].hash != work[1].hash);
}

static double* radiosity_of(const hrad_solver* solver) {
  const int64_t patches = patch_count(solver);
  double* out = malloc((size_t)patches * BANDS * sizeof *out);
  assert_ok(hrad_query_patches(solver, HRAD_RADIOSITY, HRAD_FRONT, 0, patches, out));
  return out;
}

/* The present links carry light in proportion: twice the emission, twice the radiosity. */
static void emission_may_change(void** state) {
  hrad_solver* solver = prepared("cornell", 0.1, 1);
  const int64_t patches = patch_count(solver);
  double *before, *after, *e = malloc((size_t)patches * BANDS * sizeof *e), top = 0;
  int64_t leaves = -1, same_leaves = -2;
  uint64_t hash;
  (void)state;
  assert_ok(hrad_solve(solver));
  before = radiosity_of(solver);
  hash = hash_of(solver);
  assert_ok(hrad_leaf_count(solver, &leaves));
  assert_ok(hrad_query_patches(solver, HRAD_EMISSION, HRAD_FRONT, 0, patches, e));
  for (int64_t i = 0; i < patches * BANDS; ++i) e[i] *= 2;
  assert_ok(hrad_set_emission(solver, 0, patches, e));
  assert_ok(hrad_set_int(solver, "refine", 0));
  assert_ok(hrad_solve(solver));
  after = radiosity_of(solver);
  assert_ok(hrad_leaf_count(solver, &same_leaves));
  assert_int_equal(same_leaves, leaves);
  assert_true(hash_of(solver) != hash);
  for (int64_t i = 0; i < patches * BANDS; ++i) top = fmax(top, after[i]);
  for (int64_t i = 0; i < patches * BANDS; ++i)
    assert_near(after[i], 2 * before[i], 1e-3 * 2 * before[i] + 1e-6 * top);
  free(before);
  free(after);
  free(e);
  hrad_destroy(&solver);
}

/* Black surfaces send out what they emit and nothing else; and back again. */
static void reflectance_may_change(void** state) {
  hrad_solver* solver = prepared("cornell", 0.1, 1);
  const int64_t patches = patch_count(solver);
  double *before, *black, *again, top = 0;
  double* rho = calloc((size_t)patches * BANDS, sizeof *rho);
  double* e = malloc((size_t)patches * BANDS * sizeof *e);
  (void)state;
  assert_ok(hrad_solve(solver));
  before = radiosity_of(solver);
  assert_ok(hrad_set_int(solver, "refine", 0));
  assert_ok(hrad_set_reflectance(solver, 0, patches, rho));
  assert_ok(hrad_solve(solver));
  black = radiosity_of(solver);
  assert_ok(hrad_query_patches(solver, HRAD_EMISSION, HRAD_FRONT, 0, patches, e));
  for (int64_t i = 0; i < patches * BANDS; ++i) top = fmax(top, before[i]);
  for (int64_t i = 0; i < patches * BANDS; ++i) assert_near(black[i], e[i], 1e-6 * top);
  for (int64_t p = 0; p < patches; ++p) {
    hrad_patch patch = {.struct_size = sizeof patch};
    assert_ok(hrad_get_patch(solver, p, &patch));
    assert_ok(
        hrad_get_material(solver, patch.material, NULL, 0, NULL, rho + p * BANDS, NULL, NULL));
  }
  assert_ok(hrad_set_reflectance(solver, 0, patches, rho));
  assert_ok(hrad_solve(solver));
  again = radiosity_of(solver);
  for (int64_t i = 0; i < patches * BANDS; ++i)
    assert_near(again[i], before[i], 1e-3 * before[i] + 1e-6 * top);
  free(before);
  free(black);
  free(again);
  free(rho);
  free(e);
  hrad_destroy(&solver);
}

/* With refinement the mesh follows a new light: a patch of the floor shines instead of the lamp. */
static void mesh_follows_the_emission(void** state) {
  (void)state;
  for (int refine = 0; refine <= 1; ++refine) {
    hrad_solver *changed = prepared("furnished-room", 0.1, 2),
                *fresh = prepared("furnished-room", 0.1, 1);
    const int64_t patches = patch_count(changed);
    double* e = calloc((size_t)patches * BANDS, sizeof *e);
    double emitted = 0, absorbed = 0, back = 0, escaped = 0, totals[4][BANDS];
    for (int b = 0; b < BANDS; ++b) e[b] = 10;
    assert_ok(hrad_solve(changed));
    assert_ok(hrad_set_emission(changed, 0, patches, e));
    assert_ok(hrad_set_emission(fresh, 0, patches, e));
    assert_ok(hrad_set_int(changed, "refine", refine));
    assert_true(hrad_solve(changed) >= 0);
    assert_ok(hrad_power_balance(changed, totals[0], totals[1], totals[2], totals[3]));
    for (int b = 0; b < BANDS; ++b) {
      emitted += totals[0][b];
      absorbed += totals[1][b];
      back += totals[2][b];
      escaped += totals[3][b];
    }
    assert_true(emitted > 0);
    assert_near(absorbed + back + escaped, emitted, 0.1 * emitted);
    assert_ok(hrad_solve(fresh));
    /* refine is a result parameter, and the present links know no mesh for the new light. */
    assert_int_equal(hash_of(changed) == hash_of(fresh), refine);
    hrad_destroy(&changed);
    hrad_destroy(&fresh);
    free(e);
  }
}

static void result_parameters_hold_once_begun(void** state) {
  hrad_solver* solver = prepared("cornell", 0.2, 1);
  double accuracy = -1;
  (void)state;
  assert_ok(hrad_solve(solver));
  assert_fails(hrad_set_double(solver, "accuracy", 0.3), HRAD_ERROR_STATE, "0.2");
  assert_fails(hrad_set_text(solver, "accuracy", "0.3"), HRAD_ERROR_STATE, "0.3");
  assert_fails(hrad_set_int(solver, "seed", 5), HRAD_ERROR_STATE, "seed");
  assert_fails(hrad_set_text(solver, "oracle", "energy"), HRAD_ERROR_STATE, "energy");
  assert_fails(hrad_set_int(solver, "max_iterations", 1), HRAD_ERROR_STATE, "max_iterations");
  assert_fails(hrad_set_double(solver, "accuracy", 9), HRAD_ERROR_ARGUMENT, "0.0005 to 0.5");
  assert_ok(hrad_set_int(solver, "seed", 1));
  assert_ok(hrad_set_int(solver, "max_iterations", 3000));
  assert_ok(hrad_set_int(solver, "refine", 0));
  assert_ok(hrad_set_int(solver, "refine", 1));
  assert_ok(hrad_set_int(solver, "threads", 2));
  assert_ok(hrad_get_double(solver, "accuracy", &accuracy));
  assert_true(accuracy == 0.2);
  hrad_destroy(&solver);
}

static void smaller_accuracy_goes_on(void** state) {
  hrad_solver* solver = prepared("cornell", 0.3, 1);
  hrad_stats coarse = {.struct_size = sizeof coarse}, fine = coarse;
  uint64_t hash;
  (void)state;
  assert_ok(hrad_solve(solver));
  assert_ok(hrad_get_stats(solver, &coarse));
  hash = hash_of(solver);
  assert_ok(hrad_solve(solver)); /* nothing is left to do */
  assert_true(hash_of(solver) == hash);
  assert_ok(hrad_set_double(solver, "accuracy", 0.1));
  assert_ok(hrad_solve(solver));
  assert_ok(hrad_get_stats(solver, &fine));
  assert_true(fine.leaves >= coarse.leaves);
  assert_true(fine.error_estimate <= 0.1);
  assert_true(hash_of(solver) != hash);
  hrad_destroy(&solver);
}

static void few_iterations_do_not_converge(void** state) {
  hrad_solver* solver = prepared("furnace", 0.05, 1);
  hrad_stats stats = {.struct_size = sizeof stats};
  (void)state;
  assert_ok(hrad_set_int(solver, "max_iterations", 1));
  assert_status(hrad_solve(solver), HRAD_NOT_CONVERGED);
  assert_ok(hrad_get_stats(solver, &stats));
  assert_int_equal(stats.converged, 0);
  assert_ok(hrad_set_int(solver, "max_iterations", 2000));
  assert_ok(hrad_solve(solver));
  assert_ok(hrad_get_stats(solver, &stats));
  assert_int_equal(stats.converged, 1);
  hrad_destroy(&solver);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(threads_do_not_change_a_bit),
      cmocka_unit_test(result_parameters_and_scene_change_the_hash),
      cmocka_unit_test(callbacks_can_not_call_back),
      cmocka_unit_test(the_log_function_can_not_call_back),
      cmocka_unit_test(solvers_work_side_by_side),
      cmocka_unit_test(emission_may_change),
      cmocka_unit_test(reflectance_may_change),
      cmocka_unit_test(mesh_follows_the_emission),
      cmocka_unit_test(result_parameters_hold_once_begun),
      cmocka_unit_test(smaller_accuracy_goes_on),
      cmocka_unit_test(few_iterations_do_not_converge),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
