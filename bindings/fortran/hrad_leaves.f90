! hrad.h, section "query": the leaves, the undivided pieces of surface.
module hrad_leaves
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_loc, c_null_ptr, c_ptr
  use hrad_c_results, only: c_leaf_count, c_query_leaves
  use hrad_checks, only: any_extent, beyond_int32, lacks_bands, lacks_size, misshapen, &
    out_of_range
  use hrad_constants, only: HRAD_OK
  use hrad_errors, only: finish
  use hrad_types, only: handle_of, hrad_solver
  implicit none
  private
  public :: hrad_leaf_count, hrad_query_leaves

  ! hrad_leaf_count(solver, count [, status]): the number of leaves (a two-sided patch has those of
  ! both sides); default integer or int64. Errors: STATE before a solve.
  interface hrad_leaf_count
    module procedure leaf_count_32, leaf_count_64
  end interface hrad_leaf_count

  ! hrad_query_leaves(solver, first [, patch] [, face] [, side] [, corners_xyz] [, area]
  ! [, radiosity] [, status]): leaves from `first` (from 1; default integer or int64) on, as many as
  ! the arrays have places for, ordered by patch, side and path. patch(count) and face(count), from
  ! 1, default integer or int64; side(count): HRAD_FRONT or HRAD_BACK, default integer;
  ! corners_xyz(3, 3, count): (:, k, i) is corner k of a leaf, anticlockwise seen from its side;
  ! area(count) in unit^2; radiosity(bands, count): means in W/m2. Errors: ARGUMENT for a wrong
  ! shape or range, STATE before a solve.
  interface hrad_query_leaves
    module procedure leaves_32, leaves_64, leaves_32_patch, leaves_64_patch, leaves_32_face, &
      leaves_64_face
  end interface hrad_query_leaves

contains

  subroutine leaf_count_32(solver, count, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(inout) :: count
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t) :: found
    integer(c_int32_t) :: code
    found = 0
    code = c_leaf_count(handle_of(solver), found)
    if (beyond_int32("hrad_leaf_count", found, status)) return
    if (code == HRAD_OK) count = int(found, c_int32_t)
    call finish(code, status)
  end subroutine leaf_count_32

  subroutine leaf_count_64(solver, count, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(inout) :: count
    integer(c_int32_t), intent(out), optional :: status
    call finish(c_leaf_count(handle_of(solver), count), status)
  end subroutine leaf_count_64

  ! patch and face as int64, or neither.
  subroutine leaves_64(solver, first, patch, face, side, corners_xyz, area, radiosity, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(in) :: first
    integer(c_int64_t), contiguous, intent(inout), target, optional :: patch(:), face(:)
    integer(c_int32_t), contiguous, intent(inout), target, optional :: side(:)
    real(c_double), contiguous, intent(inout), target, optional :: corners_xyz(:, :, :), area(:)
    real(c_double), contiguous, intent(inout), target, optional :: radiosity(:, :)
    integer(c_int32_t), intent(out), optional :: status
    character(len=*), parameter :: name = "hrad_query_leaves"
    type(c_ptr) :: address(6)
    integer(c_int64_t) :: bands, count, leaves
    integer(c_int32_t) :: code
    if (lacks_bands(solver, bands, status)) return
    count = 0
    if (present(patch)) count = size(patch, kind=c_int64_t)
    if (present(face)) count = size(face, kind=c_int64_t)
    if (present(side)) count = size(side, kind=c_int64_t)
    if (present(corners_xyz)) count = size(corners_xyz, 3, c_int64_t)
    if (present(area)) count = size(area, kind=c_int64_t)
    if (present(radiosity)) count = size(radiosity, 2, c_int64_t)
    address = c_null_ptr
    if (present(patch)) then
      if (misshapen(name, "patch", shape(patch, c_int64_t), [count], status)) return
      if (count > 0) address(1) = c_loc(patch)
    end if
    if (present(face)) then
      if (misshapen(name, "face", shape(face, c_int64_t), [count], status)) return
      if (count > 0) address(2) = c_loc(face)
    end if
    if (present(side)) then
      if (misshapen(name, "side", shape(side, c_int64_t), [count], status)) return
      if (count > 0) address(3) = c_loc(side)
    end if
    if (present(corners_xyz)) then
      if (misshapen(name, "corners_xyz", shape(corners_xyz, c_int64_t), &
        [3_c_int64_t, 3_c_int64_t, count], status)) return
      if (count > 0) address(4) = c_loc(corners_xyz)
    end if
    if (present(area)) then
      if (misshapen(name, "area", shape(area, c_int64_t), [count], status)) return
      if (count > 0) address(5) = c_loc(area)
    end if
    if (present(radiosity)) then
      if (misshapen(name, "radiosity", shape(radiosity, c_int64_t), [bands, any_extent], &
        status)) return
      if (count > 0) address(6) = c_loc(radiosity)
    end if
    leaves = 0
    code = c_leaf_count(handle_of(solver), leaves)
    if (code == HRAD_OK) then
      if (out_of_range(name, "leaves", first, count, leaves, status)) return
      code = c_query_leaves(handle_of(solver), first - 1, count, address(1), address(2), &
        address(3), address(4), address(5), address(6))
    end if
    if (code == HRAD_OK .and. present(patch)) patch = patch + 1
    if (code == HRAD_OK .and. present(face)) face = face + 1
    call finish(code, status)
  end subroutine leaves_64

  subroutine leaves_32(solver, first, patch, face, side, corners_xyz, area, radiosity, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: first
    integer(c_int64_t), contiguous, intent(inout), target, optional :: patch(:), face(:)
    integer(c_int32_t), contiguous, intent(inout), target, optional :: side(:)
    real(c_double), contiguous, intent(inout), target, optional :: corners_xyz(:, :, :), area(:)
    real(c_double), contiguous, intent(inout), target, optional :: radiosity(:, :)
    integer(c_int32_t), intent(out), optional :: status
    call leaves_64(solver, int(first, c_int64_t), patch, face, side, corners_xyz, area, &
      radiosity, status)
  end subroutine leaves_32

  ! patch, and face if it is there, as default integers.
  subroutine leaves_64_patch(solver, first, patch, face, side, corners_xyz, area, radiosity, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(in) :: first
    integer(c_int32_t), intent(inout) :: patch(:)
    integer(c_int32_t), intent(inout), optional :: face(:)
    integer(c_int32_t), contiguous, intent(inout), target, optional :: side(:)
    real(c_double), contiguous, intent(inout), target, optional :: corners_xyz(:, :, :), area(:)
    real(c_double), contiguous, intent(inout), target, optional :: radiosity(:, :)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t), allocatable :: patch_64(:), face_64(:)
    if (too_many(solver, status)) return
    allocate (patch_64(size(patch)), source=0_c_int64_t)
    if (present(face)) then
      allocate (face_64(size(face)), source=0_c_int64_t)
      call leaves_64(solver, first, patch_64, face_64, side, corners_xyz, area, radiosity, status)
      call narrow(face_64, face)
    else
      call leaves_64(solver, first, patch_64, side=side, corners_xyz=corners_xyz, area=area, &
        radiosity=radiosity, status=status)
    end if
    call narrow(patch_64, patch)
  end subroutine leaves_64_patch

  subroutine leaves_32_patch(solver, first, patch, face, side, corners_xyz, area, radiosity, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: first
    integer(c_int32_t), intent(inout) :: patch(:)
    integer(c_int32_t), intent(inout), optional :: face(:)
    integer(c_int32_t), contiguous, intent(inout), target, optional :: side(:)
    real(c_double), contiguous, intent(inout), target, optional :: corners_xyz(:, :, :), area(:)
    real(c_double), contiguous, intent(inout), target, optional :: radiosity(:, :)
    integer(c_int32_t), intent(out), optional :: status
    call leaves_64_patch(solver, int(first, c_int64_t), patch, face, side, corners_xyz, area, &
      radiosity, status)
  end subroutine leaves_32_patch

  ! face as default integers; patch as int64, or not at all.
  subroutine leaves_64_face(solver, first, patch, face, side, corners_xyz, area, radiosity, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(in) :: first
    integer(c_int64_t), contiguous, intent(inout), target, optional :: patch(:)
    integer(c_int32_t), intent(inout) :: face(:)
    integer(c_int32_t), contiguous, intent(inout), target, optional :: side(:)
    real(c_double), contiguous, intent(inout), target, optional :: corners_xyz(:, :, :), area(:)
    real(c_double), contiguous, intent(inout), target, optional :: radiosity(:, :)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t), allocatable :: face_64(:)
    if (too_many(solver, status)) return
    allocate (face_64(size(face)), source=0_c_int64_t)
    call leaves_64(solver, first, patch, face_64, side, corners_xyz, area, radiosity, status)
    call narrow(face_64, face)
  end subroutine leaves_64_face

  subroutine leaves_32_face(solver, first, patch, face, side, corners_xyz, area, radiosity, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: first
    integer(c_int64_t), contiguous, intent(inout), target, optional :: patch(:)
    integer(c_int32_t), intent(inout) :: face(:)
    integer(c_int32_t), contiguous, intent(inout), target, optional :: side(:)
    real(c_double), contiguous, intent(inout), target, optional :: corners_xyz(:, :, :), area(:)
    real(c_double), contiguous, intent(inout), target, optional :: radiosity(:, :)
    integer(c_int32_t), intent(out), optional :: status
    call leaves_64_face(solver, int(first, c_int64_t), patch, face, side, corners_xyz, area, &
      radiosity, status)
  end subroutine leaves_32_face

  ! Whether patches have numbers that default integers can't hold.
  logical function too_many(solver, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t) :: patches, materials
    too_many = lacks_size(solver, patches, materials, status)
    if (.not. too_many) too_many = beyond_int32("hrad_query_leaves", patches, status)
  end function too_many

  ! Hands numbers over as default integers, if there are any: after an error they are still 0.
  subroutine narrow(from, to)
    integer(c_int64_t), intent(in) :: from(:)
    integer(c_int32_t), intent(inout) :: to(:)
    if (all(from > 0)) to = int(from, c_int32_t)
  end subroutine narrow
end module hrad_leaves
