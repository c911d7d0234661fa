// Pieces of a loop: everything once, and found things in order.
#include "machine/pieces.h"
#include "support/check.h"

namespace {

using namespace hrad;
using namespace hrad_test;

constexpr size_t counts[] = {0, 1, things_of_a_piece, things_of_a_piece + 1, 40000};

void each_thing_has_its_turn() {
  for (int threads : {1, 4}) {
    ThreadTeam team(threads);
    for (size_t count : counts) {
      std::vector<int> turns(count, 0);
      for_each_thing(team, count, [&](size_t k) { ++turns[k]; });
      for (int turn : turns) CHECK_EQUAL(turn, 1);
    }
  }
}

void found_things_stand_in_order() {
  for (int threads : {1, 4}) {
    ThreadTeam team(threads);
    for (size_t count : counts) {
      std::vector<size_t> expected;
      for (size_t k = 0; k < count; ++k)
        for (size_t times = k % 3; times > 0; --times) expected.push_back(k);
      const auto found = gathered<size_t>(team, count, [](size_t k, std::vector<size_t>& list) {
        for (size_t times = k % 3; times > 0; --times) list.push_back(k);
      });
      CHECK(found == expected);
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(each_thing_has_its_turn),
      HRAD_TEST(found_things_stand_in_order),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
