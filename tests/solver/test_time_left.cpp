// The time that a solve has left, guessed on the way through solves whose course is known. No clock
// is read: seconds are told.
#include <algorithm>
#include <functional>
#include <vector>

#include "solver/time_left.h"
#include "support/check.h"

using hrad::TimeLeft;

namespace {

double nothing(double) { return 0; }

// Of a stage from `begin` on whose share of its seconds is share_at(t): told over true time left,
// at its worst between two shares of the stage.
double worst_of(TimeLeft& guess, double begin, double seconds, double later,
                const std::function<double(double)>& share_at, double from, double to) {
  double worst = 1;
  for (int k = 1; k < 1000; ++k) {
    const double t = k / 1000.0, now = begin + t * seconds;
    guess.report(now, share_at(t));
    if (t < from || t > to) continue;
    const double told = guess.left(now), left = (1 - t) * seconds + later;
    worst = std::max({worst, told / left, left / told});
  }
  return worst;
}

void nothing_is_told_before_anything_is_known() {
  TimeLeft guess;
  guess.report(0.1, 0);
  CHECK(guess.left(0.1) < 0);
  guess.begin_stage(0.2, {-1}, nothing);
  CHECK(guess.left(0.5) < 0);
  guess.report(1, 0);
  CHECK(guess.left(1) < 0);
  guess.report(2, 0.1);
  CHECK_NEAR(guess.left(2), 16, 1);
}

void an_even_stage_is_told_right() {
  TimeLeft guess;
  guess.begin_stage(5, {-1}, nothing);
  CHECK(worst_of(
            guess, 5, 40, 0, [](double t) { return t; }, 0.05, 0.95) < 1.1);
}

void what_was_expected_counts_until_the_pace_is_known() {
  TimeLeft guess;
  guess.begin_stage(0, {100}, nothing);
  CHECK_NEAR(guess.left(10), 90, 1e-9);
  guess.report(10, 0.5);  // of 20 s in truth
  CHECK_NEAR(guess.left(10), 10, 1);
}

// Seven tenths of what counts as the work go by in half of the time.
void what_was_expected_may_count_for_long() {
  const auto share_at = [](double t) { return t < 0.5 ? 1.4 * t : 0.7 + 0.6 * (t - 0.5); };
  TimeLeft by_pace, by_both;
  by_pace.begin_stage(0, {100, 0.2}, nothing);
  by_both.begin_stage(0, {100, 1}, nothing);
  CHECK(worst_of(by_pace, 0, 100, 0, share_at, 0.2, 0.5) > 2);
  CHECK(worst_of(by_both, 0, 100, 0, share_at, 0.2, 0.5) < 2);
}

// The first of two stages tells how long the second will take.
void later_stages_are_told() {
  TimeLeft guess;
  guess.begin_stage(0, {-1}, [](double seconds) { return 2 * seconds + 3; });
  CHECK(worst_of(
            guess, 0, 10, 23, [](double t) { return t; }, 0.1, 0.9) < 1.1);
}

// The first half took a fifth of the time: soon after, no more than half of what is left is missed.
void a_pace_that_falls_is_followed() {
  const auto share_at = [](double t) { return t < 0.2 ? 2.5 * t : 0.5 + 0.5 * (t - 0.2) / 0.8; };
  TimeLeft guess;
  guess.begin_stage(0, {-1}, nothing);
  CHECK(worst_of(guess, 0, 60, 0, share_at, 0.45, 0.95) < 2);
}

// After a restart the first half is known and goes by at once.
void what_was_known_before_is_left_out() {
  TimeLeft guess;
  guess.begin_stage(0, {-1}, nothing);
  const auto share_at = [](double t) { return t < 0.01 ? 50 * t : 0.5 + 0.5 * (t - 0.01) / 0.99; };
  CHECK(worst_of(guess, 0, 60, 0, share_at, 0.1, 0.95) < 1.5);
}

// What counts as done may be counted anew, and then be less: it never goes backwards.
void a_share_that_falls_is_no_step_back() {
  TimeLeft guess;
  guess.begin_stage(0, {-1}, nothing);
  guess.report(10, 0.5);
  const double before = guess.left(10);
  guess.report(10, 0.3);
  CHECK_EQUAL(guess.left(10), before);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(nothing_is_told_before_anything_is_known),
                              HRAD_TEST(an_even_stage_is_told_right),
                              HRAD_TEST(what_was_expected_counts_until_the_pace_is_known),
                              HRAD_TEST(what_was_expected_may_count_for_long),
                              HRAD_TEST(later_stages_are_told),
                              HRAD_TEST(a_pace_that_falls_is_followed),
                              HRAD_TEST(what_was_known_before_is_left_out),
                              HRAD_TEST(a_share_that_falls_is_no_step_back)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
