! hrad.h, section "files".
module hrad_files
  use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_int64_t
  use hrad_c_results, only: c_describe_checkpoint, c_export, c_lock_checkpoint, &
    c_read_checkpoint, c_write_checkpoint
  use hrad_checks, only: has_nul
  use hrad_constants, only: HRAD_OK
  use hrad_errors, only: finish
  use hrad_text, only: c_text, text_of_buffer
  use hrad_types, only: handle_of, hrad_solver
  implicit none
  private
  public :: hrad_write_checkpoint, hrad_lock_checkpoint, hrad_read_checkpoint
  public :: hrad_describe_checkpoint, hrad_export

contains

  ! Writes a checkpoint (.hrad) at any time between other calls, or from the progress callback of a
  ! solve. The file appears whole under its name or not at all; older ones stay as PATH.prev,
  ! PATH.prev2 and so on, as the parameter checkpoint_keep says. Errors: FILE (the old file is
  ! whole), also when another process holds the lock; STATE from the callback while there is nothing
  ! to go on from, or of several ranks, which must write together.
  subroutine hrad_write_checkpoint(solver, path, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_write_checkpoint", "path", path, status)) return
    call finish(c_write_checkpoint(handle_of(solver), c_text(path)), status)
  end subroutine hrad_write_checkpoint

  ! Locks a checkpoint against other writers until the solver locks another one or is destroyed.
  ! Errors: FILE when it is locked already or PATH.lock can't be made.
  subroutine hrad_lock_checkpoint(solver, path, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_lock_checkpoint", "path", path, status)) return
    call finish(c_lock_checkpoint(handle_of(solver), c_text(path)), status)
  end subroutine hrad_lock_checkpoint

  ! Reads a checkpoint: the solver is then as the one that wrote it was, with the same hash. A
  ! solver that has patches must have the same scene. Errors: FILE; FORMAT for a file that is
  ! damaged or no checkpoint; STATE for another scene; MEMORY. The solver is then as it was.
  subroutine hrad_read_checkpoint(solver, path, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_read_checkpoint", "path", path, status)) return
    call finish(c_read_checkpoint(handle_of(solver), c_text(path)), status)
  end subroutine hrad_read_checkpoint

  ! Checks a whole checkpoint, without a solver, and describes it, one "name: value" a line. Errors:
  ! as for hrad_read_checkpoint.
  subroutine hrad_describe_checkpoint(path, text, status)
    character(len=*), intent(in) :: path
    character(len=:), allocatable, intent(inout) :: text
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable :: buffer(:)
    integer(c_int64_t) :: needed
    integer(c_int32_t) :: code
    if (has_nul("hrad_describe_checkpoint", "path", path, status)) return
    allocate (buffer(1))
    needed = 0
    code = c_describe_checkpoint(c_text(path), buffer, 0_c_int64_t, needed)
    if (code == HRAD_OK) then
      deallocate (buffer)
      allocate (buffer(needed))
      code = c_describe_checkpoint(c_text(path), buffer, needed, needed)
    end if
    if (code == HRAD_OK) text = text_of_buffer(buffer)
    call finish(code, status)
  end subroutine hrad_describe_checkpoint

  ! Writes the solution in the format of the path's ending, .csv, .vtu, .ply or .glb, or the scene
  ! as .obj. Numbers in files count from 0. Errors: ARGUMENT for another ending, FILE, STATE before
  ! a solve, UNSUPPORTED for a solution larger than the format can hold.
  subroutine hrad_export(solver, path, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_export", "path", path, status)) return
    call finish(c_export(handle_of(solver), c_text(path)), status)
  end subroutine hrad_export
end module hrad_files
