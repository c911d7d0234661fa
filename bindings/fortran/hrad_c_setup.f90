! The C functions of hrad.h that lead up to a solve, as C declares them: log, create, parameters,
! load, partition. For the modules of the binding alone; arrays that may be NULL are addresses.
module hrad_c_setup
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, &
    c_null_ptr, c_ptr, c_size_t
  use hrad_types, only: hrad_patch
  implicit none
  public

  ! struct hrad_param
  type, bind(c) :: c_param
    integer(c_size_t) :: struct_size = 72
    type(c_ptr) :: name = c_null_ptr
    integer(c_int32_t) :: type = 0
    integer(c_int32_t) :: is_result = 0
    type(c_ptr) :: default_text = c_null_ptr
    real(c_double) :: minimum = 0
    real(c_double) :: maximum = 0
    type(c_ptr) :: choices = c_null_ptr
    type(c_ptr) :: unit = c_null_ptr
    type(c_ptr) :: help = c_null_ptr
  end type c_param

  ! struct hrad_material
  type, bind(c) :: c_material
    integer(c_size_t) :: struct_size = 40
    type(c_ptr) :: reflectance = c_null_ptr
    type(c_ptr) :: emission = c_null_ptr
    integer(c_int32_t) :: flags = 0
    type(c_ptr) :: name = c_null_ptr
  end type c_material

  interface
    function c_set_log(solver, function, user, level) bind(c, name="hrad_set_log") result(status)
      import :: c_funptr, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      type(c_funptr), value :: function
      type(c_ptr), value :: user
      integer(c_int32_t), value :: level
      integer(c_int32_t) :: status
    end function c_set_log

    function c_create(solver) bind(c, name="hrad_create") result(status)
      import :: c_int32_t, c_ptr
      type(c_ptr), intent(inout) :: solver
      integer(c_int32_t) :: status
    end function c_create

    subroutine c_destroy(solver) bind(c, name="hrad_destroy")
      import :: c_ptr
      type(c_ptr), intent(inout) :: solver
    end subroutine c_destroy

    function c_set_int(solver, name, value) bind(c, name="hrad_set_int") result(status)
      import :: c_char, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: value
      integer(c_int32_t) :: status
    end function c_set_int

    function c_set_double(solver, name, value) bind(c, name="hrad_set_double") result(status)
      import :: c_char, c_double, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), value :: value
      integer(c_int32_t) :: status
    end function c_set_double

    function c_set_text(solver, name, value) bind(c, name="hrad_set_text") result(status)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: name(*), value(*)
      integer(c_int32_t) :: status
    end function c_set_text

    function c_get_int(solver, name, value) bind(c, name="hrad_get_int") result(status)
      import :: c_char, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), intent(inout) :: value
      integer(c_int32_t) :: status
    end function c_get_int

    function c_get_double(solver, name, value) bind(c, name="hrad_get_double") result(status)
      import :: c_char, c_double, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(inout) :: value
      integer(c_int32_t) :: status
    end function c_get_double

    function c_get_text(solver, name, text, size, needed) &
      bind(c, name="hrad_get_text") result(status)
      import :: c_char, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: name(*)
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: size
      integer(c_int64_t), intent(inout) :: needed
      integer(c_int32_t) :: status
    end function c_get_text

    function c_describe_param(index, param) bind(c, name="hrad_describe_param") result(status)
      import :: c_int32_t, c_int64_t, c_param
      integer(c_int64_t), value :: index
      type(c_param), intent(inout) :: param
      integer(c_int32_t) :: status
    end function c_describe_param

    function c_add_material(solver, material, number) &
      bind(c, name="hrad_add_material") result(status)
      import :: c_int32_t, c_material, c_ptr
      type(c_ptr), value :: solver
      type(c_material), intent(in) :: material
      integer(c_int32_t), intent(inout) :: number
      integer(c_int32_t) :: status
    end function c_add_material

    function c_add_patches(solver, n_vertices, xyz, n_triangles, vertex, material) &
      bind(c, name="hrad_add_patches") result(status)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: n_vertices
      real(c_double), intent(in) :: xyz(*)
      integer(c_int64_t), value :: n_triangles
      integer(c_int64_t), intent(in) :: vertex(*)
      type(c_ptr), value :: material
      integer(c_int32_t) :: status
    end function c_add_patches

    function c_load_scene(solver, path) bind(c, name="hrad_load_scene") result(status)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_load_scene

    function c_make_scene(solver, name) bind(c, name="hrad_make_scene") result(status)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t) :: status
    end function c_make_scene

    function c_scene_name(index) bind(c, name="hrad_scene_name") result(text)
      import :: c_int64_t, c_ptr
      integer(c_int64_t), value :: index
      type(c_ptr) :: text
    end function c_scene_name

    function c_scene_size(solver, patches, materials) bind(c, name="hrad_scene_size") result(status)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), intent(inout) :: patches, materials
      integer(c_int32_t) :: status
    end function c_scene_size

    function c_get_patch(solver, patch, out) bind(c, name="hrad_get_patch") result(status)
      import :: c_int32_t, c_int64_t, c_ptr, hrad_patch
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: patch
      type(hrad_patch), intent(inout) :: out
      integer(c_int32_t) :: status
    end function c_get_patch

    function c_get_material(solver, material, name, size, needed, reflectance, emission, flags) &
      bind(c, name="hrad_get_material") result(status)
      import :: c_char, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int32_t), value :: material
      character(kind=c_char), intent(inout) :: name(*)
      integer(c_int64_t), value :: size
      integer(c_int64_t), intent(inout) :: needed
      type(c_ptr), value :: reflectance, emission
      integer(c_int32_t), intent(inout) :: flags
      integer(c_int32_t) :: status
    end function c_get_material

    function c_get_diagnostic(solver, index, text, size, needed) &
      bind(c, name="hrad_get_diagnostic") result(status)
      import :: c_char, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: index
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: size
      integer(c_int64_t), intent(inout) :: needed
      integer(c_int32_t) :: status
    end function c_get_diagnostic

    function c_set_emission(solver, first_patch, count, emission) &
      bind(c, name="hrad_set_emission") result(status)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: first_patch, count
      real(c_double), intent(in) :: emission(*)
      integer(c_int32_t) :: status
    end function c_set_emission

    function c_set_reflectance(solver, first_patch, count, reflectance) &
      bind(c, name="hrad_set_reflectance") result(status)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: first_patch, count
      real(c_double), intent(in) :: reflectance(*)
      integer(c_int32_t) :: status
    end function c_set_reflectance

    function c_partition(solver) bind(c, name="hrad_partition") result(status)
      import :: c_int32_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int32_t) :: status
    end function c_partition

    function c_patch_owner(solver, patch, rank) bind(c, name="hrad_patch_owner") result(status)
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      integer(c_int64_t), value :: patch
      integer(c_int32_t), intent(inout) :: rank
      integer(c_int32_t) :: status
    end function c_patch_owner

    function c_plan_partition(solver, method, ranks, owner, loads) &
      bind(c, name="hrad_plan_partition") result(status)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: method(*)
      integer(c_int32_t), value :: ranks
      type(c_ptr), value :: owner, loads
      integer(c_int32_t) :: status
    end function c_plan_partition

    function c_export_partition(solver, method, ranks, path) &
      bind(c, name="hrad_export_partition") result(status)
      import :: c_char, c_int32_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(in) :: method(*)
      integer(c_int32_t), value :: ranks
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_export_partition

    function c_describe_machine(solver, text, size, needed) &
      bind(c, name="hrad_describe_machine") result(status)
      import :: c_char, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: solver
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: size
      integer(c_int64_t), intent(inout) :: needed
      integer(c_int32_t) :: status
    end function c_describe_machine
  end interface
end module hrad_c_setup
