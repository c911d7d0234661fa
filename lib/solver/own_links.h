// The links of one owner out of those of all. Floor 8 (solver).
#pragma once

#include "stages/exchange.h"
#include "stages/state.h"

namespace hrad {

// Drops the links of other owners' receivers and what goes with them, of a state that has all.
void keep_own_links(State& state, const Exchange& exchange, ThreadTeam& team);

}  // namespace hrad
