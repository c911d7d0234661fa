/* hrad_mpi.h: what is refused, the same outcome on all ranks, and a program's communicators as they
 * were before. */
#include <pthread.h>
#include <string.h>

#include "api/api.h"
#include "mpi_program.h"

/* On all ranks the call fails with this status and with one message, which has the text. */
static void assert_all_fail(hrad_status got, hrad_status wanted, const char* text) {
  char mine[512] = "", first[512] = "";
  int different, anywhere = 0;
  strncpy(mine, hrad_error_message(), sizeof mine - 1);
  memcpy(first, mine, sizeof first);
  MPI_Bcast(first, sizeof first, MPI_CHAR, 0, MPI_COMM_WORLD);
  different = got != wanted || strcmp(mine, first) != 0 || strstr(mine, text) == NULL;
  MPI_Allreduce(&different, &anywhere, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  if (anywhere)
    fail_msg("rank %d: %s '%s', rank 0 says '%s'", rank_of_world(), hrad_status_name(got), mine,
             first);
}

static int is_last(void) { return rank_of_world() == size_of_world() - 1; }

static hrad_solver* solver_over(MPI_Comm comm) {
  hrad_solver* solver = NULL;
  assert_ok(hrad_create_mpi(comm, &solver));
  assert_non_null(solver);
  return solver;
}

static void refused_before_mpi_init(void** state) {
  hrad_solver* solver = NULL;
  (void)state;
  assert_fails(hrad_create_mpi(MPI_COMM_WORLD, &solver), HRAD_ERROR_MPI,
               "call MPI_Init_thread before");
  assert_fails(hrad_create_mpi_f(0, &solver), HRAD_ERROR_MPI, "call MPI_Init_thread before");
  assert_null(solver);
}

static void refused_after_mpi_finalize(void** state) {
  hrad_solver* solver = NULL;
  (void)state;
  assert_fails(hrad_create_mpi(MPI_COMM_WORLD, &solver), HRAD_ERROR_MPI, "MPI has ended");
  assert_fails(hrad_create_mpi_f(0, &solver), HRAD_ERROR_MPI, "MPI has ended");
  assert_null(solver);
}

static void makes_an_empty_solver(void** state) {
  hrad_solver* solver = solver_over(MPI_COMM_WORLD);
  (void)state;
  assert_int_equal(patch_count(solver), 0);
  assert_ok(hrad_set_double(solver, "accuracy", 0.1));
  hrad_destroy(&solver);
  assert_null(solver);
  assert_ok(hrad_create_mpi_f(MPI_Comm_c2f(MPI_COMM_WORLD), &solver));
  assert_ok(hrad_set_double(solver, "accuracy", 0.1));
  hrad_destroy(&solver);
}

static void null_on_one_rank_fails_on_all(void** state) {
  hrad_solver* solver = NULL;
  (void)state;
  assert_all_fail(hrad_create_mpi(MPI_COMM_WORLD, is_last() ? NULL : &solver), HRAD_ERROR_ARGUMENT,
                  "is NULL");
  assert_null(solver);
  assert_all_fail(hrad_create_mpi_f(MPI_Comm_c2f(MPI_COMM_WORLD), is_last() ? NULL : &solver),
                  HRAD_ERROR_ARGUMENT, "is NULL");
  assert_null(solver);
}

/* Of any collective function: what fails on one rank fails on all. */
static void one_rank_fails_for_all(void** state) {
  hrad_solver* solver = solver_over(MPI_COMM_WORLD);
  (void)state;
  assert_all_fail(hrad_set_int(solver, is_last() ? "no_such_parameter" : "seed", 1),
                  HRAD_ERROR_ARGUMENT, "no_such_parameter");
  assert_all_fail(hrad_load_scene(solver, "no_such_file.obj"), HRAD_ERROR_FILE, "no_such_file");
  hrad_destroy(&solver);
}

static void refuses_what_is_no_group_of_ranks(void** state) {
  hrad_solver* solver = NULL;
  (void)state;
  assert_fails(hrad_create_mpi(MPI_COMM_NULL, &solver), HRAD_ERROR_ARGUMENT, "MPI_COMM_NULL");
  assert_fails(hrad_create_mpi_f(MPI_Comm_c2f(MPI_COMM_NULL), &solver), HRAD_ERROR_ARGUMENT,
               "MPI_COMM_NULL");
  assert_null(solver);
}

static void* create_on_a_thread(void* failed) {
  hrad_solver* solver = NULL;
  const hrad_status status = hrad_create_mpi(MPI_COMM_WORLD, &solver);
  *(int*)failed = status == HRAD_ERROR_MPI && solver == NULL &&
                  strstr(hrad_error_message(), "may not call MPI") != NULL;
  return NULL;
}

/* MPI_THREAD_FUNNELED was asked for. */
static void refused_on_another_thread(void** state) {
  pthread_t thread;
  int failed = 0, level = MPI_THREAD_MULTIPLE;
  (void)state;
  MPI_Query_thread(&level);
  if (level > MPI_THREAD_FUNNELED) return;
  assert_int_equal(pthread_create(&thread, NULL, create_on_a_thread, &failed), 0);
  assert_int_equal(pthread_join(thread, NULL), 0);
  assert_true(failed);
}

static int errors_met = 0;
static void note_error(MPI_Comm* comm, int* code, ...) {
  (void)comm;
  (void)code;
  ++errors_met;
}

static void error_handler_stays(void** state) {
  MPI_Comm host;
  MPI_Errhandler own, found;
  hrad_solver* solver;
  int nothing = 0;
  (void)state;
  MPI_Comm_dup(MPI_COMM_WORLD, &host);
  MPI_Comm_create_errhandler(note_error, &own);
  MPI_Comm_set_errhandler(host, own);
  solver = solver_over(host);
  assert_ok(hrad_set_int(solver, "seed", 3));
  MPI_Comm_get_errhandler(host, &found);
  assert_true(found == own);
  MPI_Errhandler_free(&found);
  errors_met = 0;
  MPI_Send(&nothing, 1, MPI_INT, size_of_world() + 5, 0, host);
  assert_int_equal(errors_met, 1);
  hrad_destroy(&solver);
  MPI_Send(&nothing, 1, MPI_INT, size_of_world() + 5, 0, host);
  assert_int_equal(errors_met, 2);
  MPI_Errhandler_free(&own);
  MPI_Comm_free(&host);
}

/* An attribute of the communicator goes with every duplicate: those that are left can be counted.
 */
static int duplicates = 0, duplicates_ever = 0;
static int copy_attribute(MPI_Comm comm, int key, void* extra, void* in, void* out, int* flag) {
  (void)comm;
  (void)key;
  (void)extra;
  *(void**)out = in;
  *flag = 1;
  ++duplicates;
  ++duplicates_ever;
  return MPI_SUCCESS;
}
static int delete_attribute(MPI_Comm comm, int key, void* value, void* extra) {
  (void)comm;
  (void)key;
  (void)value;
  (void)extra;
  --duplicates;
  return MPI_SUCCESS;
}

static void no_communicator_is_left(void** state) {
  enum { many = 500 };
  MPI_Comm host;
  int key = MPI_KEYVAL_INVALID, k;
  (void)state;
  MPI_Comm_dup(MPI_COMM_WORLD, &host);
  MPI_Comm_create_keyval(copy_attribute, delete_attribute, &key, NULL);
  MPI_Comm_set_attr(host, key, &key);
  duplicates = duplicates_ever = 0;
  for (k = 0; k < many; ++k) {
    hrad_solver* solver = solver_over(host);
    hrad_destroy(&solver);
    /* Also when no solver comes of it. */
    if (k % 10 == 0) assert_int_equal(hrad_create_mpi(host, NULL), HRAD_ERROR_ARGUMENT);
    assert_int_equal(duplicates, 0);
  }
  assert_true(duplicates_ever >= many);
  MPI_Comm_delete_attr(host, key);
  MPI_Comm_free_keyval(&key);
  MPI_Comm_free(&host);
}

/* Two solvers over other groups of ranks, their calls mixed; a communicator is not needed any more
 * once the solver is made. */
static void two_solvers_on_two_communicators(void** state) {
  MPI_Comm half, reversed;
  hrad_solver *one, *other;
  const int rank = rank_of_world();
  int k;
  (void)state;
  MPI_Comm_split(MPI_COMM_WORLD, rank % 2, rank, &half);
  MPI_Comm_split(MPI_COMM_WORLD, 0, -rank, &reversed);
  one = solver_over(half);
  other = solver_over(reversed);
  MPI_Comm_free(&half);
  MPI_Comm_free(&reversed);
  for (k = 1; k <= 20; ++k) {
    int64_t seed = 0;
    assert_ok(hrad_set_int(one, "seed", 10 * k + rank % 2));
    /* Fails on its half alone. */
    if (rank % 2 == 0) assert_status(hrad_set_int(one, NULL, 1), HRAD_ERROR_ARGUMENT);
    assert_ok(hrad_set_int(other, "seed", k));
    assert_all_fail(hrad_set_int(other, k % size_of_world() == rank ? NULL : "seed", k),
                    HRAD_ERROR_ARGUMENT, "NULL");
    assert_ok(hrad_get_int(one, "seed", &seed));
    assert_int_equal(seed, 10 * k + rank % 2);
    assert_ok(hrad_get_int(other, "seed", &seed));
    assert_int_equal(seed, k);
  }
  hrad_destroy(&one);
  hrad_destroy(&other);
}

int main(int argc, char** argv) {
  const struct CMUnitTest before[] = {cmocka_unit_test(refused_before_mpi_init)};
  const struct CMUnitTest between[] = {
      cmocka_unit_test(makes_an_empty_solver),
      cmocka_unit_test(null_on_one_rank_fails_on_all),
      cmocka_unit_test(one_rank_fails_for_all),
      cmocka_unit_test(refuses_what_is_no_group_of_ranks),
      cmocka_unit_test(refused_on_another_thread),
      cmocka_unit_test(error_handler_stays),
      cmocka_unit_test(no_communicator_is_left),
      cmocka_unit_test(two_solvers_on_two_communicators),
  };
  const struct CMUnitTest after[] = {cmocka_unit_test(refused_after_mpi_finalize)};
  int level = MPI_THREAD_SINGLE;
  if (cmocka_run_group_tests(before, NULL, NULL) != 0) return 1;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  run_together(between, sizeof between / sizeof *between);
  MPI_Finalize();
  return cmocka_run_group_tests(after, NULL, NULL);
}
