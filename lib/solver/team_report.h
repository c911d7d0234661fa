// Which threads each process starts, told to the user, and a warning where those of one node are more
// than its processors (paper, Section 3.2). Floor 8 (solver).
#pragma once

#include "base/log.h"
#include "machine/comm.h"
#include "machine/topology.h"

namespace hrad {

// Collective. Rank 0 is told of every process and warned of every node, the others are warned of
// their own node.
void report_teams(Comm& comm, const Topology& topology, const PoolPlan& plan, const Log& log);

}  // namespace hrad
