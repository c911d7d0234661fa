// Numbers from a prefix sum over the tasks, so that all else is done task by task.
// Floor 7 (stages).
#include "stages/new_elements.h"

#include <algorithm>
#include <utility>

namespace hrad {

void share_elements(std::vector<SubtreeResult>& results, const std::vector<NodeId>& roots,
                    const State& state, const Exchange& exchange) {
  if (exchange.alone()) return;
  struct Made {
    Node place;
    NodeId old_id;
    int32_t parent, first_child;
  };
  const auto surface_of = [&](size_t k) { return state.forest.nodes[roots[k]].surface; };
  std::vector<uint8_t> handed_on;
  std::vector<std::vector<Made>> made(results.size());
  for (size_t k = 0; k < results.size(); ++k) {
    handed_on.push_back(results[k].handed_on ? 1 : 0);
    bool any = results[k].handed_on;
    for (const SubtreeNode& node : results[k].nodes) any = any || node.old_id < 0;
    if (!any) continue;
    for (const SubtreeNode& node : results[k].nodes)
      made[k].push_back({node.place, node.old_id, node.parent, node.first_child});
  }
  exchange.share(handed_on, surface_of);
  exchange.share_lists(made, surface_of);
  for (size_t k = 0; k < results.size(); ++k) {
    if (exchange.mine(surface_of(k))) continue;
    results[k].handed_on = handed_on[k] != 0;
    for (const Made& from : made[k]) {
      SubtreeNode node;
      node.place = from.place;
      node.old_id = from.old_id;
      node.parent = from.parent;
      node.first_child = from.first_child;
      results[k].nodes.push_back(std::move(node));
    }
  }
}

std::vector<std::vector<NodeId>> add_elements(State& state,
                                              const std::vector<SubtreeResult>& results,
                                              ThreadTeam& team) {
  constexpr int64_t tasks_of_a_step = 64;
  const size_t bands = static_cast<size_t>(state.bands);
  std::vector<Node>& nodes = state.forest.nodes;
  std::vector<NodeId> first;  // new number of each task
  size_t count = nodes.size();
  for (const SubtreeResult& result : results) {
    first.push_back(static_cast<NodeId>(count));
    for (const SubtreeNode& node : result.nodes) count += node.old_id < 0;
  }
  nodes.resize(count);
  state.radiosity.resize(count * bands);
  state.irradiance.resize(count * bands);
  std::vector<std::vector<NodeId>> ids(results.size());
  const auto add = [&](size_t task) {
    const std::vector<SubtreeNode>& made = results[task].nodes;
    std::vector<NodeId>& id = ids[task];
    NodeId next = first[task];
    for (const SubtreeNode& node : made) {
      id.push_back(node.old_id >= 0 ? node.old_id : next++);
      if (node.old_id >= 0) continue;
      Node& place = nodes[static_cast<size_t>(id.back())];
      place = node.place;
      place.parent = id[static_cast<size_t>(node.parent)];
      place.first_child = -1;
      const size_t from = static_cast<size_t>(place.parent) * bands;
      const size_t to = static_cast<size_t>(id.back()) * bands;
      for (auto* light : {&state.radiosity, &state.irradiance})
        std::copy_n(light->begin() + static_cast<std::ptrdiff_t>(from), bands,
                    light->begin() + static_cast<std::ptrdiff_t>(to));
    }
    for (size_t k = 0; k < made.size(); ++k)
      if (made[k].first_child >= 0)
        nodes[static_cast<size_t>(id[k])].first_child =
            id[static_cast<size_t>(made[k].first_child)];
  };
  const int64_t tasks = static_cast<int64_t>(results.size());
  team.for_each((tasks + tasks_of_a_step - 1) / tasks_of_a_step, [&](int64_t step, int) {
    for (int64_t k = step * tasks_of_a_step; k < std::min(tasks, (step + 1) * tasks_of_a_step); ++k)
      add(static_cast<size_t>(k));
  });
  return ids;
}

}  // namespace hrad
