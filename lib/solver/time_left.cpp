// The pace of a stage but for its beginning: what was known of it before, as after a restart, goes
// by in no time and says nothing of the rest. Floor 8 (solver).
#include "solver/time_left.h"

#include <algorithm>
#include <array>
#include <utility>

namespace hrad {
namespace {

constexpr double least_share = 0.01;  // below it the pace says nothing
// The pace is the mean of those since these shares of the time: one is steady, one quick.
struct Window {
  double since, weight;
};
constexpr std::array<Window, 2> windows = {{{1.0 / 8, 2.0 / 3}, {1.0 / 3, 1.0 / 3}}};

}  // namespace

void TimeLeft::begin_stage(double now, Expected expected, std::function<double(double)> later) {
  begin_ = now;
  expected_ = expected;
  share_ = 0;
  later_ = std::move(later);
  marks_.assign(1, {0, 0});
}

void TimeLeft::report(double now, double share) {
  share_ = std::max(share_, std::min(1.0, share));
  const double elapsed = now - begin_;
  if (elapsed > 1.1 * marks_.back().elapsed) marks_.push_back({elapsed, share_});
}

double TimeLeft::pace_since(double from, double elapsed) const {
  auto mark = std::upper_bound(marks_.begin(), marks_.end(), from,
                               [](double time, const Mark& m) { return time < m.elapsed; });
  --mark;  // the first one is at 0
  return (share_ - mark->share) / (elapsed - mark->elapsed);
}

double TimeLeft::left_of_stage(double elapsed) const {
  const double by_expectation =
      expected_.seconds < 0 ? -1 : std::max(0.0, expected_.seconds - elapsed);
  if (share_ < least_share || !(elapsed > 0)) return by_expectation;
  double pace = 0;
  for (const Window& window : windows)
    pace += window.weight * pace_since(window.since * elapsed, elapsed);
  if (!(pace > 0)) pace = share_ / elapsed;
  const double by_pace = (1 - share_) / pace;
  if (by_expectation < 0) return by_pace;
  const double sure = std::min(1.0, share_ / expected_.until);
  return sure * by_pace + (1 - sure) * by_expectation;
}

double TimeLeft::left(double now) const {
  const double elapsed = now - begin_, of_stage = left_of_stage(elapsed);
  return of_stage < 0 ? -1 : of_stage + later_(elapsed + of_stage);
}

}  // namespace hrad
