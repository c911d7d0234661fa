// The runs of links that a process gathers over, and which of them wait for what others tell: the
// rest need no message and are gathered over while messages fly (paper, Section 3.1).
// Floor 7 (stages).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "stages/exchange.h"
#include "stages/state.h"
#include "stages/state_memory.h"
#include "stages/sweep_kernels.h"

namespace hrad {

// The runs of a block of a table, that number: returns how many. runs: room for all receivers of
// a block.
size_t put_runs(const LightPlaces& places, const LinkTable::Block& block, size_t number,
                GatherRun* runs);

// While it lives the sources of own links are not ids but places of their light, so that sweeps
// need not look these up: nobody else may look at links then.
class OwnRuns {
 public:
  // One of LinkTable in which some receivers are clusters or this process's own.
  struct Block {
    uint32_t number = 0;
    // Of State::links and then of direct light, first those that don't wait: each of these four
    // kinds from where the one before ends.
    std::vector<GatherRun> runs;
    std::array<uint32_t, 5> first = {};

    Span<const GatherRun> of_table(size_t table, bool waiting) const {
      const size_t kind = 2 * table + (waiting ? 1 : 0);
      return {runs.data() + first[kind], first[kind + 1] - first[kind]};
    }
  };

  // All of them, and none that waits: of a process that is alone.
  OwnRuns() = default;
  // As it stands once it has asked for its sources; counted against the limit of memory. state and
  // team must outlive this.
  OwnRuns(State& state, const Exchange& exchange, ThreadTeam& team);
  ~OwnRuns();
  OwnRuns(const OwnRuns&) = delete;
  OwnRuns& operator=(const OwnRuns&) = delete;

  bool all() const { return all_; }
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  bool all_ = true;
  std::vector<Block> blocks_;
  State* state_ = nullptr;
  ThreadTeam* team_ = nullptr;
  std::vector<NodeId> node_at_;  // per place
  std::optional<StageMemory> memory_;
};

}  // namespace hrad
