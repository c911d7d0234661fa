! A solver over several processes in a program that has MPI by module mpi_f08, whose communicators
! are a type: its component mpi_val is the integer; also of a part of the processes.
program test_mpi_f08
  use check
  use hrad
  use hrad_mpi
  use mpi_f08
  implicit none
  type(hrad_solver) :: solver
  type(hrad_stats) :: stats
  type(MPI_Comm) :: half
  integer :: level, rank, ranks, status
  call mpi_init_thread(MPI_THREAD_FUNNELED, level)
  call mpi_comm_rank(MPI_COMM_WORLD, rank)
  call mpi_comm_split(MPI_COMM_WORLD, mod(rank, 2), rank, half)
  call mpi_comm_size(half, ranks)
  call hrad_create_mpi(half%mpi_val, solver, status)
  call expect_ok(status, "hrad_create_mpi")
  call mpi_comm_free(half)
  call hrad_make_scene(solver, "furnace")
  call hrad_set_double(solver, "accuracy", 0.1d0)
  call hrad_solve(solver, status)
  call expect_ok(status, "hrad_solve")
  call hrad_get_stats(solver, stats)
  call expect(stats%ranks == ranks, "the ranks of the communicator")
  call hrad_destroy(solver)
  call mpi_finalize()
  call finish_checks()
end program test_mpi_f08
