// The sparse product, block by block of receivers. Floor 7 (stages).
#include "stages/gather.h"

#include <algorithm>
#include <cstddef>

#include "stages/sweep_kernels.h"

namespace hrad {
namespace {

static_assert(State::floats_beyond >= most_lanes, "the last source is read beyond its own");

// Any number of bands.
void gather_run(Span<const Link> links, const State& state, float* out) {
  double sum[most_bands] = {};
  for (const Link& link : links) {
    const float* source = &state.radiosity[static_cast<size_t>(link.source) * state.bands];
    for (int band = 0; band < state.bands; ++band)
      sum[band] += static_cast<double>(link.weight) * source[band];
  }
  for (int band = 0; band < state.bands; ++band) out[band] = static_cast<float>(sum[band]);
}

// Adds what arrives over the links of one block of receivers.
void add_block(const State& state, const LinkTable::Block& block, float* out) {
  uint16_t receivers[LinkTable::receivers_of_a_block];
  size_t runs = 0;
  block.has_links.for_each([&](size_t k) { receivers[runs++] = static_cast<uint16_t>(k); });
  if (state.bands >= 2 && state.bands <= most_lanes) {
    sweep_kernels()[0]->gather(block.links.data(), block.ends.data(), receivers, runs,
                               state.radiosity.data(), state.bands, out);
    return;
  }
  const size_t bands = static_cast<size_t>(state.bands);
  for (size_t run = 0, first = 0; run < runs; first = block.ends[run++]) {
    float light[most_bands];
    gather_run({block.links.data() + first, block.ends[run] - first}, state, light);
    for (size_t b = 0; b < bands; ++b) out[receivers[run] * bands + b] += light[b];
  }
}

}  // namespace

void gather_point(const State& state, size_t point, float* irradiance) {
  const CornerLight& direct = state.direct;
  gather_run({direct.links.data() + direct.first[point],
              static_cast<size_t>(direct.first[point + 1] - direct.first[point])},
             state, irradiance);
}

void gather_links(const State& state, NodeId node, float* irradiance) {
  gather_run(state.links[node].links(), state, irradiance);
}

void gather_direct(const State& state, NodeId leaf, float* irradiance) {
  gather_run(state.direct.mean[leaf].links(), state, irradiance);
}

void gather(State& state, ThreadTeam& team, const std::vector<uint32_t>& blocks) {
  const size_t bands = static_cast<size_t>(state.bands);
  const size_t count = blocks.empty() ? state.links.block_count() : blocks.size();
  team.for_each(static_cast<int64_t>(count), [&](int64_t task, int) {
    const size_t at = static_cast<size_t>(task);
    const size_t number = blocks.empty() ? at : blocks[at];
    const LinkTable::Block& block = state.links.block(number);
    const size_t first = number * LinkTable::receivers_of_a_block * bands;
    float* const out = &state.irradiance[first];
    std::fill(out, out + block.has_links.size() * bands, 0.0f);
    add_block(state, block, out);
    if (number < state.direct.mean.block_count())
      add_block(state, state.direct.mean.block(number), out);
  });
}

}  // namespace hrad
