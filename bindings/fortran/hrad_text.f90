! Text between Fortran and C. Fortran to C: trailing blanks are dropped, a NUL is added. C to
! Fortran: text of deferred length.
module hrad_text
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_null_char, c_ptr, &
    c_size_t
  implicit none
  private
  public :: c_text, c_characters, fortran_text, text_of_buffer

  interface
    pure function c_strlen(text) bind(c, name="strlen") result(length)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: text
      integer(c_size_t) :: length
    end function c_strlen
  end interface

contains

  ! Text for C.
  pure function c_text(text) result(ended)
    character(len=*), intent(in) :: text
    character(kind=c_char, len=len_trim(text) + 1) :: ended
    ended = trim(text)//c_null_char
  end function c_text

  ! The same as an array, whose address can stand in a struct.
  pure function c_characters(text) result(ended)
    character(len=*), intent(in) :: text
    character(kind=c_char) :: ended(len_trim(text) + 1)
    integer :: i
    do i = 1, len_trim(text)
      ended(i) = text(i:i)
    end do
    ended(size(ended)) = c_null_char
  end function c_characters

  ! Text of C; "" for NULL.
  function fortran_text(address) result(text)
    type(c_ptr), intent(in) :: address
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: characters(:)
    integer(c_size_t) :: length
    if (.not. c_associated(address)) then
      text = ""
      return
    end if
    length = c_strlen(address)
    call c_f_pointer(address, characters, [length])
    text = joined(characters)
  end function fortran_text

  ! The text in a buffer that C has filled: what stands before the NUL.
  pure function text_of_buffer(buffer) result(text)
    character(kind=c_char), intent(in) :: buffer(:)
    character(len=:), allocatable :: text
    integer(c_size_t) :: length
    do length = 0, size(buffer, kind=c_size_t) - 1
      if (buffer(length + 1) == c_null_char) exit
    end do
    text = joined(buffer(:length))
  end function text_of_buffer

  pure function joined(characters) result(text)
    character(kind=c_char), intent(in) :: characters(:)
    character(len=size(characters)) :: text
    integer(c_size_t) :: i
    do i = 1, size(characters, kind=c_size_t)
      text(i:i) = characters(i)
    end do
  end function joined
end module hrad_text
