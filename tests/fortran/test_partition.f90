! Partitions and the machine: owners and plans with numbers from 1 for patches and from 0 for ranks.
program test_partition
  use, intrinsic :: iso_fortran_env, only: int64
  use check
  use hrad
  implicit none
  type(hrad_solver) :: solver
  call hrad_create(solver)
  call hrad_make_scene(solver, "cornell")
  call owners()
  call plans()
  call machine()
  call hrad_destroy(solver)
  call finish_checks()

contains

  subroutine owners()
    integer :: rank, status
    rank = -1
    call hrad_patch_owner(solver, 36, rank, status)
    call expect(status == HRAD_ERROR_STATE .and. rank == -1, "no owners before hrad_partition")
    call hrad_partition(solver, status)
    call expect_ok(status, "hrad_partition")
    call hrad_patch_owner(solver, 36, rank, status)
    call expect_ok(status, "hrad_patch_owner")
    call expect(rank == 0, "the only rank owns the last patch")
    call hrad_patch_owner(solver, 37_int64, rank, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "from 1 to 36", "the owner of patch 37")
  end subroutine owners

  subroutine plans()
    type(hrad_rank_load) :: loads(3), few(2)
    integer :: owner(36), every_other(72), status, rank
    call hrad_plan_partition(solver, "cost", 3, owner, loads, status)
    call expect_ok(status, "hrad_plan_partition")
    call expect(minval(owner) == 0 .and. maxval(owner) == 2, "ranks count from 0")
    do rank = 0, 2
      call expect(loads(rank + 1)%patches == count(owner == rank), "loads(i) is that of rank i - 1")
      call expect(loads(rank + 1)%work > 0 .and. all(loads(rank + 1)%lower <= &
        loads(rank + 1)%upper) .and. loads(rank + 1)%remote > 0, "a load has its fields")
    end do
    every_other = -1
    call hrad_plan_partition(solver, "cost", 3_int64, every_other(1::2))
    call expect(all(every_other(1::2) == owner) .and. all(every_other(2::2) == -1), "a section")
    call hrad_plan_partition(solver, "grid", 2, loads=few, status=status)
    call expect_ok(status, "loads alone")
    call expect(sum(few%patches) == 36, "both have all patches")
    call hrad_plan_partition(solver, "cost", 3, owner, few, status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "loads has the shape (2)", "2 places, 3 ranks")
    call hrad_plan_partition(solver, "cost", 3, owner(1:35), status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "owner has the shape (35)", "35 of 36 owners")
    call hrad_plan_partition(solver, "lots", 3, owner, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "lots", "an unknown method")
    call hrad_plan_partition(solver, "cost", HRAD_MOST_RANKS + 1_int64, owner, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "65537", "too many ranks")
    call hrad_plan_partition(solver, "cost", -1, owner, status=status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "ranks", "-1 ranks")
    call hrad_export_partition(solver, "grid", 2, "fortran_partition.vtu", status)
    call expect_ok(status, "hrad_export_partition")
    call hrad_export_partition(solver, "grid", 2_int64, "fortran_partition.xyz", status)
    call expect_fails(status, HRAD_ERROR_ARGUMENT, "fortran_partition.xyz", "an unknown ending")
  end subroutine plans

  subroutine machine()
    character(len=:), allocatable :: text
    integer :: status
    call hrad_describe_machine(solver, text, status)
    call expect_ok(status, "hrad_describe_machine")
    call expect(index(text, "cores") > 0 .and. index(text, achar(10)) > 0, "lines on the cores")
  end subroutine machine
end program test_partition
