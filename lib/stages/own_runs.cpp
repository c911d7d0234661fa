// Whose receivers, and whose sources. Floor 7 (stages).
#include "stages/own_runs.h"

#include <array>
#include <utility>

#include "machine/pieces.h"

namespace hrad {
namespace {

std::array<LinkTable*, 2> tables_of(State& state) { return {&state.links, &state.direct.mean}; }

size_t runs_in(const LinkTable& table, size_t number) {
  return number < table.block_count() ? table.block(number).ends.size() : 0;
}

}  // namespace

size_t put_runs(const LightPlaces& places, const LinkTable::Block& block, size_t number,
                GatherRun* runs) {
  const NodeId first = static_cast<NodeId>(number * LinkTable::receivers_of_a_block);
  size_t count = 0;
  block.has_links.for_each([&](size_t k) {
    const uint32_t before = count > 0 ? block.ends[count - 1] : 0;
    runs[count] = {before, block.ends[count],
                   static_cast<uint32_t>(places[first + static_cast<NodeId>(k)])};
    ++count;
  });
  return count;
}

OwnRuns::OwnRuns(State& state, const Exchange& exchange, ThreadTeam& team) {
  if (exchange.alone()) return;
  all_ = false;
  state_ = &state;
  team_ = &team;
  const NodeArray& nodes = state.forest.nodes;
  constexpr size_t of_a_block = LinkTable::receivers_of_a_block;
  std::vector<uint8_t> is_own(pieces_of(nodes.size(), of_a_block), 0);
  for_each_piece(
      team, nodes.size(),
      [&](size_t block, size_t begin, size_t end) {
        for (size_t k = begin; k < end && !is_own[block]; ++k) {
          const Node node = nodes[k];
          is_own[block] = Forest::is_cluster(node) || exchange.mine(node.surface);
        }
      },
      of_a_block);
  for (size_t block = 0; block < is_own.size(); ++block)
    if (is_own[block]) {
      blocks_.emplace_back();
      blocks_.back().number = static_cast<uint32_t>(block);
    }
  const auto runs_of = [&](const Block& block) {
    return runs_in(state.links, block.number) + runs_in(state.direct.mean, block.number);
  };
  size_t bytes = blocks_.size() * sizeof(Block) + state.places.count() * sizeof(NodeId);
  for (const Block& block : blocks_) bytes += runs_of(block) * sizeof(GatherRun);
  memory_.emplace(state);
  memory_->take(static_cast<int64_t>(bytes), "lists of the links that a sweep goes over");
  node_at_.resize(state.places.count());
  state.places.for_each_stretch(0, state.places.nodes(),
                                [&](size_t node, size_t place, size_t count) {
                                  for (; count-- > 0; ++node)
                                    node_at_[place++] = static_cast<NodeId>(node);
                                });
  team.for_each(static_cast<int64_t>(blocks_.size()), [&](int64_t k, int) {
    Block& block = blocks_[static_cast<size_t>(k)];
    block.runs.resize(runs_of(block));
  });
  // Nothing fails from here on: either all sources of own runs are places, or none is.
  team.for_each(static_cast<int64_t>(blocks_.size()), [&](int64_t k, int) {
    Block& block = blocks_[static_cast<size_t>(k)];
    size_t kind = 0;
    for (LinkTable* table : tables_of(state)) {
      GatherRun* const runs = block.runs.data() + block.first[kind];
      const size_t count = runs_in(*table, block.number);
      size_t here = 0;
      if (count > 0) put_runs(state.places, table->block(block.number), block.number, runs);
      for (size_t run = 0; run < count; ++run) {
        bool waits = false;
        for (uint32_t at = runs[run].first; at < runs[run].end; ++at) {
          NodeId& source = table->links_of_block(block.number)[at].source;
          waits = waits || exchange.comes_by_message(source);
          source = static_cast<NodeId>(state.places[source]);
        }
        if (!waits) std::swap(runs[here++], runs[run]);
      }
      block.first[kind + 1] = block.first[kind] + static_cast<uint32_t>(here);
      block.first[kind + 2] = block.first[kind] + static_cast<uint32_t>(count);
      kind += 2;
    }
  });
}

OwnRuns::~OwnRuns() {
  if (all_) return;
  team_->for_each(static_cast<int64_t>(blocks_.size()), [&](int64_t k, int) {
    const size_t number = blocks_[static_cast<size_t>(k)].number;
    for (LinkTable* table : tables_of(*state_)) {
      if (number >= table->block_count()) continue;
      for (Link& link : table->links_of_block(number))
        link.source = node_at_[static_cast<size_t>(link.source)];
    }
  });
}

}  // namespace hrad
