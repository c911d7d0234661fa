// How much of elements is exposed, measured by one process each. Floor 7 (stages).
#pragma once

#include <vector>

#include "stages/state.h"

namespace hrad {

// Collective: all give the same elements. False: stopped, and nothing has changed.
bool measure_exposure(State& state, const StageTools& tools, const std::vector<NodeId>& elements);

}  // namespace hrad
