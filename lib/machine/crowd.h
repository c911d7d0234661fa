// Processes of one node that would start their threads on the same processors. Floor 2 (machine).
#pragma once

#include "machine/comm.h"
#include "machine/topology.h"

namespace hrad {

// Collective. How many processes, this one among them, may run on any of the processors that this
// one may run on. A process's own topology alone says which those are.
int sharers_of_processors(Comm& comm, const Topology& topology);

}  // namespace hrad
