! Solvers over several processes from Fortran: made, refused, and the same outcome on all ranks.
program test_fortran
  use check
  use hrad
  use hrad_mpi
  use mpi
  implicit none
  integer :: level, code, rank, ranks
  call refused_before_mpi_init()
  call mpi_init_thread(MPI_THREAD_FUNNELED, level, code)
  call mpi_comm_rank(MPI_COMM_WORLD, rank, code)
  call mpi_comm_size(MPI_COMM_WORLD, ranks, code)
  call makes_a_solver()
  call refuses_no_communicator()
  call mpi_finalize(code)
  call finish_checks()

contains

  subroutine refused_before_mpi_init()
    type(hrad_solver) :: solver
    integer :: status
    call hrad_create_mpi(0, solver, status)
    call expect_fails(status, HRAD_ERROR_MPI, "MPI_Init_thread", "hrad_create_mpi too early")
  end subroutine refused_before_mpi_init

  ! A parameter that one rank gives wrongly is refused on all.
  subroutine makes_a_solver()
    type(hrad_solver) :: solver
    integer :: status, bands
    call hrad_create_mpi(MPI_COMM_WORLD, solver, status)
    call expect_ok(status, "hrad_create_mpi")
    call hrad_set_int(solver, "bands", 5, status)
    call expect_ok(status, "hrad_set_int on all ranks")
    call hrad_get_int(solver, "bands", bands)
    call expect(bands == 5, "bands on every rank")
    if (rank == ranks - 1) then
      call hrad_set_int(solver, "no_such_parameter", 5, status)
    else
      call hrad_set_int(solver, "bands", 5, status)
    end if
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "no_such_parameter", "the last rank's mistake")
    call hrad_destroy(solver)
  end subroutine makes_a_solver

  subroutine refuses_no_communicator()
    type(hrad_solver) :: solver
    integer :: status
    call hrad_create_mpi(MPI_COMM_NULL, solver, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "MPI_COMM_NULL", "no communicator")
  end subroutine refuses_no_communicator
end program test_fortran
