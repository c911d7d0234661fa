! The module that programs use: all of hrad.h for Fortran 2008, under the names of C. hrad.h is the
! manual of what the functions do; the procedures' own heads tell shapes, units and errors. A whole
! program:
!
!   program heat
!     use hrad
!     implicit none
!     type(hrad_solver) :: solver
!     double precision, dimension(3) :: power, front, back
!     integer :: status
!     call hrad_create(solver)
!     call hrad_make_scene(solver, "cornell")
!     call hrad_set_double(solver, "accuracy", 0.05d0)
!     call hrad_solve(solver, status)
!     if (status < 0) error stop
!     call hrad_power_balance(solver, emitted=power, absorbed=front, absorbed_back=back)
!     print "(2(a, f8.3), a)", "emitted", power(1), " W, absorbed", front(1) + back(1), " W"
!     call hrad_destroy(solver)
!   end program heat
!
! STATUS is the last argument of everything that can fail and may be left out: an error then stops
! the program (error stop 1) with the message on error_unit. Positive statuses are no errors. After
! an error outputs are untouched. hrad_error_message() tells what happened.
!
! NUMBERS of patches, vertices, materials, faces, leaves and of the rows of tables count from 1 (the
! C library's messages, and files, count from 0); 0 is none of them. Ranks count from 0, as in MPI.
! Counts, indices and values may be default integers or int64; flags, levels, quantities, sides and
! statuses are default integers. Counts that an array tells are no arguments.
!
! ARRAYS are assumed-shape, of double precision: values(bands, count), xyz(3, count), vertex(3,
! triangles), uv(2, count), corners_xyz(3, 3, count). A wrong shape is HRAD_ERROR_ARGUMENT. Sections
! that are not contiguous are copied.
!
! RANKS: collective, to be called by all ranks in the same order, is what hrad.h marks [C]: all but
! hrad_scene_name, hrad_scene_size, hrad_patch_owner, hrad_get_patch, _material, _diagnostic, _int,
! _double and _text, hrad_describe_param, _machine and _checkpoint, hrad_set_log, hrad_set_progress
! and hrad_request_stop, and what asks for no solver. Arrays of a scene, and of emission and
! reflectance, count on rank 0: others may hand over (3, 0), (bands, 0). A query answers every rank
! what it asks for itself, also for 0 values. A wrong shape is found before the call: the rank that
! has it makes no call, and the others wait for it; without `status` it ends the job.
!
! TEXT: trailing blanks of arguments are dropped; results have the length that they need.
!
! CALLBACKS are module procedures with the interface hrad_log_procedure or hrad_progress_procedure.
! A context of any type is handed on to them. They must not call procedures of the solver that
! called them, except hrad_request_stop, and hrad_write_checkpoint in the progress callback.
!
! OTHER COMPILERS: compile the sources in the order hrad_constants, hrad_types, hrad_text,
! hrad_errors, hrad_c_setup, hrad_c_results, hrad_checks, then the others, and this one last; with
! OpenMP switched on when several threads of a program call the binding. The status is an
! integer(c_int32_t), the default integer unless an option changes that.
module hrad
  use hrad_constants
  use hrad_creation, only: hrad_create, hrad_destroy, hrad_set_log
  use hrad_errors, only: hrad_error_message, hrad_status_name, hrad_version, hrad_version_text
  use hrad_files, only: hrad_describe_checkpoint, hrad_export, hrad_lock_checkpoint, &
    hrad_read_checkpoint, hrad_write_checkpoint
  use hrad_leaves, only: hrad_leaf_count, hrad_query_leaves
  use hrad_parameters, only: hrad_describe_param, hrad_get_double, hrad_get_int, hrad_get_text, &
    hrad_set_double, hrad_set_int, hrad_set_text
  use hrad_partitions, only: hrad_describe_machine, hrad_export_partition, hrad_partition, &
    hrad_patch_owner, hrad_plan_partition
  use hrad_patches, only: hrad_add_patches, hrad_get_patch, hrad_scene_size, hrad_set_emission, &
    hrad_set_reflectance
  use hrad_queries, only: hrad_power_balance, hrad_query_patches, hrad_query_points, &
    hrad_query_sensors
  use hrad_scenes, only: hrad_add_material, hrad_get_diagnostic, hrad_get_material, &
    hrad_load_scene, hrad_make_scene, hrad_scene_name
  use hrad_solving, only: hrad_get_stats, hrad_request_stop, hrad_set_progress, hrad_solve, &
    hrad_state_hash
  use hrad_types, only: hrad_log_procedure, hrad_material, hrad_param, hrad_patch, &
    hrad_progress, hrad_progress_procedure, hrad_rank_load, hrad_solver, hrad_stats
  implicit none
  public
end module hrad
