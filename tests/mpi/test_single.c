/* A program that starts MPI by MPI_Init, which promises that it has one thread: a solver can be
 * made. */
#include "api/api.h"
#include "mpi_program.h"

static void a_solver_can_be_made(void** state) {
  hrad_solver* solver = NULL;
  int level = MPI_THREAD_MULTIPLE;
  (void)state;
  MPI_Query_thread(&level);
  assert_int_equal(level, MPI_THREAD_SINGLE);
  assert_ok(hrad_create_mpi(MPI_COMM_WORLD, &solver));
  assert_ok(hrad_set_int(solver, "threads", 1));
  hrad_destroy(&solver);
}

int main(int argc, char** argv) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_solver_can_be_made)};
  MPI_Init(&argc, &argv);
  run_together(tests, 1);
  MPI_Finalize();
  return 0;
}
