// Hashes: recorded values, which sample points and files depend on, and their spread.
#include <bitset>

#include "base/hash.h"
#include "support/check.h"

namespace {

using namespace hrad;

// The published sequence of splitmix64 from the state 1234567.
void mix_is_splitmix64() {
  uint64_t state = 1234567;
  const uint64_t step = 0x9e3779b97f4a7c15u;
  for (uint64_t wanted : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u}) {
    CHECK_EQUAL(mix(state), wanted);
    state += step;
  }
}

void every_input_bit_reaches_the_output() {
  for (int bit = 0; bit < 64; ++bit) {
    double flipped = 0;
    for (uint64_t k = 0; k < 256; ++k) {
      const uint64_t x = mix(k);
      flipped +=
          static_cast<double>(std::bitset<64>(mix(x) ^ mix(x ^ (uint64_t{1} << bit))).count());
    }
    CHECK_NEAR(flipped / 256, 32, 2);
  }
}

void order_of_the_arguments_matters() {
  CHECK(mix(1, 2) != mix(2, 1));
  CHECK(mix(1, 2, 3) != mix(1, 3, 2));
  CHECK(mix(0, 0) != mix(0));
}

void unit_interval_is_half_open_and_even() {
  CHECK_EQUAL(unit_interval(0), 0.0);
  CHECK(unit_interval(~uint64_t{0}) < 1);
  int count[10] = {};
  for (uint64_t k = 0; k < 100000; ++k) ++count[static_cast<int>(unit_interval(mix(k)) * 10)];
  for (int c : count) CHECK_NEAR(c, 10000, 400);
}

template <class... T>
uint64_t hash_of(T... values) {
  Hasher hash;
  (hash.add(values), ...);
  return hash.value();
}

void sequences_are_told_apart() {
  CHECK(hash_of(1.0, 2.0) != hash_of(2.0, 1.0));
  CHECK(hash_of(uint64_t{0}) != hash_of());
  CHECK(hash_of(uint64_t{0}) != hash_of(uint64_t{0}, uint64_t{0}));
  CHECK(hash_of("ab", "c") != hash_of("a", "bc"));
  CHECK(hash_of("") != hash_of());
}

void equal_numbers_have_equal_hashes() {
  CHECK_EQUAL(hash_of(-0.0), hash_of(0.0));
  CHECK_EQUAL(hash_of(0.25f), hash_of(0.25));
  CHECK(hash_of(0.1f) != hash_of(0.1));
}

void values_are_as_recorded() {
  CHECK_EQUAL(hash_of(), 0xc217ac478e5d0150u);
  CHECK_EQUAL(hash_of("hrad", 1.5, uint64_t{42}), 0xf26176c400340638u);
  CHECK_EQUAL(mix(1, 2, 3), 0xd0734750fde362b3u);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(mix_is_splitmix64),
      HRAD_TEST(every_input_bit_reaches_the_output),
      HRAD_TEST(order_of_the_arguments_matters),
      HRAD_TEST(unit_interval_is_half_open_and_even),
      HRAD_TEST(sequences_are_told_apart),
      HRAD_TEST(equal_numbers_have_equal_hashes),
      HRAD_TEST(values_are_as_recorded),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
