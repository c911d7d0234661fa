// Points of leaves, named in any order and then settled, against a plain table.
#include <vector>

#include "base/hash.h"
#include "stages/leaf_points.h"
#include "support/check.h"

namespace {

using namespace hrad;

constexpr size_t nodes = 700;

LeafPoints::Places places_of(size_t leaf) {
  LeafPoints::Places places;
  for (size_t c = 0; c < 3; ++c) places[c] = {static_cast<float>(leaf), static_cast<float>(c)};
  return places;
}

struct Table {
  std::vector<LeafPoints::Numbers> numbers;
  std::vector<bool> owns;
};

// A third has none, a sixth of the others points of their own.
Table some_table() {
  Table table{std::vector<LeafPoints::Numbers>(nodes, LeafPoints::none),
              std::vector<bool>(nodes, false)};
  for (size_t k = 0; k < nodes; ++k) {
    if (mix(k, 1) % 3 == 0) continue;
    table.owns[k] = mix(k, 2) % 6 == 0;
    const int32_t first = static_cast<int32_t>(mix(k, 3) % 10000);
    table.numbers[k] = {first, first + 1, first + 2};
    if (!table.owns[k]) table.numbers[k][1] += 100;
  }
  return table;
}

void check_same(const LeafPoints& points, const Table& table, bool settled) {
  CHECK_EQUAL(points.size(), table.numbers.size());
  size_t own = 0;
  for (size_t k = 0; k < nodes; ++k) {
    CHECK(points[k] == table.numbers[k]);
    if (!settled) continue;
    CHECK_EQUAL(points.own_places(k) != nullptr, table.owns[k]);
    if (!table.owns[k]) continue;
    for (size_t c = 0; c < 3; ++c) {
      CHECK_EQUAL((*points.own_places(k))[c].x, static_cast<float>(k));
      CHECK_EQUAL(points.own(own)[c].y, static_cast<float>(c));
    }
    CHECK_EQUAL(points.first_own(own++), table.numbers[k][0]);
  }
  if (settled) CHECK_EQUAL(points.own_count(), own);
}

void name(LeafPoints& points, const Table& table, size_t k) {
  if (table.owns[k])
    points.name_own(k, table.numbers[k][0], places_of(k));
  else if (table.numbers[k][0] >= 0)
    points.name(k, table.numbers[k]);
}

void what_is_named_stays_when_it_is_settled() {
  Table table = some_table();
  LeafPoints points;
  CHECK(points.empty());
  points.resize(nodes / 2);
  for (size_t k = nodes / 2; k-- > 0;) name(points, table, k);
  points.resize(nodes);
  for (size_t k = nodes; k-- > nodes / 2;) name(points, table, k);
  for (size_t k = 0; k < nodes; k += 7) {
    points.forget(k);
    table.numbers[k] = LeafPoints::none;
    table.owns[k] = false;
  }
  CHECK(!points.empty());
  check_same(points, table, false);
  const int64_t before = points.bytes();
  points.settle();
  check_same(points, table, true);
  CHECK(points.bytes() < before);
}

void appended_ones_are_settled() {
  const Table table = some_table();
  LeafPoints points;
  for (size_t k = 0; k < nodes; ++k)
    if (table.owns[k])
      points.append_own(table.numbers[k][0], places_of(k));
    else
      points.append(table.numbers[k]);
  check_same(points, table, true);
  points.shrink_to_fit();
  check_same(points, table, true);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(what_is_named_stays_when_it_is_settled),
      HRAD_TEST(appended_ones_are_settled),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
