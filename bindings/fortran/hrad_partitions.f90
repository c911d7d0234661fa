! hrad.h, section "partition and machine". Ranks count from 0, as they do in MPI.
module hrad_partitions
  use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_int64_t, c_loc, c_null_ptr, c_ptr
  use hrad_c_setup, only: c_describe_machine, c_export_partition, c_partition, c_patch_owner, &
    c_plan_partition
  use hrad_checks, only: has_nul, lacks_size, misshapen, out_of_range
  use hrad_constants, only: HRAD_OK
  use hrad_errors, only: finish
  use hrad_text, only: c_text, text_of_buffer
  use hrad_types, only: handle_of, hrad_rank_load, hrad_solver
  implicit none
  private
  public :: hrad_partition, hrad_patch_owner, hrad_plan_partition, hrad_export_partition
  public :: hrad_describe_machine

  ! hrad_patch_owner(solver, patch, rank [, status]): the rank (from 0) that owns a patch (from 1;
  ! default integer or int64). Errors: ARGUMENT for a patch out of range, STATE before
  ! hrad_partition.
  interface hrad_patch_owner
    module procedure patch_owner_32, patch_owner_64
  end interface hrad_patch_owner

  ! hrad_plan_partition(solver, method, ranks [, owner] [, loads] [, status]) plans a partition for
  ! `ranks` ranks (default integer or int64) without starting them. method: "grid" or "cost".
  ! owner(patches): a rank (from 0) per patch; loads(ranks): loads(i) is that of rank i - 1. Closes
  ! the scene as hrad_partition does. Errors: those of hrad_partition; ARGUMENT for an unknown
  ! method, a wrong shape or ranks outside 1 .. HRAD_MOST_RANKS.
  interface hrad_plan_partition
    module procedure plan_partition_32, plan_partition_64
  end interface hrad_plan_partition

  ! hrad_export_partition(solver, method, ranks, path [, status]) writes such a plan as a .vtu file.
  ! Errors: those of hrad_plan_partition; FILE; ARGUMENT for another ending.
  interface hrad_export_partition
    module procedure export_partition_32, export_partition_64
  end interface hrad_export_partition

contains

  ! Closes the scene, builds the visibility structure and gives every patch an owner. Optional:
  ! hrad_solve does it. Errors: SCENE for a scene without patches, or too small, too large or too
  ! far from the origin; MEMORY.
  subroutine hrad_partition(solver, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(out), optional :: status
    call finish(c_partition(handle_of(solver)), status)
  end subroutine hrad_partition

  subroutine patch_owner_32(solver, patch, rank, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int32_t), intent(in) :: patch
    integer(c_int32_t), intent(inout) :: rank
    integer(c_int32_t), intent(out), optional :: status
    call patch_owner_64(solver, int(patch, c_int64_t), rank, status)
  end subroutine patch_owner_32

  subroutine patch_owner_64(solver, patch, rank, status)
    type(hrad_solver), intent(in) :: solver
    integer(c_int64_t), intent(in) :: patch
    integer(c_int32_t), intent(inout) :: rank
    integer(c_int32_t), intent(out), optional :: status
    integer(c_int64_t) :: patches, materials
    if (lacks_size(solver, patches, materials, status)) return
    if (out_of_range("hrad_patch_owner", "patches", patch, 1_c_int64_t, patches, status)) return
    call finish(c_patch_owner(handle_of(solver), patch - 1, rank), status)
  end subroutine patch_owner_64

  subroutine plan_partition_32(solver, method, ranks, owner, loads, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: method
    integer(c_int32_t), intent(in) :: ranks
    integer(c_int32_t), contiguous, intent(inout), target, optional :: owner(:)
    type(hrad_rank_load), contiguous, intent(inout), target, optional :: loads(:)
    integer(c_int32_t), intent(out), optional :: status
    type(hrad_rank_load) :: fresh
    type(c_ptr) :: owner_address, loads_address
    integer(c_int64_t) :: patches, materials
    if (lacks_size(solver, patches, materials, status)) return
    if (has_nul("hrad_plan_partition", "method", method, status)) return
    owner_address = c_null_ptr
    if (present(owner)) then
      if (misshapen("hrad_plan_partition", "owner", shape(owner, c_int64_t), [patches], &
        status)) return
      if (size(owner) > 0) owner_address = c_loc(owner)
    end if
    loads_address = c_null_ptr
    if (present(loads)) then
      if (misshapen("hrad_plan_partition", "loads", shape(loads, c_int64_t), &
        [int(max(ranks, 0_c_int32_t), c_int64_t)], status)) return
      loads%struct_size = fresh%struct_size
      if (size(loads) > 0) loads_address = c_loc(loads)
    end if
    call finish(c_plan_partition(handle_of(solver), c_text(method), ranks, owner_address, &
      loads_address), status)
  end subroutine plan_partition_32

  subroutine plan_partition_64(solver, method, ranks, owner, loads, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: method
    integer(c_int64_t), intent(in) :: ranks
    integer(c_int32_t), contiguous, intent(inout), target, optional :: owner(:)
    type(hrad_rank_load), contiguous, intent(inout), target, optional :: loads(:)
    integer(c_int32_t), intent(out), optional :: status
    call plan_partition_32(solver, method, int_32(ranks), owner, loads, status)
  end subroutine plan_partition_64

  subroutine export_partition_32(solver, method, ranks, path, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: method
    integer(c_int32_t), intent(in) :: ranks
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out), optional :: status
    if (has_nul("hrad_export_partition", "method", method, status)) return
    if (has_nul("hrad_export_partition", "path", path, status)) return
    call finish(c_export_partition(handle_of(solver), c_text(method), ranks, c_text(path)), status)
  end subroutine export_partition_32

  subroutine export_partition_64(solver, method, ranks, path, status)
    type(hrad_solver), intent(in) :: solver
    character(len=*), intent(in) :: method
    integer(c_int64_t), intent(in) :: ranks
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out), optional :: status
    call export_partition_32(solver, method, int_32(ranks), path, status)
  end subroutine export_partition_64

  ! What hwloc sees of this machine and the thread pool that this solver would start, one
  ! "name: value" a line. Works on an empty solver. Errors: ARGUMENT for an empty handle.
  subroutine hrad_describe_machine(solver, text, status)
    type(hrad_solver), intent(in) :: solver
    character(len=:), allocatable, intent(inout) :: text
    integer(c_int32_t), intent(out), optional :: status
    character(kind=c_char), allocatable :: buffer(:)
    integer(c_int64_t) :: needed
    integer(c_int32_t) :: code
    allocate (buffer(1))
    needed = 0
    code = c_describe_machine(handle_of(solver), buffer, 0_c_int64_t, needed)
    if (code == HRAD_OK) then
      deallocate (buffer)
      allocate (buffer(needed))
      code = c_describe_machine(handle_of(solver), buffer, needed, needed)
    end if
    if (code == HRAD_OK) text = text_of_buffer(buffer)
    call finish(code, status)
  end subroutine hrad_describe_machine

  ! A number of ranks as C takes it; what doesn't fit stays out of range.
  pure integer(c_int32_t) function int_32(ranks)
    integer(c_int64_t), intent(in) :: ranks
    int_32 = int(min(max(ranks, 0_c_int64_t), int(huge(int_32), c_int64_t)), c_int32_t)
  end function int_32
end module hrad_partitions
