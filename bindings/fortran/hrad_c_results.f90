! The C functions of hrad.h from the solve on, as C declares them: solve, query, files. For the
! modules of the binding alone; arrays that may be NULL are addresses.
module hrad_c_results
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, &
    c_null_ptr, c_ptr, c_size_t
  use hrad_types, only: hrad_stats
  implicit none
  public

  ! struct hrad_progress
  type, bind(c) :: c_progress
    integer(c_size_t) :: struct_size = 48
    type(c_ptr) :: stage = c_null_ptr
    integer(c_int64_t) :: iteration = 0
    real(c_double) :: fraction = 0
    real(c_double) :: seconds = 0
    real(c_double) :: seconds_left = 0
  end type c_progress

  interface
    function c_set_progress(solver, function, user) bind(c, name="hrad_set_progress") result(status)
      import :: c_funptr, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      type(c_funptr), value :: function
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function c_set_progress

    function c_solve(solver) bind(c, name="hrad_solve") result(status)
      import :: c_int32_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int32_t) :: status
    end function c_solve

    subroutine c_request_stop(solver) bind(c, name="hrad_request_stop")
      import :: c_ptr
      type(c_ptr), value :: solver
    end subroutine c_request_stop

    function c_get_stats(solver, stats) bind(c, name="hrad_get_stats") result(status)
      import :: c_int32_t, c_ptr, hrad_stats
      type(c_ptr), value :: solver
      type(hrad_stats), intent(inout) :: stats
      integer(c_int32_t) :: status
    end function c_get_stats

    function c_state_hash(solver, hash) bind(c, name="hrad_state_hash") result(status)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), intent(inout) :: hash
      integer(c_int32_t) :: status
    end function c_state_hash

    function c_query_patches(solver, quantity, side, first, count, out) &
      bind(c, name="hrad_query_patches") result(status)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int32_t), value :: quantity, side
      integer(c_int64_t), value :: first, count
      real(c_double), intent(inout) :: out(*)
      integer(c_int32_t) :: status
    end function c_query_patches

    function c_query_points(solver, quantity, side, count, patch, uv, out) &
      bind(c, name="hrad_query_points") result(status)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int32_t), value :: quantity, side
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(in) :: patch(*)
      real(c_double), intent(in) :: uv(*)
      real(c_double), intent(inout) :: out(*)
      integer(c_int32_t) :: status
    end function c_query_points

    function c_query_sensors(solver, count, xyz, normal, irradiance, standard_error) &
      bind(c, name="hrad_query_sensors") result(status)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: xyz(*), normal(*)
      real(c_double), intent(inout) :: irradiance(*)
      type(c_ptr), value :: standard_error
      integer(c_int32_t) :: status
    end function c_query_sensors

    function c_leaf_count(solver, count) bind(c, name="hrad_leaf_count") result(status)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_leaf_count

    function c_query_leaves(solver, first, count, patch, face, side, corners_xyz, area, radiosity) &
      bind(c, name="hrad_query_leaves") result(status)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: first, count
      type(c_ptr), value :: patch, face, side, corners_xyz, area, radiosity
      integer(c_int32_t) :: status
    end function c_query_leaves

    function c_power_balance(solver, emitted, absorbed, absorbed_back, escaped) &
      bind(c, name="hrad_power_balance") result(status)
      import :: c_int32_t, c_ptr
      type(c_ptr), value :: solver, emitted, absorbed, absorbed_back, escaped
      integer(c_int32_t) :: status
    end function c_power_balance

    function c_write_checkpoint(solver, path) bind(c, name="hrad_write_checkpoint") result(status)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_write_checkpoint

    function c_lock_checkpoint(solver, path) bind(c, name="hrad_lock_checkpoint") result(status)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_lock_checkpoint

    function c_read_checkpoint(solver, path) bind(c, name="hrad_read_checkpoint") result(status)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_read_checkpoint

    function c_describe_checkpoint(path, text, size, needed) &
      bind(c, name="hrad_describe_checkpoint") result(status)
      import :: c_char, c_int32_t, c_int64_t
      character(kind=c_char), intent(in) :: path(*)
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: size
      integer(c_int64_t), intent(inout) :: needed
      integer(c_int32_t) :: status
    end function c_describe_checkpoint

    function c_export(solver, path) bind(c, name="hrad_export") result(status)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_export
  end interface
end module hrad_c_results
