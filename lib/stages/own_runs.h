// The runs of links that a process gathers over, and which of them wait for what others tell: the
// rest need no message and are gathered over while messages fly (paper, Section 3.1).
// Floor 7 (stages).
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

#include "stages/exchange.h"
#include "stages/state.h"

namespace hrad {

// While it lives the sources of own links are not ids but places of their light, so that sweeps
// need not look these up: nobody else may look at links then.
class OwnRuns {
 public:
  // A bit for each run of a block, in order.
  using Runs = std::bitset<LinkTable::receivers_of_a_block>;
  // One of LinkTable in which some receivers are clusters or this process's own.
  struct Block {
    uint32_t number = 0;
    std::array<Runs, 2> waits;  // of State::links, and of direct light

    bool any_waits() const { return waits[0].any() || waits[1].any(); }
  };

  // All of them, and none that waits: of a process that is alone.
  OwnRuns() = default;
  // As it stands once it has asked for its sources. state and team must outlive this.
  OwnRuns(State& state, const Exchange& exchange, ThreadTeam& team);
  ~OwnRuns();
  OwnRuns(const OwnRuns&) = delete;
  OwnRuns& operator=(const OwnRuns&) = delete;

  bool all() const { return all_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  int64_t bytes() const { return bytes_in(blocks_) + bytes_in(node_at_); }

 private:
  template <class NumberOf>
  void rename_sources(const NumberOf& number_of);

  bool all_ = true;
  std::vector<Block> blocks_;
  State* state_ = nullptr;
  ThreadTeam* team_ = nullptr;
  std::vector<NodeId> node_at_;  // per place
};

}  // namespace hrad
