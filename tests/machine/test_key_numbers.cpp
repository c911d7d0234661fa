// Keys get the same numbers whatever the threads.
#include <vector>

#include "machine/key_numbers.h"
#include "support/check.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// Some come several times, and some come again the second time.
std::vector<uint64_t> keys_of(uint64_t turn, size_t count) {
  std::vector<uint64_t> keys;
  for (size_t k = 0; k < count; ++k) keys.push_back(mix(mix(turn, k) % (count / 2)));
  return keys;
}

void numbers_follow_the_order_of_the_keys() {
  for (size_t count : {size_t{10}, size_t{30000}}) {
    ThreadTeam one(1), four(4);
    KeyNumbers serial, parallel;
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
    CHECK_EQUAL(serial.find(mix(count)), NumberTable::none);
    CHECK(parallel.bytes() >= 12 * next);
    CHECK_EQUAL(parallel.bytes(), serial.bytes());
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(numbers_follow_the_order_of_the_keys),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
