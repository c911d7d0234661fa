// What must hold of the oracles whatever their constants: nothing is refined that was surely good,
// higher thresholds keep more, and the energy rule refines the larger of the two.
#include <vector>

#include "links/oracle.h"
#include "support/check.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using hrad_test::Random;

OracleSettings random_settings(Random& random, OracleKind kind) {
  OracleSettings s;
  s.kind = kind;
  s.power = random.unit() * random.unit();
  s.mean_variance = 1e-4 * random.unit();
  s.point_variance = 1e-2 * random.unit();
  s.point_area = 0.1 + random.unit();
  return s;
}

// A link of sensible numbers, from far below the thresholds to far above.
LinkLoad random_load(Random& random) {
  LinkLoad load;
  double small = 1;
  for (int k = static_cast<int>(random.below(6)); k > 0; --k) small *= 0.1;
  load.weight = small * random.unit();
  load.brightness = 3 * random.unit();
  load.source_spread = load.brightness * random.unit();
  load.receiver_area = 2 * random.unit();
  load.patch_area = load.receiver_area * (1 + 10 * random.unit());
  load.source_area = 2 * random.unit();
  load.power = load.weight * load.brightness * load.receiver_area;
  load.may_split = random.unit() < 0.7;
  load.may_descend = random.unit() < 0.7;
  return load;
}

// seen: at least this share of the source is visible.
LinkEstimate random_estimate(Random& random, const LinkLoad& load, double seen) {
  LinkEstimate e;
  e.factor = load.weight / random.between(seen, 1);
  e.variation = e.factor * random.unit();
  e.mean_error = e.variation / 3 * random.unit();
  e.kernel_sum = 1;
  e.visible_sum = load.weight / e.factor;
  e.pairs = 16;
  return e;
}

constexpr int trials = 200000;

void surely_good_links_are_kept() {
  Random random(31);
  int good = 0;
  for (int k = 0; k < trials; ++k) {
    const OracleSettings s = random_settings(random, OracleKind::error);
    const LinkLoad load = random_load(random);
    const LinkEstimate e = random_estimate(random, load, 1.0 / 8);
    if (!surely_good(s, load)) continue;
    ++good;
    CHECK(judge_error(s, load, e, 3 * random.unit()) == Decision::keep);
  }
  CHECK(good > trials / 20 && good < trials);
}

void surely_good_links_are_kept_by_energy() {
  Random random(32);
  int good = 0;
  for (int k = 0; k < trials; ++k) {
    const OracleSettings s = random_settings(random, OracleKind::energy);
    const LinkLoad load = random_load(random);
    CHECK(surely_good(s, load) == (load.power <= s.power));
    if (!surely_good(s, load)) continue;
    ++good;
    CHECK(judge_energy(s, load) == Decision::keep);
  }
  CHECK(good > trials / 20 && good < trials);
}

void dark_links_are_surely_good() {
  Random random(33);
  for (int k = 0; k < 1000; ++k) {
    LinkLoad load = random_load(random);
    load.brightness = load.source_spread = load.power = 0;
    CHECK(surely_good(random_settings(random, OracleKind::error), load));
    CHECK(surely_good(random_settings(random, OracleKind::energy), load));
  }
}

// What is good enough stays good enough when more is allowed, or less is carried.
void higher_thresholds_keep_more() {
  Random random(34);
  int kept = 0;
  for (int k = 0; k < trials; ++k) {
    const bool energy = k % 2;
    const OracleSettings s =
        random_settings(random, energy ? OracleKind::energy : OracleKind::error);
    LinkLoad load = random_load(random);
    const LinkEstimate e = random_estimate(random, load, 1.0 / 64);
    const double ratio = 2 * random.unit();
    const auto keeps = [&](const OracleSettings& with) {
      return (energy ? judge_energy(with, load) : judge_error(with, load, e, ratio)) ==
             Decision::keep;
    };
    if (!keeps(s)) continue;
    ++kept;
    OracleSettings easier = s;
    easier.power *= 1 + random.unit();
    easier.mean_variance *= 1 + random.unit();
    easier.point_variance *= 1 + random.unit();
    CHECK(keeps(easier));
    if (surely_good(s, load)) CHECK(surely_good(easier, load));
    load.brightness *= 0.5;
    load.source_spread *= 0.5;
    load.power *= 0.5;
    CHECK(keeps(s));
  }
  CHECK(kept > trials / 20 && kept < trials - trials / 20);
}

void what_may_not_be_refined_is_kept() {
  Random random(35);
  for (int k = 0; k < 20000; ++k) {
    OracleSettings s = random_settings(random, OracleKind::error);
    s.mean_variance = s.point_variance = s.power = 0;
    LinkLoad load = random_load(random);
    const LinkEstimate e = random_estimate(random, load, 1.0 / 16);
    load.may_split = load.may_descend = false;
    CHECK(judge_error(s, load, e, 1) == Decision::keep);
    CHECK(judge_energy(s, load) == Decision::keep);
    load.may_split = true;
    CHECK(judge_error(s, load, e, 1) != Decision::descend_source);
    CHECK(judge_energy(s, load) != Decision::descend_source);
    load.may_split = false;
    load.may_descend = true;
    CHECK(judge_error(s, load, e, 1) != Decision::split_receiver);
    CHECK(judge_energy(s, load) != Decision::split_receiver);
  }
}

// Errors are to blame, not light: a strong link over which nothing varies is kept.
void even_links_are_kept_however_strong() {
  Random random(36);
  for (int k = 0; k < 1000; ++k) {
    const OracleSettings s = random_settings(random, OracleKind::error);
    LinkLoad load = random_load(random);
    load.brightness *= 1e6;
    load.source_spread = 0;
    load.may_split = load.may_descend = true;
    LinkEstimate e;
    e.factor = load.weight;
    CHECK(judge_error(s, load, e, 0.5) == Decision::keep);
  }
}

LinkLoad strong_load() {
  LinkLoad load;
  load.weight = 0.5;
  load.brightness = 100;
  load.receiver_area = load.source_area = load.patch_area = 1;
  load.may_split = load.may_descend = true;
  load.power = 50;
  return load;
}

void uneven_links_are_refined_where_they_are_uneven() {
  OracleSettings s;
  s.mean_variance = s.point_variance = 1e-3;
  const LinkLoad load = strong_load();
  LinkEstimate varying;
  varying.factor = load.weight;
  varying.variation = varying.factor / 2;
  CHECK(judge_error(s, load, varying, 0.5) == Decision::split_receiver);

  LinkEstimate shadowed;  // half of it hidden
  shadowed.factor = 2 * load.weight;
  CHECK(judge_error(s, load, shadowed, 0.5) == Decision::split_receiver);

  LinkLoad bright_in_parts = load;
  bright_in_parts.source_spread = load.brightness;
  LinkEstimate even;
  even.factor = load.weight;
  CHECK(judge_error(s, bright_in_parts, even, 0.5) == Decision::descend_source);
  // From afar it doesn't matter which part shines.
  CHECK(judge_error(s, bright_in_parts, even, 1e-4) == Decision::keep);
}

// A small element of a large patch counts for less.
void smaller_receivers_may_err_more() {
  Random random(37);
  for (int k = 0; k < trials; ++k) {
    const OracleSettings s = random_settings(random, OracleKind::error);
    LinkLoad load = random_load(random);
    const LinkEstimate e = random_estimate(random, load, 1.0 / 16);
    const double ratio = 2 * random.unit();
    if (judge_error(s, load, e, ratio) != Decision::keep) continue;
    load.receiver_area /= 4;
    CHECK(judge_error(s, load, e, ratio) == Decision::keep);
  }
}

void energy_refines_the_larger() {
  OracleSettings s;
  s.kind = OracleKind::energy;
  s.power = 1;
  LinkLoad load = strong_load();
  load.power = 1.01;
  load.source_area = 2;
  CHECK(judge_energy(s, load) == Decision::descend_source);
  load.source_area = 0.5;
  CHECK(judge_energy(s, load) == Decision::split_receiver);
  load.source_area = 1;
  CHECK(judge_energy(s, load) == Decision::split_receiver);
  // The other one where the larger can't be.
  load.source_area = 2;
  load.may_descend = false;
  CHECK(judge_energy(s, load) == Decision::split_receiver);
  load.source_area = 0.5;
  load.may_descend = true;
  load.may_split = false;
  CHECK(judge_energy(s, load) == Decision::descend_source);
  load.power = 1;
  load.may_split = true;
  CHECK(judge_energy(s, load) == Decision::keep);
}

void packets_follow_the_error_of_visibility() {
  Random random(38);
  int more = 0;
  for (int k = 0; k < trials; ++k) {
    OracleSettings s = random_settings(random, OracleKind::error);
    s.most_packets = 1 + static_cast<int>(random.below(8));
    LinkLoad load = random_load(random);
    LinkEstimate e = random_estimate(random, load, 0.02);
    const int wanted = packets_wanted(s, load, e);
    CHECK(wanted >= 1 && wanted <= s.most_packets);
    more += wanted > 1;
    OracleSettings stricter = s;
    stricter.mean_variance *= random.unit();
    CHECK(packets_wanted(stricter, load, e) >= wanted);
    // Of partly hidden links the half hidden ones are the least certain.
    LinkEstimate half = e;
    half.visible_sum = half.kernel_sum / 2;
    if (e.visible() < 1) CHECK(packets_wanted(s, load, half) >= wanted);
    // What looks dark is looked at more often than what looks clear.
    LinkEstimate dark = e;
    e.visible_sum = e.kernel_sum;
    dark.visible_sum = 0;
    CHECK(packets_wanted(s, load, dark) >= packets_wanted(s, load, e));
  }
  CHECK(more > trials / 100);
}

// Sixteen blocked rays are no proof that a bright source is hidden.
void hidden_sources_are_looked_at_again() {
  OracleSettings s;
  s.mean_variance = 1e-6;
  s.most_packets = 4;
  LinkEstimate e;
  e.factor = 0.5;
  e.kernel_sum = 1;
  e.pairs = 16;
  CHECK_EQUAL(packets_wanted(s, strong_load(), e), 8);
  // Of pairs on sealed points there are more, for as many that tell something.
  e.exposed = 0.25;
  CHECK(packets_wanted(s, strong_load(), e) >= 32);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(surely_good_links_are_kept),
      HRAD_TEST(surely_good_links_are_kept_by_energy),
      HRAD_TEST(dark_links_are_surely_good),
      HRAD_TEST(higher_thresholds_keep_more),
      HRAD_TEST(what_may_not_be_refined_is_kept),
      HRAD_TEST(even_links_are_kept_however_strong),
      HRAD_TEST(uneven_links_are_refined_where_they_are_uneven),
      HRAD_TEST(smaller_receivers_may_err_more),
      HRAD_TEST(energy_refines_the_larger),
      HRAD_TEST(packets_follow_the_error_of_visibility),
      HRAD_TEST(hidden_sources_are_looked_at_again),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
