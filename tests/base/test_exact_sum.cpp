// Exact sums: known ones, any order, any grouping.
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <vector>

#include "base/exact_sum.h"
#include "base/hash.h"
#include "support/check.h"

namespace {

using namespace hrad;

double sum_of(const std::vector<double>& values) {
  ExactSum sum;
  for (double value : values) sum.add(value);
  return sum.value();
}

void single_values_come_back() {
  for (double value : {0.0, 1.0, -1.0, 0.1, -0.3, 1e300, -1e300, DBL_MAX, -DBL_MAX, DBL_MIN,
                       DBL_TRUE_MIN, -DBL_TRUE_MIN, 3e-310, 4294967296.0, 4294967295.5})
    CHECK_EQUAL(sum_of({value}), value);
  CHECK_EQUAL(ExactSum().value(), 0.0);
}

void what_cancels_leaves_the_rest() {
  CHECK_EQUAL(sum_of({1e300, 1, -1e300}), 1.0);
  CHECK_EQUAL(sum_of({1e300, -1, -1e300}), -1.0);
  CHECK_EQUAL(sum_of({DBL_MAX, DBL_TRUE_MIN, -DBL_MAX}), DBL_TRUE_MIN);
  CHECK_EQUAL(sum_of({1e16, 1, 1, -1e16}), 2.0);
  CHECK_EQUAL(sum_of({-3, 1, 1}), -1.0);
  CHECK_EQUAL(sum_of({DBL_MAX, DBL_MAX, -DBL_MAX}), DBL_MAX);
}

void any_order_gives_the_same_bits() {
  std::vector<double> values;
  for (uint64_t k = 0; k < 3000; ++k)
    values.push_back(
        std::ldexp(unit_interval(mix(k, 1)) - 0.3, static_cast<int>(mix(k, 2) % 120) - 60));
  const double wanted = sum_of(values);
  long double plain = 0;
  for (double value : values) plain += static_cast<long double>(value);
  CHECK_NEAR(wanted, static_cast<double>(plain), 1e-12 * std::fabs(wanted));
  for (uint64_t turn = 0; turn < 20; ++turn) {
    for (size_t k = values.size(); k-- > 1;) std::swap(values[k], values[mix(turn, k) % (k + 1)]);
    CHECK_EQUAL(sum_of(values), wanted);
    ExactSum part[7];
    for (size_t k = 0; k < values.size(); ++k) part[mix(k, turn, 3) % 7].add(values[k]);
    ExactSum::Digits digits{};
    for (const ExactSum& p : part)
      for (size_t k = 0; k < digits.size(); ++k) digits[k] += p.digits()[k];
    CHECK_EQUAL(ExactSum(digits).value(), wanted);
    for (size_t p = 1; p < 7; ++p) part[0].add(part[p]);
    CHECK_EQUAL(part[0].value(), wanted);
    CHECK(part[0].digits() == ExactSum(digits).digits());
  }
}

void many_carries() {
  ExactSum sum;
  for (int k = 0; k < 1000000; ++k) sum.add(4294967295.0);
  CHECK_EQUAL(sum.value(), 4294967295.0 * 1000000);
}

void what_is_not_finite_is_not_lost() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK_EQUAL(sum_of({1, infinity, 2}), infinity);
  CHECK_EQUAL(sum_of({1, std::numeric_limits<double>::quiet_NaN()}), infinity);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(single_values_come_back),        HRAD_TEST(what_cancels_leaves_the_rest),
      HRAD_TEST(any_order_gives_the_same_bits),  HRAD_TEST(many_carries),
      HRAD_TEST(what_is_not_finite_is_not_lost),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
