// hrad.h, section "partition and machine". Floor 9 (api).
#include "api/arguments.h"
#include "api/guard.h"

hrad_status hrad_partition(hrad_solver* solver) {
  return hrad::api::guarded(solver, [](hrad::Solver& inside) { inside.partition(); });
}

hrad_status hrad_patch_owner(const hrad_solver* solver, int64_t patch, int32_t* rank) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    hrad::api::require(rank, "the place for the rank");
    hrad::api::require_range(patch, 1, inside.scene().patch_count(), "patches");
    *rank = inside.patch_owner(patch);
  });
}

hrad_status hrad_describe_machine(const hrad_solver* solver, char* text, int64_t size,
                                  int64_t* needed) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    hrad::api::require_text_buffer(text, size);
    hrad::api::copy_text(inside.describe_machine(), text, size, needed);
  });
}
