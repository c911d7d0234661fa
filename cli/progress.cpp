// The progress line (progress.h). CLI: public headers only.
#include "progress.h"

#include <algorithm>
#include <cmath>

#include "numbers.h"
#include "signals.h"

namespace hrad::cli {
namespace {

std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  char text[48];
  if (whole < 3600)
    std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
  else
    std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60,
                  whole % 60);
  return text;
}

}  // namespace

void Progress::announce_stage(const hrad_progress& progress) {
  if (progress.stage == nullptr || stage_ == progress.stage) return;
  stage_ = progress.stage;
  terminal_->say("stage " + stage_ + " after " + seconds_text(progress.seconds) + " and " +
                 std::to_string(progress.iteration) + " iterations");
}

void Progress::show(const hrad_progress& progress) {
  if (terminal_->verbosity() == Verbosity::verbose) announce_stage(progress);
  if (!terminal_->shows_line()) return;
  const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
  percent_ = std::max(percent_, static_cast<int>(100 * fraction));
  char start[96];
  std::snprintf(start, sizeof start, "hrad: %-8s %3d %%", progress.stage ? progress.stage : "",
                percent_);
  std::string line = start;
  constexpr double longest_estimate = 1e7;  // s; beyond it an estimate says nothing
  if (signals::pending() != 0)
    line += "  stopping (again: at once)";
  else if (progress.seconds_left >= 0 && progress.seconds_left < longest_estimate)
    line += "  " + clock_text(progress.seconds_left) + " left";
  terminal_->show_line(line);
}

}  // namespace hrad::cli
