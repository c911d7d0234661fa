// Drawing items in proportion to their weights. Floor 1 (base).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hrad {

class Draw {
 public:
  Draw() = default;
  explicit Draw(const std::vector<double>& weights) { assign(weights); }
  // Takes no new memory where there were as many items before.
  void assign(const std::vector<double>& weights) {
    until_.clear();
    double sum = 0;
    for (double w : weights) until_.push_back(sum += w);
  }

  // Of all weights; 0: there is nothing to draw.
  double total() const { return until_.empty() ? 0 : until_.back(); }
  double chance(size_t item) const {
    return (until_[item] - (item ? until_[item - 1] : 0)) / total();
  }
  // The item at this fraction of the total: even fractions give an even draw.
  size_t pick(double fraction) const {
    const auto found = std::upper_bound(until_.begin(), until_.end(), fraction * total());
    return std::min(static_cast<size_t>(found - until_.begin()), until_.size() - 1);
  }
  // How far the fraction has gone through the item it picks, from 0 to 1.
  double rest(size_t item, double fraction) const {
    const double from = item ? until_[item - 1] : 0;
    return std::min(1.0, std::max(0.0, (fraction * total() - from) / (until_[item] - from)));
  }

 private:
  std::vector<double> until_;  // running sum of the weights
};

}  // namespace hrad
