! What a user holds: the solver's handle, the structs of hrad.h as derived types, and the interfaces
! of callbacks. The handle is opaque; modules of the binding reach into it by the last four
! procedures, which module hrad does not pass on.
module hrad_types
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_int32_t, c_int64_t, c_loc, &
    c_null_ptr, c_ptr, c_size_t
  implicit none
  private
  public :: hrad_solver, hrad_param, hrad_material, hrad_patch, hrad_rank_load, hrad_progress
  public :: hrad_stats, hrad_log_procedure, hrad_progress_procedure
  public :: callback_record, adopt, forget, handle_of, callbacks_of

  ! One row of the parameter table.
  type :: hrad_param
    character(len=:), allocatable :: name
    integer(c_int32_t) :: type = 0           ! HRAD_PARAM_INT, _DOUBLE, _TEXT
    integer(c_int32_t) :: is_result = 0      ! 1: decides the bits of the result; 0: a run parameter
    character(len=:), allocatable :: default_text ! the default, as hrad_set_text takes it
    real(c_double) :: minimum = 0            ! allowed range, both included; 0, 0 for text
    real(c_double) :: maximum = 0
    character(len=:), allocatable :: choices ! allowed words separated by '|'; "": any text
    character(len=:), allocatable :: unit    ! "" where there is none
    character(len=:), allocatable :: help    ! one sentence
  end type hrad_param

  ! A material, for hrad_add_material.
  type :: hrad_material
    real(c_double), allocatable :: reflectance(:) ! (bands) in [0,1); not allocated: 0.5
    real(c_double), allocatable :: emission(:)    ! (bands) W/m2, 0 or 1e-30 to 1e30; none: 0
    integer(c_int32_t) :: flags = 0               ! HRAD_TWO_SIDED + HRAD_BLOCKER
    character(len=:), allocatable :: name         ! not allocated: none
  end type hrad_material

  ! A patch, from hrad_get_patch.
  type, bind(c) :: hrad_patch
    integer(c_size_t) :: struct_size = 104
    real(c_double) :: corners_xyz(3, 3) = 0 ! (:, k) is corner k, anticlockwise seen from the front
    real(c_double) :: area = 0              ! of one side, unit^2; 0 when dropped
    integer(c_int64_t) :: face = 0          ! its face in the OBJ file, from 1; else the patch
    integer(c_int32_t) :: material = 0      ! from 1
    integer(c_int32_t) :: flags = 0         ! HRAD_PATCH_...
  end type hrad_patch

  ! What one of several ranks would get, from hrad_plan_partition.
  type, bind(c) :: hrad_rank_load
    integer(c_size_t) :: struct_size = 80
    integer(c_int64_t) :: patches = 0 ! that exchange light
    real(c_double) :: work = 0        ! predicted, of all its patches; in rays, about
    real(c_double) :: lower(3) = 0    ! the box around its patches, in the scene's unit
    real(c_double) :: upper(3) = 0
    real(c_double) :: remote = 0      ! 0 to 1: the share of its light that takes messages
  end type hrad_rank_load

  ! How far a solve has come, for the progress callback.
  type :: hrad_progress
    character(len=:), allocatable :: stage ! initial, linking, refine, sweep, measure
    integer(c_int64_t) :: iteration = 0    ! sweeps done
    real(c_double) :: fraction = 0         ! of the whole solve, 0 to 1, never falling within one
    real(c_double) :: seconds = 0          ! since hrad_solve began
    real(c_double) :: seconds_left = 0     ! estimate; negative while unknown
  end type hrad_progress

  ! Counts and times, from hrad_get_stats.
  type, bind(c) :: hrad_stats
    integer(c_size_t) :: struct_size = 256
    integer(c_int32_t) :: converged = 0    ! 1 when the last solve returned HRAD_OK
    integer(c_int32_t) :: ranks = 0
    integer(c_int32_t) :: threads = 0      ! of this rank
    integer(c_int32_t) :: up_axis = 0      ! of the scene: 1 y, 2 z; 0 where nobody has said
    integer(c_int64_t) :: rounds = 0       ! of refinement
    integer(c_int64_t) :: iterations = 0   ! sweeps
    integer(c_int64_t) :: patches = 0
    integer(c_int64_t) :: elements = 0     ! all nodes of the hierarchy
    integer(c_int64_t) :: leaves = 0
    integer(c_int64_t) :: links = 0
    integer(c_int64_t) :: rays = 0         ! visibility, exposure and measuring rays together
    integer(c_int64_t) :: pairs = 0        ! of patches whose form factor was computed
    real(c_double) :: area = 0             ! unit^2, both sides of two-sided surfaces
    real(c_double) :: sealed_area = 0
    real(c_double) :: back_share = 0       ! of measuring rays: those that met a black back
    real(c_double) :: error_estimate = 0   ! negative when not measured
    real(c_double) :: error_standard_error = 0
    real(c_double) :: seconds_load = 0
    real(c_double) :: seconds_initial = 0
    real(c_double) :: seconds_linking = 0
    real(c_double) :: seconds_iterative = 0
    real(c_double) :: seconds_output = 0
    real(c_double) :: cpu_seconds = 0          ! user CPU spent in solves, of all ranks
    integer(c_int64_t) :: memory_peak_bytes = 0 ! of the rank that needed most
    integer(c_int64_t) :: link_bytes = 0
    integer(c_int64_t) :: node_bytes = 0
    integer(c_int64_t) :: messages(3) = 0       ! R, U, T
    integer(c_int64_t) :: message_bytes(3) = 0  ! R, U, T
    integer(c_int64_t) :: swept_links = 0       ! of the links, those that sweeps read
  end type hrad_stats

  abstract interface
    ! Receives one message of the library. context is what was given to hrad_set_log, absent if
    ! nothing was.
    subroutine hrad_log_procedure(level, message, context)
      import :: c_int32_t
      integer(c_int32_t), intent(in) :: level ! HRAD_LOG_...
      character(len=*), intent(in) :: message
      class(*), intent(inout), optional :: context
    end subroutine hrad_log_procedure

    ! Called between tasks, up to some thousand times a second, while a solve runs; .true. stops it.
    ! context is what was given to hrad_set_progress, absent if nothing was.
    logical function hrad_progress_procedure(progress, context)
      import :: hrad_progress
      type(hrad_progress), intent(in) :: progress
      class(*), intent(inout), optional :: context
    end function hrad_progress_procedure
  end interface

  ! The callbacks of one solver and what they are called with.
  type :: callback_record
    procedure(hrad_log_procedure), pointer, nopass :: log => null()
    class(*), pointer :: log_context => null()
    procedure(hrad_progress_procedure), pointer, nopass :: progress => null()
    class(*), pointer :: progress_context => null()
  end type callback_record

  ! The solver: an opaque handle, made by hrad_create and freed by hrad_destroy. A copy by
  ! assignment is the same solver, as a copied pointer is in C; nothing is freed by itself.
  type :: hrad_solver
    private
    type(c_ptr) :: handle = c_null_ptr
    type(callback_record), pointer :: callbacks => null()
  end type hrad_solver

contains

  ! Makes a solver of a C handle.
  subroutine adopt(handle, solver)
    type(c_ptr), intent(in) :: handle
    type(hrad_solver), intent(inout) :: solver
    solver%handle = handle
    allocate (solver%callbacks)
  end subroutine adopt

  ! Empties a solver whose C handle is freed.
  subroutine forget(solver)
    type(hrad_solver), intent(inout) :: solver
    solver%handle = c_null_ptr
    if (associated(solver%callbacks)) deallocate (solver%callbacks)
  end subroutine forget

  ! The C handle, NULL of an empty solver.
  function handle_of(solver) result(handle)
    type(hrad_solver), intent(in) :: solver
    type(c_ptr) :: handle
    handle = solver%handle
  end function handle_of

  ! The callbacks, for the caller to change, and the address by which a trampoline finds them.
  subroutine callbacks_of(solver, record, address)
    type(hrad_solver), intent(in) :: solver
    type(callback_record), pointer, intent(out) :: record
    type(c_ptr), intent(out) :: address
    record => solver%callbacks
    address = c_null_ptr
    if (c_associated(solver%handle)) address = c_loc(record)
  end subroutine callbacks_of
end module hrad_types
