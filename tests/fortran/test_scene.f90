! Scenes: materials and patches from arrays, wrong shapes and indices, files, built-in scenes.
program test_scene
  use, intrinsic :: iso_fortran_env, only: int64
  use check
  use hrad
  implicit none
  call materials()
  call patches_of_both_kinds()
  call wrong_shapes()
  call wrong_indices()
  call light_of_patches()
  call built_in()
  call files()
  call finish_checks()

contains

  subroutine materials()
    type(hrad_solver) :: solver
    type(hrad_material) :: material
    character(len=:), allocatable :: name
    double precision :: reflectance(2), emission(2), wide(3)
    integer :: number, flags, status
    integer(int64) :: long
    call hrad_create(solver)
    call hrad_set_int(solver, "bands", 2)
    call hrad_add_material(solver, material, number)
    call expect(number == 1, "the first material is number 1")
    material = hrad_material(reflectance=[0.25d0, 0.75d0], emission=[1d0, 2d0], &
      flags=HRAD_TWO_SIDED, name="glowing  ")
    call hrad_add_material(solver, material, long, status)
    call expect_ok(status, "hrad_add_material")
    call expect(long == 2, "the second is number 2")
    call hrad_add_material(solver, material, status=status)
    call expect_ok(status, "without a number")
    call hrad_get_material(solver, 2, name, reflectance, emission, flags, status)
    call expect_ok(status, "hrad_get_material")
    call expect(name == "glowing" .and. len(name) == 7, "the name without its blanks")
    call expect(all(reflectance == [0.25d0, 0.75d0]) .and. all(emission == [1d0, 2d0]) .and. &
      flags == HRAD_TWO_SIDED, "the material as it was")
    call hrad_get_material(solver, 1_int64, name, reflectance, flags=flags)
    call expect(name == "" .and. all(reflectance == 0.5d0) .and. flags == 0, "the default one")
    call hrad_get_material(solver, 4, name, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "from 1 to 3", "a material that isn't there")
    call hrad_get_material(solver, 0, name, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "from 1 to 3", "material 0")
    call hrad_get_material(solver, 1, reflectance=wide, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "reflectance has the shape (3)", "3 of 2 bands")
    call hrad_get_material(solver, 1, emission=wide, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "emission has the shape (3)", "3 of 2 bands")
    material%reflectance = [0.5d0]
    call hrad_add_material(solver, material, number, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "it needs (2)", "1 of 2 bands")
    material%reflectance = [0.5d0, 1d0]
    call hrad_add_material(solver, material, number, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "1", "a reflectance of 1")
    material%reflectance = [0.5d0, 0.5d0]
    material%emission = [0d0, 0d0, 0d0]
    call hrad_add_material(solver, material, number, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "emission", "3 of 2 bands")
    call hrad_destroy(solver)
  end subroutine materials

  ! Triangles with indices and material numbers of either kind; the patch that was meant comes back.
  subroutine patches_of_both_kinds()
    type(hrad_solver) :: solver
    type(hrad_material) :: material
    type(hrad_patch) :: patch
    double precision :: xyz(3, 4), wide(6, 4)
    integer :: vertex(3, 2), number, patches, status
    integer(int64) :: materials
    xyz = reshape([double precision :: 0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0], [3, 4])
    vertex = reshape([1, 2, 3, 1, 3, 4], [3, 2])
    wide = 0
    wide(1:5:2, :) = xyz
    call hrad_create(solver)
    call hrad_add_material(solver, material, number)
    call hrad_add_patches(solver, xyz, vertex)
    material%flags = HRAD_BLOCKER
    call hrad_add_material(solver, material, number)
    call hrad_add_patches(solver, xyz, vertex, [2, 1])
    call hrad_add_patches(solver, xyz, vertex, [2_int64, 1_int64])
    call hrad_add_patches(solver, xyz, int(vertex, int64), [2, 1])
    call hrad_add_patches(solver, xyz, int(vertex, int64), [2_int64, 1_int64])
    call hrad_add_patches(solver, wide(1:5:2, :), vertex(:, 2:2), status=status)
    call expect_ok(status, "sections")
    call hrad_scene_size(solver, patches, materials)
    call expect(patches == 11 .and. materials == 2, "11 patches, 2 materials")
    call hrad_get_patch(solver, 3, patch)
    call expect(patch%material == 2 .and. iand(patch%flags, HRAD_PATCH_BLOCKER) /= 0, "a blocker")
    call hrad_get_patch(solver, 2_int64, patch, status)
    call expect_ok(status, "hrad_get_patch")
    call expect(all(patch%corners_xyz == xyz(:, vertex(:, 2))) .and. patch%area == 3 .and. &
      patch%face == 2 .and. patch%material == 1 .and. patch%flags == 0, "patch 2")
    call hrad_get_patch(solver, 11, patch)
    call expect(all(patch%corners_xyz == xyz(:, vertex(:, 2))), "the patch from a section")
    call hrad_get_patch(solver, 12, patch, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "from 1 to 11", "patch 12")
    call hrad_get_patch(solver, 0, patch, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "from 1 to 11", "patch 0")
    call hrad_get_patch(solver, -huge(1_int64) - 1, patch, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "from 1 to 11", "the smallest number")
    call hrad_destroy(solver)
  end subroutine patches_of_both_kinds

  subroutine wrong_shapes()
    type(hrad_solver) :: solver
    double precision :: xyz(3, 3)
    integer :: status, patches, materials
    integer(int64) :: many
    xyz = reshape([double precision :: 0, 0, 0, 1, 0, 0, 0, 1, 0], [3, 3])
    call hrad_create(solver)
    call hrad_add_patches(solver, xyz(1:2, :), reshape([1, 2, 3], [3, 1]), status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "xyz has the shape (2, 3)", "xyz(2, 3)")
    call hrad_add_patches(solver, xyz, reshape([1, 2, 3, 1], [4, 1]), status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "vertex has the shape (4, 1)", "vertex(4, 1)")
    call hrad_add_patches(solver, xyz, reshape([1, 2, 3], [3, 1]), [1, 1], status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "material has the shape (2)", "material(2)")
    call hrad_scene_size(solver, many, materials)
    call expect(many == 0 .and. materials == 0, "nothing was added")
    call hrad_add_patches(solver, xyz(:, 1:0), reshape([integer ::], [3, 0]), status=status)
    call expect_ok(status, "no patches at all")
    call hrad_add_patches(solver, xyz, reshape([1, 2, 3], [3, 1]))
    call hrad_scene_size(solver, patches)
    call hrad_scene_size(solver, materials=materials, status=status)
    call expect_ok(status, "hrad_scene_size")
    call hrad_scene_size(solver, patches, materials)
    call expect(patches == 1, "1 patch")
    call hrad_set_emission(solver, 1, reshape([1d0, 1d0], [2, 1]), status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "emission has the shape (2, 1)", "2 of 3 bands")
    call hrad_set_reflectance(solver, 1, reshape([0d0], [1, 1]), status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "reflectance has the shape (1, 1)", "1 of 3")
    call hrad_destroy(solver)
  end subroutine wrong_shapes

  subroutine wrong_indices()
    type(hrad_solver) :: solver
    double precision :: xyz(3, 3), light(3, 2)
    integer :: status
    xyz = reshape([double precision :: 0, 0, 0, 1, 0, 0, 0, 1, 0], [3, 3])
    light = 0
    call hrad_create(solver)
    call hrad_add_patches(solver, xyz, reshape([0, 1, 2], [3, 1]), status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "no vertex 0", "vertex 0")
    call hrad_add_patches(solver, xyz, reshape([1_int64, 2_int64, 4_int64], [3, 1]), status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "no vertex 4 (element 3)", "vertex 4 of 3")
    call hrad_add_patches(solver, xyz, reshape([1, 2, 3], [3, 1]), [1], status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "no material 1", "material 1 of none")
    call hrad_add_patches(solver, xyz, reshape([1, 2, 3], [3, 1]))
    call hrad_set_emission(solver, 0, light(:, 1:1), status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "from 0 on", "the emission of patch 0")
    call hrad_set_emission(solver, 1, light, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "2 patches from 1 on", "two of one patch")
    call hrad_set_reflectance(solver, huge(1_int64), light(:, 1:1), status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "count from 1 to 1", "the largest number")
    call hrad_set_emission(solver, 2, light(:, 1:0), status)
    call expect_ok(status, "no patches after the last")
    call hrad_destroy(solver)
  end subroutine wrong_indices

  ! Emission set and read back, from sections and to sections of arrays.
  subroutine light_of_patches()
    type(hrad_solver) :: solver
    double precision :: light(6, 4), found(6, 6)
    integer :: status, i
    light = reshape([(dble(i), i=1, 24)], [6, 4])
    found = -1
    call hrad_create(solver)
    call unit_room(solver, 0.5d0, 0)
    call hrad_set_emission(solver, 3_int64, light(1:6:2, 1:4:3), status)
    call expect_ok(status, "hrad_set_emission of a section")
    call hrad_set_reflectance(solver, 3, light(1:3, 1:2) / 100, status)
    call expect_ok(status, "hrad_set_reflectance")
    call hrad_query_patches(solver, HRAD_EMISSION, HRAD_FRONT, 2_int64, found(2:6:2, 1:5:2), status)
    call expect_ok(status, "hrad_query_patches into a section")
    call expect(all(found(2:6:2, 1) == 0) .and. all(found(2:6:2, 3) == light(1:6:2, 1)) .and. &
      all(found(2:6:2, 5) == light(1:6:2, 4)), "the section has the values")
    call expect(all(found(1:5:2, :) == -1) .and. all(found(:, 2:6:2) == -1), "and nothing else")
    call hrad_destroy(solver)
  end subroutine light_of_patches

  subroutine built_in()
    type(hrad_solver) :: solver
    character(len=:), allocatable :: name, text
    integer :: i, patches, status
    logical :: has_cornell
    has_cornell = .false.
    i = 1
    do
      name = hrad_scene_name(i)
      if (name == "") exit
      has_cornell = has_cornell .or. name == "cornell"
      i = i + 1
    end do
    call expect(has_cornell .and. i > 5, "built-in scenes have names")
    call expect(hrad_scene_name(0_int64) == "", "there is no scene 0")
    call hrad_create(solver)
    call hrad_make_scene(solver, "cornel", status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "furnace", "an unknown scene")
    call hrad_make_scene(solver, "cornell", status)
    call expect_ok(status, "hrad_make_scene")
    call hrad_scene_size(solver, patches)
    call expect(patches == 36, "cornell has 36 patches")
    call hrad_partition(solver, status)
    call expect_ok(status, "hrad_partition")
    text = "untouched"
    call hrad_get_diagnostic(solver, 1000, text, status)
    call expect(status == HRAD_ERROR_ARGUMENT .and. text == "untouched", "no such diagnostic")
    call hrad_destroy(solver)
  end subroutine built_in

  ! A scene written and read back; a file that isn't there; a scene with something to say.
  subroutine files()
    type(hrad_solver) :: solver, again
    character(len=:), allocatable :: text
    double precision :: xyz(3, 3)
    integer :: patches, status
    call hrad_create(solver)
    call hrad_make_scene(solver, "cornell")
    call hrad_export(solver, "fortran_scene.obj", status)
    call expect_ok(status, "hrad_export")
    call hrad_export(solver, "fortran_scene.xyz", status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "fortran_scene.xyz", "an unknown ending")
    call hrad_destroy(solver)
    call hrad_create(again)
    call hrad_load_scene(again, "no_such_file.obj", status)
    call expect_fails(status, HRAD_ERROR_FILE, "no_such_file.obj", "a missing file")
    call hrad_load_scene(again, "fortran_scene.obj   ", status)
    call expect_ok(status, "hrad_load_scene")
    xyz = 0
    call hrad_add_patches(again, xyz, reshape([1, 2, 3], [3, 1]))
    call hrad_scene_size(again, patches)
    call expect(patches == 37, "36 patches from the file and a dropped one")
    call hrad_get_diagnostic(again, 1, text, status)
    call expect_ok(status, "hrad_get_diagnostic")
    call expect(len(text) > 10, "a diagnostic says something")
    call hrad_get_diagnostic(again, 1_int64, text)
    call hrad_destroy(again)
  end subroutine files
end program test_scene
