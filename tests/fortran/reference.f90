! The Fortran declarations of reference.c.
module reference
  use, intrinsic :: iso_c_binding
  use hrad, only: hrad_patch, hrad_rank_load, hrad_stats
  implicit none
  public

  interface
    function reference_create() bind(c) result(solver)
      import :: c_ptr
      type(c_ptr) :: solver
    end function reference_create

    subroutine reference_destroy(solver) bind(c)
      import :: c_ptr
      type(c_ptr), value :: solver
    end subroutine reference_destroy

    function reference_results(solver, hash, leaves, radiosity, flux, balance) bind(c) &
      result(status)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), intent(out) :: hash, leaves
      real(c_double), intent(out) :: radiosity(3, 36), flux(3, 20), balance(3, 4)
      integer(c_int32_t) :: status
    end function reference_results

    function reference_points(solver, count, patch, uv, out, xyz, normal, irradiance, &
      standard_error) bind(c) result(status)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in) :: patch(*)
      real(c_double), intent(in) :: uv(2, *), xyz(3, *), normal(3, *)
      real(c_double), intent(out) :: out(3, *), irradiance(3, *), standard_error(3, *)
      integer(c_int32_t) :: status
    end function reference_points

    function reference_leaves(solver, first, count, patch, face, side, corners_xyz, area, &
      radiosity) bind(c) result(status)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: first, count
      integer(c_int64_t), intent(out) :: patch(*), face(*)
      integer(c_int32_t), intent(out) :: side(*)
      real(c_double), intent(out) :: corners_xyz(3, 3, *), area(*), radiosity(3, *)
      integer(c_int32_t) :: status
    end function reference_leaves

    function reference_two_threads(procedure) bind(c) result(status)
      import :: c_funptr, c_int32_t
      type(c_funptr), value :: procedure
      integer(c_int32_t) :: status
    end function reference_two_threads

    subroutine reference_meet(meeting) bind(c)
      import :: c_ptr
      type(c_ptr), value :: meeting
    end subroutine reference_meet

    subroutine reference_sizes(sizes) bind(c)
      import :: c_int64_t
      integer(c_int64_t), intent(out) :: sizes(3)
    end subroutine reference_sizes

    subroutine reference_take_apart(patch, load, stats, patch_fields, load_fields, &
      stats_fields) bind(c)
      import :: c_double, hrad_patch, hrad_rank_load, hrad_stats
      type(hrad_patch), intent(in) :: patch
      type(hrad_rank_load), intent(in) :: load
      type(hrad_stats), intent(in) :: stats
      real(c_double), intent(out) :: patch_fields(13), load_fields(9), stats_fields(32)
    end subroutine reference_take_apart
  end interface
end module reference
