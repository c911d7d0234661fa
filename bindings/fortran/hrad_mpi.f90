! hrad_mpi.h: solvers over several processes. Beside module hrad, so that programs of one process
! need no MPI; programs that use it link the libraries hrad_fortran_mpi and hrad_mpi besides. What
! hrad_mpi.h says of ranks, MPI and threads holds here too.
module hrad_mpi
  use, intrinsic :: iso_c_binding, only: c_int, c_int32_t, c_null_ptr, c_ptr
  use hrad_constants, only: HRAD_OK
  use hrad_errors, only: finish
  use hrad_types, only: adopt, hrad_solver
  implicit none
  private
  public :: hrad_create_mpi

  interface
    function c_create_mpi(comm, solver) bind(c, name="hrad_create_mpi_f") result(status)
      import :: c_int, c_int32_t, c_ptr
      integer(c_int), value :: comm
      type(c_ptr), intent(inout) :: solver
      integer(c_int32_t) :: status
    end function c_create_mpi
  end interface

contains

  ! Makes an empty solver whose ranks are the processes of comm, which is duplicated; give it back
  ! with hrad_destroy, on all ranks and before mpi_finalize. Of a communicator of module mpi_f08
  ! take comm%mpi_val. Errors: MPI before mpi_init_thread, after mpi_finalize, or on a thread that
  ! may not call MPI; ARGUMENT for MPI_COMM_NULL or an intercommunicator; MEMORY.
  subroutine hrad_create_mpi(comm, solver, status)
    integer, intent(in) :: comm
    type(hrad_solver), intent(inout) :: solver
    integer(c_int32_t), intent(out), optional :: status
    type(c_ptr) :: handle
    integer(c_int32_t) :: code
    handle = c_null_ptr
    code = c_create_mpi(int(comm, c_int), handle)
    if (code == HRAD_OK) call adopt(handle, solver)
    call finish(code, status)
  end subroutine hrad_create_mpi
end module hrad_mpi
