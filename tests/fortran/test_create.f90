! Version, statuses, solvers, and how calls end: with a status, or with the message of the library
! or of the binding.
program test_create
  use check
  use hrad
  implicit none
  call versions()
  call statuses()
  call handles()
  call empty_handle()
  call last_message()
  call finish_checks()

contains

  subroutine versions()
    character(len=:), allocatable :: text
    character(len=20) :: wanted
    integer :: version
    version = hrad_version()
    text = hrad_version_text()
    call expect(version == 10000 * HRAD_VERSION_MAJOR + 100 * HRAD_VERSION_MINOR + &
      HRAD_VERSION_PATCH, "the library has the version of the binding")
    write (wanted, "(i0, '.', i0, '.', i0)") HRAD_VERSION_MAJOR, HRAD_VERSION_MINOR, &
      HRAD_VERSION_PATCH
    call expect(text == trim(wanted) .and. len(text) == len_trim(wanted), "the version as text")
  end subroutine versions

  subroutine statuses()
    call expect(hrad_status_name(HRAD_OK) == "HRAD_OK", "the name of HRAD_OK")
    call expect(hrad_status_name(HRAD_NOT_CONVERGED) == "HRAD_NOT_CONVERGED", "a positive status")
    call expect(hrad_status_name(HRAD_ERROR_INTERNAL) == "HRAD_ERROR_INTERNAL", "the last error")
    call expect(hrad_status_name(77) == "HRAD_UNKNOWN", "the name of no status")
  end subroutine statuses

  ! A copy is the same solver; destroying empties the handle and may be repeated.
  subroutine handles()
    type(hrad_solver) :: solver, same
    integer :: status, bands
    call expect(hrad_error_message() == "", "no message before the first failure")
    call hrad_create(solver, status)
    call expect_ok(status, "hrad_create")
    same = solver
    call hrad_set_int(same, "bands", 7, status)
    call expect_ok(status, "hrad_set_int of a copy")
    bands = 0
    call hrad_get_int(solver, "bands", bands)
    call expect(bands == 7, "a copy is the same solver")
    call hrad_destroy(solver)
    call hrad_destroy(solver)
    call hrad_get_int(solver, "bands", bands, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "hrad_create", "a destroyed solver")
    call expect(bands == 7, "an error leaves outputs alone")
  end subroutine handles

  ! Procedures refuse a solver that was never made.
  subroutine empty_handle()
    type(hrad_solver) :: none
    type(hrad_stats) :: stats
    type(hrad_patch) :: patch
    double precision :: out(3, 1)
    integer :: status
    call hrad_request_stop(none)
    call hrad_solve(none, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "NULL", "hrad_solve")
    call hrad_get_stats(none, stats, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "NULL", "hrad_get_stats")
    call hrad_get_patch(none, 1, patch, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "NULL", "hrad_get_patch")
    call hrad_query_patches(none, HRAD_RADIOSITY, HRAD_FRONT, 1, out, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "NULL", "hrad_query_patches")
    call hrad_set_log(none, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "NULL", "hrad_set_log")
    call hrad_set_progress(none, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "NULL", "hrad_set_progress")
  end subroutine empty_handle

  ! The message is that of the last failure, whoever found it.
  subroutine last_message()
    type(hrad_solver) :: solver
    double precision :: flat(2, 3)
    integer :: status
    flat = 0
    call hrad_create(solver)
    call hrad_add_patches(solver, flat, reshape([1, 2, 3], [3, 1]), status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, &
      "hrad_add_patches: xyz has the shape (2, 3), it needs (3, *)", "the binding")
    call hrad_set_int(solver, "colour", 1, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "colour", "the library after it")
    call hrad_set_int(solver, "seed", 2, status)
    call expect_ok(status, "a call that succeeds")
    call expect(index(hrad_error_message(), "colour") > 0, "a success keeps the message")
    call hrad_set_text(solver, "unit", "a"//achar(0)//"b", status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "NUL", "the binding again")
    call hrad_destroy(solver)
  end subroutine last_message
end program test_create
