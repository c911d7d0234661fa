// Numeric integration for the view factors: Gauss-Legendre rules, graded towards ends where an
// integrand has a kink or a logarithm.
#pragma once

#include <cmath>
#include <vector>

#include "physics/vector.h"

namespace physics {

struct Rule {
  std::vector<double> points, weights;  // on [0, 1]; the weights sum to 1
};

// n points, exact for polynomials of degree 2n - 1.
inline Rule gauss_rule(int n) {
  Rule rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 100; ++step) {  // Newton on the Legendre polynomial
      double p = 1, previous = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
        previous = p;
        p = next;
      }
      slope = n * (x * p - previous) / (x * x - 1);
      const double move = p / slope;
      x -= move;
      if (std::fabs(move) < 1e-16) break;
    }
    rule.points.push_back(0.5 * (1 - x));
    rule.weights.push_back(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

// The rule on `levels` intervals that halve in size towards both ends of [0, 1].
inline Rule graded_rule(int n, int levels) {
  const Rule base = gauss_rule(n);
  std::vector<double> ends = {0};
  for (int i = levels; i >= 1; --i) ends.push_back(std::ldexp(1.0, -i));
  for (int i = 2; i <= levels; ++i) ends.push_back(1 - std::ldexp(1.0, -i));
  ends.push_back(1);
  Rule rule;
  for (size_t k = 0; k + 1 < ends.size(); ++k) {
    const double width = ends[k + 1] - ends[k];
    for (int i = 0; i < n; ++i) {
      rule.points.push_back(ends[k] + width * base.points[i]);
      rule.weights.push_back(width * base.weights[i]);
    }
  }
  return rule;
}

// The rule repeated on `pieces` equal intervals.
inline Rule composite_rule(int n, int pieces) {
  const Rule base = gauss_rule(n);
  Rule rule;
  for (int k = 0; k < pieces; ++k) {
    for (int i = 0; i < n; ++i) {
      rule.points.push_back((k + base.points[i]) / pieces);
      rule.weights.push_back(base.weights[i] / pieces);
    }
  }
  return rule;
}

template <typename Function>
double integrate(const Rule& rule, double from, double to, Function f) {
  double sum = 0;
  for (size_t i = 0; i < rule.points.size(); ++i)
    sum += rule.weights[i] * f(from + (to - from) * rule.points[i]);
  return sum * (to - from);
}

// The mean of f over the parallelogram corner + s u + t v, 0 <= s, t <= 1.
template <typename Function>
double mean_over(const Rule& rule, Vector corner, Vector u, Vector v, Function f) {
  double sum = 0;
  for (size_t i = 0; i < rule.points.size(); ++i)
    for (size_t j = 0; j < rule.points.size(); ++j)
      sum +=
          rule.weights[i] * rule.weights[j] * f(corner + u * rule.points[i] + v * rule.points[j]);
  return sum;
}

}  // namespace physics
