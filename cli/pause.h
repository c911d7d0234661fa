// When a solve of several processes may pause for a checkpoint, which they write together.
// CLI: public headers only.
#pragma once

#include <hrad/hrad.h>

#include <chrono>

namespace hrad::cli {

class Pause {
 public:
  // The solve begins, or goes on after the last pause.
  void resume();
  // Asked with every progress. Not before the solve has gone on from where it paused last for as
  // long as it took to get there again, or it would hardly get any further; nor in a measurement,
  // which would begin anew.
  bool is_allowed(const hrad_progress& progress);
  // The solve pauses here.
  void begin(const hrad_progress& progress);

 private:
  using Clock = std::chrono::steady_clock;
  int64_t iteration_ = -1;  // where it paused last
  double fraction_ = -1;
  bool caught_up_ = false;  // it has got there again since
  Clock::time_point resumed_at_, caught_up_at_;
};

}  // namespace hrad::cli
