! hrad.h, section "load", second part: patches and their emission and reflectance.
module hrad_patches
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_loc, c_null_ptr, c_ptr
  use hrad_c_setup, only: c_add_patches, c_get_patch, c_scene_size, c_set_emission, &
    c_set_reflectance
  use hrad_checks, only: any_extent, beyond_int32, lacks_bands, lacks_size, misnumbered, &
    misshapen, out_of_range
  use hrad_constants, only: HRAD_OK
  use hrad_errors, only: finish
  use hrad_types, only: handle_of, hrad_patch, hrad_solver
  implicit none
  private
  public :: hrad_add_patches, hrad_scene_size, hrad_get_patch, hrad_set_emission
  public :: hrad_set_reflectance

  ! hrad_add_patches(solver, xyz, vertex [, material] [, status]) adds patches: xyz(3, vertices) in
  ! the scene's unit; vertex(3, triangles) indices into this call's vertices (from 1), anticlockwise
  ! seen from the front; material(triangles) numbers (from 1), without it the material added first,
  ! or reflectance 0.5 if there is none. Indices: default integer or int64. Everything is copied;
  ! patch numbers go on from call to call. Errors: ARGUMENT for a wrong shape, an index out of
  ! range, a coordinate not finite or beyond 1e30; STATE after hrad_partition; MEMORY. Nothing is
  ! added then.
  interface hrad_add_patches
    module procedure add_patches_32_32, add_patches_32_64, add_patches_64_32, add_patches_64_64
  end interface hrad_add_patches

  ! hrad_scene_size(solver [, patches] [, materials] [, status]): how many patches (dropped ones
  ! included) and materials there are; default integers or int64. Errors: ARGUMENT for an empty
  ! handle or a default integer that can't hold the count.
  interface hrad_scene_size
    module procedure scene_size_32_32, scene_size_32_64, scene_size_64_32, scene_size_64_64
  end interface hrad_scene_size

  ! hrad_get_patch(solver, patch, out [, status]): one patch (from 1; default integer or int64) as
  ! an hrad_patch. Errors: ARGUMENT for a number out of range.
  interface hrad_get_patch
    module procedure get_patch_32, get_patch_64
  end interface hrad_get_patch

  ! hrad_set_emission(solver, first_patch, emission [, status]) sets emission(bands, count), in W/m2
  ! (0, or 1e-30 to 1e30), of the patches from first_patch (from 1; default integer or int64) on.
  ! Also after a solve: the next hrad_solve then starts from B = E, with refine = 0 on the mesh and
  ! the links as they are; until then queries answer with the new values and the irradiance that
  ! was solved for. Errors: ARGUMENT for a wrong shape, range or value; STATE for a blocker with
  ! emission.
  interface hrad_set_emission
    module procedure set_emission_32, set_emission_64
  end interface hrad_set_emission

  ! hrad_set_reflectance(solver, first_patch, reflectance [, status]): as hrad_set_emission, values
  ! in [0,1).
  interface hrad_set_reflectance
    module procedure set_reflectance_32, set_reflectance_64
  end interface hrad_set_reflectance

contains

  subroutine add_patches_32_32(solver, xyz, vertex, material, status)
    type(hrad_solver), intent(in) :: solver
    real(c_double), intent(in) :: xyz(:, :)
    integer(c_int32_t), intent(in) :: vertex(:, :)
    integer(c_int32_t), intent(in), optional :: material(:)
    integer(c_int32_t), intent(out), optional :: status
    call add_patches_64_32(solver, xyz, int(vertex, c_int64_t), material, status)
  end subroutine add_patches_32_32

  subroutine add_patches_32_64(solver, xyz, vertex, material, status)
    type(hrad_solver), intent(in) :: solver
    real(c_double), intent(in) :: xyz(:, :)
    integer(c_int32_t), intent(in) :: vertex(:, :)
    integer(c_int64_t), intent(in) :: material(:)
    integer(c_int32_t), intent(out), optional :: status
    call add_patches(solver, xyz, int(vertex, c_int64_t), material, status)
  end subroutine add_patches_32_64

  subroutine add_patches_64_32(solver, xyz, vertex, material, status)
    type(hrad_solver), intent(in) :: solver
    real(c_double), intent(in) :: xyz(:, :)
    integer(c_int64_t), intent(in) :: vertex(:, :)
    integer(c_int32_t), intent(in), optional :: material(:)
    integer(c_int32_t), intent(out), optional :: status
    if (present(material)) then
      call add_patches(solver, xyz, vertex, int(material, c_int64_t), status)
    else
      call add_patches(solver, xyz, vertex, status=status)
    end if
  end subroutine add_patches_64_32

  subroutine add_patches_64_64(solver, xyz, vertex, material, status)
    type(hrad_solver), intent(in) :: solver
    real(c_double), intent(in) :: xyz(:, :)
    integer(c_int64_t), intent(in) :: vertex(:, :)
    integer(c_int64_t), intent(in) :: material(:)
    integer(c_int32_t), intent(out), optional :: status
    call add_patches(solver, xyz, vertex, material, status)
  end subroutine add_patches_64_64

  subroutine add_patches(solver, xyz, vertex, material, status)
    type(hrad_solver), intent(in) :: solver
    real(c_double), intent(in) :: xyz(:, :)
    integer(c_int64_t), intent(in) :: vertex(:, :)
    integer(c_int64_t), intent(in), optional :: material(:)
    integer(c_int32_t), intent(out), optional :: status
    character(len=*), parameter :: name = "hrad_add_patches"
    integer(c_int32_t), allocatable, target :: numbers(:)
    type(c_ptr) :: numbers_address
    integer(c_int64_t) :: vertices, triangles, patches, materials
    vertices = size(xyz, 2, c_int64_t)
    triangles = size(vertex, 2, c_int64_t)
    if (lacks_size(solver, patches, materials, status)) return
    if (misshapen(name, "xyz", shape(xyz, c_int64_t), [3_c_int64_t, any_extent], status)) return
    if (misshapen(name, "vertex", shape(vertex, c_int64_t), [3_c_int64_t, any_extent], &
      status)) return
    if (misnumbered(name, "vertex", reshape(vertex, [3 * triangles]), vertices, status)) return
    numbers_address = c_null_ptr
    if (present(material)) then
      if (misshapen(name, "material", shape(material, c_int64_t), [triangles], status)) return
      if (misnumbered(name, "material", material, materials, status)) return
      numbers = int(material - 1, c_int32_t)
      if (size(numbers) > 0) numbers_address = c_loc(numbers)
    end if
    call finish(c_add_patches(handle_of(solver), vertices, xyz, triangles, vertex - 1, &
      numbers_address), status)
  end subroutine add_patches

  subroutine scene_size_32_32(solver, patches, materials, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(inout) :: patches
    integer(c_int32_t), intent(inout), optional :: materials
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t) :: found_patches, found_materials
    if (lacks_size(solver, found_patches, found_materials, status)) return
    if (beyond_int32("hrad_scene_size", max(found_patches, found_materials), status)) return
    patches = int(found_patches, c_int32_t)
    if (present(materials)) materials = int(found_materials, c_int32_t)
    call finish(HRAD_OK, status)
  end subroutine scene_size_32_32

  subroutine scene_size_32_64(solver, patches, materials, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(inout) :: patches
    integer(c_int64_t), intent(inout) :: materials
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t) :: found_patches, found_materials
    if (lacks_size(solver, found_patches, found_materials, status)) return
    if (beyond_int32("hrad_scene_size", found_patches, status)) return
    patches = int(found_patches, c_int32_t)
    materials = found_materials
    call finish(HRAD_OK, status)
  end subroutine scene_size_32_64

  subroutine scene_size_64_32(solver, patches, materials, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(inout), optional :: patches
    integer(c_int32_t), intent(inout) :: materials
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t) :: found_patches, found_materials
    if (lacks_size(solver, found_patches, found_materials, status)) return
    if (present(patches)) patches = found_patches
    materials = int(found_materials, c_int32_t)
    call finish(HRAD_OK, status)
  end subroutine scene_size_64_32

  subroutine scene_size_64_64(solver, patches, materials, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(inout), optional :: patches
    integer(c_int64_t), intent(inout), optional :: materials
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t) :: found_patches, found_materials
    integer(c_int32_t) :: code
    found_patches = 0
    found_materials = 0
    code = c_scene_size(handle_of(solver), found_patches, found_materials)
    if (code == HRAD_OK .and. present(patches)) patches = found_patches
    if (code == HRAD_OK .and. present(materials)) materials = found_materials
    call finish(code, status)
  end subroutine scene_size_64_64

  subroutine get_patch_32(solver, patch, out, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: patch
    type(hrad_patch), intent(inout) :: out
    integer(c_int32_t), intent(out), optional :: status
    call get_patch_64(solver, int(patch, c_int64_t), out, status)
  end subroutine get_patch_32

  subroutine get_patch_64(solver, patch, out, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(in) :: patch
    type(hrad_patch), intent(inout) :: out
    integer(c_int32_t), intent(out), optional :: status
    type(hrad_patch) :: found
    integer(c_int64_t) :: patches, materials
    integer(c_int32_t) :: code
    if (lacks_size(solver, patches, materials, status)) return
    if (out_of_range("hrad_get_patch", "patches", patch, 1_c_int64_t, patches, status)) return
    code = c_get_patch(handle_of(solver), patch - 1, found)
    if (code == HRAD_OK) then
      out = found
      out%face = found%face + 1
      out%material = found%material + 1
    end if
    call finish(code, status)
  end subroutine get_patch_64

  subroutine set_emission_32(solver, first_patch, emission, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: first_patch
    real(c_double), intent(in) :: emission(:, :)
    integer(c_int32_t), intent(out), optional :: status
    call set_emission_64(solver, int(first_patch, c_int64_t), emission, status)
  end subroutine set_emission_32

  subroutine set_emission_64(solver, first_patch, emission, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(in) :: first_patch
    real(c_double), intent(in) :: emission(:, :)
    integer(c_int32_t), intent(out), optional :: status
    if (unfit("hrad_set_emission", "emission", solver, first_patch, emission, status)) return
    call finish(c_set_emission(handle_of(solver), first_patch - 1, size(emission, 2, c_int64_t), &
      emission), status)
  end subroutine set_emission_64

  subroutine set_reflectance_32(solver, first_patch, reflectance, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: first_patch
    real(c_double), intent(in) :: reflectance(:, :)
    integer(c_int32_t), intent(out), optional :: status
    call set_reflectance_64(solver, int(first_patch, c_int64_t), reflectance, status)
  end subroutine set_reflectance_32

  subroutine set_reflectance_64(solver, first_patch, reflectance, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(in) :: first_patch
    real(c_double), intent(in) :: reflectance(:, :)
    integer(c_int32_t), intent(out), optional :: status
    if (unfit("hrad_set_reflectance", "reflectance", solver, first_patch, reflectance, &
      status)) return
    call finish(c_set_reflectance(handle_of(solver), first_patch - 1, &
      size(reflectance, 2, c_int64_t), reflectance), status)
  end subroutine set_reflectance_64

  ! Whether values(bands, count) don't fit the patches from first_patch on.
  logical function unfit(procedure_name, name, solver, first_patch, values, status)
    character(len=*), intent(in) :: procedure_name, name
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(in) :: first_patch
    real(c_double), intent(in) :: values(:, :)
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t) :: bands, patches, materials
    unfit = .true.
    if (lacks_bands(solver, bands, status)) return
    if (lacks_size(solver, patches, materials, status)) return
    if (misshapen(procedure_name, name, shape(values, c_int64_t), [bands, any_extent], &
      status)) return
    if (out_of_range(procedure_name, "patches", first_patch, size(values, 2, c_int64_t), patches, &
      status)) return
    unfit = .false.
  end function unfit
end module hrad_patches
