! A program that leaves out the status of a call that fails: by the library when its argument is
! "library", by the binding otherwise. test_error_stop.sh runs it.
program stop_without_status
  use hrad
  implicit none
  type(hrad_solver) :: solver
  double precision :: xyz(2, 3)
  character(len=10) :: who
  call get_command_argument(1, who)
  call hrad_create(solver)
  xyz = 0
  if (who == "library") call hrad_make_scene(solver, "no such scene")
  if (who /= "library") call hrad_add_patches(solver, xyz, reshape([1, 2, 3], [3, 1]))
  print "(a)", "went on"
end program stop_without_status
