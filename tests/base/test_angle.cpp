// Angles without libm: held against libm within the stated errors, and their bits against recorded
// ones, which every processor and compiler must give.
#include <cmath>

#include "base/angle.h"
#include "base/hash.h"
#include "support/check.h"

namespace {

using namespace hrad;

// Sines and cosines in all proportions from 1 : 10^-300 to 10^-300 : 1, and of both signs.
template <class F>
void for_each_proportion(F&& f) {
  for (int k = 0; k <= 20000; ++k) {
    const double angle = pi * k / 20000;
    f(std::fabs(std::sin(angle)), std::cos(angle));
  }
  for (double small = 1; small > 1e-300; small *= 0.37)
    for (double sign : {1.0, -1.0}) {
      f(small, sign);
      f(1.0, sign * small);
      f(small * 1e3, sign * small * 2e3);
    }
}

void angle_agrees_with_libm() {
  for_each_proportion([](double sine, double cosine) {
    CHECK_NEAR(angle_of(sine, cosine), std::atan2(sine, cosine), 1e-12);
  });
}

void angle_at_the_ends() {
  CHECK_EQUAL(angle_of(0, 0), 0.0);
  CHECK_EQUAL(angle_of(0, 1), 0.0);
  CHECK_EQUAL(angle_of(0, -1), pi);
  CHECK_EQUAL(angle_of(1, 0), pi / 2);
  CHECK_NEAR(angle_of(1, 1), pi / 4, 1e-15);
  CHECK_NEAR(angle_of(3, -3), 3 * pi / 4, 1e-15);
}

void lanes_of_a_vector_have_the_same_bits() {
  using Two = double __attribute__((vector_size(2 * sizeof(double))));
  double sine_before = 0, cosine_before = 1;
  for_each_proportion([&](double sine, double cosine) {
    const Two angles = angles_of(Two{sine, sine_before}, Two{cosine, cosine_before});
    CHECK_EQUAL(angles[0], angle_of(sine, cosine));
    CHECK_EQUAL(angles[1], angle_of(sine_before, cosine_before));
    sine_before = sine;
    cosine_before = cosine;
  });
}

// Small angles keep their relative precision: differences of them make form factors.
void small_angles_are_precise() {
  for (double small = 0.3; small > 1e-200; small *= 0.5)
    CHECK_NEAR(angle_of(small, 1) / std::atan(small), 1, 1e-14);
}

void angle_never_falls() {
  double before = 0;
  for (int k = 1; k < 100000; ++k) {
    const double angle = pi * k / 100000;
    const double now = angle_of(std::sin(angle), std::cos(angle));
    CHECK(now > before);
    before = now;
  }
}

void turn_agrees_with_libm() {
  for (int k = 0; k < 200000; ++k) {
    const double fraction = k / 200000.0;
    const Turn turn = turn_of(fraction);
    CHECK_NEAR(turn.cosine, std::cos(2 * pi * fraction), 1e-13);
    CHECK_NEAR(turn.sine, std::sin(2 * pi * fraction), 1e-13);
  }
}

void quarter_turns_are_exact() {
  const Turn start = turn_of(0), quarter = turn_of(0.25), half = turn_of(0.5), last = turn_of(0.75);
  CHECK(start.cosine == 1 && start.sine == 0);
  CHECK(quarter.cosine == 0 && quarter.sine == 1);
  CHECK(half.cosine == -1 && half.sine == 0);
  CHECK(last.cosine == 0 && last.sine == -1);
  const Turn whole = turn_of(1 - 1e-16);
  CHECK_NEAR(whole.cosine, 1, 1e-13);
  CHECK_NEAR(whole.sine, 0, 1e-13);
}

void bits_are_as_recorded() {
  Hasher angles, turns;
  for (uint64_t k = 0; k < 20000; ++k) {
    const double sine = unit_interval(mix(k, 1)), cosine = 2 * unit_interval(mix(k, 2)) - 1;
    angles.add(angle_of(sine, cosine));
    angles.add(angle_of(sine * 1e-5, cosine));
    const Turn turn = turn_of(unit_interval(mix(k, 3)));
    turns.add(turn.cosine);
    turns.add(turn.sine);
  }
  CHECK_EQUAL(angles.value(), 0x8e1452620c3314cbu);
  CHECK_EQUAL(turns.value(), 0x6d5538705aa8370bu);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(angle_agrees_with_libm),
      HRAD_TEST(angle_at_the_ends),
      HRAD_TEST(lanes_of_a_vector_have_the_same_bits),
      HRAD_TEST(small_angles_are_precise),
      HRAD_TEST(angle_never_falls),
      HRAD_TEST(turn_agrees_with_libm),
      HRAD_TEST(quarter_turns_are_exact),
      HRAD_TEST(bits_are_as_recorded),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
