! What the Fortran tests share: checks that tell what failed and go on, and small scenes made from
! arrays.
module check
  use, intrinsic :: iso_fortran_env, only: error_unit, int64
  use hrad
  implicit none
  private
  public :: expect, expect_ok, expect_fails, finish_checks, unit_room, solved_cornell

  integer :: failures = 0, checks = 0

contains

  ! The condition holds.
  subroutine expect(condition, what)
    logical, intent(in) :: condition
    character(len=*), intent(in) :: what
    checks = checks + 1
    if (condition) return
    failures = failures + 1
    write (error_unit, "(2a)") "failed: ", what
  end subroutine expect

  ! The status is HRAD_OK.
  subroutine expect_ok(status, what)
    integer, intent(in) :: status
    character(len=*), intent(in) :: what
    call expect(status == HRAD_OK, what//" gives "//hrad_status_name(status)//": "// &
      hrad_error_message())
  end subroutine expect_ok

  ! The call failed with this status, and its message contains the words.
  subroutine expect_fails(status, wanted, words, what)
    integer, intent(in) :: status, wanted
    character(len=*), intent(in) :: words, what
    call expect(status == wanted, what//" gives "//hrad_status_name(status)//", not "// &
      hrad_status_name(wanted))
    call expect(index(hrad_error_message(), words) > 0, what//" says '"//hrad_error_message()// &
      "', not '"//words//"'")
  end subroutine expect_fails

  ! Ends the test: exit status 1 when something failed.
  subroutine finish_checks()
    write (*, "(i0, a, i0, a)") checks, " checks, ", failures, " failed"
    if (failures > 0) error stop 1
  end subroutine finish_checks

  ! The unit cube seen from within, one material: patches 1, 2 are the floor, 3, 4 the ceiling.
  subroutine unit_room(solver, reflectance, flags)
    type(hrad_solver), intent(in) :: solver
    double precision, intent(in) :: reflectance
    integer, intent(in) :: flags
    type(hrad_material) :: wall
    integer :: number, i
    double precision, parameter :: xyz(3, 8) = reshape([double precision :: &
      0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1], [3, 8])
    integer, parameter :: vertex(3, 12) = reshape([1, 2, 3, 1, 3, 4, 5, 8, 7, 5, 7, 6, 1, 5, 6, &
      1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 8, 3, 8, 4, 4, 8, 5, 4, 5, 1], [3, 12])
    allocate (wall%reflectance(3), source=reflectance)
    wall%flags = flags
    call hrad_add_material(solver, wall, number)
    call hrad_add_patches(solver, xyz, vertex, [(number, i=1, 12)])
  end subroutine unit_room

  ! The built-in scene cornell, solved to an accuracy of 0.1.
  subroutine solved_cornell(solver)
    type(hrad_solver), intent(inout) :: solver
    call hrad_create(solver)
    call hrad_make_scene(solver, "cornell")
    call hrad_set_double(solver, "accuracy", 0.1d0)
    call hrad_solve(solver)
  end subroutine solved_cornell
end module check
