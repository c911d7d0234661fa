// Whose receivers, and whose sources. Floor 7 (stages).
#include "stages/own_runs.h"

#include <algorithm>

#include "machine/pieces.h"

namespace hrad {
namespace {

OwnRuns::Runs waiting(const LinkTable& table, size_t number, const Exchange& exchange) {
  OwnRuns::Runs waits;
  if (number >= table.block_count()) return waits;
  const LinkTable::Block& block = table.block(number);
  size_t first = 0;
  for (size_t run = 0; run < block.ends.size(); first = block.ends[run++])
    waits[run] =
        std::any_of(block.links.data() + first, block.links.data() + block.ends[run],
                    [&](const Link& link) { return exchange.comes_by_message(link.source); });
  return waits;
}

}  // namespace

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
  team.for_each(static_cast<int64_t>(blocks_.size()), [&](int64_t k, int) {
    Block& block = blocks_[static_cast<size_t>(k)];
    block.waits = {waiting(state.links, block.number, exchange),
                   waiting(state.direct.mean, block.number, exchange)};
  });
  node_at_.resize(state.places.count());
  state.places.for_each_stretch(0, state.places.nodes(),
                                [&](size_t node, size_t place, size_t count) {
                                  for (; count-- > 0; ++node)
                                    node_at_[place++] = static_cast<NodeId>(node);
                                });
  rename_sources([&](NodeId source) { return static_cast<NodeId>(state.places[source]); });
}

OwnRuns::~OwnRuns() {
  if (!all_) rename_sources([&](NodeId place) { return node_at_[static_cast<size_t>(place)]; });
}

template <class NumberOf>
void OwnRuns::rename_sources(const NumberOf& number_of) {
  for (LinkTable* table : {&state_->links, &state_->direct.mean})
    team_->for_each(static_cast<int64_t>(table->block_count()), [&](int64_t block, int) {
      for (Link& link : table->links_of_block(static_cast<size_t>(block)))
        link.source = number_of(link.source);
    });
}

}  // namespace hrad
