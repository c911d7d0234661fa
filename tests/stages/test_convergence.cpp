// When sweeps may stop: totals that approach their limit geometrically, fast and slowly.
#include <algorithm>
#include <cmath>
#include <vector>

#include "stages/convergence.h"
#include "support/check.h"

namespace {

using namespace hrad;

// Sweeps until convergence of totals limit (1 - q^n), n = 1, 2, ...; the share that is missing
// then.
double missing_at_the_end(double tolerance, double q, double limit, int* sweeps) {
  Convergence convergence(tolerance);
  double left = 1;
  for (*sweeps = 1; *sweeps < 100000; ++*sweeps) {
    left *= q;
    if (convergence.reached({limit * (1 - left)})) return left;
  }
  return 1;
}

void what_is_missing_is_below_the_tolerance() {
  for (double tolerance : {1e-2, 1e-3, 1e-4, 1e-5})
    for (double q : {0.01, 0.3, 0.5, 0.9, 0.99})
      for (double limit : {1e-6, 1.0, 1e9}) {
        int sweeps = 0;
        const double missing = missing_at_the_end(tolerance, q, limit, &sweeps);
        CHECK(missing <= tolerance * 1.01);
        // And no more sweeps than it takes: one to see the ratio, one to be sure.
        const double needed = std::log(tolerance) / std::log(q);
        CHECK(sweeps <= std::max(3.0, needed + 2));
      }
}

// The change is below the tolerance long before what is missing is.
void a_small_change_alone_proves_nothing() {
  Convergence convergence(1e-3);
  double total = 1000;
  for (double change : {1.0, 0.99, 0.9801, 0.9703, 0.9606, 0.951})
    CHECK(!convergence.reached({total += change}));
}

void nothing_is_known_after_one_change() {
  Convergence convergence(0.5);
  CHECK(!convergence.reached({1}));
  CHECK(!convergence.reached({1}));
  CHECK(convergence.reached({1}));
}

void darkness_converges() {
  Convergence convergence(1e-5);
  CHECK(!convergence.reached({0, 0, 0}));
  CHECK(!convergence.reached({0, 0, 0}));
  CHECK(convergence.reached({0, 0, 0}));
}

void every_band_counts() {
  Convergence convergence(1e-3);
  double fast = 1, slow = 1;
  int sweeps = 0;
  bool done = false;
  while (!done && sweeps < 1000) {
    fast *= 0.1;
    slow *= 0.9;
    done = convergence.reached({1 - fast, 1 - slow, 0});
    ++sweeps;
  }
  CHECK(slow <= 1.01e-3);
}

// Growing steps, or steps that don't shrink, never end it.
void growth_does_not_converge() {
  Convergence grows(1e-2), creeps(1e-2);
  double total = 1, step = 1e-3;
  for (int k = 0; k < 100; ++k) {
    CHECK(!grows.reached({total += step}));
    step *= 1.1;
  }
  for (int k = 0; k < 100; ++k) CHECK(!creeps.reached({1 + 0.001 * k}));
}

// Totals of single precision values stand still only up to their rounding.
void rounding_does_not_keep_it_going() {
  Convergence convergence(1e-9);
  convergence.reached({1});
  convergence.reached({1 + 2e-8});
  CHECK(convergence.reached({1 - 2e-8}));
}

// Totals may fall too: the light that a solve begins with may be more than it keeps.
void falling_totals_converge() {
  Convergence convergence(1e-3);
  double left = 1;
  bool done = false;
  while (!done && left > 1e-12) done = convergence.reached({5 + (left *= 0.5)});
  CHECK(done);
  CHECK(left < 6e-3);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(what_is_missing_is_below_the_tolerance),
      HRAD_TEST(a_small_change_alone_proves_nothing),
      HRAD_TEST(nothing_is_known_after_one_change),
      HRAD_TEST(darkness_converges),
      HRAD_TEST(every_band_counts),
      HRAD_TEST(growth_does_not_converge),
      HRAD_TEST(rounding_does_not_keep_it_going),
      HRAD_TEST(falling_totals_converge),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
