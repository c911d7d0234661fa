! Two threads with a solver each: every one has the message of its own last failure, be it found by
! the binding or by the library, and its own result.
module two_threads
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_ptr
  use hrad
  use reference
  implicit none
  private
  public :: work

  logical, public :: own_shape(2) = .false., own_name(2) = .false.
  integer(c_int64_t), public :: hash(2) = 0

contains

  recursive subroutine work(number, meeting) bind(c)
    integer(c_int32_t), value :: number
    type(c_ptr), value :: meeting
    type(hrad_solver) :: solver
    double precision, allocatable :: xyz(:, :)
    integer :: status
    allocate (xyz(3 + number, 3), source=0d0)
    call hrad_create(solver, status)
    call hrad_add_patches(solver, xyz, reshape([1, 2, 3], [3, 1]), status=status)
    call reference_meet(meeting)
    own_shape(number) = index(hrad_error_message(), merge("(4, 3)", "(5, 3)", number == 1)) > 0
    call reference_meet(meeting)
    if (number == 1) call hrad_make_scene(solver, "nowhere", status)
    call reference_meet(meeting)
    own_name(number) = index(hrad_error_message(), merge("nowhere", " (5, 3)", number == 1)) > 0
    call hrad_make_scene(solver, "cornell", status)
    call hrad_set_double(solver, "accuracy", 0.2d0, status)
    call hrad_set_int(solver, "threads", 1, status)
    call hrad_solve(solver, status)
    call hrad_state_hash(solver, hash(number), status)
    call hrad_destroy(solver)
  end subroutine work
end module two_threads

program test_threads
  use, intrinsic :: iso_c_binding, only: c_funloc
  use check
  use hrad
  use reference
  use two_threads
  implicit none
  call expect(reference_two_threads(c_funloc(work)) == 0, "two threads are started")
  call expect(all(own_shape), "each has the binding's message of its own")
  call expect(all(own_name), "the library's message of one is none of the other")
  call expect(hash(1) == hash(2) .and. hash(1) /= 0, "both solve to the same bits")
  call expect(hrad_error_message() == "", "nothing failed on the main thread")
  call finish_checks()
end program test_threads
