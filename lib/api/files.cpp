// hrad.h, section "files". Floor 9 (api).
#include "api/arguments.h"
#include "api/guard.h"

namespace {

[[noreturn]] void fail_checkpoint(const char* path) {
  hrad::api::require(path, "the path of the checkpoint");
  hrad::fail(hrad::Status::unsupported, "%s: checkpoints are not in this version (%s)", path,
             hrad_version_text());
}

}  // namespace

hrad_status hrad_write_checkpoint(hrad_solver* solver, const char* path) {
  return hrad::api::guarded(solver, [&](hrad::Solver&) { fail_checkpoint(path); });
}

hrad_status hrad_read_checkpoint(hrad_solver* solver, const char* path) {
  return hrad::api::guarded(solver, [&](hrad::Solver&) { fail_checkpoint(path); });
}

hrad_status hrad_export(const hrad_solver* solver, const char* path) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    hrad::api::require(path, "the path of the export");
    inside.export_file(path);
  });
}
