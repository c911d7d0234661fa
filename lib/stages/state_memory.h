// The memory of a solution, counted against its budget. Floor 7 (stages).
#pragma once

#include <cstdint>

#include "stages/state.h"

namespace hrad {

// Bytes of links; of all else that grows with elements and their corners: these, the light on them
// and which links are whose; and of both together.
int64_t bytes_of_links(const State& state);
int64_t bytes_of_nodes(const State& state);
int64_t bytes_of(const State& state);

// Gives back what arrays hold beyond their size, at the end of a stage that made them grow.
void shrink_to_fit(State& state);

// Back to the patches alone, and their memory.
void clear(State& state);

// Makes a change of a solution's arrays, and counts what they have grown or shrunk by.
template <class Change>
void counted(State& state, const Change& change) {
  const int64_t before = bytes_of(state);
  change();
  state.memory.take(bytes_of(state) - before, "links and elements");
}

// Counts what a stage uses for a while, and at its end what the solution grew by instead.
class StageMemory {
 public:
  explicit StageMemory(State& state) : state_(state), before_(bytes_of(state)) {}
  ~StageMemory() { state_.memory.take(-taken_.load(), ""); }
  StageMemory(const StageMemory&) = delete;
  StageMemory& operator=(const StageMemory&) = delete;

  // MEMORY when that is over the limit. Any thread.
  void take(int64_t bytes, const char* what) {
    state_.memory.take(bytes, what);
    taken_ += bytes;
  }

  // The solution as it is now stays counted, whatever was taken for the time being is not: of a
  // stage, or a step of one, that was carried to its end.
  void settle() {
    const int64_t now = bytes_of(state_);
    take(now - before_ - taken_.load(), "links and elements");
    taken_ = 0;
    before_ = now;
  }

 private:
  State& state_;
  int64_t before_;
  std::atomic<int64_t> taken_{0};
};

}  // namespace hrad
