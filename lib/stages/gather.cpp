// The sparse product, block by block of receivers. Floor 7 (stages).
#include "stages/gather.h"

#include <algorithm>
#include <cstddef>

#include "machine/pieces.h"
#include "stages/gather_kernel.h"

namespace hrad {
namespace {

constexpr size_t items_of_a_task = 2048;

bool by_lanes(int bands) { return bands >= 2 && bands <= lanes_of_a_source; }

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

void gather_runs(const State& state, const GatherSpace& space, const Link* links,
                 const uint32_t* first, size_t runs, uint32_t end, float* out) {
  if (by_lanes(state.bands)) {
    gather_kernels()[0](links, first, runs, end, space.sources.data(), state.bands, out);
    return;
  }
  for (size_t k = 0; k < runs; ++k) {
    const uint32_t last = k + 1 < runs ? first[k + 1] : end;
    gather_run({links + first[k], last - first[k]}, state,
               out + k * static_cast<size_t>(state.bands));
  }
}

void lay_out_sources(const State& state, ThreadTeam& team, GatherSpace& space) {
  if (!by_lanes(state.bands)) return;
  const size_t bands = static_cast<size_t>(state.bands), nodes = state.forest.nodes.size();
  space.sources.resize(nodes * bands + lanes_of_a_source);
  for_each_piece(
      team, nodes,
      [&](size_t, size_t begin, size_t end) {
        std::copy(state.radiosity.begin() + static_cast<std::ptrdiff_t>(begin * bands),
                  state.radiosity.begin() + static_cast<std::ptrdiff_t>(end * bands),
                  space.sources.begin() + static_cast<std::ptrdiff_t>(begin * bands));
      },
      items_of_a_task);
}

// Adds the direct light of one block's leaves.
void add_direct_light(const State& state, const GatherSpace& space, size_t block, float* out) {
  const LinkTable::Block direct = state.direct.mean.block(block);
  const size_t values = direct.receivers * static_cast<size_t>(state.bands);
  float light[LinkTable::receivers_of_a_block * most_bands];
  gather_runs(state, space, direct.links, direct.first, direct.receivers, direct.end, light);
  for (size_t k = 0; k < values; ++k) out[k] += light[k];
}

}  // namespace

int64_t bytes_of_gather_space(const State& state) {
  if (!by_lanes(state.bands)) return 0;
  return static_cast<int64_t>(state.forest.nodes.size() * static_cast<size_t>(state.bands) *
                              sizeof(float));
}

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

void gather(State& state, ThreadTeam& team, GatherSpace& space) {
  lay_out_sources(state, team, space);
  const size_t bands = static_cast<size_t>(state.bands);
  const size_t count = space.blocks.empty() ? state.links.block_count() : space.blocks.size();
  team.for_each(static_cast<int64_t>(count), [&](int64_t task, int) {
    const size_t at = static_cast<size_t>(task);
    const size_t number = space.blocks.empty() ? at : space.blocks[at];
    const LinkTable::Block block = state.links.block(number);
    float* const out = &state.irradiance[block.receiver * bands];
    gather_runs(state, space, block.links, block.first, block.receivers, block.end, out);
    if (number < state.direct.mean.block_count()) add_direct_light(state, space, number, out);
  });
}

void gather(State& state, ThreadTeam& team) {
  GatherSpace space;
  gather(state, team, space);
}

}  // namespace hrad
