// An array that grows in place, against std::vector.
#include <algorithm>
#include <limits>
#include <new>
#include <vector>

#include "base/growing_array.h"
#include "base/hash.h"
#include "support/check.h"

namespace {

using namespace hrad;

struct Thing {
  int number = 7;
  short other = -1;
};
bool operator==(const Thing& a, const Thing& b) {
  return a.number == b.number && a.other == b.other;
}

void check_same(const GrowingArray<Thing>& array, const std::vector<Thing>& vector) {
  CHECK_EQUAL(array.size(), vector.size());
  CHECK_EQUAL(array.empty(), vector.empty());
  CHECK(array.capacity() >= array.size());
  CHECK(bytes_in(array) == static_cast<int64_t>(array.capacity() * sizeof(Thing)));
  CHECK(std::equal(array.begin(), array.end(), vector.begin(), vector.end()));
  for (size_t k = 0; k < vector.size(); k += 97) CHECK(array[k] == vector[k]);
  if (!vector.empty()) CHECK(array.back() == vector.back());
}

// Small ones and such as have pages of their own.
void it_is_like_a_vector() {
  GrowingArray<Thing> array;
  std::vector<Thing> vector;
  check_same(array, vector);
  for (int step = 0; step < 400; ++step) {
    const uint64_t chance = mix(static_cast<uint64_t>(step), 5);
    const size_t size = chance % (step % 10 == 0 ? 200000 : 300);
    switch (chance >> 32 & 3) {
      case 0:
        array.resize(size);
        vector.resize(size);
        break;
      case 1:
        array.reserve(size);
        vector.reserve(size);
        break;
      case 2:
        array.shrink_to_fit();
        CHECK_EQUAL(array.capacity(), array.size());
        break;
      default: {
        const size_t before = array.size();
        array.resize_for_overwrite(size);
        vector.resize(size);
        for (size_t k = before; k < size; ++k) array[k] = vector[k] = {static_cast<int>(k), 1};
      }
    }
    array.push_back({step, 3});
    vector.push_back({step, 3});
    array.push_back(array[0]);  // a place within it that may move
    vector.push_back(vector.front());
    check_same(array, vector);
  }
  array.resize(0);
  check_same(array, {});
  array.shrink_to_fit();
  CHECK_EQUAL(array.capacity(), 0u);
}

void it_is_copied_and_moved() {
  GrowingArray<Thing> array;
  std::vector<Thing> vector;
  for (int k = 0; k < 1000; ++k) {
    array.push_back({k, 2});
    vector.push_back({k, 2});
  }
  GrowingArray<Thing> copy = array;
  check_same(copy, vector);
  copy[3].number = -3;
  check_same(array, vector);
  copy = array;
  check_same(copy, vector);
  const GrowingArray<Thing> moved = std::move(copy);
  check_same(moved, vector);
  array = GrowingArray<Thing>();
  check_same(array, {});
  check_same(moved, vector);
}

// What can't be had leaves what there is.
void too_much_is_bad_alloc() {
  GrowingArray<Thing> array;
  array.push_back({5, 5});
  constexpr auto most = static_cast<size_t>(std::numeric_limits<std::ptrdiff_t>::max());
  for (size_t size : {std::numeric_limits<size_t>::max(), most / sizeof(Thing) + 1}) {
    bool thrown = false;
    try {
      array.reserve(size);
    } catch (const std::bad_alloc&) {
      thrown = true;
    }
    CHECK(thrown);
    check_same(array, {{5, 5}});
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(it_is_like_a_vector), HRAD_TEST(it_is_copied_and_moved),
                              HRAD_TEST(too_much_is_bad_alloc)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
