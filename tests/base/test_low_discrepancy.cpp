// Scrambled Sobol points: even as a net is, each key another net, and uniform over all keys.
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "base/low_discrepancy.h"
#include "support/check.h"

namespace {

using namespace hrad;

// Of 2^m points each of 2^m equal intervals holds one, in every dimension.
void every_dimension_is_stratified() {
  for (uint64_t key = 0; key < 50; ++key)
    for (uint32_t count : {1u, 2u, 16u, 64u, 256u})
      for (int d = 0; d < 4; ++d) {
        std::set<int> met;
        for (uint32_t k = 0; k < count; ++k) {
          double p[4];
          low_discrepancy_point(key, k, p);
          CHECK(p[d] > 0 && p[d] < 1);
          met.insert(static_cast<int>(p[d] * count));
        }
        CHECK_EQUAL(met.size(), static_cast<size_t>(count));
      }
}

// The first two dimensions: one of 16 points in every elementary box of area 1/16.
void pairs_of_dimensions_are_a_net() {
  for (uint64_t key = 0; key < 200; ++key)
    for (int columns = 1; columns <= 16; columns *= 2) {
      std::set<std::pair<int, int>> met;
      for (uint32_t k = 0; k < 16; ++k) {
        double p[4];
        low_discrepancy_point(key, k, p);
        met.insert({static_cast<int>(p[0] * columns), static_cast<int>(p[1] * (16 / columns))});
      }
      CHECK_EQUAL(met.size(), size_t{16});
    }
}

// A function of all four coordinates: its mean over keys is the integral for any number of points,
// and the spread of 64 points' means is far below that of chance.
void means_are_unbiased_and_steady() {
  const auto f = [](const double p[4]) { return p[0] * p[1] + p[1] * p[2] * p[2] + p[3] * p[0]; };
  const double exact = 0.25 + 1.0 / 6 + 0.25;
  for (int count : {1, 3, 16, 64}) {
    double sum = 0, squares = 0;
    constexpr int keys = 4000;
    for (uint64_t key = 0; key < keys; ++key) {
      double mean = 0;
      for (int k = 0; k < count; ++k) {
        double p[4];
        low_discrepancy_point(mix(key, 77), static_cast<uint32_t>(k), p);
        mean += f(p) / count;
      }
      sum += mean;
      squares += mean * mean;
    }
    const double mean = sum / keys, variance = squares / keys - mean * mean;
    CHECK_NEAR(mean, exact, 4 * std::sqrt(variance / keys));
    if (count == 64) CHECK(variance < 0.05 * 0.2 / 64);  // of a single point: about 0.2
  }
}

// Points of different keys have nothing to do with each other.
void keys_are_independent() {
  double sum[4][4] = {};
  constexpr int keys = 20000;
  for (uint64_t key = 0; key < keys; ++key) {
    double p[4], q[4];
    low_discrepancy_point(key, 0, p);
    low_discrepancy_point(key + 1, 0, q);
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) sum[a][b] += (p[a] - 0.5) * (q[b] - 0.5);
  }
  for (const auto& row : sum)
    for (double covariance : row) CHECK_NEAR(covariance / keys, 0, 4 / 12.0 / std::sqrt(keys));
}

// Numbers that agree in their first bits still do when they are scrambled, and in no more.
void scrambling_keeps_the_tree() {
  for (uint32_t seed = 1; seed < 300; ++seed)
    for (int bit = 0; bit < 32; ++bit) {
      const uint32_t x = static_cast<uint32_t>(mix(seed, static_cast<uint64_t>(bit)));
      const uint32_t a = owen_scrambled(reversed_bits(x), seed);
      const uint32_t b = owen_scrambled(reversed_bits(x ^ (1u << bit)), seed);
      CHECK_EQUAL((a ^ b) >> bit, 1u);
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(every_dimension_is_stratified), HRAD_TEST(pairs_of_dimensions_are_a_net),
      HRAD_TEST(means_are_unbiased_and_steady), HRAD_TEST(keys_are_independent),
      HRAD_TEST(scrambling_keeps_the_tree),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
