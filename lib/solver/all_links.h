// The links of all owners together, for a file that is the same whoever they are.
// Floor 8 (solver).
#pragma once

#include "stages/exchange.h"
#include "stages/state.h"

namespace hrad {

// Collective. While it lives the state of rank 0 has the links and points of all, numbered as one
// process alone would number them; then its own again.
class AllLinks {
 public:
  AllLinks(State& state, const Exchange& exchange);
  ~AllLinks();
  AllLinks(const AllLinks&) = delete;
  AllLinks& operator=(const AllLinks&) = delete;

 private:
  void swap();

  State& state_;
  bool swapped_ = false;
  LinkTable links_;
  CornerLight direct_;
};

// Drops the links of other owners' receivers and what goes with them, of a state that has all.
void keep_own_links(State& state, const Exchange& exchange);

}  // namespace hrad
