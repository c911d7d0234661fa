! Parameters: both kinds of integers, text of every length, the table.
program test_parameters
  use, intrinsic :: iso_fortran_env, only: int64
  use check
  use hrad
  implicit none
  type(hrad_solver) :: solver
  call hrad_create(solver)
  call integers()
  call reals()
  call texts()
  call table()
  call hrad_destroy(solver)
  call finish_checks()

contains

  subroutine integers()
    integer :: value, status
    integer(int64) :: long
    call hrad_set_int(solver, "seed", 5)
    call hrad_get_int(solver, "seed", long)
    call expect(long == 5, "set as default integer, read as int64")
    call hrad_set_int(solver, "seed  ", 6_int64, status)
    call expect_ok(status, "a name with blanks behind")
    call hrad_get_int(solver, "seed", value, status)
    call expect_ok(status, "hrad_get_int")
    call expect(value == 6, "set as int64, read as default integer")
    call hrad_set_int(solver, "seed", 3000000000_int64)
    call hrad_get_int(solver, "seed", value, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "3000000000", "a value beyond default integer")
    call expect(value == 6, "it leaves the variable alone")
    call hrad_get_int(solver, "seed", long)
    call expect(long == 3000000000_int64, "a large value")
    call hrad_set_int(solver, "bands", 17, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "16", "a value out of range")
    call hrad_get_int(solver, "accuracy", value, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "accuracy", "a wrong type")
  end subroutine integers

  subroutine reals()
    double precision :: value
    integer :: status
    call hrad_set_double(solver, "accuracy", 0.05d0, status)
    call expect_ok(status, "hrad_set_double")
    call hrad_get_double(solver, "accuracy", value, status)
    call expect_ok(status, "hrad_get_double")
    call expect(value == 0.05d0, "a real comes back")
    call hrad_set_double(solver, "accuracy", 7d0, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "0.5", "a real out of range")
    call hrad_get_double(solver, "seed", value, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "seed", "an integer read as real")
    call hrad_set_double(solver, "a"//achar(0), 1d0, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "NUL", "a NUL in a name")
  end subroutine reals

  subroutine texts()
    character(len=:), allocatable :: text
    integer :: status
    call hrad_set_text(solver, "unit", repeat("long ", 800)//"mile", status)
    call expect_ok(status, "a long text")
    call hrad_get_text(solver, "unit", text, status)
    call expect_ok(status, "hrad_get_text")
    call expect(len(text) == 4004 .and. text == repeat("long ", 800)//"mile", "it comes back")
    call hrad_get_text(solver, "no such name", text, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "no such name", "an unknown name")
    call expect(len(text) == 4004, "an error leaves text alone")
    call hrad_set_text(solver, "unit", "", status)
    call expect_ok(status, "an empty text")
    call hrad_get_text(solver, "unit", text)
    call expect(allocated(text) .and. len(text) == 0, "an empty text comes back")
    call hrad_set_text(solver, "accuracy", "0.25")
    call hrad_get_text(solver, "accuracy", text)
    call expect(text == "0.25", "a real in its text form")
    call hrad_set_text(solver, "linking", "ropes", status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "clusters", "a word that isn't allowed")
  end subroutine texts

  subroutine table()
    type(hrad_param) :: row
    integer :: rows, status
    integer(int64) :: first
    first = 1
    call hrad_describe_param(first, row)
    call expect(row%name == "bands" .and. row%type == HRAD_PARAM_INT .and. row%is_result == 1 &
      .and. row%default_text == "3" .and. row%minimum == 1 .and. row%maximum == 16 &
      .and. row%choices == "" .and. row%unit == "" .and. len(row%help) > 20, "the row of bands")
    rows = 0
    do
      call hrad_describe_param(rows + 1, row, status)
      if (status /= HRAD_OK) exit
      rows = rows + 1
      if (row%name == "linking") call expect(row%type == HRAD_PARAM_TEXT .and. &
        index(row%choices, "rows") > 0 .and. row%default_text == "auto", "the row of linking")
      if (row%name == "max_memory") call expect(row%unit == "bytes" .and. row%is_result == 0, &
        "the row of max_memory")
      if (row%name == "accuracy") call expect(row%type == HRAD_PARAM_DOUBLE, "that of accuracy")
    end do
    call expect(rows >= 15, "the table has rows")
    call expect(status == HRAD_ERROR_ARGUMENT, "past the end")
    call hrad_describe_param(0, row, status)
    call expect(status == HRAD_ERROR_ARGUMENT, "there is no row 0")
  end subroutine table
end program test_parameters
