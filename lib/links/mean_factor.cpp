// Midpoint rules on subdivided triangles, with one step of extrapolation. Floor 6 (links).
#include "links/mean_factor.h"

#include <algorithm>

#include "links/form_factor.h"

namespace hrad {
namespace {

// Subdivided until the radius is below this share of the distance, but not deeper than so many
// levels.
constexpr double fine_enough = 0.7;
constexpr int deepest = 3;

struct Part {
  double mean, error;
};

Triangle quarter(const Triangle& t, int k) {
  const Vec3 ab = (t.a + t.b) * 0.5, bc = (t.b + t.c) * 0.5, ca = (t.c + t.a) * 0.5;
  switch (k) {
    case 0:
      return {t.a, ab, ca};
    case 1:
      return {ab, t.b, bc};
    case 2:
      return {ca, bc, t.c};
    default:
      return {bc, ca, ab};
  }
}

// The midpoint rule with four points, extrapolated: its error falls to a quarter from one point to
// four, so a third of the difference is left over, and is taken away (Richardson).
Part four_points(const Triangle& t, Vec3 normal, const Triangle& to, double values[4]) {
  const Vec3 center = t.centroid();
  // The centroid of the quarter at a corner lies halfway between the corner and the centroid.
  values[0] = point_to_triangle((t.a + center) * 0.5, normal, to);
  values[1] = point_to_triangle((t.b + center) * 0.5, normal, to);
  values[2] = point_to_triangle((t.c + center) * 0.5, normal, to);
  values[3] = point_to_triangle(center, normal, to);
  const double four = ((values[0] + values[1]) + (values[2] + values[3])) * 0.25;
  const double step = (four - values[3]) / 3;
  return {std::max(0.0, std::min(1.0, four + step)), std::fabs(step)};
}

Part integrate(const Triangle& t, Vec3 normal, const Triangle& to, int level) {
  const Vec3 center = t.centroid();
  if (level == deepest || t.radius() <= fine_enough * distance_to_triangle(center, to)) {
    double unused[4];
    return four_points(t, normal, to, unused);
  }
  Part sum{0, 0};
  for (int k = 0; k < 4; ++k) {
    const Part part = integrate(quarter(t, k), normal, to, level + 1);
    sum.mean += part.mean / 4;
    sum.error += part.error / 4;
  }
  return sum;
}

}  // namespace

// Ericson, "Real-Time Collision Detection" (2005), Section 5.1.5: the region of the plane that the
// point projects into decides which corner, edge or inner point is nearest.
double distance_to_triangle(Vec3 p, const Triangle& t) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return length(ap);
  const Vec3 bp = p - t.b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return length(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return length(ap - ab * (d1 / (d1 - d3)));
  const Vec3 cp = p - t.c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return length(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return length(ap - ac * (d2 / (d2 - d6)));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return length(bp - (t.c - t.b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  const double scale = 1 / (va + vb + vc);
  return length(ap - ab * (vb * scale) - ac * (vc * scale));
}

MeanFactor mean_factor(const Triangle& from, Vec3 normal, const Triangle& to) {
  MeanFactor result;
  const Vec3 center = from.centroid();
  double value[4];
  if (from.radius() <= fine_enough * distance_to_triangle(center, to)) {
    const Part whole = four_points(from, normal, to, value);
    result.mean = whole.mean;
    result.error = whole.error;
  } else {
    for (int k = 0; k < 4; ++k) {
      const Part part = integrate(quarter(from, k), normal, to, 1);
      value[k] = part.mean;
      result.mean += part.mean / 4;
      result.error += part.error / 4;
    }
  }
  const auto range = std::minmax({value[0], value[1], value[2], value[3]});
  result.half_range = (range.second - range.first) / 2;
  return result;
}

}  // namespace hrad
