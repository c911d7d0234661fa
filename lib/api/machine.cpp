// hrad.h, section "partition and machine". Floor 9 (api).
#include <algorithm>
#include <cstring>

#include "api/arguments.h"
#include "api/guard.h"
#include "solver/partition_plan.h"

namespace {

void require_ranks(const char* method, int32_t ranks) {
  hrad::api::require(method, "the name of the method");
  if (ranks < 1 || ranks > HRAD_MOST_RANKS)
    hrad::fail(hrad::Status::argument, "%d ranks: use 1 to %d", static_cast<int>(ranks),
               static_cast<int>(HRAD_MOST_RANKS));
}

// A plan before the partition makes that first, which all ranks do together; after it each may plan
// by itself.
template <class Body>
hrad_status of_a_plan(hrad_solver* solver, const Body& body) {
  if (solver && solver->solver.partitioned())
    return hrad::api::guarded(solver, [&](hrad::Solver& inside) { body(inside, false); });
  return hrad::api::collective(solver, [&](hrad::Solver& inside) { body(inside, true); });
}

}  // namespace

hrad_status hrad_partition(hrad_solver* solver) {
  return hrad::api::collective(solver, [](hrad::Solver& inside) { inside.partition(); });
}

hrad_status hrad_patch_owner(const hrad_solver* solver, int64_t patch, int32_t* rank) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    hrad::api::require(rank, "the place for the rank");
    hrad::api::require_range(patch, 1, inside.scene().patch_count(), "patches");
    *rank = inside.patch_owner(patch);
  });
}

hrad_status hrad_plan_partition(hrad_solver* solver, const char* method, int32_t ranks,
                                int32_t* owner, hrad_rank_load* loads) {
  return of_a_plan(solver, [&](hrad::Solver& inside, bool together) {
    require_ranks(method, ranks);
    if (loads) hrad::api::require_struct_size(loads->struct_size, "hrad_rank_load");
    const hrad::PartitionPlan plan = inside.plan_partition(method, ranks);
    if (together) inside.comm().all_go_on();
    if (owner) std::copy(plan.owners.begin(), plan.owners.end(), owner);
    if (!loads) return;
    // The caller's structs may be smaller than ours, or larger.
    const size_t stride = loads->struct_size;
    for (size_t rank = 0; rank < plan.loads.size(); ++rank) {
      const hrad::RankLoad& from = plan.loads[rank];
      hrad_rank_load load = {};
      load.patches = from.patches;
      load.work = from.work;
      for (int axis = 0; axis < 3 && from.patches > 0; ++axis) {
        load.lower[axis] = from.box.low[axis];
        load.upper[axis] = from.box.high[axis];
      }
      load.remote = plan.remote[rank];
      load.struct_size = stride;
      // A stride that no array of structs has may leave them misaligned.
      std::memcpy(reinterpret_cast<char*>(loads) + rank * stride, &load,
                  std::min(stride, sizeof load));
    }
  });
}

hrad_status hrad_export_partition(hrad_solver* solver, const char* method, int32_t ranks,
                                  const char* path) {
  return of_a_plan(solver, [&](hrad::Solver& inside, bool) {
    require_ranks(method, ranks);
    hrad::api::require(path, "the path of the partition");
    inside.export_partition(method, ranks, path);
  });
}

hrad_status hrad_describe_machine(const hrad_solver* solver, char* text, int64_t size,
                                  int64_t* needed) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    hrad::api::require_text_buffer(text, size);
    hrad::api::copy_text(inside.describe_machine(), text, size, needed);
  });
}
