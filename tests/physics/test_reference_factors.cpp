// The closed-form view factors against each other, against exact limits, and against numeric
// integrals of the point-to-polygon formula.
#include "physics/view_factors.h"
#include "support/check.h"

using namespace physics;

namespace {

// From the parallelogram to the polygon, by integration of the point-to-polygon factor.
double integrated(const Rule& rule, Vector corner, Vector u, Vector v, const Polygon& to) {
  const Vector n = normalized(cross(u, v));
  return mean_over(rule, corner, u, v, [&](Vector p) { return point_to_polygon(p, n, to); });
}

void gauss_rules_are_exact_for_polynomials() {
  for (int n : {1, 4, 24}) {
    const Rule rule = gauss_rule(n);
    CHECK_NEAR(integrate(rule, 0, 2, [&](double x) { return std::pow(x, 2 * n - 1); }),
               std::pow(2, 2 * n) / (2 * n), 1e-12 * std::pow(2, 2 * n));
  }
  CHECK_NEAR(integrate(graded_rule(24, 40), 0, 1, [](double x) { return std::log(x); }), -1, 1e-11);
  CHECK_NEAR(integrate(composite_rule(2, 64), 0, 1, [](double x) { return x * x; }), 1 / 3.0,
             1e-14);
}

void catalogue_values() {
  // Unit cube: opposite and adjoining faces.
  CHECK_NEAR(coaxial_rectangles(1, 1, 1), 0.19982489569838732, 1e-14);
  CHECK_NEAR(shared_edge_rectangles(1, 1, 1), 0.20004377607540316, 1e-14);
  // Very long strips: sqrt(1 + (c/a)^2) - c/a, and (1 + h/w - sqrt(1 + (h/w)^2)) / 2.
  CHECK_NEAR(coaxial_rectangles(1e5, 1, 0.5), std::sqrt(1.25) - 0.5, 1e-5);
  CHECK_NEAR(shared_edge_rectangles(1e5, 1, 2), 0.5 * (3 - std::sqrt(5.0)), 1e-4);
}

void corner_formulas_contain_the_others() {
  CHECK_NEAR(parallel_rectangles({0, 2}, {0, 3}, {0, 2}, {0, 3}, 1.5),
             coaxial_rectangles(2, 3, 1.5), 1e-13);
  CHECK_NEAR(perpendicular_rectangles({0, 2}, {0, 3}, {0, 1.5}, {0, 3}),
             shared_edge_rectangles(3, 2, 1.5), 1e-13);
}

void faces_of_a_box_sum_to_one() {
  const double a = 2, b = 3, c = 0.7;
  CHECK_NEAR(coaxial_rectangles(a, b, c) + 2 * shared_edge_rectangles(a, b, c) +
                 2 * shared_edge_rectangles(b, a, c),
             1, 1e-13);
  // The same with the ceiling and a wall in four and two pieces.
  double sum = shared_edge_rectangles(b, a, c) + 2 * shared_edge_rectangles(a, b, c);
  for (Interval xi : {Interval{0, 0.5}, Interval{0.5, a}})
    for (Interval eta : {Interval{0, 1.2}, Interval{1.2, b}})
      sum += parallel_rectangles({0, a}, {0, b}, xi, eta, c);
  for (Interval eta : {Interval{0, 1.2}, Interval{1.2, b}})
    sum += perpendicular_rectangles({0, a}, {0, b}, {0, c}, eta);
  CHECK_NEAR(sum, 1, 1e-13);
}

void factors_are_reciprocal() {
  const Interval x{0, 1}, y{0, 2}, xi{1.5, 2}, eta{-1, 0.5};
  CHECK_NEAR(parallel_rectangles(x, y, xi, eta, 0.8) * x.width() * y.width(),
             parallel_rectangles(xi, eta, x, y, 0.8) * xi.width() * eta.width(), 1e-14);
  CHECK_NEAR(perpendicular_rectangles(x, y, xi, eta) * x.width() * y.width(),
             perpendicular_rectangles(xi, eta, x, y) * xi.width() * eta.width(), 1e-14);
  CHECK_NEAR(wedge(1, 2, 3, 1.1) * 2, wedge(1, 3, 2, 1.1) * 3, 1e-11);
}

void offset_rectangles_match_integrals() {
  const Rule rule = gauss_rule(24);
  // The emitter looks down from z = 0.8, the receiver up.
  const Polygon above = parallelogram({1.5, -1, 0.8}, {0, 1.5, 0}, {0.5, 0, 0});
  CHECK_NEAR(integrated(rule, {0, 0, 0}, {1, 0, 0}, {0, 2, 0}, above),
             parallel_rectangles({0, 1}, {0, 2}, {1.5, 2}, {-1, 0.5}, 0.8), 1e-10);
  // The emitter stands in x = 0 from z = 0.3 to 1 and looks along +x.
  const Polygon upright = parallelogram({0, 3, 0.3}, {0, 1, 0}, {0, 0, 0.7});
  CHECK_NEAR(integrated(rule, {0.2, 0, 0}, {1, 0, 0}, {0, 2, 0}, upright),
             perpendicular_rectangles({0.2, 1.2}, {0, 2}, {0.3, 1}, {3, 4}), 1e-10);
}

void touching_rectangles_match_integrals() {
  const Rule rule = graded_rule(12, 24);
  const Polygon corner = parallelogram({0, 2, 0}, {0, 1, 0}, {0, 0, 1});
  CHECK_NEAR(integrated(rule, {0, 0, 0}, {1, 0, 0}, {0, 2, 0}, corner),
             perpendicular_rectangles({0, 1}, {0, 2}, {0, 1}, {2, 3}), 1e-8);
  const Polygon edge = parallelogram({0, 0, 0}, {0, 2, 0}, {0, 0, 1});
  CHECK_NEAR(integrated(rule, {0, 0, 0}, {1, 0, 0}, {0, 2, 0}, edge),
             shared_edge_rectangles(2, 1, 1), 1e-8);
}

void wedges_match_integrals() {
  CHECK_NEAR(wedge(1, 1, 1, pi / 2), shared_edge_rectangles(1, 1, 1), 1e-11);
  CHECK_NEAR(wedge(2, 1, 3, pi / 2), shared_edge_rectangles(2, 1, 3), 1e-11);
  const Rule rule = graded_rule(12, 24);
  for (double degrees : {15, 30, 60, 120, 150, 170}) {
    const double angle = degrees * pi / 180;
    const Vector leg = {std::cos(angle), 0, std::sin(angle)};
    const Polygon leaning = parallelogram({0, 0, 0}, {0, 2, 0}, leg * 1.5);
    CHECK_NEAR(integrated(rule, {0, 0, 0}, {1, 0, 0}, {0, 2, 0}, leaning), wedge(2, 1, 1.5, angle),
               2e-8);
    // Long wedges by the crossed-strings rule.
    const double chord = std::sqrt(2 - 2 * std::cos(angle));
    CHECK_NEAR(wedge(2e4, 1, 1, angle), 1 - chord / 2, 1e-4);
  }
}

void a_hemisphere_is_a_whole() {
  // The five other faces of a cube around a point on its floor.
  const Vector p = {0.3, 0.8, 0}, up = {0, 0, 1};
  const Polygon faces[] = {parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0}),
                           parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1}),
                           parallelogram({1, 0, 0}, {0, 0, 1}, {0, 1, 0}),
                           parallelogram({0, 0, 0}, {0, 0, 1}, {1, 0, 0}),
                           parallelogram({0, 1, 0}, {1, 0, 0}, {0, 0, 1})};
  double sum = 0;
  for (const Polygon& face : faces) sum += point_to_polygon(p, up, face);
  CHECK_NEAR(sum, 1, 1e-14);
  // A wall that reaches below the horizon counts its upper part alone.
  const Polygon deep = parallelogram({0, 0, -5}, {0, 1, 0}, {0, 0, 6});
  CHECK_NEAR(point_to_polygon(p, up, deep), point_to_polygon(p, up, faces[1]), 1e-14);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(gauss_rules_are_exact_for_polynomials),
      HRAD_TEST(catalogue_values),
      HRAD_TEST(corner_formulas_contain_the_others),
      HRAD_TEST(faces_of_a_box_sum_to_one),
      HRAD_TEST(factors_are_reciprocal),
      HRAD_TEST(offset_rectangles_match_integrals),
      HRAD_TEST(touching_rectangles_match_integrals),
      HRAD_TEST(wedges_match_integrals),
      HRAD_TEST(a_hemisphere_is_a_whole),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
