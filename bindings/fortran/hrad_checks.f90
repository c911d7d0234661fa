! Checks of arguments that C can't make: shapes, indices from 1, text. Each is true when the
! argument is wrong; the procedure has failed then and its caller returns.
module hrad_checks
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_null_char, c_ptr
  use hrad_c_setup, only: c_get_int, c_scene_size
  use hrad_constants, only: HRAD_OK
  use hrad_errors, only: fail_argument, finish
  use hrad_text, only: c_text
  use hrad_types, only: handle_of, hrad_solver
  implicit none
  private
  public :: any_extent, misshapen, misnumbered, out_of_range, has_nul, lacks_bands, lacks_size
  public :: beyond_int32, from_zero

  integer(c_int64_t), parameter :: any_extent = -1

contains

  ! Whether an array has not the wanted shape; any_extent leaves an extent free.
  logical function misshapen(procedure_name, name, found, wanted, status)
    character(len=*), intent(in) :: procedure_name, name
    integer(c_int64_t), intent(in) :: found(:), wanted(:)
    integer(c_int32_t), intent(out), optional :: status
    misshapen = any(found /= wanted .and. wanted /= any_extent)
    if (misshapen) call fail_argument(procedure_name//": "//name//" has the shape "// &
      shape_text(found)//", it needs "//shape_text(wanted), status)
  end function misshapen

  ! Whether indices that count from 1 go beyond `last`.
  logical function misnumbered(procedure_name, noun, indices, last, status)
    character(len=*), intent(in) :: procedure_name, noun
    integer(c_int64_t), intent(in) :: indices(:), last
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t) :: i
    misnumbered = .false.
    do i = 1, size(indices, kind=c_int64_t)
      if (indices(i) >= 1 .and. indices(i) <= last) cycle
      misnumbered = .true.
      call fail_argument(procedure_name//": there is no "//noun//" "//number_text(indices(i))// &
        " (element "//number_text(i)//"): they count from 1 to "//number_text(last), status)
      return
    end do
  end function misnumbered

  ! Whether `count` indices from `first` on, which counts from 1, are not all there.
  logical function out_of_range(procedure_name, noun, first, count, last, status)
    character(len=*), intent(in) :: procedure_name, noun
    integer(c_int64_t), intent(in) :: first, count, last
    integer(c_int32_t), intent(out), optional :: status
    out_of_range = first < 1 .or. count > last - max(first, 1_c_int64_t) + 1
    if (out_of_range) call fail_argument(procedure_name//": "//number_text(count)//" "//noun// &
      " from "//number_text(first)//" on: they count from 1 to "//number_text(last), status)
  end function out_of_range

  ! Whether text holds a NUL, at which C would cut it.
  logical function has_nul(procedure_name, name, text, status)
    character(len=*), intent(in) :: procedure_name, name, text
    integer(c_int32_t), intent(out), optional :: status
    has_nul = index(text, c_null_char) > 0
    if (has_nul) call fail_argument(procedure_name//": there is a NUL character in "//name, &
      status)
  end function has_nul

  ! Whether a value is too large for a default integer.
  logical function beyond_int32(procedure_name, value, status)
    character(len=*), intent(in) :: procedure_name
    integer(c_int64_t), intent(in) :: value
    integer(c_int32_t), intent(out), optional :: status
    beyond_int32 = abs(value) > huge(0_c_int32_t)
    if (beyond_int32) call fail_argument(procedure_name//": "//number_text(value)// &
      " is too large for a default integer: use integer(int64)", status)
  end function beyond_int32

  ! An index that counts from 1 as C counts it, from 0; what lies below 1 stays out of range.
  elemental integer(c_int64_t) function from_zero(index)
    integer(c_int64_t), intent(in) :: index
    from_zero = max(index, 0_c_int64_t) - 1
  end function from_zero

  ! Asks for the number of bands; true when that failed.
  logical function lacks_bands(solver, bands, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(out) :: bands
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int32_t) :: code
    bands = 0
    code = c_get_int(handle_of(solver), c_text("bands"), bands)
    lacks_bands = code < HRAD_OK
    if (lacks_bands) call finish(code, status)
  end function lacks_bands

  ! Asks for the number of patches and materials; true when that failed.
  logical function lacks_size(solver, patches, materials, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(out) :: patches, materials
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int32_t) :: code
    code = c_scene_size(handle_of(solver), patches, materials)
    lacks_size = code < HRAD_OK
    if (lacks_size) call finish(code, status)
  end function lacks_size

  ! A shape as in "(3, *)".
  function shape_text(extents) result(text)
    integer(c_int64_t), intent(in) :: extents(:)
    character(len=:), allocatable :: text
    integer :: i
    text = "("
    do i = 1, size(extents)
      if (i > 1) text = text//", "
      if (extents(i) == any_extent) then
        text = text//"*"
      else
        text = text//number_text(extents(i))
      end if
    end do
    text = text//")"
  end function shape_text

  function number_text(number) result(text)
    integer(c_int64_t), intent(in) :: number
    character(len=:), allocatable :: text
    character(len=20) :: digits
    write (digits, "(i0)") number
    text = trim(digits)
  end function number_text
end module hrad_checks
