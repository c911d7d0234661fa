// What all nodes have, as one number, from what every process has of its own. Floor 8 (solver).
#pragma once

#include <cstdint>

#include "base/hash.h"
#include "stages/exchange.h"

namespace hrad {

// Collective: whole numbers, hash_of(id), are added up in any order.
template <class HashOf>
uint64_t hash_of_own(const State& state, const Exchange& exchange, const HashOf& hash_of) {
  uint64_t sum = 0;
  for (NodeId id = 0; id < static_cast<NodeId>(state.forest.nodes.size()); ++id)
    if (exchange.mine(state.forest, id)) sum += mix(static_cast<uint64_t>(id), hash_of(id));
  exchange.comm().add_up({&sum, 1});
  return sum;
}

}  // namespace hrad
