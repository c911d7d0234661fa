! How calls end: status or error stop, and the message of the last failure. The binding's own
! message is all that outlives a call here; it belongs to one thread where OpenMP is switched on (as
! the library's CMake files do), as the library's messages always do.
module hrad_errors
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_ptr
  use, intrinsic :: iso_fortran_env, only: error_unit
  use hrad_constants, only: HRAD_ERROR_ARGUMENT
  use hrad_text, only: fortran_text
  implicit none
  private
  public :: hrad_version, hrad_version_text, hrad_status_name, hrad_error_message
  public :: finish, fail_argument, leave_word_to_library

  ! What the binding found wrong last; blank when the library has the last word.
  character(len=1024), save :: own_message = ""
  !$omp threadprivate(own_message)

  interface
    ! The library's version as major*10000 + minor*100 + patch. Never fails.
    function hrad_version() bind(c, name="hrad_version") result(version)
      import :: c_int32_t
      integer(c_int32_t) :: version
    end function hrad_version

    function c_version_text() bind(c, name="hrad_version_text") result(text)
      import :: c_ptr
      type(c_ptr) :: text
    end function c_version_text

    function c_status_name(status) bind(c, name="hrad_status_name") result(text)
      import :: c_int32_t, c_ptr
      integer(c_int32_t), value :: status
      type(c_ptr) :: text
    end function c_status_name

    function c_error_message() bind(c, name="hrad_error_message") result(text)
      import :: c_ptr
      type(c_ptr) :: text
    end function c_error_message
  end interface

contains

  ! The library's version as text, "0.1.0". Never fails.
  function hrad_version_text() result(text)
    character(len=:), allocatable :: text
    text = fortran_text(c_version_text())
  end function hrad_version_text

  ! The name of a status, "HRAD_OK" for 0; "HRAD_UNKNOWN" for a value not listed. Never fails.
  function hrad_status_name(status) result(text)
    integer(c_int32_t), intent(in) :: status
    character(len=:), allocatable :: text
    text = fortran_text(c_status_name(status))
  end function hrad_status_name

  ! What this thread's last failing call said, "" if none failed: one sentence. Messages of the
  ! binding (shapes, indices, text) count from 1, messages of the C library from 0. Never fails.
  function hrad_error_message() result(text)
    character(len=:), allocatable :: text
    if (own_message /= "") then
      text = trim(own_message)
    else
      text = fortran_text(c_error_message())
    end if
  end function hrad_error_message

  ! Ends a procedure with a status of the C library.
  subroutine finish(code, status)
    integer(c_int32_t), intent(in) :: code
    integer(c_int32_t), intent(out), optional :: status
    if (code < 0) call leave_word_to_library()
    call conclude(code, status)
  end subroutine finish

  ! The library has failed last: its message counts.
  subroutine leave_word_to_library()
    own_message = ""
  end subroutine leave_word_to_library

  ! Ends a procedure that the binding itself refuses.
  subroutine fail_argument(message, status)
    character(len=*), intent(in) :: message
    integer(c_int32_t), intent(out), optional :: status
    own_message = message
    call conclude(HRAD_ERROR_ARGUMENT, status)
  end subroutine fail_argument

  ! Hands the status over; an error that nobody asks for stops the program.
  subroutine conclude(code, status)
    integer(c_int32_t), intent(in) :: code
    integer(c_int32_t), intent(out), optional :: status
    if (present(status)) then
      status = code
    else if (code < 0) then
      write (error_unit, "(4a)") "hrad: ", hrad_status_name(code), ": ", hrad_error_message()
      flush (error_unit)
      error stop 1
    end if
  end subroutine conclude
end module hrad_errors
