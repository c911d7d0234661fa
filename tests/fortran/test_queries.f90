! A solution asked from Fortran has the bits of the same solution asked from C; wrong shapes and
! numbers are refused.
program test_queries
  use, intrinsic :: iso_c_binding, only: c_associated, c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use check
  use hrad
  use reference
  implicit none
  type(hrad_solver) :: solver
  type(c_ptr) :: twin
  twin = reference_create()
  call expect(c_associated(twin), "the C side solves cornell")
  call before_a_solve()
  call solved_cornell(solver)
  call results()
  call points()
  call leaves()
  call wrong_arguments()
  call files()
  call hrad_destroy(solver)
  call reference_destroy(twin)
  call finish_checks()

contains

  subroutine before_a_solve()
    type(hrad_solver) :: fresh
    type(hrad_stats) :: stats
    double precision :: out(3, 2)
    integer(int64) :: hash
    integer :: count, status
    call hrad_create(fresh)
    call hrad_make_scene(fresh, "cornell")
    call hrad_query_patches(fresh, HRAD_RADIOSITY, HRAD_FRONT, 1, out, status)
    call expect(status == HRAD_ERROR_STATE, "hrad_query_patches before a solve")
    call hrad_query_patches(fresh, HRAD_EMISSION, HRAD_FRONT, 1, out, status)
    call expect_ok(status, "the emission before a solve")
    call hrad_leaf_count(fresh, count, status)
    call expect(status == HRAD_ERROR_STATE, "hrad_leaf_count before a solve")
    call hrad_query_leaves(fresh, 1, status=status)
    call expect(status == HRAD_ERROR_STATE, "hrad_query_leaves before a solve")
    call hrad_state_hash(fresh, hash, status)
    call expect(status == HRAD_ERROR_STATE, "hrad_state_hash before a solve")
    call hrad_power_balance(fresh, out(:, 1), status=status)
    call expect(status == HRAD_ERROR_STATE, "hrad_power_balance before a solve")
    call hrad_query_sensors(fresh, out(:, 1:0), out(:, 1:0), out(:, 1:0), status=status)
    call expect(status == HRAD_ERROR_STATE, "hrad_query_sensors before a solve")
    call hrad_get_stats(fresh, stats, status)
    call expect_ok(status, "hrad_get_stats before a solve")
    call expect(stats%converged == 0 .and. stats%links == 0, "it answers zeros")
    call hrad_destroy(fresh)
  end subroutine before_a_solve

  subroutine results()
    type(hrad_stats) :: stats
    double precision :: radiosity(3, 36), flux(3, 20)
    double precision :: c_radiosity(3, 36), c_flux(3, 20), c_balance(3, 4)
    double precision, dimension(3) :: emitted, absorbed, absorbed_back, escaped
    integer(int64) :: hash, c_hash, count, c_count
    integer :: short_count, status
    call expect_ok(reference_results(twin, c_hash, c_count, c_radiosity, c_flux, c_balance), "C")
    call hrad_state_hash(solver, hash, status)
    call expect_ok(status, "hrad_state_hash")
    call expect(hash == c_hash .and. hash /= 0, "the hash")
    call hrad_leaf_count(solver, count, status)
    call expect_ok(status, "hrad_leaf_count")
    call hrad_leaf_count(solver, short_count)
    call expect(count == c_count .and. short_count == c_count, "the number of leaves")
    call hrad_query_patches(solver, HRAD_RADIOSITY, HRAD_FRONT, 1, radiosity, status)
    call expect_ok(status, "hrad_query_patches")
    call expect(all(radiosity == c_radiosity) .and. any(radiosity > 0), "the radiosities")
    call hrad_query_patches(solver, HRAD_NET_FLUX, HRAD_FRONT, 6_int64, flux)
    call expect(all(flux == c_flux) .and. any(abs(flux) > 0), "the net fluxes of 20 patches from 6")
    call hrad_power_balance(solver, emitted, absorbed, absorbed_back, escaped, status)
    call expect_ok(status, "hrad_power_balance")
    call expect(all(reshape([emitted, absorbed, absorbed_back, escaped], [3, 4]) == c_balance), &
      "the balance")
    call expect(all(abs(emitted - absorbed - absorbed_back - escaped) < 0.05 * emitted), &
      "the balance closes")
    escaped = 0
    call hrad_power_balance(solver, escaped=escaped)
    call expect(all(escaped == c_balance(:, 4)), "one term of the balance")
    call hrad_get_stats(solver, stats, status)
    call expect_ok(status, "hrad_get_stats")
    call expect(stats%converged == 1 .and. stats%patches == 36 .and. stats%leaves == count .and. &
      stats%ranks == 1 .and. stats%cpu_seconds > 0, "the statistics")
  end subroutine results

  subroutine points()
    integer(int64), parameter :: patch(3) = [1_int64, 7_int64, 36_int64]
    double precision :: uv(2, 3), xyz(3, 3), normal(3, 3)
    double precision, dimension(3, 3) :: out, irradiance, error, c_out, c_irradiance, c_error
    integer :: status
    uv = reshape([0.2d0, 0.3d0, 0d0, 1d0, 0.5d0, 0.5d0], [2, 3])
    xyz = reshape([0.2d0, 0.2d0, 0.2d0, 0.3d0, 0.3d0, 0.1d0, 0.1d0, 0.4d0, 0.5d0], [3, 3])
    normal = reshape([0d0, 0d0, 1d0, 0d0, 2d0, 0d0, 1d0, 1d0, 1d0], [3, 3])
    call expect_ok(reference_points(twin, 3_int64, patch - 1, uv, c_out, xyz, normal, &
      c_irradiance, c_error), "C")
    call hrad_query_points(solver, HRAD_IRRADIANCE, HRAD_FRONT, patch, uv, out, status)
    call expect_ok(status, "hrad_query_points")
    call expect(all(out == c_out) .and. any(out > 0), "the irradiances at points")
    out = 0
    call hrad_query_points(solver, HRAD_IRRADIANCE, HRAD_FRONT, int(patch), uv, out)
    call expect(all(out == c_out), "with default integers")
    call hrad_query_sensors(solver, xyz, normal, irradiance, error, status)
    call expect_ok(status, "hrad_query_sensors")
    call expect(all(irradiance == c_irradiance) .and. all(error == c_error) .and. &
      any(irradiance > 0), "the irradiances of sensors")
    irradiance = 0
    call hrad_query_sensors(solver, xyz, normal, irradiance)
    call expect(all(irradiance == c_irradiance), "without standard errors")
  end subroutine points

  subroutine leaves()
    integer, parameter :: n = 50
    integer(int64), dimension(n) :: patch, face, c_patch, c_face
    integer, dimension(n) :: short_patch, short_face, side, c_side
    double precision, dimension(3, 3, n) :: corners, c_corners
    double precision :: area(2 * n), c_area(n), radiosity(3, n), c_radiosity(3, n)
    integer :: count, status
    call expect_ok(reference_leaves(twin, 99_int64, int(n, int64), c_patch, c_face, c_side, &
      c_corners, c_area, c_radiosity), "C")
    call hrad_query_leaves(solver, 100, patch, face, side, corners, area(1::2), radiosity, status)
    call expect_ok(status, "hrad_query_leaves")
    call expect(all(patch == c_patch + 1) .and. all(face == c_face + 1), "patches and faces")
    call expect(all(side == c_side) .and. all(corners == c_corners), "sides and corners")
    call expect(all(area(1::2) == c_area) .and. all(radiosity == c_radiosity), "areas and light")
    call hrad_query_leaves(solver, 100_int64, short_patch, short_face, status=status)
    call expect_ok(status, "hrad_query_leaves with default integers")
    call expect(all(short_patch == patch) .and. all(short_face == face), "the same numbers")
    short_patch = 0
    short_face = 0
    call hrad_query_leaves(solver, 100, short_patch)
    call hrad_query_leaves(solver, 100, face=short_face, side=side)
    call expect(all(short_patch == patch) .and. all(short_face == face), "one at a time")
    short_face = 0
    call hrad_query_leaves(solver, 100_int64, patch, short_face)
    call expect(all(short_face == face) .and. all(patch == c_patch + 1), "of both kinds")
    call hrad_query_leaves(solver, 100_int64, radiosity=radiosity)
    call expect(all(radiosity == c_radiosity), "light alone")
    call hrad_leaf_count(solver, count)
    call hrad_query_leaves(solver, count - n + 1, short_patch, status=status)
    call expect_ok(status, "the last leaves")
    call hrad_query_leaves(solver, count - n + 2, short_patch, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "50 leaves from", "leaves past the last")
    call hrad_query_leaves(solver, 0, area=area, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "from 0 on", "leaf 0")
    call hrad_query_leaves(solver, 1, patch, area=area, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "patch has the shape (50)", "50 and 100 places")
    call hrad_query_leaves(solver, 1, radiosity=radiosity(1:2, :), status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "radiosity has the shape (2, 50)", "2 bands")
    call hrad_query_leaves(solver, 1, corners_xyz=corners(1:2, :, :), status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "corners_xyz has the shape (2, 3", "2 of 3 axes")
  end subroutine leaves

  subroutine wrong_arguments()
    double precision :: out(3, 3), uv(2, 3), wide(4)
    integer :: status
    uv = 0.25d0
    out = -1
    call hrad_query_patches(solver, HRAD_RADIOSITY, HRAD_FRONT, 35, out, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "3 patches from 35 on", "patches past the last")
    call hrad_query_patches(solver, HRAD_RADIOSITY, HRAD_FRONT, 0, out, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "from 0 on", "patch 0")
    call hrad_query_patches(solver, HRAD_RADIOSITY, HRAD_FRONT, 1, out(1:2, :), status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "out has the shape (2, 3)", "2 of 3 bands")
    call hrad_query_patches(solver, 4, HRAD_FRONT, 1, out, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "HRAD_NET_FLUX", "an unknown quantity")
    call hrad_query_patches(solver, HRAD_RADIOSITY, 2, 1, out, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "HRAD_BACK", "an unknown side")
    call hrad_query_points(solver, HRAD_RADIOSITY, HRAD_FRONT, [1, 2, 37], uv, out, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "no patch 37 (element 3)", "a point on patch 37")
    call hrad_query_points(solver, HRAD_RADIOSITY, HRAD_FRONT, [1, 2], uv, out, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "uv has the shape (2, 3)", "2 patches, 3 points")
    call hrad_query_points(solver, HRAD_RADIOSITY, HRAD_FRONT, [1, 2], uv(:, 1:2), out, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "out has the shape (3, 3)", "3 places, 2 points")
    call hrad_query_sensors(solver, out, out(:, 1:2), out, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "normal has the shape (3, 2)", "2 of 3 normals")
    call hrad_query_sensors(solver, out(1:2, :), out, out, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "xyz has the shape (2, 3)", "2 of 3 axes")
    call hrad_query_sensors(solver, out, out, out(:, 1:1), status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "irradiance has the shape (3, 1)", "1 place")
    call hrad_query_sensors(solver, out, out, out, out(:, 1:1), status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "standard_error has the shape (3, 1)", "1 place")
    call hrad_power_balance(solver, absorbed_back=wide, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "absorbed_back has the shape (4)", "4 bands")
    call expect(all(out == -1), "an error leaves outputs alone")
  end subroutine wrong_arguments

  subroutine files()
    integer :: status, unit
    character(len=20) :: heading
    call hrad_export(solver, "fortran_queries.csv", status)
    call expect_ok(status, "hrad_export")
    open (newunit=unit, file="fortran_queries.csv", status="old", action="read")
    read (unit, "(a)") heading
    close (unit, status="delete")
    call expect(heading == "patch,face,side,x0,y", "the table has its heading")
  end subroutine files
end program test_queries
