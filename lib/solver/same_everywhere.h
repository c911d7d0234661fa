// Whether the ranks of a solver were told the same. Floor 8 (solver).
#pragma once

#include "machine/comm.h"
#include "scene/scene.h"
#include "solver/params.h"

namespace hrad {

// Collective. ARGUMENT, with the name of what differs, unless all ranks have the same result
// parameters, method of partition and scene.
void check_same_everywhere(Comm& comm, const Params& params, const Scene& scene);

}  // namespace hrad
