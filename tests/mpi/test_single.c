/* A program that starts MPI by MPI_Init, which promises that it has one thread: a solver can be
 * made, and warns of threads that MPI doesn't expect. */
#include <string.h>

#include "api/api.h"
#include "mpi_program.h"

static int warnings = 0;
static void count_warnings(int32_t level, const char* message, void* user) {
  (void)user;
  if (level == HRAD_LOG_WARNING && strstr(message, "MPI_THREAD_FUNNELED") != NULL) ++warnings;
}

static int warnings_with_threads(int64_t threads) {
  hrad_solver* solver = NULL;
  assert_ok(hrad_create_mpi(MPI_COMM_WORLD, &solver));
  assert_ok(hrad_set_log(solver, count_warnings, NULL, HRAD_LOG_WARNING));
  assert_ok(hrad_set_int(solver, "threads", threads));
  assert_ok(hrad_make_scene(solver, "furnace"));
  warnings = 0;
  assert_ok(hrad_partition(solver));
  hrad_destroy(&solver);
  return warnings;
}

static void several_threads_are_warned_of(void** state) {
  int level = MPI_THREAD_MULTIPLE;
  (void)state;
  MPI_Query_thread(&level);
  assert_int_equal(level, MPI_THREAD_SINGLE);
  assert_int_equal(warnings_with_threads(1), 0);
  assert_int_equal(warnings_with_threads(2), 1);
}

int main(int argc, char** argv) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(several_threads_are_warned_of)};
  MPI_Init(&argc, &argv);
  run_together(tests, 1);
  MPI_Finalize();
  return 0;
}
