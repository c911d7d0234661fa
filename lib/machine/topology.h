// What hwloc sees of this node, and the pool that follows from it: cores or SMT contexts of this
// process's own cpuset (paper, Section 3.2 and 4: two packages, four cores, two contexts a core).
// Floor 2 (machine). The one file that includes hwloc.h is topology.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hrad {

struct Topology {
  int packages = 0, numa_nodes = 0, cores = 0, contexts = 0;  // of the whole machine
  int usable_cores = 0, usable_contexts = 0;                  // of this process's cpuset
  bool synthetic = false;  // not this machine: threads must not be bound
  // For every usable core the operating-system numbers of its usable contexts, in logical order.
  std::vector<std::vector<int>> core_contexts;
};

// Reads this machine (HWLOC_SYNTHETIC and HWLOC_XMLFILE of the environment are honoured as hwloc
// does). Never fails: a machine that can't be read is one core.
Topology read_topology();

struct PoolPlan {
  int threads = 1;
  std::vector<std::vector<int>> binding;  // per worker, empty when not bound
  std::string reason;                     // one sentence: why this many
};

// threads: 0 = from the topology; smt: also use a core's further contexts; bind: pin workers.
PoolPlan plan_pool(const Topology& topology, int64_t threads, bool smt, bool bind);

// `name: value` lines for `hrad machine` and hrad_describe_machine.
std::string describe(const Topology& topology, const PoolPlan& plan);

}  // namespace hrad
