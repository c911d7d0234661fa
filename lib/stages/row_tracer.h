// Rows of rays: an element's hemisphere, sampled by rays that are form factor and visibility at
// once, so that the weights of a closed scene sum to one (design: `rows`). Floor 7 (stages).
#pragma once

#include <vector>

#include "links/light_grid.h"
#include "stages/bright_spots.h"
#include "stages/rows.h"
#include "stages/state_memory.h"

namespace hrad {

// Gives these cells their rows of so many rays each, state.links[cell]: cosine-distributed rays
// from the exposed part, spread evenly over it and its hemisphere. Each is a link to the leaf that
// it meets, of weight 1/rays; one that meets nothing, a blocker, a black back, or an emitter whose
// light comes by links of its own, is none. False: stopped.
bool trace_rows(State& state, const StageTools& tools, const RowSettings& settings,
                const LightGrid& grid, const BrightSpots& spots, const std::vector<NodeId>& cells,
                const std::vector<int>& rays_of_cell, StageMemory& memory);

}  // namespace hrad
