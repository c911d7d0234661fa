// The error that measured patches tell, against made-up measurements whose true error is known.
#include <cmath>
#include <vector>

#include "base/hash.h"
#include "solver/residuals.h"
#include "support/check.h"

namespace {

using namespace hrad;

// Even, of variance 1.
double noise(uint64_t k, uint64_t which) {
  return (unit_interval(mix(k, which, 0x6e6f697365u)) - 0.5) * std::sqrt(12.0);
}

// Measured so many times each, in two bands of radiosity 1: too large by `error`, with noise in
// each half that goes the same way in both bands.
struct MadeUp {
  std::vector<DrawnPatch> drawn;
  std::vector<Residual> residuals;
  void measure(size_t patch, int times, double error, double sigma, uint64_t key) {
    for (int t = 0; t < times; ++t) {
      Residual r;
      for (uint64_t half = 0; half < 2; ++half) {
        const double e = noise(mix(key, patch), 2 * static_cast<uint64_t>(t) + half);
        for (int b = 0; b < 2; ++b) {
          const double difference = error - sigma * e;
          r.difference[b] += difference;
          r.squares += difference * difference;
        }
      }
      r.solved = r.solved_sum = 2;
      drawn.push_back({patch, 1});
      residuals.push_back(r);
    }
  }
  MeasuredError error(double returned = 0) const { return error_of(drawn, residuals, returned); }
};

void without_noise_the_error_is_exact() {
  for (int times : {1, 2, 7}) {
    MadeUp m;
    for (size_t patch = 0; patch < 20; ++patch)
      m.measure(patch, times, patch % 2 ? 0.1 : -0.1, 0, 1);
    CHECK_NEAR(m.error().error, 0.1, 1e-12);
  }
}

// The mean is reflected on: 0.1 / (1 - 0.5) in the end.
void an_even_error_comes_back() {
  MadeUp m;
  for (size_t patch = 0; patch < 20; ++patch) m.measure(patch, 3, 0.1, 0, 1);
  CHECK_NEAR(m.error(0.5).error, 0.2, 1e-12);
}

// Over many such measurements the square of the error has no bias, and its spread is what the
// standard error says, or less.
void noise_makes_no_error_and_is_told() {
  for (int times : {1, 4, 16}) {
    double square = 0, spread = 0, told = 0;
    constexpr int trials = 400;
    constexpr double wanted = 0.05;
    for (uint64_t trial = 0; trial < trials; ++trial) {
      MadeUp m;
      for (size_t patch = 0; patch < 32; ++patch)
        m.measure(patch, times, patch % 2 ? wanted : -wanted, 0.1, trial);
      const MeasuredError e = m.error();
      square += e.error * e.error / trials;
      spread += std::pow(e.error * e.error - wanted * wanted, 2) / trials;
      told += std::pow(2 * e.error * e.standard_error, 2) / trials;
    }
    CHECK_NEAR(square, wanted * wanted, 4 * std::sqrt(spread / trials) + 0.02 * wanted * wanted);
    CHECK(told > 0.5 * spread);
    CHECK(told < 6 * spread);
  }
}

// Measured over and over, the noise of a patch falls faster than that of as many others.
void few_patches_are_known_better() {
  MadeUp few, many;
  for (size_t patch = 0; patch < 16; ++patch) few.measure(patch, 32, 0, 0.1, 3);
  for (size_t patch = 0; patch < 512; ++patch) many.measure(patch, 1, 0, 0.1, 3);
  CHECK(few.error().standard_error < 0.6 * many.error().standard_error);
  CHECK(few.error().error < 0.02);
}

void nothing_lit_has_no_error() {
  MadeUp m;
  m.drawn.push_back({0, 1});
  m.residuals.push_back({});
  CHECK(m.error().error < 0);
  CHECK(MadeUp().error().error < 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(without_noise_the_error_is_exact), HRAD_TEST(an_even_error_comes_back),
      HRAD_TEST(noise_makes_no_error_and_is_told), HRAD_TEST(few_patches_are_known_better),
      HRAD_TEST(nothing_lit_has_no_error),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
