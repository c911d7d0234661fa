// What is not a rank's own is dropped. Floor 8 (solver).
#include "solver/own_links.h"

#include <utility>
#include <vector>

#include "stages/point_numbers.h"

namespace hrad {

void keep_own_links(State& state, const Exchange& exchange, ThreadTeam& team) {
  if (exchange.alone()) return;
  const auto is_mine = [&](NodeId id) {
    const Node& node = state.forest.nodes[static_cast<size_t>(id)];
    return Forest::is_cluster(node) || exchange.mine(node.surface);
  };
  for (LinkTable* table : {&state.links, &state.direct.mean}) {
    std::vector<LinkTable::NewRun> none;
    for (size_t k = 0; k < table->size(); ++k)
      if (!is_mine(static_cast<NodeId>(k)) && (*table)[k].count() > 0)
        none.push_back({static_cast<NodeId>(k), {}});
    table->replace(std::move(none), &team);
  }
  CornerLight& direct = state.direct;
  if (direct.of_leaf.empty()) return;
  direct.of_leaf.keep([&](size_t leaf) { return is_mine(static_cast<NodeId>(leaf)); });
  number_points_by_leaves(
      direct, direct.point_count(), [&](int32_t point) { return direct.links_of_point(point); },
      team);
}

}  // namespace hrad
