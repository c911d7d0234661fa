// Rays through a scene in double precision, by a binary tree of boxes split by the surface area
// heuristic. It answers which side of which surface a ray meets.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "physics/surfaces.h"

namespace physics {

struct Hit {
  int64_t surface = -1;  // -1: none
  double t = std::numeric_limits<double>::infinity();
  bool back = false;
  bool black = false;  // a back of a one-sided surface, or a blocker
};

class RayTree {
 public:
  explicit RayTree(std::vector<Surface> surfaces) : surfaces_(std::move(surfaces)) {
    find_partners(surfaces_);
    Box all;
    for (size_t i = 0; i < surfaces_.size(); ++i) {
      if (surfaces_[i].area == 0) continue;
      order_.push_back(static_cast<int32_t>(i));
      all.grow(bounds(surfaces_[i]));
    }
    radius_ = 0.5 * length(all.high - all.low);
    if (order_.empty()) return;
    nodes_.emplace_back();
    split(0, 0, static_cast<int32_t>(order_.size()));
    for (int32_t i : order_) {
      const Surface& s = surfaces_[i];
      corners_.push_back({s.a, s.b - s.a, s.c - s.a});
    }
  }

  const std::vector<Surface>& surfaces() const { return surfaces_; }
  double radius() const { return radius_; }
  // Rays start this far off their surface: beyond a contact (1e-6 radii), below every meant gap.
  double offset() const { return 2e-6 * radius_; }

  // The nearest hit with t > 0; direction has length 1. Of surfaces in contact (1e-6 radii) the
  // black one counts: the ray comes from inside a solid.
  Hit nearest(Vector origin, Vector direction) const {
    Hit best;
    const double contact = 1e-6 * radius_;
    walk(origin, direction, [&](int32_t place, double t, bool back) {
      const int64_t index = order_[place];
      const Surface& s = surfaces_[index];
      const bool black = s.blocker || (back && !s.two_sided && s.partner < 0);
      const bool tie = std::fabs(t - best.t) <= contact && black != best.black;
      if (tie ? black : t < best.t) best = {index, t, back, black};
      return best.t + contact;
    });
    if (best.surface >= 0 && best.back && !best.black && !surfaces_[best.surface].two_sided) {
      best.surface = surfaces_[best.surface].partner;
      best.back = false;
    }
    return best;
  }

  // Something lies between two points.
  bool blocked(Vector from, Vector to) const {
    bool found = false;
    walk(from, to - from, [&](int32_t, double t, bool) {
      if (t < 1) found = true;
      return found ? 0.0 : 1.0;
    });
    return found;
  }

 private:
  struct Box {
    Vector low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    void grow(const Box& b) {
      low = {std::min(low.x, b.low.x), std::min(low.y, b.low.y), std::min(low.z, b.low.z)};
      high = {std::max(high.x, b.high.x), std::max(high.y, b.high.y), std::max(high.z, b.high.z)};
    }
    double half_area() const {
      const Vector d = high - low;
      return d.x * d.y + d.y * d.z + d.z * d.x;
    }
  };
  struct Node {
    Box box;
    int32_t first = 0;  // of the children, or of the triangles of a leaf
    int32_t count = 0;  // triangles; 0: an inner node
  };
  struct Corners {
    Vector a, ab, ac;
  };
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  static Box bounds(const Surface& s) {
    Box box;
    for (const Vector& p : {s.a, s.b, s.c}) box.grow({p, p});
    return box;
  }
  static double along(Vector v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

  void split(int32_t node, int32_t first, int32_t count) {
    Box box;
    for (int32_t i = first; i < first + count; ++i) box.grow(bounds(surfaces_[order_[i]]));
    nodes_[node].box = box;
    nodes_[node].first = first;
    nodes_[node].count = count;
    if (count <= 2) return;
    // The best cut of the sorted middles along each axis.
    double best_cost = count * box.half_area();
    int best_axis = -1;
    int32_t best_cut = 0;
    const auto sort_along = [&](int axis) {
      const auto middle = [&](int32_t i) {
        const Surface& s = surfaces_[i];
        return along(s.a, axis) + along(s.b, axis) + along(s.c, axis);
      };
      std::stable_sort(order_.begin() + first, order_.begin() + first + count,
                       [&](int32_t l, int32_t r) { return middle(l) < middle(r); });
    };
    std::vector<double> right_area(count);
    for (int axis = 0; axis < 3; ++axis) {
      sort_along(axis);
      Box right, left;
      for (int32_t i = count - 1; i > 0; --i) {
        right.grow(bounds(surfaces_[order_[first + i]]));
        right_area[i] = right.half_area();
      }
      for (int32_t i = 1; i < count; ++i) {
        left.grow(bounds(surfaces_[order_[first + i - 1]]));
        const double cost = box.half_area() + i * left.half_area() + (count - i) * right_area[i];
        if (cost < best_cost) best_cost = cost, best_axis = axis, best_cut = i;
      }
    }
    if (best_axis < 0) {
      if (count <= 8) return;
      best_axis = 0, best_cut = count / 2;
    }
    sort_along(best_axis);
    const int32_t child = static_cast<int32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = child;
    nodes_[node].count = 0;
    split(child, first, best_cut);
    split(child + 1, first + best_cut, count - best_cut);
  }

  // Where the ray enters the box, infinity when it misses it before t = limit.
  static double entry(const Box& box, Vector origin, Vector inverse, double limit) {
    double low = 0, high = limit;
    const auto slab = [&](double l, double h, double o, double i) {
      const double t0 = (l - o) * i, t1 = (h - o) * i;
      low = std::max(low, std::min(t0, t1));
      high = std::min(high, std::max(t0, t1));
    };
    slab(box.low.x, box.high.x, origin.x, inverse.x);
    slab(box.low.y, box.high.y, origin.y, inverse.y);
    slab(box.low.z, box.high.z, origin.z, inverse.z);
    return low <= high * (1 + 1e-12) + 1e-300 ? low : infinity;
  }

  // Calls visit(place, t, back) for hits with 0 < t < limit, near boxes first; it returns the
  // limit.
  template <typename Visit>
  void walk(Vector origin, Vector direction, Visit visit) const {
    if (nodes_.empty()) return;
    const auto inverted = [](double d) { return 1 / (std::fabs(d) > 1e-200 ? d : 1e-200); };
    const Vector inverse = {inverted(direction.x), inverted(direction.y), inverted(direction.z)};
    double limit = infinity;
    std::array<int32_t, 128> stack;
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[stack[--depth]];
      if (node.count > 0) {
        for (int32_t i = node.first; i < node.first + node.count; ++i) {
          double t;
          bool back;
          if (meets(corners_[i], origin, direction, t, back) && t < limit)
            limit = std::min(limit, visit(i, t, back));
        }
        continue;
      }
      const double near = entry(nodes_[node.first].box, origin, inverse, limit);
      const double far = entry(nodes_[node.first + 1].box, origin, inverse, limit);
      const int first = near <= far ? 1 : 0;  // pushed first, looked at last
      if ((first == 1 ? far : near) < infinity) stack[depth++] = node.first + first;
      if ((first == 1 ? near : far) < infinity) stack[depth++] = node.first + 1 - first;
    }
  }

  static bool meets(const Corners& c, Vector origin, Vector direction, double& t, bool& back) {
    const Vector p = cross(direction, c.ac);
    const double determinant = dot(c.ab, p);
    if (determinant == 0) return false;
    const double inverse = 1 / determinant;
    const Vector s = origin - c.a;
    const double u = dot(s, p) * inverse;
    if (u < 0 || u > 1) return false;
    const Vector q = cross(s, c.ab);
    const double v = dot(direction, q) * inverse;
    if (v < 0 || u + v > 1) return false;
    t = dot(c.ac, q) * inverse;
    back = determinant < 0;
    return t > 0;
  }

  std::vector<Surface> surfaces_;
  std::vector<Node> nodes_;
  std::vector<int32_t> order_;    // surfaces in the order of the leaves
  std::vector<Corners> corners_;  // likewise
  double radius_ = 0;
};

}  // namespace physics
