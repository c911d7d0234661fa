! Callbacks: messages and progress reach Fortran with their context, progress stops a solve, and the
! solver is closed to its own callbacks.
module listeners
  use hrad
  implicit none
  public

  ! What the callbacks have seen.
  type :: notebook
    integer :: messages = 0
    integer :: highest_level = -1
    integer :: calls = 0
    integer :: stop_after = huge(0)
    integer :: status_within = HRAD_OK
    double precision :: fraction = 0
    logical :: fell_back = .false.
    character(len=:), allocatable :: last
    type(hrad_solver) :: solver
  end type notebook

contains

  subroutine write_down(level, message, context)
    integer, intent(in) :: level
    character(len=*), intent(in) :: message
    class(*), intent(inout), optional :: context
    if (.not. present(context)) error stop "no context"
    select type (context)
    type is (notebook)
      context%messages = context%messages + 1
      context%highest_level = max(context%highest_level, level)
      context%last = message
    end select
  end subroutine write_down

  logical function watch(progress, context)
    type(hrad_progress), intent(in) :: progress
    class(*), intent(inout), optional :: context
    double precision :: out(3, 1)
    watch = .false.
    if (.not. present(context)) error stop "no context"
    select type (context)
    type is (notebook)
      context%calls = context%calls + 1
      context%last = progress%stage
      context%fell_back = context%fell_back .or. progress%fraction < context%fraction
      context%fraction = progress%fraction
      call hrad_query_patches(context%solver, HRAD_EMISSION, HRAD_FRONT, 1, out, &
        context%status_within)
      call hrad_destroy(context%solver)
      watch = context%calls >= context%stop_after
    end select
  end function watch

  ! Stops by the procedure that a callback may call.
  logical function ask_to_stop(progress, context)
    type(hrad_progress), intent(in) :: progress
    class(*), intent(inout), optional :: context
    ask_to_stop = progress%seconds < 0
    select type (context)
    type is (hrad_solver)
      call hrad_request_stop(context)
    end select
  end function ask_to_stop

  ! Needs no context, and has none.
  logical function stop_at_once(progress, context)
    type(hrad_progress), intent(in) :: progress
    class(*), intent(inout), optional :: context
    stop_at_once = progress%fraction >= 0 .and. .not. present(context)
  end function stop_at_once
end module listeners

program test_callbacks
  use, intrinsic :: iso_fortran_env, only: int64
  use check
  use hrad
  use listeners
  implicit none
  integer(int64) :: undisturbed
  call calm_solve()
  call messages()
  call progress_that_stops()
  call progress_without_context()
  call finish_checks()

contains

  subroutine calm_solve()
    type(hrad_solver) :: solver
    call solved_cornell(solver)
    call hrad_state_hash(solver, undisturbed)
    call hrad_destroy(solver)
  end subroutine calm_solve

  subroutine messages()
    type(hrad_solver) :: solver
    type(notebook), target :: notes
    double precision :: xyz(3, 3)
    integer :: status, before
    xyz = 0
    call hrad_create(solver)
    call hrad_set_log(solver, write_down, notes, HRAD_LOG_DEBUG, status)
    call expect_ok(status, "hrad_set_log")
    call hrad_make_scene(solver, "cornell")
    call hrad_set_double(solver, "accuracy", 0.1d0)
    call hrad_add_patches(solver, xyz, reshape([1, 2, 3], [3, 1]))
    call hrad_solve(solver)
    call expect(notes%messages > 0 .and. notes%highest_level >= 0 .and. &
      notes%highest_level <= HRAD_LOG_DEBUG, "messages come")
    call expect(len(notes%last) > 5, "they say something")
    before = notes%messages
    call hrad_set_log(solver, write_down, level=9, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "9", "a level that isn't")
    call hrad_set_log(solver)
    call hrad_set_double(solver, "accuracy", 0.09d0)
    call hrad_solve(solver)
    call expect(notes%messages == before, "no messages after they are turned off")
    call hrad_set_log(solver, write_down, notes)
    call hrad_destroy(solver)
  end subroutine messages

  subroutine progress_that_stops()
    type(hrad_solver) :: solver
    type(notebook), target :: notes
    integer(int64) :: hash
    integer :: status
    call hrad_create(solver)
    call hrad_make_scene(solver, "cornell")
    call hrad_set_double(solver, "accuracy", 0.1d0)
    notes%solver = solver
    notes%stop_after = 1
    call hrad_set_progress(solver, watch, notes, status)
    call expect_ok(status, "hrad_set_progress")
    call hrad_solve(solver, status)
    call expect(status == HRAD_STOPPED .and. notes%calls == 1, "the first call stops")
    call expect(notes%status_within == HRAD_ERROR_STATE, "the solver is closed to its callback")
    call expect(any(notes%last == [character(len=7) :: "initial", "linking", "refine", "sweep", &
      "measure"]), "the stage has a name")
    call hrad_set_progress(solver, ask_to_stop, solver)
    call hrad_solve(solver, status)
    call expect(status == HRAD_STOPPED, "hrad_request_stop within a callback")
    notes%solver = solver
    notes%stop_after = huge(0)
    notes%fraction = 0
    call hrad_set_progress(solver, watch, notes)
    call hrad_solve(solver, status)
    call expect_ok(status, "the solve goes on")
    call expect(notes%calls > 1 .and. .not. notes%fell_back .and. notes%fraction <= 1, "to its end")
    call hrad_state_hash(solver, hash)
    call expect(hash == undisturbed, "to the same bits")
    call hrad_destroy(solver)
  end subroutine progress_that_stops

  subroutine progress_without_context()
    type(hrad_solver) :: solver
    integer :: status
    call hrad_create(solver)
    call hrad_make_scene(solver, "cornell")
    call hrad_set_double(solver, "accuracy", 0.1d0)
    call hrad_set_progress(solver, stop_at_once)
    call hrad_solve(solver, status)
    call expect(status == HRAD_STOPPED, "a callback without a context")
    call hrad_set_progress(solver)
    call hrad_solve(solver, status)
    call expect(status /= HRAD_STOPPED, "no callback any more")
    call hrad_destroy(solver)
  end subroutine progress_without_context
end program test_callbacks
