! hrad.h, section "solve".
module hrad_solving
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_funloc, c_funptr, c_int32_t, c_int64_t, &
    c_null_funptr, c_ptr
  use hrad_c_results, only: c_get_stats, c_progress, c_request_stop, c_set_progress, c_solve, &
    c_state_hash
  use hrad_constants, only: HRAD_OK
  use hrad_errors, only: finish
  use hrad_text, only: fortran_text
  use hrad_types, only: callback_record, callbacks_of, handle_of, hrad_progress, &
    hrad_progress_procedure, hrad_solver, hrad_stats
  implicit none
  private
  public :: hrad_set_progress, hrad_solve, hrad_request_stop, hrad_get_stats, hrad_state_hash

contains

  ! From now on progress(progress, context) is called between tasks while hrad_solve runs,
  ! on rank 0's calling thread; .true. stops the solve. Without it there are no calls (the default).
  ! context must have the attribute target and live as long as it may be called with it. Errors:
  ! ARGUMENT for an empty solver.
  subroutine hrad_set_progress(solver, progress, context, status)
    type(hrad_solver), intent(in) :: solver
    procedure(hrad_progress_procedure), optional :: progress
    class(*), intent(inout), target, optional :: context
    integer(c_int32_t), intent(out), optional :: status
    type(callback_record), pointer :: record
    type(c_ptr) :: address
    type(c_funptr) :: function_address
    integer(c_int32_t) :: code
    call callbacks_of(solver, record, address)
    function_address = c_null_funptr
    if (present(progress)) function_address = c_funloc(forward_progress)
    code = c_set_progress(handle_of(solver), function_address, address)
    if (code == HRAD_OK) then
      record%progress => null()
      record%progress_context => null()
      if (present(progress)) record%progress => progress
      if (present(context)) record%progress_context => context
    end if
    call finish(code, status)
  end subroutine hrad_set_progress

  ! What C calls: hands progress to the user's procedure; 1 stops the solve.
  function forward_progress(progress, user) bind(c, name="") result(stops)
    type(c_ptr), value :: progress, user
    integer(c_int32_t) :: stops
    type(callback_record), pointer :: record
    type(c_progress), pointer :: from
    type(hrad_progress) :: now
    call c_f_pointer(user, record)
    call c_f_pointer(progress, from)
    now%stage = fortran_text(from%stage)
    now%iteration = from%iteration
    now%fraction = from%fraction
    now%seconds = from%seconds
    now%seconds_left = from%seconds_left
    stops = 0
    if (record%progress(now, record%progress_context)) stops = 1
  end function forward_progress

  ! Solves, or goes on from the present state; with the parameter refine = 0, for a new emission or
  ! reflectance, by sweeps over the present mesh and links alone. Status: HRAD_OK,
  ! HRAD_NOT_CONVERGED, or HRAD_STOPPED (call it again to go on); without the argument status these
  ! three go on alike: hrad_stats%converged tells. Errors: SCENE for an empty scene, STATE for
  ! refine = 0 without links, UNSUPPORTED for a method that is not in this build, MEMORY.
  subroutine hrad_solve(solver, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(out), optional :: status
    call finish(c_solve(handle_of(solver)), status)
  end subroutine hrad_solve

  ! Asks a running hrad_solve to stop at the next safe point. From any thread or callback; an empty
  ! solver is fine.
  subroutine hrad_request_stop(solver)
    type(hrad_solver), intent(in) :: solver
    call c_request_stop(handle_of(solver))
  end subroutine hrad_request_stop

  ! Counts and times so far; zeros before a solve. Errors: ARGUMENT for an empty handle.
  subroutine hrad_get_stats(solver, stats, status)
    type(hrad_solver), intent(in) :: solver
    type(hrad_stats), intent(inout) :: stats
    integer(c_int32_t), intent(out), optional :: status
    type(hrad_stats) :: found
    integer(c_int32_t) :: code
    code = c_get_stats(handle_of(solver), found)
    if (code == HRAD_OK) stats = found
    call finish(code, status)
  end subroutine hrad_get_stats

  ! A hash of scene, result parameters, tree, links and radiosity: 64 bits, to be printed by the
  ! format z16.16. Errors: STATE before a solve.
  subroutine hrad_state_hash(solver, hash, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(inout) :: hash
    integer(c_int32_t), intent(out), optional :: status
    call finish(c_state_hash(handle_of(solver), hash), status)
  end subroutine hrad_state_hash
end module hrad_solving
