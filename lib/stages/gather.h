// Gathering (paper, Section 2): the irradiance that arrives over each node's own links, one sparse
// product over frozen links. Floor 7 (stages).
#pragma once

#include <vector>

#include "stages/state.h"

namespace hrad {

// What gathering needs beside the state, to be kept from sweep to sweep.
struct GatherSpace {
  std::vector<float> sources;    // radiosity as the inner loop reads it
  std::vector<uint32_t> blocks;  // of receivers to be gathered for; empty: all
};

int64_t bytes_of_gather_space(const State& state);

// Irradiance at a point of CornerLight, straight from bright emitters: bands values.
void gather_point(const State& state, size_t point, float* irradiance);

// Irradiance over a node's own links alone, without direct light: bands values.
void gather_links(const State& state, NodeId node, float* irradiance);

// Irradiance over a leaf straight from bright emitters: bands values.
void gather_direct(const State& state, NodeId leaf, float* irradiance);

// state.irradiance = links x state.radiosity, and at leaves the mean of their direct light, for
// push_pull() to spread: in double precision and in the order of each run.
void gather(State& state, ThreadTeam& team, GatherSpace& space);
void gather(State& state, ThreadTeam& team);

}  // namespace hrad
