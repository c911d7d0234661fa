// Gathering (paper, Section 2): the irradiance that arrives over each node's own links, one sparse
// product over frozen links. Floor 7 (stages).
#pragma once

#include "stages/own_runs.h"
#include "stages/state.h"

namespace hrad {

// Irradiance at a point of CornerLight, straight from bright emitters: bands values.
void gather_point(const State& state, size_t point, float* irradiance);

// Irradiance over a node's own links alone, without direct light: bands values.
void gather_links(const State& state, NodeId node, float* irradiance);

// Irradiance over a leaf straight from bright emitters: bands values.
void gather_direct(const State& state, NodeId leaf, float* irradiance);

// state.irradiance = links x state.radiosity, and at leaves the mean of their direct light, for
// push_pull() to spread: in double precision and in the order of each run. Of a process that is
// alone.
void gather(State& state, ThreadTeam& team);
// The same of a process's own runs, in two steps: of those that need no message, helping those
// under way along, and then of those that wait for them.
void gather_what_is_here(State& state, ThreadTeam& team, const OwnRuns& runs,
                         const Exchange& exchange);
void gather_what_has_come(State& state, ThreadTeam& team, const OwnRuns& runs);

}  // namespace hrad
