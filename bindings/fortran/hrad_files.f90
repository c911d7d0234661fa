! hrad.h, section "files".
module hrad_files
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use hrad_c_results, only: c_export, c_read_checkpoint, c_write_checkpoint
  use hrad_checks, only: has_nul
  use hrad_errors, only: finish
  use hrad_text, only: c_text
  use hrad_types, only: handle_of, hrad_solver
  implicit none
  private
  public :: hrad_write_checkpoint, hrad_read_checkpoint, hrad_export

contains

  ! Writes a checkpoint. Not in this version. Errors: UNSUPPORTED.
  subroutine hrad_write_checkpoint(solver, path, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_write_checkpoint", "path", path, status)) return
    call finish(c_write_checkpoint(handle_of(solver), c_text(path)), status)
  end subroutine hrad_write_checkpoint

  ! Reads a checkpoint. Not in this version. Errors: UNSUPPORTED.
  subroutine hrad_read_checkpoint(solver, path, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_read_checkpoint", "path", path, status)) return
    call finish(c_read_checkpoint(handle_of(solver), c_text(path)), status)
  end subroutine hrad_read_checkpoint

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
