/* Checkpoints by the C interface: a solver that reads one is the solver that wrote it, a solve that
 * was stopped goes on to the same bits, and what does not fit is refused and changes nothing. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "api.h"

static char folder[] = "hrad_test_checkpoint_XXXXXX";
static char path[64], other_path[64];

static int make_folder(void** state) {
  (void)state;
  if (!mkdtemp(folder)) return -1;
  sprintf(path, "%s/a.hrad", folder);
  sprintf(other_path, "%s/b.hrad", folder);
  return 0;
}

static int remove_folder(void** state) {
  char command[96];
  (void)state;
  sprintf(command, "rm -rf '%s'", folder);
  return system(command);
}

static hrad_solver* room(double accuracy) {
  hrad_solver* solver = new_solver();
  const int32_t wall = add_gray(solver, 0.5, 0, 0), lamp = add_gray(solver, 0.1, 10, 0);
  add_room(solver, wall);
  add_square(solver, 0.5, 0.5, 0.9, 0.2, 1, lamp);
  assert_ok(hrad_set_double(solver, "accuracy", accuracy));
  assert_ok(hrad_set_int(solver, "threads", 1));
  return solver;
}

static uint64_t hash_of(const hrad_solver* solver) {
  uint64_t hash = 0;
  assert_ok(hrad_state_hash(solver, &hash));
  return hash;
}

static void assert_same_answers(const hrad_solver* one, const hrad_solver* other) {
  enum { patches = 14 };
  double a[3 * patches], b[3 * patches];
  const int64_t patch[2] = {0, 3};
  const double uv[4] = {0.2, 0.3, 0.6, 0.1}, up[3] = {0, 0, 1}, place[3] = {0.3, 0.4, 0.2};
  int64_t leaves = 0, other_leaves = 0;
  int32_t quantity;
  assert_true(hash_of(one) == hash_of(other));
  for (quantity = HRAD_RADIOSITY; quantity <= HRAD_NET_FLUX; ++quantity) {
    assert_ok(hrad_query_patches(one, quantity, HRAD_FRONT, 0, patches, a));
    assert_ok(hrad_query_patches(other, quantity, HRAD_FRONT, 0, patches, b));
    assert_memory_equal(a, b, sizeof a);
    assert_ok(hrad_query_points(one, quantity, HRAD_FRONT, 2, patch, uv, a));
    assert_ok(hrad_query_points(other, quantity, HRAD_FRONT, 2, patch, uv, b));
    assert_memory_equal(a, b, 6 * sizeof *a);
  }
  assert_ok(hrad_query_sensors(one, 1, place, up, a, a + 3));
  assert_ok(hrad_query_sensors(other, 1, place, up, b, b + 3));
  assert_memory_equal(a, b, 6 * sizeof *a);
  assert_ok(hrad_power_balance(one, a, a + 3, a + 6, a + 9));
  assert_ok(hrad_power_balance(other, b, b + 3, b + 6, b + 9));
  assert_memory_equal(a, b, 12 * sizeof *a);
  assert_ok(hrad_leaf_count(one, &leaves));
  assert_ok(hrad_leaf_count(other, &other_leaves));
  assert_int_equal(leaves, other_leaves);
}

static void reading_gives_the_solver_that_wrote(void** state) {
  hrad_solver *solver = room(0.1), *other = new_solver();
  double accuracy = 0;
  (void)state;
  assert_ok(hrad_solve(solver));
  assert_ok(hrad_write_checkpoint(solver, path));
  assert_ok(hrad_read_checkpoint(other, path));
  assert_same_answers(solver, other);
  assert_int_equal(patch_count(other), 14);
  assert_int_equal(material_count(other), 2);
  assert_ok(hrad_get_double(other, "accuracy", &accuracy));
  assert_true(accuracy == 0.1);
  /* The file is exported as the solution is. */
  assert_ok(hrad_write_checkpoint(other, other_path));
  assert_ok(hrad_solve(other));
  assert_same_answers(solver, other);
  hrad_destroy(&solver);
  hrad_destroy(&other);
}

static int32_t stop_in_sweeps(const hrad_progress* progress, void* user) {
  return strcmp(progress->stage, "sweep") == 0 && progress->iteration >= *(int64_t*)user;
}

static void a_stopped_solve_goes_on_elsewhere(void** state) {
  hrad_solver *whole = room(0.1), *part = room(0.1), *rest = new_solver();
  int64_t sweeps = 2;
  (void)state;
  assert_ok(hrad_solve(whole));
  assert_ok(hrad_set_progress(part, stop_in_sweeps, &sweeps));
  assert_status(hrad_solve(part), HRAD_STOPPED);
  assert_ok(hrad_write_checkpoint(part, path));
  assert_ok(hrad_set_int(rest, "threads", 2));
  assert_ok(hrad_read_checkpoint(rest, path));
  assert_true(hash_of(rest) == hash_of(part));
  assert_ok(hrad_solve(rest));
  assert_same_answers(whole, rest);
  hrad_destroy(&whole);
  hrad_destroy(&part);
  hrad_destroy(&rest);
}

struct on_the_way {
  hrad_solver* solver;
  int reports, written, refused;
};

/* In the progress function a checkpoint can be written, here at every tenth report, and nothing else
 * can be done at any. */
static int32_t write_on_the_way(const hrad_progress* progress, void* user) {
  struct on_the_way* way = (struct on_the_way*)user;
  hrad_status status = HRAD_OK;
  uint64_t hash;
  if (way->reports++ % 10 == 0) {
    status = hrad_write_checkpoint(way->solver, path);
    if (status == HRAD_OK) ++way->written;
  }
  if (status == HRAD_ERROR_STATE) ++way->refused;
  return hrad_read_checkpoint(way->solver, path) != HRAD_ERROR_STATE ||
         hrad_lock_checkpoint(way->solver, path) != HRAD_ERROR_STATE ||
         hrad_state_hash(way->solver, &hash) != HRAD_ERROR_STATE ||
         (status != HRAD_OK && strcmp(progress->stage, "linking") != 0);
}

static void the_progress_function_writes(void** state) {
  hrad_solver *solver = room(0.2), *other = new_solver();
  struct on_the_way way = {NULL, 0, 0, 0};
  (void)state;
  way.solver = solver;
  assert_ok(hrad_set_int(solver, "checkpoint_keep", 0));
  assert_ok(hrad_set_int(solver, "resumable", 1));
  assert_ok(hrad_set_progress(solver, write_on_the_way, &way));
  assert_ok(hrad_solve(solver));
  assert_true(way.written > 3);
  assert_ok(hrad_read_checkpoint(other, path));
  assert_ok(hrad_solve(other));
  assert_same_answers(solver, other);
  hrad_destroy(&solver);
  hrad_destroy(&other);
}

static void what_does_not_fit_is_refused(void** state) {
  hrad_solver *solver = room(0.2), *other = room(0.2), *third = new_solver();
  static const char* const differences[] = {"corner 0 of patch 12 has x = ",
                                            "patch 0 has the flags 0", "3 bands and the scene 1"};
  const double dim[3] = {1, 1, 1};
  uint64_t hash;
  int k;
  FILE* file;
  (void)state;
  assert_ok(hrad_solve(solver));
  assert_ok(hrad_write_checkpoint(solver, path));
  hash = hash_of(solver);
  /* The same scene is welcome, another is not. */
  assert_ok(hrad_read_checkpoint(other, path));
  assert_ok(hrad_set_emission(other, 12, 1, dim));
  assert_fails(hrad_read_checkpoint(other, path), HRAD_ERROR_STATE, "emission of patch 12");
  add_square(third, 0, 0, 0, 1, 0, add_gray(third, 0.5, 1, 0));
  assert_fails(hrad_read_checkpoint(third, path), HRAD_ERROR_STATE, "14 patches and the scene 2");
  assert_int_equal(patch_count(third), 2);
  /* Nor one of which a corner or a flag differs, or the bands. */
  for (k = 0; k < 3; ++k) {
    hrad_solver* near = new_solver();
    hrad_material wall = {.struct_size = sizeof wall, .flags = k == 1 ? HRAD_TWO_SIDED : 0};
    if (k == 2) assert_ok(hrad_set_int(near, "bands", 1));
    assert_ok(hrad_add_material(near, &wall, NULL));
    add_gray(near, 0.1, k == 2 ? 0 : 10, 0);
    add_room(near, 0);
    add_square(near, 0.5, 0.5, 0.9, k == 0 ? 0.21 : 0.2, 1, 1);
    assert_int_equal(patch_count(near), 14);
    assert_fails(hrad_read_checkpoint(near, path), HRAD_ERROR_STATE, differences[k]);
    assert_int_equal(patch_count(near), 14);
    hrad_destroy(&near);
  }
  /* Parameters of results hold from then on. */
  assert_fails(hrad_set_int(solver, "seed", 9), HRAD_ERROR_STATE, "'seed' is 1");
  assert_fails(hrad_set_text(other, "linking", "pairs"), HRAD_ERROR_STATE, "pairs");
  assert_ok(hrad_set_int(other, "max_iterations", 3000));
  assert_ok(hrad_set_int(other, "checkpoint_keep", 3));
  /* Damage. */
  file = fopen(other_path, "wb");
  assert_non_null(file);
  fputs("no checkpoint", file);
  fclose(file);
  assert_fails(hrad_read_checkpoint(solver, other_path), HRAD_ERROR_FORMAT, "section 'head'");
  assert_fails(hrad_read_checkpoint(solver, folder), HRAD_ERROR_FILE, folder);
  assert_true(hash_of(solver) == hash);
  hrad_destroy(&solver);
  hrad_destroy(&other);
  hrad_destroy(&third);
}

/* Also of a scene in which nothing exchanges light. */
static void any_scene_is_read_back(void** state) {
  hrad_solver *solver = new_solver(), *other = new_solver();
  hrad_material wall = {.struct_size = sizeof wall, .flags = HRAD_BLOCKER, .name = "wall"};
  const double line[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
  const int64_t corners[3] = {0, 1, 2};
  (void)state;
  assert_ok(hrad_add_material(solver, &wall, NULL));
  add_square(solver, 0, 0, 0, 1, 0, 0);
  assert_ok(hrad_solve(solver));
  assert_ok(hrad_write_checkpoint(solver, path));
  assert_ok(hrad_read_checkpoint(other, path));
  assert_true(hash_of(solver) == hash_of(other));
  assert_ok(hrad_solve(other));
  hrad_destroy(&solver);
  hrad_destroy(&other);
  /* Nothing but a patch that was dropped. */
  solver = new_solver();
  other = new_solver();
  assert_ok(hrad_add_patches(solver, 3, line, 1, corners, NULL));
  if (hrad_solve(solver) == HRAD_OK) {
    assert_ok(hrad_write_checkpoint(solver, path));
    assert_ok(hrad_read_checkpoint(other, path));
    assert_true(hash_of(solver) == hash_of(other));
  }
  hrad_destroy(&solver);
  hrad_destroy(&other);
}

static int32_t stop_in_refinement(const hrad_progress* progress, void* user) {
  (void)user;
  return strcmp(progress->stage, "refine") == 0;
}

static void a_file_is_described_without_a_solver(void** state) {
  hrad_solver* solver = room(0.2);
  char text[4096];
  int64_t needed = 0;
  (void)state;
  assert_ok(hrad_write_checkpoint(solver, path));
  assert_ok(hrad_describe_checkpoint(path, text, sizeof text, &needed));
  assert_int_equal(needed, strlen(text) + 1);
  assert_non_null(strstr(text, "state: not begun\n"));
  assert_ok(hrad_set_text(solver, "linking", "pairs"));
  assert_ok(hrad_set_progress(solver, stop_in_refinement, NULL));
  assert_status(hrad_solve(solver), HRAD_STOPPED);
  assert_ok(hrad_write_checkpoint(solver, path));
  assert_ok(hrad_describe_checkpoint(path, text, sizeof text, NULL));
  assert_non_null(strstr(text, "state: stopped between rounds\n"));
  assert_ok(hrad_set_progress(solver, NULL, NULL));
  assert_ok(hrad_solve(solver));
  assert_ok(hrad_write_checkpoint(solver, path));
  assert_ok(hrad_describe_checkpoint(path, text, sizeof text, NULL));
  assert_non_null(strstr(text, "written by: libhrad " /* its version */));
  assert_non_null(strstr(text, "state: converged\n"));
  assert_non_null(strstr(text, "patches: 14\n"));
  assert_ok(hrad_describe_checkpoint(path, NULL, 0, &needed));
  assert_fails(hrad_describe_checkpoint("none.hrad", text, sizeof text, NULL), HRAD_ERROR_FILE,
               "none.hrad");
  assert_status(hrad_describe_checkpoint(NULL, text, sizeof text, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_describe_checkpoint(path, text, -1, NULL), HRAD_ERROR_ARGUMENT);
  hrad_destroy(&solver);
}

static void a_lock_keeps_others_away(void** state) {
  hrad_solver *one = room(0.2), *other = room(0.2);
  (void)state;
  assert_ok(hrad_lock_checkpoint(one, path));
  assert_fails(hrad_write_checkpoint(other, path), HRAD_ERROR_FILE, "another process");
  assert_fails(hrad_lock_checkpoint(other, path), HRAD_ERROR_FILE, "another process");
  assert_ok(hrad_write_checkpoint(other, other_path));
  assert_ok(hrad_write_checkpoint(one, path));
  assert_status(hrad_lock_checkpoint(one, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_lock_checkpoint(one, ""), HRAD_ERROR_FILE);
  assert_fails(hrad_lock_checkpoint(one, folder), HRAD_ERROR_FILE, folder);
  assert_status(hrad_lock_checkpoint(NULL, path), HRAD_ERROR_ARGUMENT);
  hrad_destroy(&one);
  assert_ok(hrad_write_checkpoint(other, path));
  hrad_destroy(&other);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(reading_gives_the_solver_that_wrote),
                                     cmocka_unit_test(a_stopped_solve_goes_on_elsewhere),
                                     cmocka_unit_test(the_progress_function_writes),
                                     cmocka_unit_test(what_does_not_fit_is_refused),
                                     cmocka_unit_test(any_scene_is_read_back),
                                     cmocka_unit_test(a_file_is_described_without_a_solver),
                                     cmocka_unit_test(a_lock_keeps_others_away)};
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
