! hrad.h, sections "log" and "create".
module hrad_creation
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_funloc, c_funptr, c_int32_t, &
    c_null_funptr, c_null_ptr, c_ptr
  use hrad_c_setup, only: c_create, c_destroy, c_set_log
  use hrad_constants, only: HRAD_LOG_WARNING, HRAD_OK
  use hrad_errors, only: finish, leave_word_to_library
  use hrad_text, only: fortran_text
  use hrad_types, only: adopt, callback_record, callbacks_of, forget, handle_of, &
    hrad_log_procedure, hrad_solver
  implicit none
  private
  public :: hrad_create, hrad_destroy, hrad_set_log

contains

  ! Makes an empty solver for this process alone; give it back with hrad_destroy. Errors: MEMORY.
  subroutine hrad_create(solver, status)
    type(hrad_solver), intent(inout) :: solver
    integer(c_int32_t), intent(out), optional :: status
    type(c_ptr) :: handle
    integer(c_int32_t) :: code
    handle = c_null_ptr
    code = c_create(handle)
    if (code == HRAD_OK) call adopt(handle, solver)
    call finish(code, status)
  end subroutine hrad_create

  ! Frees a solver and everything in it, waits for its threads and empties the handle. An empty one
  ! is fine. Must not be called from a callback of the same solver: it does nothing then.
  subroutine hrad_destroy(solver)
    type(hrad_solver), intent(inout) :: solver
    type(c_ptr) :: handle
    handle = handle_of(solver)
    call c_destroy(handle)
    if (c_associated(handle)) then
      call leave_word_to_library()
    else
      call forget(solver)
    end if
  end subroutine hrad_destroy

  ! From now on log(level, message, context) receives every message up to `level`, HRAD_LOG_WARNING
  ! unless given, on the thread that called the solver. Without log messages are turned off (the
  ! default). context must have the attribute target and live as long as it may be called with it.
  ! Errors: ARGUMENT for an empty solver or a level outside 0..3.
  subroutine hrad_set_log(solver, log, context, level, status)
    type(hrad_solver), intent(in) :: solver
    procedure(hrad_log_procedure), optional :: log
    class(*), intent(inout), target, optional :: context
    integer(c_int32_t), intent(in), optional :: level
    integer(c_int32_t), intent(out), optional :: status
    type(callback_record), pointer :: record
    type(c_ptr) :: address
    type(c_funptr) :: function_address
    integer(c_int32_t) :: chosen, code
    call callbacks_of(solver, record, address)
    function_address = c_null_funptr
    if (present(log)) function_address = c_funloc(forward_log)
    chosen = HRAD_LOG_WARNING
    if (present(level)) chosen = level
    code = c_set_log(handle_of(solver), function_address, address, chosen)
    if (code == HRAD_OK) then
      record%log => null()
      record%log_context => null()
      if (present(log)) record%log => log
      if (present(context)) record%log_context => context
    end if
    call finish(code, status)
  end subroutine hrad_set_log

  ! What C calls: hands a message to the user's procedure.
  subroutine forward_log(level, message, user) bind(c, name="")
    integer(c_int32_t), value :: level
    type(c_ptr), value :: message, user
    type(callback_record), pointer :: record
    call c_f_pointer(user, record)
    call record%log(level, fortran_text(message), record%log_context)
  end subroutine forward_log
end module hrad_creation
