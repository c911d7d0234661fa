// Lambert's formula, two edges at a time. Floor 6 (links).
#include "links/form_factor.h"

#include <cmath>

#include "base/angle.h"

namespace hrad {
namespace {

using Two = double __attribute__((vector_size(2 * sizeof(double))));

// Edges of a triangle cut off at the horizon, four at the most. Two take each step together, to the
// bit what they would be one by one.
class Outline {
 public:
  void add(Vec3 from, Vec3 to) {
    Edges& two = edges_[count_ / 2];
    const int lane = count_++ % 2;
    two.from.set(lane, from);
    two.to.set(lane, to);
  }

  // Over the edges: the angle between the directions to their ends times the cosine between the
  // normal and the edge's own normal. Twice pi times the form factor.
  double sum(Vec3 normal) const {
    double sum = 0;
    for (int k = 0; k < count_; k += 2) {
      const Points &a = edges_[k / 2].from, &b = edges_[k / 2].to;
      const Two x = a.y * b.z - a.z * b.y, y = a.z * b.x - a.x * b.z, z = a.x * b.y - a.y * b.x;
      const Two square = x * x + y * y + z * z;
      const Two sine = {std::sqrt(square[0]), std::sqrt(square[1])};
      const Two term = angles_of(sine, a.x * b.x + a.y * b.y + a.z * b.z) *
                       (x * normal.x + y * normal.y + z * normal.z) / sine;
      for (int lane = 0; lane < 2; ++lane)
        if (sine[lane] > 0) sum += term[lane];
    }
    return sum;
  }

 private:
  struct Points {
    Two x{}, y{}, z{};
    void set(int lane, Vec3 p) {
      x[lane] = p.x;
      y[lane] = p.y;
      z[lane] = p.z;
    }
  };
  struct Edges {
    Points from, to;
  };
  Edges edges_[2];
  int count_ = 0;
};

}  // namespace

double point_to_triangle(Vec3 x, Vec3 normal, const Triangle& source) {
  if (dot(source.area_vector(), source.a - x) >= 0) return 0;  // x sees its back
  const Vec3 corner[3] = {source.a - x, source.b - x, source.c - x};
  const double height[3] = {dot(corner[0], normal), dot(corner[1], normal), dot(corner[2], normal)};
  Outline outline;
  Vec3 leaving, entering;  // where it crosses the horizon
  bool crosses = false;
  for (int k = 0; k < 3; ++k) {
    const int next = k == 2 ? 0 : k + 1;
    const bool above = height[k] > 0, next_above = height[next] > 0;
    if (!above && !next_above) continue;
    if (above && next_above) {
      outline.add(corner[k], corner[next]);
      continue;
    }
    const double t = height[k] / (height[k] - height[next]);
    const Vec3 horizon = corner[k] + (corner[next] - corner[k]) * t;
    crosses = true;
    if (above) {
      outline.add(corner[k], horizon);
      leaving = horizon;
    } else {
      outline.add(horizon, corner[next]);
      entering = horizon;
    }
  }
  if (crosses) outline.add(leaving, entering);
  // Seen from its front a triangle turns clockwise around the line of sight.
  const double factor = -outline.sum(normal) * (1 / (2 * pi));
  return factor < 0 ? 0 : factor > 1 ? 1 : factor;
}

}  // namespace hrad
