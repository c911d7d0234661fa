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
  bool synthetic = false;               // not this machine: threads must not be bound
  bool caller_confined = false;         // the calling thread may use less than its process
  std::string source = "this machine";  // or "synthetic", "recorded": what hwloc was told to read
  // For every usable core the operating-system numbers of its usable contexts, in logical order.
  std::vector<std::vector<int>> core_contexts;
};

// Reads this machine (HWLOC_SYNTHETIC and HWLOC_XMLFILE of the environment are honoured as hwloc
// does). Never fails: a machine that can't be read is one core.
Topology read_topology();

// A machine that is not here, for tests and planning: hwloc's synthetic description, or the XML
// text or file that lstopo wrote elsewhere. Usable is what that topology allows. Throws
// Error(argument) where hwloc can't read it.
enum class TopologyKind { synthetic, xml, xml_file };
Topology read_topology_from(TopologyKind kind, const std::string& text);

struct PoolPlan {
  int threads = 1;
  // Per worker, as ThreadTeam takes it; empty when not bound. Where the caller is confined to less
  // than its process (as by OMP_PROC_BIND), workers that are not to be pinned get the whole of the
  // process's processors instead of inheriting the caller's.
  std::vector<std::vector<int>> binding;
  bool pinned = false;  // binding keeps each worker to its own core or context
  int sharers = 1;
  std::string reason;  // one sentence: why this many
};

// threads: 0 = from the topology; smt: also use a core's further contexts; bind: pin workers;
// sharers: processes that divide these processors among themselves.
PoolPlan plan_pool(const Topology& topology, int64_t threads, bool smt, bool bind, int sharers = 1);

// `name: value` lines for `hrad machine` and hrad_describe_machine.
std::string describe(const Topology& topology, const PoolPlan& plan);

}  // namespace hrad
