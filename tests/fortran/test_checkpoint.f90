! Checkpoints: written after a solve and by the progress callback, described, locked, read to the
! same bits; files that are missing, damaged or of another scene are refused.
module writer
  use hrad
  implicit none
  public

  ! A solver that is written by its own progress callback.
  type :: written_solver
    type(hrad_solver) :: solver
    integer :: status = 99
  end type written_solver

contains

  ! Writes once, when there are links to be kept, and stops.
  logical function write_and_stop(progress, context)
    type(hrad_progress), intent(in) :: progress
    class(*), intent(inout), optional :: context
    write_and_stop = progress%stage == "sweep"
    if (.not. write_and_stop) return
    select type (context)
    type is (written_solver)
      call hrad_write_checkpoint(context%solver, "fortran_stopped.hrad", context%status)
    end select
  end function write_and_stop
end module writer

program test_checkpoint
  use, intrinsic :: iso_fortran_env, only: int64
  use check
  use hrad
  use writer
  implicit none
  integer(int64) :: hash
  call written_and_read()
  call written_by_the_callback()
  call refused()
  call finish_checks()

contains

  subroutine written_and_read()
    type(hrad_solver) :: solver, other
    character(len=:), allocatable :: text
    integer(int64) :: found
    integer :: status
    call solved_cornell(solver)
    call hrad_state_hash(solver, hash)
    call hrad_set_int(solver, "checkpoint_keep", 0)
    call hrad_lock_checkpoint(solver, "fortran.hrad", status)
    call expect_ok(status, "hrad_lock_checkpoint")
    call hrad_create(other)
    call hrad_lock_checkpoint(other, "fortran.hrad", status)
    call expect_fails(status, HRAD_ERROR_FILE, "fortran.hrad", "a second lock")
    call hrad_write_checkpoint(solver, "fortran.hrad  ", status)
    call expect_ok(status, "hrad_write_checkpoint")
    call hrad_read_checkpoint(other, "fortran.hrad", status)
    call expect_ok(status, "hrad_read_checkpoint")
    call hrad_state_hash(other, found)
    call expect(found == hash, "the same bits are read")
    call hrad_describe_checkpoint("fortran.hrad", text, status)
    call expect_ok(status, "hrad_describe_checkpoint")
    call expect(index(text, ": ") > 0 .and. index(text, achar(10)) > 0, "it describes in lines")
    call hrad_destroy(solver)
    call hrad_destroy(other)
  end subroutine written_and_read

  subroutine written_by_the_callback()
    type(written_solver), target :: stopped
    type(hrad_solver) :: other
    integer(int64) :: found
    integer :: status
    call hrad_create(stopped%solver)
    call hrad_make_scene(stopped%solver, "cornell")
    call hrad_set_double(stopped%solver, "accuracy", 0.1d0)
    call hrad_set_int(stopped%solver, "checkpoint_keep", 0)
    call hrad_set_progress(stopped%solver, write_and_stop, stopped)
    call hrad_solve(stopped%solver, status)
    call expect(status == HRAD_STOPPED, "the callback stops the solve")
    call expect_ok(stopped%status, "hrad_write_checkpoint in a callback")
    call hrad_destroy(stopped%solver)
    call hrad_create(other)
    call hrad_make_scene(other, "cornell")
    call hrad_read_checkpoint(other, "fortran_stopped.hrad", status)
    call expect_ok(status, "hrad_read_checkpoint of a stopped solve")
    call hrad_solve(other, status)
    call expect_ok(status, "it goes on")
    call hrad_state_hash(other, found)
    call expect(found == hash, "to the same bits")
    call hrad_destroy(other)
  end subroutine written_by_the_callback

  subroutine refused()
    type(hrad_solver) :: solver
    character(len=:), allocatable :: text
    integer :: status, unit
    call hrad_create(solver)
    call hrad_read_checkpoint(solver, "no_such_file.hrad", status)
    call expect_fails(status, HRAD_ERROR_FILE, "no_such_file.hrad", "a missing file")
    text = "untouched"
    call hrad_describe_checkpoint("no_such_file.hrad", text, status)
    call expect(status == HRAD_ERROR_FILE .and. text == "untouched", "it is not described")
    open (newunit=unit, file="fortran_damaged.hrad", status="replace", action="write")
    write (unit, "(a)") "no checkpoint"
    close (unit)
    call hrad_read_checkpoint(solver, "fortran_damaged.hrad", status)
    call expect(status == HRAD_ERROR_FORMAT, "a file that is no checkpoint")
    call hrad_describe_checkpoint("fortran_damaged.hrad", text, status)
    call expect(status == HRAD_ERROR_FORMAT .and. text == "untouched", "it is not described")
    call hrad_make_scene(solver, "furnace")
    call hrad_read_checkpoint(solver, "fortran.hrad", status)
    call expect(status == HRAD_ERROR_STATE, "another scene")
    call hrad_destroy(solver)
  end subroutine refused
end program test_checkpoint
