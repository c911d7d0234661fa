// Numbers from a prefix sum over the tasks, so that all else is done task by task.
// Floor 7 (stages).
#include "stages/new_elements.h"

#include <algorithm>
#include <cstddef>

#include "machine/pieces.h"
#include "stages/exchange.h"

namespace hrad {

std::vector<NewFamily> new_families(const SubtreeResult& result) {
  const std::vector<SubtreeNode>& nodes = result.nodes;
  std::vector<NewFamily> families;
  std::vector<int32_t> made;  // number of each new element
  for (size_t at = 0; at < nodes.size(); ++at) {
    if (nodes[at].old_id >= 0) {
      made.push_back(-1);
      continue;
    }
    const int32_t number = static_cast<int32_t>(4 * families.size());
    for (int32_t child = 0; child < 4; ++child) made.push_back(number + child);
    const size_t parent = static_cast<size_t>(nodes[at].parent);
    NewFamily family;
    family.parent = parent == 0                 ? NewFamily::root_of_task
                    : nodes[parent].old_id >= 0 ? nodes[parent].old_id
                                                : -1 - made[parent];
    for (size_t child = 0; child < 4; ++child)
      family.exposed[child] = nodes[at + child].place.exposed;
    families.push_back(family);
    at += 3;  // brothers stand side by side
  }
  return families;
}

std::vector<NodeId> add_families(State& state, const std::vector<NodeId>& roots,
                                 const std::vector<std::vector<NewFamily>>& families,
                                 ThreadTeam& team, const Exchange& exchange) {
  constexpr size_t tasks_of_a_step = 64;
  const size_t bands = static_cast<size_t>(state.bands);
  NodeArray& nodes = state.forest.nodes;
  std::vector<NodeId> first;
  size_t count = nodes.size();
  for (const std::vector<NewFamily>& of_task : families) {
    first.push_back(static_cast<NodeId>(count));
    count += 4 * of_task.size();
  }
  require_numbers(count);
  nodes.resize(count);
  const auto add = [&](size_t task) {
    NodeId next = first[task];
    for (const NewFamily& family : families[task]) {
      const NodeId parent = family.parent == NewFamily::root_of_task ? roots[task]
                            : family.parent >= 0                     ? family.parent
                                                 : first[task] - 1 - family.parent;
      nodes.adopt(parent, next);
      for (int child = 0; child < 4; ++child)
        nodes.set_exposed(static_cast<size_t>(next + child), family.exposed[child]);
      next += 4;
    }
  };
  // Where a process keeps light, its parent's is kept, too.
  const auto light = [&](size_t task) {
    NodeId id = first[task];
    for (const NodeId end = id + 4 * static_cast<NodeId>(families[task].size()); id < end; ++id) {
      if (!state.places.has(id)) continue;
      const NodeId parent = nodes[static_cast<size_t>(id)].parent;
      std::copy_n(state.radiosity_of(parent), bands, state.radiosity_of(id));
      std::copy_n(state.irradiance_of(parent), bands, state.irradiance_of(id));
    }
  };
  const auto for_each_task = [&](const auto& body) {
    for_each_piece(
        team, families.size(),
        [&](size_t, size_t begin, size_t end) {
          for (size_t task = begin; task < end; ++task) body(task);
        },
        tasks_of_a_step);
  };
  for_each_task(add);
  exchange.make_room_for_light(state);
  for_each_task(light);
  return first;
}

void drop_elements(State& state, size_t first) {
  NodeArray& nodes = state.forest.nodes;
  for (size_t k = first; k < nodes.size(); k += 4)
    nodes.lose_children(static_cast<size_t>(nodes[k].parent));
  nodes.resize(first);
  state.places.resize(first);
  state.resize_light();
  state.links.resize(first);
}

}  // namespace hrad
