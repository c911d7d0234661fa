// The Linking Stage (paper, Section 2): the first links, between patches that see each other, with
// form factor and visibility; each reciprocal pair is computed once. Floor 7 (stages).
#pragma once

#include "stages/state.h"

namespace hrad {

// Fills state.links (of the roots). False: stopped by tools.progress; the state is as before.
bool link_pairs(State& state, const StageTools& tools, const Brightness& brightness);

}  // namespace hrad
