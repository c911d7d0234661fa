// The sparse product, block by block of receivers. Floor 7 (stages).
#include "stages/gather.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "stages/sweep_kernels.h"

namespace hrad {
namespace {

static_assert(State::floats_beyond >= most_lanes, "the last source is read beyond its own");

// Any number of bands. value_at(link.source): in State::radiosity.
template <class ValueAt>
void gather_run(Span<const Link> links, const State& state, const ValueAt& value_at, float* out) {
  double sum[most_bands] = {};
  for (const Link& link : links) {
    const float* source = &state.radiosity[value_at(link.source)];
    for (int band = 0; band < state.bands; ++band)
      sum[band] += static_cast<double>(link.weight) * source[band];
  }
  for (int band = 0; band < state.bands; ++band) out[band] = static_cast<float>(sum[band]);
}

void gather_run(Span<const Link> links, const State& state, float* out) {
  gather_run(
      links, state, [&](NodeId source) { return state.values_before(source); }, out);
}

// Adds what arrives over some runs of one block of receivers, those that wait or the others, whose
// sources are places.
void add_runs(State& state, const LinkTable::Block& block, NodeId first_receiver,
              const OwnRuns::Runs* waits, bool wanted) {
  uint32_t receivers[LinkTable::receivers_of_a_block];
  size_t runs = 0;
  block.has_links.for_each([&](size_t k) {
    receivers[runs++] =
        static_cast<uint32_t>(state.places[first_receiver + static_cast<NodeId>(k)]);
  });
  const bool by_kernel = state.bands >= 2 && state.bands <= most_lanes;
  const size_t bands = static_cast<size_t>(state.bands);
  for (size_t run = 0; run < runs;) {
    const size_t begin = run;
    const bool kind = waits && (*waits)[run];
    while (run < runs && (!waits || (*waits)[run] == kind)) ++run;
    if (kind != wanted) continue;
    uint32_t first = begin > 0 ? block.ends[begin - 1] : 0;
    if (by_kernel) {
      sweep_kernels()[0]->gather({block.links.data(), block.ends.back(), first, &block.ends[begin],
                                  receivers + begin, run - begin},
                                 state.radiosity.data(), state.bands, state.irradiance.data());
      continue;
    }
    for (size_t k = begin; k < run; first = block.ends[k++]) {
      float light[most_bands];
      gather_run(
          {block.links.data() + first, block.ends[k] - first}, state,
          [&](NodeId place) { return static_cast<size_t>(place) * bands; }, light);
      float* const out = &state.irradiance[receivers[k] * bands];
      for (size_t b = 0; b < bands; ++b) out[b] += light[b];
    }
  }
}

size_t first_of_block(size_t number) { return number * LinkTable::receivers_of_a_block; }

void set_to_nothing(State& state, size_t number) {
  const size_t first = first_of_block(number), bands = static_cast<size_t>(state.bands);
  const auto set = [&](size_t, size_t place, size_t count) {
    if (place < state.places.end_of_own())
      std::fill_n(&state.irradiance[place * bands], count * bands, 0.0f);
  };
  state.places.for_each_stretch(first, first + state.links.block(number).has_links.size(), set);
}

// waits: of both tables, nullptr: no run does.
void add_block(State& state, size_t number, const std::array<OwnRuns::Runs, 2>* waits,
               bool wanted) {
  const LinkTable* const tables[] = {&state.links, &state.direct.mean};
  for (size_t t = 0; t < 2; ++t)
    if (number < tables[t]->block_count())
      add_runs(state, tables[t]->block(number), static_cast<NodeId>(first_of_block(number)),
               waits ? &(*waits)[t] : nullptr, wanted);
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

void gather(State& state, ThreadTeam& team) {
  team.for_each(static_cast<int64_t>(state.links.block_count()), [&](int64_t task, int) {
    const size_t number = static_cast<size_t>(task);
    set_to_nothing(state, number);
    add_block(state, number, nullptr, false);
  });
}

void gather_what_is_here(State& state, ThreadTeam& team, const OwnRuns& runs,
                         const Exchange& exchange) {
  if (runs.all()) return gather(state, team);
  const auto add = [&](int64_t task, int) {
    const OwnRuns::Block& block = runs.blocks()[static_cast<size_t>(task)];
    set_to_nothing(state, block.number);
    add_block(state, block.number, &block.waits, false);
  };
  team.for_each(static_cast<int64_t>(runs.blocks().size()), add, [&](int64_t) {
    exchange.make_progress();
    return true;
  });
}

// Each receiver has at most two runs, so that their order changes no bit.
void gather_what_has_come(State& state, ThreadTeam& team, const OwnRuns& runs) {
  team.for_each(static_cast<int64_t>(runs.blocks().size()), [&](int64_t task, int) {
    const OwnRuns::Block& block = runs.blocks()[static_cast<size_t>(task)];
    if (block.any_waits()) add_block(state, block.number, &block.waits, true);
  });
}

}  // namespace hrad
