// hrad.h, section "files". Floor 9 (api).
#include "api/arguments.h"
#include "api/guard.h"
#include "solver/checkpoint.h"

hrad_status hrad_write_checkpoint(hrad_solver* solver, const char* path) {
  // The progress function of this solver may call it: the solve stands still meanwhile.
  const bool from_progress =
      solver && solver->reporting && solver->reporting_thread == std::this_thread::get_id();
  if (from_progress)
    return hrad::api::guarded([&] {
      hrad::api::require(path, "the path of the checkpoint");
      solver->solver.write_checkpoint(path);
    });
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    hrad::api::require(path, "the path of the checkpoint");
    inside.write_checkpoint(path);
  });
}

hrad_status hrad_lock_checkpoint(hrad_solver* solver, const char* path) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    hrad::api::require(path, "the path of the checkpoint");
    inside.lock_checkpoint(path);
  });
}

hrad_status hrad_read_checkpoint(hrad_solver* solver, const char* path) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    hrad::api::require(path, "the path of the checkpoint");
    inside.read_checkpoint(path);
  });
}

hrad_status hrad_describe_checkpoint(const char* path, char* text, int64_t size, int64_t* needed) {
  return hrad::api::guarded([&] {
    hrad::api::require(path, "the path of the checkpoint");
    hrad::api::require_text_buffer(text, size);
    hrad::api::copy_text(hrad::describe_checkpoint(path), text, size, needed);
  });
}

hrad_status hrad_export(const hrad_solver* solver, const char* path) {
  return hrad::api::collective(solver, [&](const hrad::Solver& inside) {
    hrad::api::require(path, "the path of the export");
    inside.export_file(path);
  });
}
