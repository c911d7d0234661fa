// Where surfaces are pressed against each other. Of two that turn their fronts to each other both
// see nothing there, unless they are the two sides of one sheet; of two that face the same way, as
// a rug on a floor, the one below. Within rounding of each other a sheet lies on what has one side,
// a lamp on what is dark, and of two alike the first.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "physics/surfaces.h"

namespace bench {

using physics::Surface;
using physics::Vector;

class Covers {
 public:
  explicit Covers(const std::vector<Surface>& surfaces) : surfaces_(surfaces) {
    Vector low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    std::vector<double> from, to;
    for (const Surface& s : surfaces) {
      from.push_back(std::min({s.a.x, s.b.x, s.c.x}));
      to.push_back(std::max({s.a.x, s.b.x, s.c.x}));
      for (const Vector& p : {s.a, s.b, s.c}) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    }
    const double radius = length(high - low) / 2;
    pressed_ = 1e-6 * radius;
    tie_ = 1e-9 * radius;
    std::vector<size_t> order(surfaces.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return from[a] < from[b]; });
    of_.resize(2 * surfaces.size());
    for (size_t i = 0; i < order.size(); ++i)
      for (size_t j = i + 1; j < order.size() && from[order[j]] <= to[order[i]] + pressed_; ++j) {
        add(order[i], order[j]);
        add(order[j], order[i]);
      }
  }

  bool covered(size_t surface, int64_t side, Vector at) const {
    for (size_t q : of_[2 * surface + static_cast<size_t>(side)]) {
      const Surface& s = surfaces_[q];
      const Vector n = s.normal;
      if (dot(cross(s.b - s.a, at - s.a), n) >= 0 && dot(cross(s.c - s.b, at - s.b), n) >= 0 &&
          dot(cross(s.a - s.c, at - s.c), n) >= 0)
        return true;
    }
    return false;
  }

 private:
  // q to what covers p.
  void add(size_t p, size_t q) {
    const Surface &below = surfaces_[p], &cover = surfaces_[q];
    if (cover.area == 0 || below.partner == static_cast<int64_t>(q)) return;
    for (int side = 0; side < below.sides(); ++side) {
      const Vector n = side == 0 ? below.normal : below.normal * -1;
      const double along = dot(n, cover.normal);
      if (std::fabs(along) < 1 - 1e-9) continue;
      const double height = dot(cover.a - below.a, n);
      if (std::fabs(height) > pressed_) continue;
      bool above = along < 0 || height > 0;
      if (along > 0 && std::fabs(height) <= tie_) {
        above = q < p;
        if (cover.emits() != below.emits()) above = cover.emits();
        if (cover.two_sided != below.two_sided) above = cover.two_sided;
      }
      if (above) of_[2 * p + static_cast<size_t>(side)].push_back(q);
    }
  }

  const std::vector<Surface>& surfaces_;
  double pressed_, tie_;
  std::vector<std::vector<size_t>> of_;  // per surface and side
};

}  // namespace bench
