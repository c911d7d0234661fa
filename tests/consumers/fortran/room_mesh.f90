! The mesh of the heated room: triangles with the number of the face they belong to. The room's
! faces look inward, the heater's outward.
module room_mesh
  implicit none
  private
  public :: mesh, furnished_mesh

  ! Numbers of faces.
  integer, parameter, public :: heater = 1, ground = 2, ceiling = 3, faces = 7

  type :: mesh
    double precision, allocatable :: xyz(:, :) ! (3, vertices), m
    integer, allocatable :: vertex(:, :)       ! (3, triangles), from 1
    integer, allocatable :: face(:)            ! (triangles)
  end type mesh

  double precision, parameter :: size_x = 5, size_y = 4, size_z = 2.5d0 ! of the room, m

contains

  ! The room, and a heater by its wall x = 0.
  function furnished_mesh() result(room)
    type(mesh) :: room
    allocate (room%xyz(3, 0), room%vertex(3, 0), room%face(0))
    call add_box(room, [0d0, 0d0, 0d0], [size_x, size_y, size_z], .true.)
    call add_box(room, [0.1d0, 1.2d0, 0.15d0], [0.2d0, 2.8d0, 0.75d0], .false.)
  end function furnished_mesh

  ! A box: a room of six faces that look inward, or a heater, whose one face looks outward on all
  ! sides.
  subroutine add_box(room, lower, upper, inward)
    type(mesh), intent(inout) :: room
    double precision, intent(in) :: lower(3), upper(3)
    logical, intent(in) :: inward
    double precision :: x(3), y(3), z(3)
    integer :: n
    x = [upper(1) - lower(1), 0d0, 0d0]
    y = [0d0, upper(2) - lower(2), 0d0]
    z = [0d0, 0d0, upper(3) - lower(3)]
    n = merge(6, 2, inward)
    if (inward) then
      call add_face(room, lower, x, y, n, ground)
      call add_face(room, upper, -y, -x, n, ceiling)
      call add_face(room, lower, y, z, n, 4)
      call add_face(room, upper, -z, -y, n, 5)
      call add_face(room, lower, z, x, n, 6)
      call add_face(room, upper, -x, -z, n, 7)
    else
      call add_face(room, lower, y, x, n, heater)
      call add_face(room, upper, -x, -y, n, heater)
      call add_face(room, lower, z, y, n, heater)
      call add_face(room, upper, -y, -z, n, heater)
      call add_face(room, lower, x, z, n, heater)
      call add_face(room, upper, -z, -x, n, heater)
    end if
  end subroutine add_box

  ! A rectangle of n by n cells, two triangles each, from a corner along two edges; it looks where
  ! edge_1 x edge_2 points.
  subroutine add_face(room, corner, edge_1, edge_2, n, number)
    type(mesh), intent(inout) :: room
    double precision, intent(in) :: corner(3), edge_1(3), edge_2(3)
    integer, intent(in) :: n, number
    double precision :: xyz(3, 0:n, 0:n)
    integer :: vertex(3, 2, n, n), i, j, first
    first = size(room%xyz, 2) + 1
    do j = 0, n
      do i = 0, n
        xyz(:, i, j) = corner + edge_1 * i / n + edge_2 * j / n
      end do
    end do
    do j = 1, n
      do i = 1, n
        vertex(:, 1, i, j) = [node(i - 1, j - 1), node(i, j - 1), node(i, j)]
        vertex(:, 2, i, j) = [node(i - 1, j - 1), node(i, j), node(i - 1, j)]
      end do
    end do
    room%xyz = reshape([room%xyz, xyz], [3, size(room%xyz, 2) + size(xyz) / 3])
    room%vertex = reshape([room%vertex, vertex], [3, size(room%vertex, 2) + size(vertex) / 3])
    room%face = [room%face, spread(number, 1, 2 * n * n)]

  contains

    integer function node(i, j)
      integer, intent(in) :: i, j
      node = first + i + (n + 1) * j
    end function node
  end subroutine add_face
end module room_mesh
