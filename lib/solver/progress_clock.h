// Progress of one solve: fractions of stages laid end to end, told to the user a few times a
// second. Floor 8 (solver).
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>

#include "machine/work_observer.h"
#include "solver/solver.h"

namespace hrad {

class ProgressClock {
 public:
  // observer: told of the stages, may be nullptr.
  ProgressClock(std::function<bool(const Progress&)> sink, WorkObserver* observer,
                std::chrono::steady_clock::time_point start)
      : sink_(std::move(sink)), observer_(observer), start_(start) {}

  // From here on `name` is under way, from `first` to `last` of the whole.
  void begin(const char* name, double first, double last) {
    name_ = name;
    if (observer_) observer_->stage_begins(name);
    first_ = first;
    last_ = last;
  }

  // The share of the stage that is done. False: the user asks to stop.
  bool report(double share, int64_t iteration) {
    fraction_ = std::max(fraction_, std::min(1.0, first_ + (last_ - first_) * share));
    const auto now = std::chrono::steady_clock::now();
    Progress p;
    p.stage = name_;
    p.iteration = iteration;
    p.fraction = fraction_;
    p.seconds = std::chrono::duration<double>(now - start_).count();
    if (fraction_ > 0.05) p.seconds_left = p.seconds * (1 - fraction_) / fraction_;
    return sink_(p);
  }

  double fraction() const { return fraction_; }

 private:
  std::function<bool(const Progress&)> sink_;
  WorkObserver* const observer_;
  const std::chrono::steady_clock::time_point start_;
  const char* name_ = "initial";
  double first_ = 0, last_ = 0, fraction_ = 0;
};

}  // namespace hrad
