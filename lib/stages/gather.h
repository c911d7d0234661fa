// Gathering (paper, Section 2): the irradiance that arrives over each node's own links, one sparse
// product over frozen links. Floor 7 (stages).
#pragma once

#include "stages/state.h"

namespace hrad {

// Irradiance at a corner, straight from bright emitters: bands values.
void gather_corner(const State& state, size_t corner, float* irradiance);

// state.gathered = links x state.radiosity, in double precision and in the order of each run.
void gather(State& state, ThreadTeam& team);

}  // namespace hrad
