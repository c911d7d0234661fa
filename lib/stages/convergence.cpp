// Extrapolating what is still to come. Floor 7 (stages).
#include "stages/convergence.h"

#include <algorithm>
#include <cmath>

namespace hrad {

bool Convergence::reached(const std::vector<double>& total) {
  if (last_.empty()) {
    last_ = total;
    return false;
  }
  const bool first_change = change_.empty();
  if (first_change) change_.assign(total.size(), 0.0);
  bool done = true;
  for (size_t b = 0; b < total.size(); ++b) {
    const double change = std::fabs(total[b] - last_[b]);
    const double before = change_[b];
    const double ratio = before > 0 ? std::min(0.999, change / before) : (change > 0 ? 0.999 : 0.0);
    const double missing = change * ratio / (1 - ratio);
    // Single precision can't show less than some 1e-7 of the total.
    const bool still = change <= 1e-7 * std::fabs(total[b]);
    if (!still && !(missing <= tolerance_ * std::fabs(total[b]))) done = false;
    change_[b] = change;
  }
  last_ = total;
  return done && !first_change;
}

}  // namespace hrad
