! hrad.h, section "query" without the leaves. Results are out(bands, count); the count is that of
! the array.
module hrad_queries
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_loc, c_null_ptr, c_ptr
  use hrad_c_results, only: c_power_balance, c_query_patches, c_query_points, c_query_sensors
  use hrad_checks, only: any_extent, lacks_bands, lacks_size, misnumbered, misshapen, out_of_range
  use hrad_constants, only: HRAD_OK
  use hrad_errors, only: finish
  use hrad_types, only: handle_of, hrad_solver
  implicit none
  private
  public :: hrad_query_patches, hrad_query_points, hrad_query_sensors, hrad_power_balance

  ! hrad_query_patches(solver, quantity, side, first, out [, status]): the mean of a quantity
  ! (HRAD_RADIOSITY, _IRRADIANCE, _EMISSION, _NET_FLUX: leaving minus arriving; W/m2) on a side
  ! (HRAD_FRONT, _BACK) over each of the patches from `first` (from 1; default integer or int64) on:
  ! out(bands, count). The back of a one-sided patch and a blocker answer 0. Errors: ARGUMENT for a
  ! wrong shape or range; STATE before a solve (HRAD_EMISSION always works).
  interface hrad_query_patches
    module procedure query_patches_32, query_patches_64
  end interface hrad_query_patches

  ! hrad_query_points(solver, quantity, side, patch, uv, out [, status]): a quantity at points of
  ! patches: point i lies at (1-u-v)*corner1 + u*corner2 + v*corner3 of patch(i) (from 1; default
  ! integer or int64) with u = uv(1, i), v = uv(2, i), u, v >= 0, u + v <= 1. patch(count),
  ! uv(2, count), out(bands, count). Errors as for hrad_query_patches.
  interface hrad_query_points
    module procedure query_points_32, query_points_64
  end interface hrad_query_points

contains

  subroutine query_patches_32(solver, quantity, side, first, out, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: quantity, side, first
    real(c_double), intent(inout) :: out(:, :)
    integer(c_int32_t), intent(out), optional :: status
    call query_patches_64(solver, quantity, side, int(first, c_int64_t), out, status)
  end subroutine query_patches_32

  subroutine query_patches_64(solver, quantity, side, first, out, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: quantity, side
    integer(c_int64_t), intent(in) :: first
    real(c_double), intent(inout) :: out(:, :)
    integer(c_int32_t), intent(out), optional :: status
    character(len=*), parameter :: name = "hrad_query_patches"
    integer(c_int64_t) :: bands, patches, materials, count
    count = size(out, 2, c_int64_t)
    if (lacks_bands(solver, bands, status)) return
    if (lacks_size(solver, patches, materials, status)) return
    if (misshapen(name, "out", shape(out, c_int64_t), [bands, any_extent], status)) return
    if (out_of_range(name, "patches", first, count, patches, status)) return
    call finish(c_query_patches(handle_of(solver), quantity, side, first - 1, count, out), status)
  end subroutine query_patches_64

  subroutine query_points_32(solver, quantity, side, patch, uv, out, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: quantity, side
    integer(c_int32_t), intent(in) :: patch(:)
    real(c_double), intent(in) :: uv(:, :)
    real(c_double), intent(inout) :: out(:, :)
    integer(c_int32_t), intent(out), optional :: status
    call query_points_64(solver, quantity, side, int(patch, c_int64_t), uv, out, status)
  end subroutine query_points_32

  subroutine query_points_64(solver, quantity, side, patch, uv, out, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: quantity, side
    integer(c_int64_t), intent(in) :: patch(:)
    real(c_double), intent(in) :: uv(:, :)
    real(c_double), intent(inout) :: out(:, :)
    integer(c_int32_t), intent(out), optional :: status
    character(len=*), parameter :: name = "hrad_query_points"
    integer(c_int64_t) :: bands, patches, materials, count
    count = size(patch, kind=c_int64_t)
    if (lacks_bands(solver, bands, status)) return
    if (lacks_size(solver, patches, materials, status)) return
    if (misshapen(name, "uv", shape(uv, c_int64_t), [2_c_int64_t, count], status)) return
    if (misshapen(name, "out", shape(out, c_int64_t), [bands, count], status)) return
    if (misnumbered(name, "patch", patch, patches, status)) return
    call finish(c_query_points(handle_of(solver), quantity, side, count, patch - 1, uv, out), &
      status)
  end subroutine query_points_64

  ! Irradiance in W/m2 at free points: xyz(3, count) in the scene's unit, normal(3, count) of any
  ! length but 0, irradiance(bands, count), standard_error(bands, count). By rays to the solved
  ! leaves. Errors: ARGUMENT for a wrong shape or value, STATE before a solve.
  subroutine hrad_query_sensors(solver, xyz, normal, irradiance, standard_error, status)
    type(hrad_solver), intent(in) :: solver
    real(c_double), intent(in) :: xyz(:, :), normal(:, :)
    real(c_double), intent(inout) :: irradiance(:, :)
    real(c_double), contiguous, intent(inout), target, optional :: standard_error(:, :)
    integer(c_int32_t), intent(out), optional :: status
    character(len=*), parameter :: name = "hrad_query_sensors"
    type(c_ptr) :: error_address
    integer(c_int64_t) :: bands, count
    count = size(xyz, 2, c_int64_t)
    if (lacks_bands(solver, bands, status)) return
    if (misshapen(name, "xyz", shape(xyz, c_int64_t), [3_c_int64_t, any_extent], status)) return
    if (misshapen(name, "normal", shape(normal, c_int64_t), [3_c_int64_t, count], status)) return
    if (misshapen(name, "irradiance", shape(irradiance, c_int64_t), [bands, count], status)) return
    error_address = c_null_ptr
    if (present(standard_error)) then
      if (misshapen(name, "standard_error", shape(standard_error, c_int64_t), [bands, count], &
        status)) return
      if (size(standard_error) > 0) error_address = c_loc(standard_error)
    end if
    call finish(c_query_sensors(handle_of(solver), count, xyz, normal, irradiance, &
      error_address), status)
  end subroutine hrad_query_sensors

  ! Power in W per band, each (bands) and optional: emitted; absorbed by fronts; absorbed by black
  ! backs, blockers and inside sealed contacts; escaped to the outside. Errors: ARGUMENT for a wrong
  ! shape; STATE before a solve, or when emission or reflectance changed before a solve with
  ! refine = 0 had been asked.
  subroutine hrad_power_balance(solver, emitted, absorbed, absorbed_back, escaped, status)
    type(hrad_solver), intent(in) :: solver
    real(c_double), contiguous, intent(inout), target, optional :: emitted(:), absorbed(:)
    real(c_double), contiguous, intent(inout), target, optional :: absorbed_back(:), escaped(:)
    integer(c_int32_t), intent(out), optional :: status
    type(c_ptr) :: address(4)
    integer(c_int64_t) :: bands
    if (lacks_bands(solver, bands, status)) return
    if (not_a_term("emitted", emitted, bands, address(1), status)) return
    if (not_a_term("absorbed", absorbed, bands, address(2), status)) return
    if (not_a_term("absorbed_back", absorbed_back, bands, address(3), status)) return
    if (not_a_term("escaped", escaped, bands, address(4), status)) return
    call finish(c_power_balance(handle_of(solver), address(1), address(2), address(3), &
      address(4)), status)
  end subroutine hrad_power_balance

  ! Whether a term of the balance has a wrong shape; else its address, NULL without one.
  logical function not_a_term(name, term, bands, address, status)
    character(len=*), intent(in) :: name
    real(c_double), contiguous, intent(inout), target, optional :: term(:)
    integer(c_int64_t), intent(in) :: bands
    type(c_ptr), intent(out) :: address
    integer(c_int32_t), intent(out), optional :: status
    not_a_term = .false.
    address = c_null_ptr
    if (.not. present(term)) return
    not_a_term = misshapen("hrad_power_balance", name, shape(term, c_int64_t), [bands], status)
    if (.not. not_a_term) address = c_loc(term)
  end function not_a_term
end module hrad_queries
