// A tree of points in the plane that answers which of the living ones may lie in a triangle. Floor
// 3 (scene).
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace hrad {

struct Point {
  double x, y;
};

// Twice the signed area of a triangle; positive when it runs anticlockwise.
inline double turn(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class PointTree {
 public:
  // The points must outlive the tree; all are dead at first.
  explicit PointTree(const std::vector<Point>& points)
      : points_(points), order_(points.size()), slot_(points.size()), alive_(points.size(), 0) {
    std::iota(order_.begin(), order_.end(), 0);
    while ((size_t{leaf_size} << depth_) < points.size()) ++depth_;
    nodes_.resize((size_t{2} << depth_) - 1);
    build(0, 0, static_cast<int32_t>(points.size()), 0);
    for (size_t i = 0; i < order_.size(); ++i) slot_[order_[i]] = static_cast<int32_t>(i);
  }

  void set_alive(int32_t point, bool alive) {
    if (alive_[point] == alive) return;
    alive_[point] = alive;
    int32_t node = 0;
    for (int level = 0;; ++level) {
      nodes_[node].alive += alive ? 1 : -1;
      if (level == depth_) return;
      node = 2 * node + 1;
      if (slot_[point] >= nodes_[node].end) ++node;
    }
  }

  // Calls test(point) for living points until one answers true; then true. Points outside the
  // triangle (anticlockwise) may be among them, none inside or on it is left out.
  template <class Test>
  bool any_in(Point a, Point b, Point c, const Test& test) const {
    int32_t stack[64];
    int top = 0;
    stack[top++] = 0;
    const Point corners[3] = {a, b, c};
    while (top > 0) {
      const int32_t number = stack[--top];
      const Node& node = nodes_[number];
      if (node.alive == 0 || apart(node, corners)) continue;
      if (2 * static_cast<size_t>(number) + 2 < nodes_.size()) {
        stack[top++] = 2 * number + 2;
        stack[top++] = 2 * number + 1;
        continue;
      }
      for (int32_t i = node.begin; i < node.end; ++i)
        if (alive_[order_[i]] && test(order_[i])) return true;
    }
    return false;
  }

 private:
  static constexpr int leaf_size = 8;
  struct Node {
    Point low{1e300, 1e300}, high{-1e300, -1e300};
    int32_t begin = 0, end = 0, alive = 0;
  };

  // Splits at the median of the longer side.
  void build(int32_t number, int32_t begin, int32_t end, int level) {
    Node& node = nodes_[number];
    node.begin = begin;
    node.end = end;
    for (int32_t i = begin; i < end; ++i) {
      const Point p = points_[order_[i]];
      node.low = {std::min(node.low.x, p.x), std::min(node.low.y, p.y)};
      node.high = {std::max(node.high.x, p.x), std::max(node.high.y, p.y)};
    }
    if (level == depth_) return;
    const bool along_x = node.high.x - node.low.x > node.high.y - node.low.y;
    const int32_t middle = begin + (end - begin) / 2;
    const auto before = [&](int32_t i, int32_t j) {
      const double u = along_x ? points_[i].x : points_[i].y;
      const double v = along_x ? points_[j].x : points_[j].y;
      return u != v ? u < v : i < j;
    };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, before);
    build(2 * number + 1, begin, middle, level + 1);
    build(2 * number + 2, middle, end, level + 1);
  }

  // The node's box lies outside one side of the triangle or of the triangle's box.
  static bool apart(const Node& node, const Point (&t)[3]) {
    if (std::max({t[0].x, t[1].x, t[2].x}) < node.low.x ||
        std::min({t[0].x, t[1].x, t[2].x}) > node.high.x ||
        std::max({t[0].y, t[1].y, t[2].y}) < node.low.y ||
        std::min({t[0].y, t[1].y, t[2].y}) > node.high.y)
      return true;
    for (int i = 0; i < 3; ++i) {
      const Point a = t[i], b = t[(i + 1) % 3];
      // The corner of the box that lies farthest inside.
      const Point corner{b.y > a.y ? node.low.x : node.high.x,
                         b.x > a.x ? node.high.y : node.low.y};
      if (turn(a, b, corner) < 0) return true;
    }
    return false;
  }

  const std::vector<Point>& points_;
  std::vector<int32_t> order_, slot_;
  std::vector<uint8_t> alive_;
  std::vector<Node> nodes_;
  int depth_ = 0;
};

}  // namespace hrad
