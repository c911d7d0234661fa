! hrad.h, section "parameters".
module hrad_parameters
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_int64_t
  use hrad_c_setup, only: c_describe_param, c_get_double, c_get_int, c_get_text, c_param, &
    c_set_double, c_set_int, c_set_text
  use hrad_checks, only: beyond_int32, from_zero, has_nul
  use hrad_constants, only: HRAD_OK
  use hrad_errors, only: finish
  use hrad_text, only: c_text, fortran_text, text_of_buffer
  use hrad_types, only: handle_of, hrad_param, hrad_solver
  implicit none
  private
  public :: hrad_set_int, hrad_set_double, hrad_set_text
  public :: hrad_get_int, hrad_get_double, hrad_get_text, hrad_describe_param

  ! hrad_set_int(solver, name, value [, status]) sets a parameter of integer type by its name;
  ! value: default integer or int64. Errors: ARGUMENT for an unknown name, a wrong type or a value
  ! out of range; STATE for a result parameter after hrad_solve has begun, unless it is a smaller
  ! accuracy, a larger max_iterations, refine, or the value it has; bands only before the first
  ! material.
  interface hrad_set_int
    module procedure set_int_32, set_int_64
  end interface hrad_set_int

  ! hrad_get_int(solver, name, value [, status]) reads one; value: default integer or int64. Errors:
  ! ARGUMENT for an unknown name, a wrong type or a default integer that can't hold the value.
  interface hrad_get_int
    module procedure get_int_32, get_int_64
  end interface hrad_get_int

  ! hrad_describe_param(index, param [, status]): row `index` (from 1) of the parameter table.
  ! Errors: ARGUMENT past its end, so that a loop until the first error reads the whole table.
  interface hrad_describe_param
    module procedure describe_param_32, describe_param_64
  end interface hrad_describe_param

contains

  subroutine set_int_32(solver, name, value, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in) :: value
    integer(c_int32_t), intent(out), optional :: status
    call set_int_64(solver, name, int(value, c_int64_t), status)
  end subroutine set_int_32

  subroutine set_int_64(solver, name, value, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: name
    integer(c_int64_t), intent(in) :: value
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_set_int", "name", name, status)) return
    call finish(c_set_int(handle_of(solver), c_text(name), value), status)
  end subroutine set_int_64

  ! Sets a parameter of real type by its name. Errors as for hrad_set_int.
  subroutine hrad_set_double(solver, name, value, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: value
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_set_double", "name", name, status)) return
    call finish(c_set_double(handle_of(solver), c_text(name), value), status)
  end subroutine hrad_set_double

  ! Sets a parameter of any type from its text form ("0.02", "rows"). Errors as for hrad_set_int.
  subroutine hrad_set_text(solver, name, value, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: name, value
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_set_text", "name", name, status)) return
    if (has_nul("hrad_set_text", "value", value, status)) return
    call finish(c_set_text(handle_of(solver), c_text(name), c_text(value)), status)
  end subroutine hrad_set_text

  subroutine get_int_32(solver, name, value, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(inout) :: value
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t) :: whole
    integer(c_int32_t) :: code
    if (has_nul("hrad_get_int", "name", name, status)) return
    whole = 0
    code = c_get_int(handle_of(solver), c_text(name), whole)
    if (beyond_int32("hrad_get_int", whole, status)) return
    if (code == HRAD_OK) value = int(whole, c_int32_t)
    call finish(code, status)
  end subroutine get_int_32

  subroutine get_int_64(solver, name, value, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: name
    integer(c_int64_t), intent(inout) :: value
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_get_int", "name", name, status)) return
    call finish(c_get_int(handle_of(solver), c_text(name), value), status)
  end subroutine get_int_64

  ! Reads a parameter of real type. Errors: ARGUMENT for an unknown name or a wrong type.
  subroutine hrad_get_double(solver, name, value, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: name
    real(c_double), intent(inout) :: value
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_get_double", "name", name, status)) return
    call finish(c_get_double(handle_of(solver), c_text(name), value), status)
  end subroutine hrad_get_double

  ! Reads a parameter of any type as text. Errors: ARGUMENT for an unknown name.
  subroutine hrad_get_text(solver, name, text, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: name
    character(len=:), allocatable, intent(inout) :: text
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable :: buffer(:)
    integer(c_int64_t) :: needed
    integer(c_int32_t) :: code
    if (has_nul("hrad_get_text", "name", name, status)) return
    allocate (buffer(1))
    needed = 0
    code = c_get_text(handle_of(solver), c_text(name), buffer, 0_c_int64_t, needed)
    if (code == HRAD_OK) then
      deallocate (buffer)
      allocate (buffer(needed))
      code = c_get_text(handle_of(solver), c_text(name), buffer, needed, needed)
    end if
    if (code == HRAD_OK) text = text_of_buffer(buffer)
    call finish(code, status)
  end subroutine hrad_get_text

  subroutine describe_param_32(index, param, status)
    integer(c_int32_t), intent(in) :: index
    type(hrad_param), intent(inout) :: param
    integer(c_int32_t), intent(out), optional :: status
    call describe_param_64(int(index, c_int64_t), param, status)
  end subroutine describe_param_32

  subroutine describe_param_64(index, param, status)
    integer(c_int64_t), intent(in) :: index
    type(hrad_param), intent(inout) :: param
    integer(c_int32_t), intent(out), optional :: status
    type(c_param) :: row
    integer(c_int32_t) :: code
    code = c_describe_param(from_zero(index), row)
    if (code == HRAD_OK) then
      param%name = fortran_text(row%name)
      param%type = row%type
      param%is_result = row%is_result
      param%default_text = fortran_text(row%default_text)
      param%minimum = row%minimum
      param%maximum = row%maximum
      param%choices = fortran_text(row%choices)
      param%unit = fortran_text(row%unit)
      param%help = fortran_text(row%help)
    end if
    call finish(code, status)
  end subroutine describe_param_64
end module hrad_parameters
