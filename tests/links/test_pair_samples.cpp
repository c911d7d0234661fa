// Sample pairs: spread evenly on both sides, on their surfaces, with the kernel between them.
#include <cmath>
#include <set>
#include <vector>

#include "base/angle.h"
#include "base/hash.h"
#include "links/pair_samples.h"
#include "support/check.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using hrad_test::Random;

// The quarter of the unit triangle that holds (u,v); turns them into coordinates within it.
int quarter_of(double& u, double& v) {
  const int quarter = u > 0.5 ? 1 : v > 0.5 ? 2 : u + v < 0.5 ? 0 : 3;
  u = quarter == 1 ? 2 * u - 1 : quarter == 3 ? 1 - 2 * u : 2 * u;
  v = quarter == 2 ? 2 * v - 1 : quarter == 3 ? 1 - 2 * v : 2 * v;
  return quarter;
}

int sixteenth_of(const double uv[2]) {
  double u = uv[0], v = uv[1];
  const int quarter = quarter_of(u, v);
  return 4 * quarter + quarter_of(u, v);
}

Element element(const Triangle& t) {
  Element e;
  e.corners = t;
  e.normal = normalized(t.area_vector());
  e.centroid = t.centroid();
  e.area = length(t.area_vector()) / 2;
  return e;
}

Element random_element(Random& random, double size) {
  const Vec3 p = random.in_cube(1);
  return element({p, p + random.in_cube(size), p + random.in_cube(size)});
}

void all_sixteenths_are_met_once_on_both_sides() {
  for (uint64_t key = 0; key < 3000; ++key) {
    std::set<int> of_source;
    for (int k = 0; k < 16; ++k) {
      double receiver[2], source[2];
      pair_points(key, k, receiver, source);
      CHECK_EQUAL(sixteenth_of(receiver), k);
      of_source.insert(sixteenth_of(source));
    }
    CHECK_EQUAL(of_source.size(), size_t{16});
  }
}

void every_quarter_meets_every_quarter() {
  for (uint64_t key = 0; key < 3000; ++key) {
    std::set<int> meetings;
    for (int k = 0; k < 16; ++k) {
      double receiver[2], source[2];
      pair_points(key, k, receiver, source);
      meetings.insert(4 * (sixteenth_of(receiver) / 4) + sixteenth_of(source) / 4);
    }
    CHECK_EQUAL(meetings.size(), size_t{16});
  }
}

void quick_pairs_lie_in_four_quarters_of_both() {
  for (uint64_t key = 0; key < 1000; ++key) {
    std::set<int> of_receiver, of_source;
    for (int k = 0; k < 16; ++k) {
      if (!(quick_pairs >> k & 1)) continue;
      double receiver[2], source[2];
      pair_points(key, k, receiver, source);
      of_receiver.insert(sixteenth_of(receiver) / 4);
      of_source.insert(sixteenth_of(source) / 4);
    }
    CHECK_EQUAL(of_receiver.size(), size_t{4});
    CHECK_EQUAL(of_source.size(), size_t{4});
  }
}

void points_lie_in_the_triangle() {
  for (uint64_t key = 0; key < 3000; ++key)
    for (int k = 0; k < 16; ++k) {
      double uv[4], spread[2];
      pair_points(key, k, uv, uv + 2);
      for (int side = 0; side < 2; ++side)
        CHECK(uv[2 * side] >= 0 && uv[2 * side + 1] >= 0 &&
              uv[2 * side] + uv[2 * side + 1] <= 1 + 1e-7);
      spread_point(key, k, spread);
      CHECK(spread[0] == uv[0] && spread[1] == uv[1]);
    }
}

// Over many keys the points have the moments of a triangle, and the two sides are unrelated.
void points_are_spread_evenly() {
  constexpr int keys = 4000;
  double mean[4] = {}, square[4] = {}, mixed = 0;
  for (uint64_t key = 0; key < keys; ++key)
    for (int k = 0; k < 16; ++k) {
      double uv[4];
      pair_points(key, k, uv, uv + 2);
      for (int m = 0; m < 4; ++m) {
        mean[m] += uv[m] / (16 * keys);
        square[m] += uv[m] * uv[m] / (16 * keys);
      }
      mixed += (uv[0] - 1.0 / 3) * (uv[2] - 1.0 / 3) / (16 * keys);
    }
  for (int m = 0; m < 4; ++m) {
    CHECK_NEAR(mean[m], 1.0 / 3, 2e-3);
    CHECK_NEAR(square[m], 1.0 / 6, 2e-3);
  }
  CHECK_NEAR(mixed, 0, 1e-3);
}

void keys_have_patterns_of_their_own() {
  std::set<std::vector<double>> patterns;
  for (uint64_t key = 0; key < 1000; ++key) {
    std::vector<double> points(4);
    pair_points(key, 0, &points[0], &points[2]);
    patterns.insert(points);
    std::vector<double> again(4);
    pair_points(key, 0, &again[0], &again[2]);
    CHECK(points == again);
  }
  CHECK(patterns.size() > 100);
}

void segments_run_between_the_points() {
  Random random(21);
  for (uint64_t key = 0; key < 200; ++key) {
    const Element receiver = random_element(random, 0.5), source = random_element(random, 0.5);
    const Vec3 center = random.in_cube(1);
    const double offset = 0.01 * random.unit();
    PairSamples samples;
    draw_pairs(receiver, source, key, center, offset, samples);
    CHECK_EQUAL(samples.packet.active, all_pairs);
    for (int k = 0; k < 16; ++k) {
      double uv[4];
      pair_points(key, k, uv, uv + 2);
      const Vec3 from = receiver.corners.at(uv[0], uv[1]) + receiver.normal * offset;
      const Vec3 to = source.corners.at(uv[2], uv[3]) + source.normal * offset;
      const Vec3 o = hrad_test::packet_origin(samples.packet, k, center);
      CHECK_NEAR(length(o - from), 0, 1e-6);
      CHECK_NEAR(length(o + hrad_test::packet_direction(samples.packet, k) - to), 0, 1e-6);
    }
  }
}

void kernels_are_those_of_the_pairs() {
  Random random(22);
  int lit = 0, dark = 0;
  for (uint64_t key = 0; key < 300; ++key) {
    const Element receiver = random_element(random, 0.5), source = random_element(random, 0.5);
    PairSamples samples;
    draw_pairs(receiver, source, key, {0, 0, 0}, 0, samples);
    for (int k = 0; k < 16; ++k) {
      double uv[4];
      pair_points(key, k, uv, uv + 2);
      const Vec3 d = source.corners.at(uv[2], uv[3]) - receiver.corners.at(uv[0], uv[1]);
      const double d2 = dot(d, d);
      const double at_receiver = dot(d, receiver.normal), at_source = -dot(d, source.normal);
      if (at_receiver < -1e-5 || at_source < -1e-5) {
        CHECK_EQUAL(samples.kernel[k], 0.0f);
        ++dark;
      } else if (at_receiver > 1e-5 && at_source > 1e-5) {
        const double wanted = at_receiver * at_source / d2 / (pi * d2);
        // A pair may count for no more than the disc of a sixteenth of the source that it stands
        // for.
        const double least = wanted / (1 + source.area / 16 / (pi * d2));
        const double rounding = wanted * (1e-4 + 1e-6 / at_receiver + 1e-6 / at_source);
        CHECK(samples.kernel[k] > least - rounding && samples.kernel[k] < wanted + rounding);
        ++lit;
      }
    }
  }
  CHECK(lit > 500 && dark > 500);
}

void kernels_stay_finite_in_contact() {
  const Element receiver = element({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  for (double gap : {1e-3, 1e-6, 1e-12, 0.0}) {
    const Element source = element({{0, 0, gap}, {0, 1, gap}, {1, 0, gap}});
    PairSamples samples;
    for (uint64_t key = 0; key < 100; ++key) {
      draw_pairs(receiver, source, key, {0, 0, 0}, 0, samples);
      for (float kernel : samples.kernel) CHECK(kernel >= 0 && std::isfinite(kernel));
    }
  }
  // Coincident elements: no direction at all.
  PairSamples samples;
  const Element point = element({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  draw_pairs(point, point, 1, {0, 0, 0}, 0, samples);
  for (float kernel : samples.kernel) CHECK_EQUAL(kernel, 0.0f);
}

// The mean of the kernel over many keys is the form factor: parallel squares at five sides'
// distance.
void the_mean_kernel_is_the_form_factor() {
  const Triangle low[2] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  const Triangle high[2] = {{{0, 0, 5}, {1, 1, 5}, {1, 0, 5}}, {{0, 0, 5}, {0, 1, 5}, {1, 1, 5}}};
  double sum = 0;
  constexpr int keys = 2000;
  for (const Triangle& r : low)
    for (const Triangle& s : high)
      for (uint64_t key = 0; key < keys; ++key) {
        PairSamples samples;
        const Element receiver = element(r), source = element(s);
        draw_pairs(receiver, source, key, {0, 0, 2}, 1e-6, samples);
        for (float kernel : samples.kernel) sum += kernel * source.area / 16 / keys / 2;
      }
  const double x = 0.2, r = std::sqrt(1 + x * x);
  const double wanted = 2 / (pi * x * x) *
                        (std::log(r * r / std::sqrt(1 + 2 * x * x)) + 2 * x * r * std::atan(x / r) -
                         2 * x * std::atan(x));
  CHECK_NEAR(sum / wanted, 1, 1e-3);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(all_sixteenths_are_met_once_on_both_sides),
      HRAD_TEST(every_quarter_meets_every_quarter),
      HRAD_TEST(quick_pairs_lie_in_four_quarters_of_both),
      HRAD_TEST(points_lie_in_the_triangle),
      HRAD_TEST(points_are_spread_evenly),
      HRAD_TEST(keys_have_patterns_of_their_own),
      HRAD_TEST(segments_run_between_the_points),
      HRAD_TEST(kernels_are_those_of_the_pairs),
      HRAD_TEST(kernels_stay_finite_in_contact),
      HRAD_TEST(the_mean_kernel_is_the_form_factor),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
