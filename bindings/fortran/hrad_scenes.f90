! hrad.h, section "load", first part: scenes from files and built-in ones, materials, diagnostics.
module hrad_scenes
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_int64_t, c_loc, &
    c_null_ptr, c_ptr
  use hrad_c_setup, only: c_add_material, c_get_diagnostic, c_get_material, c_load_scene, &
    c_make_scene, c_material, c_scene_name
  use hrad_checks, only: from_zero, has_nul, lacks_bands, lacks_size, misshapen, out_of_range
  use hrad_constants, only: HRAD_OK
  use hrad_errors, only: finish
  use hrad_text, only: c_characters, c_text, fortran_text, text_of_buffer
  use hrad_types, only: handle_of, hrad_material, hrad_solver
  implicit none
  private
  public :: hrad_add_material, hrad_get_material, hrad_load_scene, hrad_make_scene
  public :: hrad_scene_name, hrad_get_diagnostic

  ! hrad_add_material(solver, material [, number] [, status]) adds a material, of type
  ! hrad_material, and gives its number (from 1; default integer or int64). Everything is copied.
  ! Errors: ARGUMENT for a value out of range or not finite, or arrays that don't have `bands`
  ! values; STATE after hrad_partition.
  interface hrad_add_material
    module procedure add_material_32, add_material_64
  end interface hrad_add_material

  ! hrad_get_material(solver, material [, name] [, reflectance] [, emission] [, flags] [, status]):
  ! a material (from 1; default integer or int64) as loaded; reflectance(bands), emission(bands) in
  ! W/m2. Errors: ARGUMENT for a number out of range or a wrong shape.
  interface hrad_get_material
    module procedure get_material_32, get_material_64
  end interface hrad_get_material

  ! hrad_scene_name(index): the name of built-in scene `index` (from 1; default integer or int64),
  ! "" past the last.
  interface hrad_scene_name
    module procedure scene_name_32, scene_name_64
  end interface hrad_scene_name

  ! hrad_get_diagnostic(solver, index, text [, status]): one of the sentences on what is doubtful in
  ! the scene, `index` from 1 (default integer or int64); patches that it names count from 0.
  ! More is known after hrad_partition and after hrad_solve. Errors: ARGUMENT past the last.
  interface hrad_get_diagnostic
    module procedure get_diagnostic_32, get_diagnostic_64
  end interface hrad_get_diagnostic

contains

  subroutine add_material_32(solver, material, number, status)
    type(hrad_solver), intent(in) :: solver
    type(hrad_material), intent(in), target :: material
    integer(c_int32_t), intent(inout), optional :: number
    integer(c_int32_t), intent(out), optional :: status
    type(c_material) :: given
    character(kind=c_char), allocatable, target :: name(:)
    integer(c_int64_t) :: bands
    integer(c_int32_t) :: added, code
    if (lacks_bands(solver, bands, status)) return
    if (allocated(material%reflectance)) then
      if (misshapen("hrad_add_material", "reflectance", &
        shape(material%reflectance, c_int64_t), [bands], status)) return
      given%reflectance = c_loc(material%reflectance)
    end if
    if (allocated(material%emission)) then
      if (misshapen("hrad_add_material", "emission", &
        shape(material%emission, c_int64_t), [bands], status)) return
      given%emission = c_loc(material%emission)
    end if
    given%flags = material%flags
    if (allocated(material%name)) then
      if (has_nul("hrad_add_material", "name", material%name, status)) return
      name = c_characters(material%name)
      given%name = c_loc(name)
    end if
    added = 0
    code = c_add_material(handle_of(solver), given, added)
    if (code == HRAD_OK .and. present(number)) number = added + 1
    call finish(code, status)
  end subroutine add_material_32

  subroutine add_material_64(solver, material, number, status)
    type(hrad_solver), intent(in) :: solver
    type(hrad_material), intent(in), target :: material
    integer(c_int64_t), intent(inout) :: number
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int32_t) :: added
    added = 0
    call add_material_32(solver, material, added, status)
    if (added > 0) number = added
  end subroutine add_material_64

  subroutine get_material_32(solver, material, name, reflectance, emission, flags, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: material
    character(len=:), allocatable, intent(inout), optional :: name
    real(c_double), contiguous, intent(inout), target, optional :: reflectance(:), emission(:)
    integer(c_int32_t), intent(inout), optional :: flags
    integer(c_int32_t), intent(out), optional :: status
    character(len=:), allocatable :: found_name
    call read_material(solver, int(material, c_int64_t), found_name, reflectance, emission, flags, &
      status)
    if (present(name) .and. allocated(found_name)) name = found_name
  end subroutine get_material_32

  subroutine get_material_64(solver, material, name, reflectance, emission, flags, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(in) :: material
    character(len=:), allocatable, intent(inout), optional :: name
    real(c_double), contiguous, intent(inout), target, optional :: reflectance(:), emission(:)
    integer(c_int32_t), intent(inout), optional :: flags
    integer(c_int32_t), intent(out), optional :: status
    character(len=:), allocatable :: found_name
    call read_material(solver, material, found_name, reflectance, emission, flags, status)
    if (present(name) .and. allocated(found_name)) name = found_name
  end subroutine get_material_64

  ! The name stays without allocation after an error. (It is not optional: gfortran 12 loses the
  ! length of an optional one that is handed on.)
  subroutine read_material(solver, material, name, reflectance, emission, flags, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(in) :: material
    character(len=:), allocatable, intent(inout) :: name
    real(c_double), contiguous, intent(inout), target, optional :: reflectance(:), emission(:)
    integer(c_int32_t), intent(inout), optional :: flags
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable :: buffer(:)
    type(c_ptr) :: reflectance_address, emission_address
    integer(c_int64_t) :: bands, patches, materials, needed
    integer(c_int32_t) :: index, found_flags, code
    if (lacks_bands(solver, bands, status)) return
    if (lacks_size(solver, patches, materials, status)) return
    if (out_of_range("hrad_get_material", "materials", material, 1_c_int64_t, materials, &
      status)) return
    reflectance_address = c_null_ptr
    if (present(reflectance)) then
      if (misshapen("hrad_get_material", "reflectance", shape(reflectance, c_int64_t), [bands], &
        status)) return
      reflectance_address = c_loc(reflectance)
    end if
    emission_address = c_null_ptr
    if (present(emission)) then
      if (misshapen("hrad_get_material", "emission", shape(emission, c_int64_t), [bands], &
        status)) return
      emission_address = c_loc(emission)
    end if
    index = int(material - 1, c_int32_t)
    allocate (buffer(1))
    needed = 0
    found_flags = 0
    code = c_get_material(handle_of(solver), index, buffer, 0_c_int64_t, needed, c_null_ptr, &
      c_null_ptr, found_flags)
    if (code == HRAD_OK) then
      deallocate (buffer)
      allocate (buffer(needed))
      code = c_get_material(handle_of(solver), index, buffer, needed, needed, &
        reflectance_address, emission_address, found_flags)
    end if
    if (code == HRAD_OK) then
      name = text_of_buffer(buffer)
      if (present(flags)) flags = found_flags
    end if
    call finish(code, status)
  end subroutine read_material

  ! Loads an OBJ file with its MTL files and adds it to what is there; needs bands = 1 or 3. Errors:
  ! FILE; SCENE with file:line; STATE after hrad_partition; MEMORY. Nothing is added then.
  subroutine hrad_load_scene(solver, path, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_load_scene", "path", path, status)) return
    call finish(c_load_scene(handle_of(solver), c_text(path)), status)
  end subroutine hrad_load_scene

  ! Makes a built-in scene in an empty solver: see hrad_scene_name. Errors: ARGUMENT for an unknown
  ! name (the message lists all); STATE if there are patches already.
  subroutine hrad_make_scene(solver, name, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_make_scene", "name", name, status)) return
    call finish(c_make_scene(handle_of(solver), c_text(name)), status)
  end subroutine hrad_make_scene

  function scene_name_32(index) result(name)
    integer(c_int32_t), intent(in) :: index
    character(len=:), allocatable :: name
    name = scene_name_64(int(index, c_int64_t))
  end function scene_name_32

  function scene_name_64(index) result(name)
    integer(c_int64_t), intent(in) :: index
    character(len=:), allocatable :: name
    name = fortran_text(c_scene_name(from_zero(index)))
  end function scene_name_64

  subroutine get_diagnostic_32(solver, index, text, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: index
    character(len=:), allocatable, intent(inout) :: text
    integer(c_int32_t), intent(out), optional :: status
    call get_diagnostic_64(solver, int(index, c_int64_t), text, status)
  end subroutine get_diagnostic_32

  subroutine get_diagnostic_64(solver, index, text, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(in) :: index
    character(len=:), allocatable, intent(inout) :: text
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable :: buffer(:)
    integer(c_int64_t) :: needed
    integer(c_int32_t) :: code
    allocate (buffer(1))
    needed = 0
    code = c_get_diagnostic(handle_of(solver), from_zero(index), buffer, 0_c_int64_t, needed)
    if (code == HRAD_OK) then
      deallocate (buffer)
      allocate (buffer(needed))
      code = c_get_diagnostic(handle_of(solver), from_zero(index), buffer, needed, needed)
    end if
    if (code == HRAD_OK) text = text_of_buffer(buffer)
    call finish(code, status)
  end subroutine get_diagnostic_64
end module hrad_scenes
