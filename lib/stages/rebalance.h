// Surfaces dealt out anew by what they have been found to cost (the paper's Section 3.1 leaves the
// rest independent of how patches are dealt out). Moves links between owners, and changes nothing
// of the result. Floor 7 (stages).
#pragma once

#include <vector>

#include "stages/exchange.h"

namespace hrad {

// Collective; before a round of refinement. work: that of each of this process's own surfaces, in
// any unit, as it is expected to be. A clock may have told it, as it decides no bit of the result.
void rebalance(State& state, ThreadTeam& team, Exchange& exchange, std::vector<double> work);

// What is expected where nothing has been measured: the links of each of this process's surfaces.
std::vector<double> links_of_surfaces(const State& state, const Exchange& exchange);

}  // namespace hrad
