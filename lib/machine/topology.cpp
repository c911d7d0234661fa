// What hwloc sees of this node and the size and binding of the pool (paper, Section 3.2: t threads
// per node, on cores or on their simultaneous contexts). Floor 2 (machine).
#include "machine/topology.h"

#include <hwloc.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <cstring>
#include <memory>
#include <type_traits>

#include "base/error.h"

namespace hrad {
namespace {

struct DestroyTopology {
  void operator()(hwloc_topology_t topology) const { hwloc_topology_destroy(topology); }
};
using TopologyHandle = std::unique_ptr<std::remove_pointer_t<hwloc_topology_t>, DestroyTopology>;

struct FreeBitmap {
  void operator()(hwloc_bitmap_t bitmap) const { hwloc_bitmap_free(bitmap); }
};
using Bitmap = std::unique_ptr<std::remove_pointer_t<hwloc_bitmap_t>, FreeBitmap>;

// Null where hwloc has no memory.
TopologyHandle new_topology() {
  hwloc_topology_t topology = nullptr;
  if (hwloc_topology_init(&topology) != 0) return nullptr;
  return TopologyHandle(topology);
}

// Where the system tells nothing of its processors, as in a container without /sys, hwloc's Linux
// part would write about that to standard error; the others count them without it.
void leave_out_what_sees_nothing(hwloc_topology_t topology) {
  for (const char* folder : {"/sys/bus/cpu/devices", "/sys/devices/system/cpu"})
    if (access(folder, R_OK | X_OK) == 0) return;
  hwloc_topology_set_components(topology, HWLOC_TOPOLOGY_COMPONENTS_FLAG_BLACKLIST, "linux");
}

// Loads the whole machine, including what the process may not use; the caller's binding stays.
bool load(hwloc_topology_t topology) {
  unsigned long flags = HWLOC_TOPOLOGY_FLAG_INCLUDE_DISALLOWED;
#if HWLOC_API_VERSION >= 0x00020500
  flags |= HWLOC_TOPOLOGY_FLAG_DONT_CHANGE_BINDING;
#endif
  return hwloc_topology_set_flags(topology, flags) == 0 && hwloc_topology_load(topology) == 0;
}

int count_objects(hwloc_topology_t topology, hwloc_obj_type_t type) {
  return std::max(0, hwloc_get_nbobjs_by_type(topology, type));
}

// Narrows usable to what the process is bound to; says whether its calling thread has still less.
// Where the system doesn't tell, nothing is narrowed.
bool narrow_to_process(hwloc_topology_t topology, hwloc_bitmap_t usable) {
  const Bitmap bound(hwloc_bitmap_alloc());
  if (!bound) return false;
  const auto narrow = [&](int what) {
    if (hwloc_get_cpubind(topology, bound.get(), what) != 0) return false;
    if (!hwloc_bitmap_intersects(bound.get(), usable)) return false;
    hwloc_bitmap_and(usable, usable, bound.get());
    return true;
  };
  if (!narrow(HWLOC_CPUBIND_PROCESS)) {
    narrow(HWLOC_CPUBIND_THREAD);
    return false;
  }
  return hwloc_get_cpubind(topology, bound.get(), HWLOC_CPUBIND_THREAD) == 0 &&
         !hwloc_bitmap_isincluded(usable, bound.get());
}

// Counts cores and contexts. A context without a core object above it is a core of its own.
void count_cores(hwloc_topology_t topology, hwloc_const_bitmap_t usable, Topology* result) {
  hwloc_obj_t last_core = nullptr, last_usable_core = nullptr;
  for (hwloc_obj_t context = nullptr;
       (context = hwloc_get_next_obj_by_type(topology, HWLOC_OBJ_PU, context)) != nullptr;) {
    hwloc_obj_t core = hwloc_get_ancestor_obj_by_type(topology, HWLOC_OBJ_CORE, context);
    if (!core) core = context;
    ++result->contexts;
    if (core != last_core) ++result->cores;
    last_core = core;
    if (!hwloc_bitmap_isset(usable, context->os_index)) continue;
    if (core != last_usable_core) result->core_contexts.emplace_back();
    last_usable_core = core;
    result->core_contexts.back().push_back(static_cast<int>(context->os_index));
    ++result->usable_contexts;
  }
  result->usable_cores = static_cast<int>(result->core_contexts.size());
}

// The origin that hwloc notes at the root of a topology that is not this machine.
std::string origin(hwloc_topology_t topology) {
  const char* backend = hwloc_obj_get_info_by_name(hwloc_get_root_obj(topology), "Backend");
  return backend && std::strcmp(backend, "Synthetic") == 0 ? "synthetic" : "recorded";
}

Topology examine(hwloc_topology_t topology) {
  Topology result;
  result.packages = count_objects(topology, HWLOC_OBJ_PACKAGE);
  result.numa_nodes = count_objects(topology, HWLOC_OBJ_NUMANODE);
  const Bitmap usable(hwloc_bitmap_dup(hwloc_topology_get_allowed_cpuset(topology)));
  if (!usable) fail(Status::memory, "no memory to read the machine's topology");
  result.synthetic = !hwloc_topology_is_thissystem(topology);
  if (result.synthetic)
    result.source = origin(topology);
  else
    result.caller_confined = narrow_to_process(topology, usable.get());
  count_cores(topology, usable.get(), &result);
  return result;
}

Topology one_core() {
  Topology result;
  result.packages = result.numa_nodes = result.cores = result.contexts = 1;
  result.usable_cores = result.usable_contexts = 1;
  result.source = "none, hwloc could not read this machine";
  return result;
}

// The usable contexts in the order in which workers fill them: the first context of every core,
// then the second ones.
std::vector<int> filling_order(const Topology& topology) {
  std::vector<int> order;
  for (size_t rank = 0; order.size() < static_cast<size_t>(topology.usable_contexts); ++rank)
    for (const std::vector<int>& contexts : topology.core_contexts)
      if (rank < contexts.size()) order.push_back(contexts[rank]);
  return order;
}

// Up to as many workers as cores: each its own core, spread evenly, so that caches and memory
// channels are shared by as few as possible. More: each its own context, in turns.
std::vector<std::vector<int>> pin(const Topology& topology, int threads) {
  std::vector<std::vector<int>> binding;
  const size_t cores = topology.core_contexts.size(), count = static_cast<size_t>(threads);
  binding.reserve(count);
  if (count <= cores) {
    for (size_t worker = 0; worker < count; ++worker)
      binding.push_back(topology.core_contexts[worker * cores / count]);
  } else {
    const std::vector<int> order = filling_order(topology);
    for (size_t worker = 0; worker < count; ++worker)
      binding.push_back({order[worker % order.size()]});
  }
  return binding;
}

std::string plural(int count, const char* noun) {
  return format("%d %s%s", count, noun, count == 1 ? "" : "s");
}

std::string explain(const Topology& topology, int threads, bool chosen, bool smt) {
  if (chosen) {
    std::string reason = plural(threads, "thread") + ", as asked for";
    if (threads > topology.usable_contexts)
      reason += format(", on only %s", plural(topology.usable_contexts, "usable context").c_str());
    return reason;
  }
  const int places = smt ? topology.usable_contexts : topology.usable_cores;
  const char* noun = smt ? "usable context" : "usable core";
  std::string reason = places > 1 ? "one thread for each of " + plural(places, noun)
                                  : format("one thread for the only %s", noun);
  if (topology.usable_contexts < topology.contexts)
    reason += format(" (this process may use %d of %s)", topology.usable_contexts,
                     plural(topology.contexts, "context").c_str());
  return reason;
}

}  // namespace

Topology read_topology() {
  const TopologyHandle topology = new_topology();
  if (topology) leave_out_what_sees_nothing(topology.get());
  if (!topology || !load(topology.get())) return one_core();
  Topology result = examine(topology.get());
  return result.usable_cores > 0 ? result : one_core();
}

Topology read_topology_from(TopologyKind kind, const std::string& text) {
  const TopologyHandle topology = new_topology();
  if (!topology) fail(Status::memory, "no memory to read a topology");
  int set = -1;
  switch (kind) {
    case TopologyKind::synthetic:
      set = hwloc_topology_set_synthetic(topology.get(), text.c_str());
      break;
    case TopologyKind::xml:
      if (text.size() < INT_MAX)
        set = hwloc_topology_set_xmlbuffer(topology.get(), text.c_str(),
                                           static_cast<int>(text.size()) + 1);
      break;
    case TopologyKind::xml_file:
      set = hwloc_topology_set_xml(topology.get(), text.c_str());
      break;
  }
  if (set != 0 || !load(topology.get()))
    fail(Status::argument, "hwloc can't read the topology '%.60s'", text.c_str());
  Topology result = examine(topology.get());
  if (result.usable_cores == 0)
    fail(Status::argument, "the topology '%.60s' has no usable core", text.c_str());
  return result;
}

PoolPlan plan_pool(const Topology& topology, int64_t threads, bool smt, bool bind, int sharers) {
  PoolPlan plan;
  plan.sharers = sharers;
  const bool chosen = threads > 0;
  if (chosen)
    plan.threads = static_cast<int>(std::min<int64_t>(threads, INT_MAX));
  else
    plan.threads = std::max(1, (smt ? topology.usable_contexts : topology.usable_cores) / sharers);
  plan.reason = explain(topology, plan.threads, chosen, smt);
  if (sharers > 1)
    plan.reason += "; " + std::to_string(sharers) + " processes share these processors";

  if (topology.synthetic || topology.core_contexts.empty()) {
    if (bind) plan.reason += "; not pinned, because this is not the machine's own topology";
  } else if (bind && sharers == 1) {
    plan.binding = pin(topology, plan.threads);
    plan.pinned = true;
  } else if (topology.caller_confined) {
    plan.binding.assign(static_cast<size_t>(plan.threads), filling_order(topology));
  }
  return plan;
}

std::string describe(const Topology& topology, const PoolPlan& plan) {
  const char* binding = "none";
  if (plan.pinned)
    binding = plan.threads <= topology.usable_cores ? "a core each" : "a context each";
  else if (!plan.binding.empty())
    binding = "the process's processors";
  std::string text;
  const auto line = [&](const char* name, const std::string& value) {
    text += std::string(name) + ": " + value + "\n";
  };
  line("source", topology.source);
  line("packages", std::to_string(topology.packages));
  line("numa_nodes", std::to_string(topology.numa_nodes));
  line("cores", std::to_string(topology.cores));
  line("contexts", std::to_string(topology.contexts));
  line("usable_cores", std::to_string(topology.usable_cores));
  line("usable_contexts", std::to_string(topology.usable_contexts));
  line("threads", std::to_string(plan.threads));
  line("binding", binding);
  line("reason", plan.reason);
  line("hwloc", HWLOC_VERSION);
  return text;
}

}  // namespace hrad
