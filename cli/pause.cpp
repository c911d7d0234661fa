// Time spent on getting back, and on getting further. CLI: public headers only.
#include "pause.h"

#include <cstring>

namespace hrad::cli {

void Pause::resume() {
  caught_up_ = false;
  resumed_at_ = Clock::now();
}

bool Pause::is_allowed(const hrad_progress& progress) {
  if (progress.iteration <= iteration_ && progress.fraction <= fraction_) return false;
  const Clock::time_point now = Clock::now();
  if (!caught_up_) caught_up_at_ = now;
  caught_up_ = true;
  return progress.stage != nullptr && std::strcmp(progress.stage, "measure") != 0 &&
         now - caught_up_at_ >= caught_up_at_ - resumed_at_;
}

void Pause::begin(const hrad_progress& progress) {
  iteration_ = progress.iteration;
  fraction_ = progress.fraction;
}

}  // namespace hrad::cli
