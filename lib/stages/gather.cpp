// The sparse product, block by block of receivers. Floor 7 (stages).
#include "stages/gather.h"

#include <algorithm>
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

// Adds what arrives over some runs of these links, whose sources are places.
void add_runs(State& state, Span<const Link> links, Span<const GatherRun> runs) {
  if (state.bands >= 2 && state.bands <= most_lanes) {
    sweep_kernels()[0]->gather({links, runs}, state.radiosity.data(), state.bands,
                               state.irradiance.data());
    return;
  }
  const size_t bands = static_cast<size_t>(state.bands);
  for (const GatherRun& run : runs) {
    float light[most_bands];
    gather_run(
        links.subspan(run.first, run.end - run.first), state,
        [&](NodeId place) { return static_cast<size_t>(place) * bands; }, light);
    float* const out = &state.irradiance[run.receiver * bands];
    for (size_t b = 0; b < bands; ++b) out[b] += light[b];
  }
}

void set_to_nothing(State& state, size_t number) {
  const size_t first = number * LinkTable::receivers_of_a_block,
               bands = static_cast<size_t>(state.bands);
  const auto set = [&](size_t, size_t place, size_t count) {
    if (place < state.places.end_of_own())
      std::fill_n(&state.irradiance[place * bands], count * bands, 0.0f);
  };
  state.places.for_each_stretch(first, first + state.links.block(number).has_links.size(), set);
}

// A block of own runs, those that wait for messages or the others.
void add_own_runs(State& state, const OwnRuns::Block& block, bool waiting) {
  const LinkTable* const tables[] = {&state.links, &state.direct.mean};
  for (size_t t = 0; t < 2; ++t) {
    const Span<const GatherRun> runs = block.of_table(t, waiting);
    if (!runs.empty()) add_runs(state, tables[t]->block(block.number).links, runs);
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

void gather(State& state, ThreadTeam& team) {
  team.for_each(static_cast<int64_t>(state.links.block_count()), [&](int64_t task, int) {
    const size_t number = static_cast<size_t>(task);
    set_to_nothing(state, number);
    GatherRun runs[LinkTable::receivers_of_a_block];
    for (const LinkTable* table : {&state.links, &state.direct.mean}) {
      if (number >= table->block_count()) continue;
      const LinkTable::Block& block = table->block(number);
      add_runs(state, block.links, {runs, put_runs(state.places, block, number, runs)});
    }
  });
}

void gather_what_is_here(State& state, ThreadTeam& team, const OwnRuns& runs,
                         const Exchange& exchange) {
  if (runs.all()) return gather(state, team);
  const auto add = [&](int64_t task, int) {
    const OwnRuns::Block& block = runs.blocks()[static_cast<size_t>(task)];
    set_to_nothing(state, block.number);
    add_own_runs(state, block, false);
  };
  team.for_each(static_cast<int64_t>(runs.blocks().size()), add, [&](int64_t) {
    exchange.make_progress();
    return true;
  });
}

// Each receiver has at most two runs, so that their order changes no bit.
void gather_what_has_come(State& state, ThreadTeam& team, const OwnRuns& runs) {
  team.for_each(static_cast<int64_t>(runs.blocks().size()), [&](int64_t task, int) {
    add_own_runs(state, runs.blocks()[static_cast<size_t>(task)], true);
  });
}

}  // namespace hrad
