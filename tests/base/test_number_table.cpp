// Numbers by keys, however many there are.
#include "base/number_table.h"
#include "support/check.h"

namespace {

using namespace hrad;
using namespace hrad_test;

uint64_t key_of(int32_t k) { return mix(static_cast<uint64_t>(k)) >> 1; }

void an_empty_table_knows_no_key() {
  NumberTable table;
  CHECK_EQUAL(table.size(), 0u);
  CHECK_EQUAL(table.find(0), NumberTable::none);
  CHECK_EQUAL(table.bytes(), 0);
}

void numbers_are_kept_as_the_table_grows() {
  NumberTable table;
  for (int32_t k = 0; k < 5000; ++k) {
    int32_t& number = table.at(key_of(k));
    CHECK_EQUAL(number, NumberTable::none);
    number = k;
    CHECK_EQUAL(table.size(), static_cast<size_t>(k) + 1);
  }
  for (int32_t k = 0; k < 5000; ++k) {
    CHECK_EQUAL(table.find(key_of(k)), k);
    CHECK_EQUAL(table.at(key_of(k)), k);
  }
  CHECK_EQUAL(table.find(key_of(5000)), NumberTable::none);
  CHECK_EQUAL(table.size(), 5000u);
}

void numbers_stay_in_place_where_there_is_room() {
  NumberTable table;
  table.make_room(100);
  int32_t* first = &table.at(key_of(0));
  for (int32_t k = 1; k < 100; ++k) table.at(key_of(k)) = k;
  *first = 77;
  CHECK_EQUAL(table.find(key_of(0)), 77);
}

void a_cleared_table_is_empty() {
  NumberTable table;
  for (int32_t k = 0; k < 40; ++k) table.at(key_of(k)) = k;
  table.clear();
  CHECK_EQUAL(table.size(), 0u);
  for (int32_t k = 0; k < 40; ++k) CHECK_EQUAL(table.find(key_of(k)), NumberTable::none);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(an_empty_table_knows_no_key),
      HRAD_TEST(numbers_are_kept_as_the_table_grows),
      HRAD_TEST(numbers_stay_in_place_where_there_is_room),
      HRAD_TEST(a_cleared_table_is_empty),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
