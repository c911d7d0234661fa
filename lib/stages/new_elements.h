// The elements that the tasks of a round have made: told to all, numbered in the order of the
// tasks, put into the forest. Floor 7 (stages).
#pragma once

#include <limits>
#include <vector>

#include "stages/exchange.h"
#include "stages/subtree_refiner.h"

namespace hrad {

// Elements are made four at a time: all that is to be known of them is whose children they are, and
// how much of each is exposed.
struct NewFamily {
  static constexpr NodeId root_of_task = std::numeric_limits<NodeId>::min();
  NodeId parent;  // an old element, the root of the task, or -1-k: its new element k
  float exposed[4];
};

// Those of one task, in the order of the children.
std::vector<NewFamily> new_families(const SubtreeResult& result);

// Gives new elements their numbers, task by task, and the light of their parents for the time
// being. Returns the number of each task's first one.
std::vector<NodeId> add_families(State& state, const std::vector<NodeId>& roots,
                                 const std::vector<std::vector<NewFamily>>& families,
                                 ThreadTeam& team, const Exchange& exchange);

// Takes out the elements from number `first` on, whose parents are leaves again.
void drop_elements(State& state, size_t first);

}  // namespace hrad
