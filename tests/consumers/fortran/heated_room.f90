! A heated room, as a finite-element program would compute it: the mesh of its surfaces is made of
! arrays, and in every time step the temperatures give the emission, hrad the net fluxes, and these
! the temperatures of the next step. The first step solves with refinement, the others sweep over
! its mesh and links alone.
!
! Emission is that above the room's first temperature, sigma*(T**4 - T0**4): in a closed room of one
! temperature nothing flows, so that only differences count. It prints a row a step: its number; the
! heater's temperature in K; the net flux in W that leaves the heater, floor, ceiling and the four
! walls; what the fluxes of all patches miss of balance, and what the library's own balance misses,
! in W; and the mean temperature of the floor in K.
program heated_room
  use hrad
  use room_mesh
  implicit none

  double precision, parameter :: sigma = 5.670374419d-8 ! Stefan-Boltzmann, W/m2/K4
  double precision, parameter :: start = 291            ! K, everywhere
  double precision, parameter :: heating = 12           ! K that the heater gains a step
  double precision, parameter :: time_step = 300        ! s
  double precision, parameter :: capacity = 2d4         ! J/m2/K, of floor, ceiling and walls
  double precision, parameter :: emissivity = 0.9d0
  integer, parameter :: steps = 6

  type(hrad_solver) :: solver
  type(mesh) :: room
  double precision, allocatable :: temperature(:), area(:), emission(:, :), flux(:, :)
  double precision :: face_flux(faces), imbalance, own_imbalance, emitted(1), absorbed(1), &
    absorbed_back(1), escaped(1)
  logical, allocatable :: is_heater(:)
  integer :: step, face, patches

  room = furnished_mesh()
  patches = size(room%vertex, 2)
  allocate (temperature(patches), area(patches), emission(1, patches), flux(1, patches), &
    is_heater(patches))
  is_heater = room%face == heater
  temperature = start

  call create_solver()
  do step = 1, steps
    where (is_heater) temperature = start + heating * step
    emission(1, :) = emissivity * sigma * max(temperature**4 - start**4, 0d0)
    call hrad_set_emission(solver, 1, emission)
    call hrad_solve(solver)
    call hrad_set_int(solver, "refine", 0)
    call hrad_query_patches(solver, HRAD_NET_FLUX, HRAD_FRONT, 1, flux)
    call report()
    where (.not. is_heater) temperature = temperature - time_step / capacity * flux(1, :)
  end do
  call hrad_destroy(solver)
  deallocate (temperature, area, emission, flux, is_heater)

contains

  ! Hands the mesh over. All surfaces are of one material; the reflectance is what is not absorbed,
  ! and emissivity is absorptance.
  subroutine create_solver()
    type(hrad_material) :: paint
    type(hrad_patch) :: patch
    integer :: i, number
    call hrad_create(solver)
    call hrad_set_int(solver, "bands", 1)
    call hrad_set_double(solver, "accuracy", 0.05d0)
    paint%name = "paint"
    paint%reflectance = [1 - emissivity]
    call hrad_add_material(solver, paint, number)
    call hrad_add_patches(solver, room%xyz, room%vertex, spread(number, 1, patches))
    do i = 1, patches
      call hrad_get_patch(solver, i, patch)
      area(i) = patch%area
    end do
  end subroutine create_solver

  subroutine report()
    do face = 1, faces
      face_flux(face) = sum(area * flux(1, :), room%face == face)
    end do
    call hrad_power_balance(solver, emitted, absorbed, absorbed_back, escaped)
    own_imbalance = emitted(1) - absorbed(1) - absorbed_back(1) - escaped(1)
    imbalance = sum(face_flux)
    print "(i2, f7.1, 7f10.3, 2es11.3, f10.4)", step, start + heating * step, face_flux, &
      imbalance, own_imbalance, &
      sum(area * temperature, room%face == ground) / sum(area, room%face == ground)
  end subroutine report
end program heated_room
