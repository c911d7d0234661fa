// The elements that the tasks of a round have made: told to all, numbered in the order of the
// tasks, put into the forest. Floor 7 (stages).
#pragma once

#include <vector>

#include "stages/exchange.h"
#include "stages/subtree_refiner.h"

namespace hrad {

// Collective. roots: of the tasks; of other owners' tasks the elements alone become known, links
// stay with the owners of their receivers.
void share_elements(std::vector<SubtreeResult>& results, const std::vector<NodeId>& roots,
                    const State& state, const Exchange& exchange);

// Gives new elements their numbers, and the light of their parents for the time being.
// ids[task][k]: of the task's element k, old or new.
std::vector<std::vector<NodeId>> add_elements(State& state,
                                              const std::vector<SubtreeResult>& results,
                                              ThreadTeam& team);

}  // namespace hrad
