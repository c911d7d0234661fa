! A room whose lamp is dimmed, over several processes, as `mpirun -n 2 dimmed_room`: rank 0
! describes the room by arrays, all ranks solve it together. The first step solves with refinement,
! the others sweep over its mesh and links alone. The solution is left in dimmed_room.hrad, and each
! rank measures its own rows of a plane 0.8 m above the floor. Rank 0 prints a row a step, its
! number and the irradiance of the floor in W/m2, all bands together, and at last the mean of the
! plane.
program dimmed_room
  use mpi
  use hrad
  use hrad_mpi
  implicit none
  integer, parameter :: bands = 3, steps = 3, columns = 8, rows = 6
  double precision, parameter :: glow(bands) = [100d0, 100d0, 90d0] ! of the lamp at first, W/m2
  type(hrad_solver) :: solver
  integer :: level, error, rank, ranks, step, status

  call mpi_init_thread(MPI_THREAD_FUNNELED, level, error)
  call mpi_comm_rank(MPI_COMM_WORLD, rank, error)
  call mpi_comm_size(MPI_COMM_WORLD, ranks, error)

  ! All ranks make the same calls. Without a status an error ends the program with its message.
  call hrad_create_mpi(MPI_COMM_WORLD, solver)
  call hrad_set_double(solver, "accuracy", 0.05d0)
  call describe_room()
  do step = 1, steps
    if (step > 1) call dim_lamp(0.5d0**(step - 1))
    call hrad_solve(solver, status)
    if (status < 0) error stop "the solve failed"
    if (status == HRAD_NOT_CONVERGED .and. rank == 0) print "(a)", "the accuracy is not assured"
    call hrad_set_int(solver, "refine", 0)
    call report_floor()
  end do
  call hrad_write_checkpoint(solver, "dimmed_room.hrad")
  call measure_plane()
  call hrad_destroy(solver)
  call mpi_finalize(error)

contains

  ! A room of 4 x 3 x 2.5 m, its walls looking inside: patches 1 to 12, of which 1 and 2 are the
  ! floor; and a square lamp of 0.6 m under the ceiling: patches 13 and 14. Arrays count on rank 0,
  ! the others hand over empty ones.
  subroutine describe_room()
    type(hrad_material) :: wall, lamp
    integer :: white, bright
    double precision :: xyz(3, 12)
    integer :: vertex(3, 14)
    wall%name = "wall"
    wall%reflectance = [0.7d0, 0.7d0, 0.65d0]
    call hrad_add_material(solver, wall, white)
    lamp%name = "lamp"
    lamp%emission = glow
    call hrad_add_material(solver, lamp, bright)
    if (rank == 0) then
      xyz = reshape([0d0, 0d0, 0d0, 4d0, 0d0, 0d0, 4d0, 3d0, 0d0, 0d0, 3d0, 0d0, &
        0d0, 0d0, 2.5d0, 4d0, 0d0, 2.5d0, 4d0, 3d0, 2.5d0, 0d0, 3d0, 2.5d0, &
        1.7d0, 1.2d0, 2.45d0, 1.7d0, 1.8d0, 2.45d0, 2.3d0, 1.8d0, 2.45d0, 2.3d0, 1.2d0, 2.45d0], &
        shape(xyz))
      vertex = reshape([1, 2, 3, 1, 3, 4, 5, 8, 7, 5, 7, 6, 1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, &
        3, 7, 8, 3, 8, 4, 4, 8, 5, 4, 5, 1, 9, 10, 11, 9, 11, 12], shape(vertex))
      call hrad_add_patches(solver, xyz, vertex, [spread(white, 1, 12), spread(bright, 1, 2)])
    else
      call hrad_add_patches(solver, xyz(:, :0), vertex(:, :0))
    end if
  end subroutine describe_room

  subroutine dim_lamp(factor)
    double precision, intent(in) :: factor
    double precision :: emission(bands, 2)
    emission = factor * spread(glow, 2, 2)
    if (rank == 0) then
      call hrad_set_emission(solver, 13, emission)
    else
      call hrad_set_emission(solver, 13, emission(:, :0))
    end if
  end subroutine dim_lamp

  ! A query answers every rank what it asks for itself.
  subroutine report_floor()
    double precision :: irradiance(bands, 2)
    call hrad_query_patches(solver, HRAD_IRRADIANCE, HRAD_FRONT, 1, irradiance)
    if (rank == 0) print "(i2, f10.4)", step, sum(irradiance) / 2
  end subroutine report_floor

  subroutine measure_plane()
    double precision, allocatable :: xyz(:, :), up(:, :), irradiance(:, :)
    double precision :: own, whole
    integer :: column, row, point
    point = columns * size([(row, row=rank + 1, rows, ranks)])
    allocate (xyz(3, point), up(3, point), irradiance(bands, point))
    point = 0
    do row = rank + 1, rows, ranks
      do column = 1, columns
        point = point + 1
        xyz(:, point) = [(column - 0.5d0) * 4 / columns, (row - 0.5d0) * 3 / rows, 0.8d0]
      end do
    end do
    up = spread([0d0, 0d0, 1d0], 2, point)
    call hrad_query_sensors(solver, xyz, up, irradiance)
    own = sum(irradiance)
    call mpi_reduce(own, whole, 1, MPI_DOUBLE_PRECISION, MPI_SUM, 0, MPI_COMM_WORLD, error)
    if (rank == 0) print "(a, f8.4, a, i0, a)", "plane: mean ", whole / (columns * rows), &
      " W/m2, measured by ", ranks, " ranks"
  end subroutine measure_plane
end program dimmed_room
