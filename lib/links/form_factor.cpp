// Lambert's formula, edge by edge. Floor 6 (links).
#include "links/form_factor.h"

#include "base/angle.h"

namespace hrad {
namespace {

// Angle between two directions times the cosine between the normal and the edge's own normal:
// twice pi times what this edge adds to the form factor.
double edge_term(Vec3 a, Vec3 b, Vec3 normal) {
  const Vec3 c = cross(a, b);
  const double sine = length(c);
  if (!(sine > 0)) return 0;
  return angle_of(sine, dot(a, b)) * dot(c, normal) / sine;
}

}  // namespace

double point_to_triangle(Vec3 x, Vec3 normal, const Triangle& source) {
  if (dot(source.area_vector(), source.a - x) >= 0) return 0;  // x sees its back
  const Vec3 corner[3] = {source.a - x, source.b - x, source.c - x};
  const double height[3] = {dot(corner[0], normal), dot(corner[1], normal), dot(corner[2], normal)};
  double sum = 0;
  Vec3 leaving, entering;  // where the outline crosses the horizon
  bool crosses = false;
  for (int k = 0; k < 3; ++k) {
    const int next = k == 2 ? 0 : k + 1;
    const bool above = height[k] > 0, next_above = height[next] > 0;
    if (!above && !next_above) continue;
    if (above && next_above) {
      sum += edge_term(corner[k], corner[next], normal);
      continue;
    }
    const double t = height[k] / (height[k] - height[next]);
    const Vec3 horizon = corner[k] + (corner[next] - corner[k]) * t;
    crosses = true;
    if (above) {
      sum += edge_term(corner[k], horizon, normal);
      leaving = horizon;
    } else {
      sum += edge_term(horizon, corner[next], normal);
      entering = horizon;
    }
  }
  if (crosses) sum += edge_term(leaving, entering, normal);
  // Seen from its front a triangle turns clockwise around the line of sight.
  const double factor = -sum * (1 / (2 * pi));
  return factor < 0 ? 0 : factor > 1 ? 1 : factor;
}

}  // namespace hrad
