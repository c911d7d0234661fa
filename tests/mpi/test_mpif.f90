! A solver over several processes in a program that has MPI by its oldest way, mpif.h: the
! communicator is an integer there too.
program test_mpif
  use check
  use hrad
  use hrad_mpi
  implicit none
  include 'mpif.h'
  type(hrad_solver) :: solver
  type(hrad_stats) :: stats
  integer :: level, code, ranks, status
  call mpi_init_thread(MPI_THREAD_FUNNELED, level, code)
  call mpi_comm_size(MPI_COMM_WORLD, ranks, code)
  call hrad_create_mpi(MPI_COMM_WORLD, solver, status)
  call expect_ok(status, "hrad_create_mpi")
  call hrad_make_scene(solver, "furnace")
  call hrad_set_double(solver, "accuracy", 0.1d0)
  call hrad_solve(solver, status)
  call expect_ok(status, "hrad_solve")
  call hrad_get_stats(solver, stats)
  call expect(stats%ranks == ranks, "the ranks of MPI_COMM_WORLD")
  call hrad_destroy(solver)
  call mpi_finalize(code)
  call finish_checks()
end program test_mpif
