// Form factors between whole triangles: against closed forms and fine integration, with their
// stated errors.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "links/form_factor.h"
#include "links/mean_factor.h"
#include "support/check.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using hrad_test::Random;

Vec3 normal_of(const Triangle& t) { return normalized(t.area_vector()); }

// The mean over n*n equal parts.
double fine_mean(const Triangle& from, const Triangle& to, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      sum += point_to_triangle(from.at((i + 1.0 / 3) / n, (j + 1.0 / 3) / n), normal_of(from), to);
      if (i + j + 1 < n)
        sum +=
            point_to_triangle(from.at((i + 2.0 / 3) / n, (j + 2.0 / 3) / n), normal_of(from), to);
    }
  return sum / (static_cast<double>(n) * n);
}

// From one square to another, each of two triangles.
double of_squares(Vec3 a, Vec3 ax, Vec3 ay, Vec3 b, Vec3 bx, Vec3 by) {
  const Triangle from[2] = {{a, a + ax, a + ax + ay}, {a, a + ax + ay, a + ay}};
  const Triangle to[2] = {{b, b + bx, b + bx + by}, {b, b + bx + by, b + by}};
  double sum = 0;
  for (const Triangle& f : from)
    for (const Triangle& t : to) sum += mean_factor(f, normal_of(f), t).mean / 2;
  return sum;
}

void parallel_squares_have_their_closed_form() {
  for (double z : {0.05, 0.2, 0.5, 1.0, 3.0, 10.0}) {
    const double x = 1 / z, r = std::sqrt(1 + x * x);
    const double wanted = 2 / (pi * x * x) *
                          (std::log(r * r / std::sqrt(1 + 2 * x * x)) +
                           2 * x * r * std::atan(x / r) - 2 * x * std::atan(x));
    const double found =
        of_squares({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, z}, {0, 1, 0}, {1, 0, 0});
    CHECK_NEAR(found / wanted, 1, z < 0.2 ? 0.02 : 0.005);
  }
}

void squares_in_a_corner_have_their_closed_form() {
  // Unit squares at right angles that share an edge.
  const double found = of_squares({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  CHECK_NEAR(found, 0.200044, 0.004);
}

void any_pair_agrees_with_fine_integration() {
  Random random(91);
  int lit = 0, within = 0;
  for (int k = 0; k < 400; ++k) {
    const Vec3 p = random.in_cube(1), q = random.in_cube(1);
    const Triangle from{p, p + random.in_cube(1), p + random.in_cube(1)};
    const Triangle to{q, q + random.in_cube(1), q + random.in_cube(1)};
    const double wanted = fine_mean(from, to, 48);
    const MeanFactor found = mean_factor(from, normal_of(from), to);
    CHECK(found.mean >= 0 && found.mean <= 1 && found.error >= 0 && found.half_range >= 0);
    CHECK(found.half_range <= 0.5);
    CHECK_NEAR(found.mean, wanted, 0.01);
    if (!(wanted > 1e-4)) continue;
    ++lit;
    within += std::fabs(found.mean - wanted) <= 2 * found.error + 1e-3 * wanted;
  }
  CHECK(lit > 50);
  CHECK(within > 0.9 * lit);
}

// The half range is that of the quarters' means.
void half_range_tells_the_quarters_apart() {
  const Triangle from{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Triangle above{{0, 0, 0.4}, {0, 1, 0.4}, {1, 0, 0.4}};
  const Vec3 ab{0.5, 0, 0}, bc{0.5, 0.5, 0}, ca{0, 0.5, 0};
  const Triangle quarters[4] = {{from.a, ab, ca}, {ab, from.b, bc}, {ca, bc, from.c}, {bc, ca, ab}};
  double low = 1, high = 0;
  for (const Triangle& quarter : quarters) {
    const double mean = fine_mean(quarter, above, 32);
    low = std::min(low, mean);
    high = std::max(high, mean);
  }
  CHECK_NEAR(mean_factor(from, {0, 0, 1}, above).half_range, (high - low) / 2, 0.01);
  // From afar all quarters see the same.
  const Triangle far{{0, 0, 50}, {0, 1, 50}, {1, 0, 50}};
  const MeanFactor found = mean_factor(from, {0, 0, 1}, far);
  CHECK(found.half_range < 1e-3 * found.mean);
  CHECK(found.error < 1e-3 * found.mean);
}

void what_is_turned_away_counts_nothing() {
  const Triangle from{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Triangle back{{0, 0, 0.4}, {1, 0, 0.4}, {0, 1, 0.4}};
  const Triangle below{{0, 0, -0.4}, {0, 1, -0.4}, {1, 0, -0.4}};
  for (const Triangle& to : {back, below, from}) {
    const MeanFactor found = mean_factor(from, {0, 0, 1}, to);
    CHECK_EQUAL(found.mean, 0.0);
    CHECK_EQUAL(found.error, 0.0);
    CHECK_EQUAL(found.half_range, 0.0);
  }
}

// A spot hard over a large triangle is not missed, wherever it is.
void small_spots_are_not_missed() {
  Random random(92);
  const Triangle from{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (int k = 0; k < 200; ++k) {
    const Vec3 p = hrad_test::point_on(from, random) + Vec3{0, 0, 0.05};
    const Triangle spot{p, p + Vec3{0, 0.05, 0}, p + Vec3{0.05, 0, 0}};
    const double wanted = fine_mean(from, spot, 64);
    CHECK_NEAR(mean_factor(from, {0, 0, 1}, spot).mean / wanted, 1, 0.5);
  }
}

void distances_are_to_the_nearest_point() {
  Random random(93);
  for (int k = 0; k < 2000; ++k) {
    const Triangle t{random.in_cube(1), random.in_cube(1), random.in_cube(1)};
    const Vec3 p = random.in_cube(k % 2 ? 1.0 : 3.0);
    const double found = distance_to_triangle(p, t);
    // No point of the triangle is nearer, and one of a fine set is about as near.
    double nearest = 1e300;
    constexpr int n = 24;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        nearest = std::min(
            nearest, length(t.at(i / static_cast<double>(n), j / static_cast<double>(n)) - p));
    CHECK(found <= nearest + 1e-12);
    CHECK(found >= nearest - 3.5 / n);
    if (found < 0.2) continue;
    // Moving the point towards the triangle's nearest point by this length touches it: moving by
    // less in any direction doesn't.
    const Vec3 moved = p + normalized(random.in_cube(1)) * (0.9 * found);
    CHECK(distance_to_triangle(moved, t) >= 0.1 * found - 1e-9);
  }
  const Triangle t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK_NEAR(distance_to_triangle({0.2, 0.2, 3}, t), 3, 1e-12);  // the inside
  CHECK_NEAR(distance_to_triangle({0.5, -2, 0}, t), 2, 1e-12);   // an edge
  CHECK_NEAR(distance_to_triangle({1, 1, 0}, t), std::sqrt(0.5), 1e-12);
  CHECK_NEAR(distance_to_triangle({-3, -4, 0}, t), 5, 1e-12);  // a corner
  CHECK_NEAR(distance_to_triangle({0.3, 0.3, 0}, t), 0, 1e-12);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(parallel_squares_have_their_closed_form),
      HRAD_TEST(squares_in_a_corner_have_their_closed_form),
      HRAD_TEST(any_pair_agrees_with_fine_integration),
      HRAD_TEST(half_range_tells_the_quarters_apart),
      HRAD_TEST(what_is_turned_away_counts_nothing),
      HRAD_TEST(small_spots_are_not_missed),
      HRAD_TEST(distances_are_to_the_nearest_point),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
