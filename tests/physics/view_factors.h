// View factors in closed form. The corner formulas are those of J.R. Ehlert and T.F. Smith, "View
// factors for perpendicular and parallel rectangular plates", J. Thermophysics and Heat Transfer 7
// (1993); the coaxial and the shared-edge ones those of the catalogues (Howell C-11, C-14); the
// wedge follows from the contour integral A1 F12 = (1/2pi) o o ln r ds1.ds2 (Cohen and
// Wallace, 4.3).
#pragma once

#include <algorithm>
#include <cmath>

#include "physics/quadrature.h"
#include "physics/vector.h"

namespace physics {

// Two equal rectangles a x b face to face at distance c.
inline double coaxial_rectangles(double a, double b, double c) {
  const double x = a / c, y = b / c;
  const double x1 = 1 + x * x, y1 = 1 + y * y;
  return 2 / (pi * x * y) *
         (std::log(std::sqrt(x1 * y1 / (x1 + y * y))) +
          x * std::sqrt(y1) * std::atan(x / std::sqrt(y1)) +
          y * std::sqrt(x1) * std::atan(y / std::sqrt(x1)) - x * std::atan(x) - y * std::atan(y));
}

// From a rectangle edge x depth to a rectangle edge x height that stands upright on the shared
// edge.
inline double shared_edge_rectangles(double edge, double depth, double height) {
  const double h = height / edge, w = depth / edge;
  const double h2 = h * h, w2 = w * w, hw = h2 + w2;
  const double logarithm = std::log((1 + w2) * (1 + h2) / (1 + hw)) +
                           w2 * std::log(w2 * (1 + hw) / ((1 + w2) * hw)) +
                           h2 * std::log(h2 * (1 + hw) / ((1 + h2) * hw));
  return 1 / (pi * w) *
         (w * std::atan(1 / w) + h * std::atan(1 / h) -
          std::sqrt(hw) * std::atan(1 / std::sqrt(hw)) + 0.25 * logarithm);
}

struct Interval {
  double from = 0, to = 0;
  double operator[](int i) const { return i == 0 ? from : to; }
  double width() const { return to - from; }
};

// Sums the alternating corner terms G(x_i, y_j, eta_k, xi_l) and divides by the first area.
template <typename CornerTerm>
double corner_sum(Interval x, Interval y, Interval eta, Interval xi, CornerTerm term) {
  double sum = 0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l)
          sum += ((i + j + k + l) % 2 == 0 ? 1 : -1) * term(x[i], y[j], eta[k], xi[l]);
  return sum / (2 * pi * x.width() * y.width());
}

// From x by y in the plane z = 0 to xi (along x) by eta (along y) in the plane z = distance.
inline double parallel_rectangles(Interval x, Interval y, Interval xi, Interval eta,
                                  double distance) {
  const double z2 = distance * distance;
  return corner_sum(x, y, eta, xi, [z2](double x, double y, double eta, double xi) {
    const double dx = x - xi, dy = y - eta;
    const double sx = std::sqrt(dx * dx + z2), sy = std::sqrt(dy * dy + z2);
    return dy * sx * std::atan(dy / sx) + dx * sy * std::atan(dx / sy) -
           0.5 * z2 * std::log(dx * dx + dy * dy + z2);
  });
}

// From x by y in the plane z = 0 (x >= 0) to z = xi (>= 0) by y = eta in the plane x = 0.
inline double perpendicular_rectangles(Interval x, Interval y, Interval xi, Interval eta) {
  return corner_sum(x, y, eta, xi, [](double x, double y, double eta, double xi) {
    const double s2 = x * x + xi * xi, dy = y - eta, r2 = s2 + dy * dy;
    if (r2 == 0) return 0.0;  // the limit
    const double s = std::sqrt(s2);
    const double angle = s > 0 ? dy * s * std::atan(dy / s) : 0;
    return angle - 0.25 * (s2 - dy * dy) * std::log(r2);
  });
}

// Integral of ln r over two parallel segments of the same length, face to face at a distance.
inline double parallel_edges(double edge, double distance) {
  const double l2 = edge * edge, d2 = distance * distance;
  if (distance == 0) return l2 * (std::log(edge) - 1.5);
  return 0.5 * (l2 - d2) * std::log(l2 + d2) + d2 * std::log(distance) +
         2 * edge * distance * std::atan(edge / distance) - 1.5 * l2;
}

// Integral of ln r over segments of lengths a and b that leave two points `offset` apart (along the
// common edge) and include an angle: the inner integral in closed form, the outer one by
// quadrature.
inline double inclined_edges(double a, double b, double angle, double offset) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Rule rule = graded_rule(24, 40);
  return integrate(rule, 0, a, [=](double p) {
    const double height2 = p * p * s * s + offset * offset, height = std::sqrt(height2);
    const auto primitive = [=](double t) {
      return 0.5 * t * std::log(t * t + height2) - t + height * std::atan(t / height);
    };
    return primitive(b - p * c) - primitive(-p * c);
  });
}

// From a rectangle edge x width1 to a rectangle edge x width2 that share the edge and include an
// angle (radians, less than pi) in front of them.
inline double wedge(double edge, double width1, double width2, double angle) {
  const double c = std::cos(angle);
  const double far2 = width1 * width1 + width2 * width2 - 2 * width1 * width2 * c;
  // Pairs of edges along y run against each other at the shared edge, and so on alternately.
  const double along = -parallel_edges(edge, 0) + parallel_edges(edge, width1) +
                       parallel_edges(edge, width2) - parallel_edges(edge, std::sqrt(far2));
  const double across =
      2 * c *
      (inclined_edges(width1, width2, angle, edge) - inclined_edges(width1, width2, angle, 0));
  return (along + across) / (2 * pi * edge * width1);
}

// The part of a polygon in front of a point with a normal (height above its plane >= 0).
inline Polygon clipped_at_horizon(const Polygon& polygon, Vector point, Vector normal) {
  Polygon kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vector a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double ha = dot(a - point, normal), hb = dot(b - point, normal);
    if (ha >= 0) kept.push_back(a);
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) kept.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  return kept;
}

// From a small element at a point with a normal to a polygon's front (Lambert's formula); 0 when
// the point is behind the polygon.
inline double point_to_polygon(Vector point, Vector normal, const Polygon& polygon) {
  if (dot(doubled_area(polygon), point - polygon[0]) <= 0) return 0;
  const Polygon seen = clipped_at_horizon(polygon, point, normal);
  double sum = 0;
  for (size_t i = 0; i < seen.size() && seen.size() >= 3; ++i) {
    const Vector a = seen[i] - point, b = seen[(i + 1) % seen.size()] - point;
    const Vector axis = cross(a, b);
    const double sine = length(axis);
    if (sine > 0) sum += dot(normal, axis) / sine * std::atan2(sine, dot(a, b));
  }
  // Anticlockwise seen from its front is clockwise seen by the point.
  return std::max(0.0, -sum / (2 * pi));
}

}  // namespace physics
