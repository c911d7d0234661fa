// Numbers from a prefix sum over the tasks, so that all else is done task by task.
// Floor 7 (stages).
#include "stages/new_elements.h"

#include <algorithm>
#include <cstddef>

#include "machine/pieces.h"

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
                                 ThreadTeam& team) {
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
  state.resize_light();
  const auto add = [&](size_t task) {
    NodeId next = first[task];
    for (const NewFamily& family : families[task]) {
      const NodeId parent = family.parent == NewFamily::root_of_task ? roots[task]
                            : family.parent >= 0                     ? family.parent
                                                 : first[task] - 1 - family.parent;
      nodes.adopt(parent, next);
      for (int child = 0; child < 4; ++child) {
        const size_t id = static_cast<size_t>(next + child);
        nodes.set_exposed(id, family.exposed[child]);
        for (auto* light : {&state.radiosity, &state.irradiance})
          std::copy_n(light->begin() + static_cast<std::ptrdiff_t>(parent * bands), bands,
                      light->begin() + static_cast<std::ptrdiff_t>(id * bands));
      }
      next += 4;
    }
  };
  for_each_piece(
      team, families.size(),
      [&](size_t, size_t begin, size_t end) {
        for (size_t task = begin; task < end; ++task) add(task);
      },
      tasks_of_a_step);
  return first;
}

void drop_elements(State& state, size_t first) {
  NodeArray& nodes = state.forest.nodes;
  for (size_t k = first; k < nodes.size(); k += 4)
    nodes.lose_children(static_cast<size_t>(nodes[k].parent));
  nodes.resize(first);
  state.resize_light();
  state.links.resize(first);
}

}  // namespace hrad
