// Ear clipping: a corner whose diagonal lies inside is cut off until three are left. Which corners
// may lie in an ear is asked of a tree, so that a polygon of n corners takes about n sqrt(n) steps
// at worst. Floor 3 (scene).
#include "scene/triangulate.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

#include "scene/point_tree.h"

namespace hrad {

namespace {

// Rounding of a turn, relative to the size of the polygon times the length of its sides: below it
// three corners count as lying on a line.
constexpr double turn_rounding = 1e-15;

void fan(size_t n, std::vector<std::array<int32_t, 3>>& triangles) {
  for (size_t i = 2; i < n; ++i)
    triangles.push_back({0, static_cast<int32_t>(i - 1), static_cast<int32_t>(i)});
}

// The polygon along the dominant axis of its vector area, anticlockwise.
struct Outline {
  std::vector<Point> points;  // empty without an area
  double size = 0;            // of its largest coordinate
  int turns = 0;              // how often it turns round: 1 unless it crosses itself
  bool convex = true;

  explicit Outline(Span<const Vec3> polygon) {
    const Vec3 origin = polygon[0];
    Vec3 normal;
    for (size_t i = 1; i + 1 < polygon.size(); ++i)
      normal = normal + cross(polygon[i] - origin, polygon[i + 1] - origin);
    const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
    const int axis = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    if (normal[axis] == 0) return;
    const int first = (axis + 1) % 3, second = (axis + 2) % 3;
    points.reserve(polygon.size());
    for (const Vec3& corner : polygon) {
      const Vec3 p = corner - origin;
      points.push_back(normal[axis] > 0 ? Point{p[first], p[second]} : Point{p[second], p[first]});
      size = std::max({size, std::fabs(p[first]), std::fabs(p[second])});
    }
    const int32_t n = static_cast<int32_t>(points.size());
    for (int32_t i = 0; i < n; ++i) visit(i == 0 ? n - 1 : i - 1, i, i + 1 == n ? 0 : i + 1);
  }

  // 1: the outline turns left at b, -1: right, 0: it goes straight on or back, within rounding.
  int side(int32_t a, int32_t b, int32_t c) const {
    const Point p = points[a], q = points[b], r = points[c];
    const double reach =
        std::fabs(q.x - p.x) + std::fabs(q.y - p.y) + std::fabs(r.x - q.x) + std::fabs(r.y - q.y);
    const double bend = turn(p, q, r), limit = turn_rounding * size * reach;
    return bend > limit ? 1 : bend < -limit ? -1 : 0;
  }

 private:
  // A turn round is counted when the direction passes that of the first axis.
  void visit(int32_t a, int32_t b, int32_t c) {
    const double before = points[b].y - points[a].y, after = points[c].y - points[b].y;
    const double bend = turn(points[a], points[b], points[c]);
    if (before < 0 && after >= 0 && bend > 0) ++turns;
    if (before >= 0 && after < 0 && bend < 0) --turns;
    if (side(a, b, c) <= 0) convex = false;
  }
};

bool same(Point a, Point b) { return a.x == b.x && a.y == b.y; }

class EarClipper {
 public:
  EarClipper(const Outline& outline, std::vector<std::array<int32_t, 3>>& triangles)
      : outline_(outline),
        points_(outline.points),
        triangles_(triangles),
        tree_(points_),
        left_(points_.size()),
        next_(points_.size()),
        previous_(points_.size()),
        twin_(points_.size(), 0),
        candidates_(points_.size()) {
    const int32_t n = static_cast<int32_t>(points_.size());
    for (int32_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      previous_[i] = (i + n - 1) % n;
    }
    mark_twins();
    for (int32_t i = 0; i < n; ++i) {
      sides_.push_back(outline.side(previous_[i], i, next_[i]));
      tree_.set_alive(i, blocks(i));
    }
  }

  // False when corners are left among which there is no ear.
  bool clip() {
    std::iota(candidates_.begin(), candidates_.end(), 0);
    do {
      while (left_ > 3 && !candidates_.empty()) {
        const int32_t i = candidates_.front();
        candidates_.pop_front();
        if (next_[i] < 0 || !is_ear(i)) continue;
        triangles_.push_back({previous_[i], i, next_[i]});
        remove(i);
      }
    } while (left_ > 3 && remove_flat_corners());
    if (left_ > 3 || sides_[last_] < 0) return false;
    if (sides_[last_] > 0) triangles_.push_back({previous_[last_], last_, next_[last_]});
    return true;
  }

 private:
  // Only these can lie in an ear or pass through one.
  bool blocks(int32_t i) const { return sides_[i] <= 0 || twin_[i]; }

  void mark_twins() {
    std::vector<int32_t> order(points_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int32_t i, int32_t j) {
      const Point p = points_[i], q = points_[j];
      return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : i < j;
    });
    for (size_t i = 1; i < order.size(); ++i)
      if (same(points_[order[i - 1]], points_[order[i]])) twin_[order[i - 1]] = twin_[order[i]] = 1;
  }

  bool is_ear(int32_t i) const {
    if (sides_[i] <= 0) return false;
    const int32_t before = previous_[i], after = next_[i];
    const Point a = points_[before], b = points_[i], c = points_[after];
    return !tree_.any_in(a, b, c, [&](int32_t j) {
      if (j == before || j == i || j == after) return false;
      const Point p = points_[j];
      // At a corner of the ear: in the way if the outline goes on into it from there.
      if (same(p, a)) return enters(j, b, c);
      if (same(p, b)) return enters(j, c, a);
      if (same(p, c)) return enters(j, a, b);
      return sides_[j] <= 0 && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }

  // A side of the outline at j leads between the directions to `from` and `to`.
  bool enters(int32_t j, Point from, Point to) const {
    const Point p = points_[j];
    for (const int32_t neighbour : {previous_[j], next_[j]}) {
      const Point q = points_[neighbour];
      if (turn(p, from, q) > 0 && turn(p, q, to) > 0) return true;
    }
    return false;
  }

  // Whether a corner is an ear changes with its neighbours alone: only those are asked again.
  void remove(int32_t i) {
    const int32_t before = previous_[i], after = next_[i];
    tree_.set_alive(i, false);
    next_[before] = after;
    previous_[after] = before;
    next_[i] = -1;
    --left_;
    last_ = before;
    for (const int32_t j : {before, after}) {
      sides_[j] = outline_.side(previous_[j], j, next_[j]);
      tree_.set_alive(j, blocks(j));
      candidates_.push_back(j);
    }
  }

  // Takes out, without a triangle, what is left of the outline as lines without area. False when
  // there is no such corner.
  bool remove_flat_corners() {
    const size_t before = left_;
    for (size_t i = 0; i < sides_.size() && left_ > 3; ++i)
      if (next_[i] >= 0 && sides_[i] == 0) remove(static_cast<int32_t>(i));
    return left_ < before;
  }

  const Outline& outline_;
  const std::vector<Point>& points_;
  std::vector<std::array<int32_t, 3>>& triangles_;
  PointTree tree_;
  size_t left_;
  std::vector<int32_t> next_, previous_;  // next is -1 for a corner that was cut off
  std::vector<uint8_t> twin_;             // another corner lies at the same place
  std::vector<int> sides_;
  std::deque<int32_t> candidates_;
  int32_t last_ = 0;  // a corner that is still there
};

}  // namespace

bool triangulate(Span<const Vec3> polygon, std::vector<std::array<int32_t, 3>>& triangles) {
  const size_t n = polygon.size();
  if (n == 3) {
    fan(n, triangles);
    return true;
  }
  const Outline outline(polygon);
  if (outline.turns == 1) {
    const size_t before = triangles.size();
    if (outline.convex) {
      fan(n, triangles);
      return true;
    }
    if (EarClipper(outline, triangles).clip()) return true;
    triangles.resize(before);
  }
  fan(n, triangles);
  return false;
}

}  // namespace hrad
