// Extrapolating what is still to come. Floor 7 (stages).
#include "stages/convergence.h"

#include <algorithm>
#include <cmath>

namespace hrad {
namespace {

constexpr double most_to_come = 1000;

// Sweeps until no more than `tolerated` is missing.
double sweeps_to_come(double missing, double ratio, double tolerated) {
  double sweeps = 0;
  for (; missing > tolerated && sweeps < most_to_come; ++sweeps) missing *= ratio;
  return sweeps;
}

}  // namespace

bool Convergence::reached(const std::vector<double>& total) {
  ++sweeps_;
  if (last_.empty()) {
    last_ = total;
    return false;
  }
  const bool first_change = change_.empty();
  if (first_change) change_.assign(total.size(), 0.0);
  bool done = true;
  to_come_ = first_change ? 1 : 0;
  for (size_t b = 0; b < total.size(); ++b) {
    const double change = std::fabs(total[b] - last_[b]);
    const double before = change_[b];
    const double ratio = before > 0 ? std::min(0.999, change / before) : (change > 0 ? 0.999 : 0.0);
    const double missing = change * ratio / (1 - ratio);
    // Single precision can't show less than some 1e-7 of the total.
    const bool still = change <= 1e-7 * std::fabs(total[b]);
    if (!still && !(missing <= tolerance_ * std::fabs(total[b]))) done = false;
    change_[b] = change;
    if (!still)
      to_come_ =
          std::max(to_come_, sweeps_to_come(missing, ratio, tolerance_ * std::fabs(total[b])));
  }
  last_ = total;
  return done && !first_change;
}

}  // namespace hrad
