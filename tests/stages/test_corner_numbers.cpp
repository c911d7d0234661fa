// Corners get the same numbers whatever the threads.
#include "stages/corner_numbers.h"
#include "support/check.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// Some come several times, and some come again the second time.
std::vector<uint64_t> keys_of(uint64_t turn, size_t count) {
  std::vector<uint64_t> keys;
  for (size_t k = 0; k < count; ++k) {
    const uint64_t hash = mix(turn, k) % (count / 2);
    keys.push_back(key_of_corner(static_cast<int32_t>(hash % 7),
                                 {static_cast<int32_t>(hash / 7), lattice_size}));
  }
  return keys;
}

void a_key_tells_surface_and_point() {
  const uint64_t key = key_of_corner(2147483647, {lattice_size, 5});
  CHECK_EQUAL(surface_of_corner(key), 2147483647);
  CHECK_EQUAL(point_of_corner(key).i, lattice_size);
  CHECK_EQUAL(point_of_corner(key).j, 5);
}

void numbers_follow_the_order_of_the_keys() {
  for (size_t count : {size_t{10}, size_t{30000}}) {
    ThreadTeam one(1), four(4);
    CornerNumbers serial, parallel;
    int32_t next = 0;
    for (uint64_t turn = 0; turn < 3; ++turn) {
      const std::vector<uint64_t> keys = keys_of(turn, count);
      const std::vector<uint32_t> added = serial.add(keys, next, one);
      CHECK(added == parallel.add(keys, next, four));
      for (uint32_t k : added) CHECK_EQUAL(serial.find(keys[k]), next++);
      for (uint64_t key : keys) {
        CHECK(serial.find(key) >= 0);
        CHECK_EQUAL(serial.find(key), parallel.find(key));
      }
    }
    CHECK(parallel.add(keys_of(2, count), next, four).empty());
    CHECK_EQUAL(serial.find(key_of_corner(8, {0, 0})), NumberTable::none);
    CHECK(parallel.bytes() >= 12 * next);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(a_key_tells_surface_and_point),
      HRAD_TEST(numbers_follow_the_order_of_the_keys),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
