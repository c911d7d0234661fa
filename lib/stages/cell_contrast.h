// Where reflected light is uneven: how much the rows of neighbouring cells differ.
// Floor 7 (stages).
#pragma once

#include <vector>

#include "hierarchy/corner_names.h"
#include "stages/state.h"

namespace hrad {

// Per cell the error that a step between its neighbours would leave in it, in units of the scene's
// mean irradiance: a share of the largest difference between rows of cells that touch it within its
// plane. A step keeps its height when cells are divided, a slope gets flatter, so that only steps
// are followed far down. Right for this process's own cells alone. names: of state.forest.
std::vector<float> contrast_of_cells(const State& state, const Brightness& brightness,
                                     const CornerNames& names, ThreadTeam& team,
                                     const Exchange& exchange);

}  // namespace hrad
