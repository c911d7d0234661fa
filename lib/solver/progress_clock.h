// Progress of one solve, told to the user: stage, share of the time, and time left. Floor 8
// (solver).
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>

#include "machine/work_observer.h"
#include "solver/solver.h"
#include "solver/time_left.h"

namespace hrad {

class ProgressClock {
 public:
  // observer: told of the stages, may be nullptr.
  ProgressClock(std::function<bool(const Progress&)> sink, WorkObserver* observer,
                std::chrono::steady_clock::time_point start)
      : sink_(std::move(sink)), observer_(observer), start_(start) {}

  // From here on `name` is under way; expected and later as for TimeLeft.
  void begin(const char* name, TimeLeft::Expected expected, std::function<double(double)> later) {
    name_ = name;
    if (observer_) observer_->stage_begins(name);
    stage_begin_ = seconds();
    time_left_.begin_stage(stage_begin_, expected, std::move(later));
  }

  // The share of the stage that is done. False: the user asks to stop.
  bool report(double share, int64_t iteration) {
    const double now = seconds();
    time_left_.report(now, share);
    const double left = time_left_.left(now);
    // Of what was left before, what has gone by: it never runs backwards, and where there is more
    // to do than was thought it goes on slower.
    if (left >= 0 && now > told_) {
      const double since = fraction_ > 0 ? now - told_ : now;
      fraction_ = std::min(largest_share, 1 - (1 - fraction_) * left / (left + since));
      told_ = now;
    }
    return tell(now, left, share, iteration);
  }

  // The solve is done.
  void finish(int64_t iteration) {
    fraction_ = 1;
    tell(seconds(), 0, 1, iteration);
  }

  double seconds_of_stage() const { return seconds() - stage_begin_; }

 private:
  static constexpr double largest_share = 0.99;  // before the end

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  bool tell(double now, double left, double share, int64_t iteration) const {
    Progress p;
    p.stage = name_;
    p.iteration = iteration;
    p.fraction = fraction_;
    p.seconds = now;
    p.seconds_left = left;
    p.stage_share = share;
    return sink_(p);
  }

  std::function<bool(const Progress&)> sink_;
  WorkObserver* const observer_;
  const std::chrono::steady_clock::time_point start_;
  const char* name_ = "initial";
  double stage_begin_ = 0, told_ = 0, fraction_ = 0;
  TimeLeft time_left_;
};

}  // namespace hrad
