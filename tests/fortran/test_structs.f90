! The derived types lie in memory as the structs of hrad.h do: values written in Fortran are read by
! C's declarations.
program test_structs
  use, intrinsic :: iso_c_binding, only: c_int64_t, c_sizeof
  use check
  use hrad
  use reference
  implicit none
  type(hrad_patch) :: patch
  type(hrad_rank_load) :: load
  type(hrad_stats) :: stats
  double precision :: patch_fields(13), load_fields(9), stats_fields(33)
  integer(c_int64_t) :: sizes(3)
  integer :: i

  call reference_sizes(sizes)
  call expect(patch%struct_size == sizes(1) .and. c_sizeof(patch) == sizes(1), "hrad_patch's size")
  call expect(load%struct_size == sizes(2) .and. c_sizeof(load) == sizes(2), "hrad_rank_load's")
  call expect(stats%struct_size == sizes(3) .and. c_sizeof(stats) == sizes(3), "hrad_stats's size")

  patch%corners_xyz = reshape([(dble(i), i=1, 9)], [3, 3])
  patch%area = 10
  patch%face = 11
  patch%material = 12
  patch%flags = 13

  load = hrad_rank_load(patches=1, work=2d0, lower=[3d0, 4d0, 5d0], upper=[6d0, 7d0, 8d0], &
    remote=9d0)

  stats = hrad_stats(converged=1, ranks=2, threads=3, up_axis=4, rounds=5, iterations=6, &
    patches=7, elements=8, leaves=9, links=10, rays=11, pairs=12, area=13d0, sealed_area=14d0, &
    back_share=15d0, error_estimate=16d0, error_standard_error=17d0, seconds_load=18d0, &
    seconds_initial=19d0, seconds_linking=20d0, seconds_iterative=21d0, seconds_output=22d0, &
    cpu_seconds=23d0, memory_peak_bytes=24, link_bytes=25, node_bytes=26, &
    messages=[27_c_int64_t, 28_c_int64_t, 29_c_int64_t], &
    message_bytes=[30_c_int64_t, 31_c_int64_t, 32_c_int64_t], swept_links=33)

  call reference_take_apart(patch, load, stats, patch_fields, load_fields, stats_fields)
  call expect(all(patch_fields == [(dble(i), i=1, 13)]), "the fields of hrad_patch")
  call expect(all(load_fields == [(dble(i), i=1, 9)]), "the fields of hrad_rank_load")
  call expect(all(stats_fields == [(dble(i), i=1, 33)]), "the fields of hrad_stats")
  call finish_checks()
end program test_structs
