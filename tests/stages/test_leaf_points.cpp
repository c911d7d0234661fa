// Points of leaves, named in any order, then settled and numbered, against plain tables.
#include <vector>

#include "base/hash.h"
#include "stages/leaf_points.h"
#include "stages/point_numbers.h"
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
  ThreadTeam team(3);
  points.settle(team);
  check_same(points, table, true);
  CHECK(points.bytes() < before);
}

LeafPoints settled(const Table& table) {
  LeafPoints points;
  points.resize(nodes);
  for (size_t k = 0; k < nodes; ++k) name(points, table, k);
  ThreadTeam team(1);
  points.settle(team);
  return points;
}

void some_are_kept() {
  Table table = some_table();
  LeafPoints points = settled(table);
  const auto is_kept = [](size_t leaf) { return leaf % 3 != 1; };
  points.keep(is_kept);
  for (size_t k = 0; k < nodes; ++k) {
    if (is_kept(k)) continue;
    table.numbers[k] = LeafPoints::none;
    table.owns[k] = false;
  }
  check_same(points, table, true);
}

// Against numbers given out one by one, on any number of threads: points that leaves share, of
// which the first few are named by all, some twice by one leaf, and some by none.
void points_are_numbered_as_leaves_name_them() {
  constexpr int32_t points = 5000, shared = 900;
  Table table{std::vector<LeafPoints::Numbers>(nodes, LeafPoints::none),
              std::vector<bool>(nodes, false)};
  int32_t next_own = shared;
  for (size_t k = 0; k < nodes; ++k) {
    if (mix(k, 1) % 4 == 0) continue;
    table.owns[k] = mix(k, 2) % 4 == 0;
    if (table.owns[k]) {
      table.numbers[k] = {next_own, next_own + 1, next_own + 2};
      next_own += 4;
    } else {
      const auto drawn = [&](uint64_t c) { return static_cast<int32_t>(mix(k, c, 5) % shared); };
      table.numbers[k] = {drawn(0), drawn(1), mix(k, 3) % 3 == 0 ? drawn(0) : drawn(2) % 7};
    }
  }
  CHECK(next_own < points);
  std::vector<Link> links;
  for (int32_t k = 0; k < points; ++k) links.push_back({k, 0.5f});
  const auto links_of = [&](int32_t point) {
    return Span<const Link>(&links[static_cast<size_t>(point)], static_cast<size_t>(point % 2));
  };
  Table wanted = table;
  std::vector<int32_t> number(points, -1), order;
  for (LeafPoints::Numbers& numbers : wanted.numbers)
    for (int32_t& point : numbers) {
      if (point < 0) continue;
      int32_t& given = number[static_cast<size_t>(point)];
      if (given < 0) {
        given = static_cast<int32_t>(order.size());
        order.push_back(point);
      }
      point = given;
    }
  for (int threads : {1, 2, 5}) {
    ThreadTeam team(threads);
    CornerLight direct;
    direct.of_leaf = settled(table);
    number_points_by_leaves(direct, points, links_of, team);
    check_same(direct.of_leaf, wanted, true);
    CHECK_EQUAL(direct.point_count(), order.size());
    for (size_t k = 0; k < order.size(); ++k) {
      const Span<const Link> kept = direct.links_of_point(static_cast<int32_t>(k));
      CHECK_EQUAL(kept.size(), static_cast<size_t>(order[k] % 2));
      if (kept.size() > 0) CHECK_EQUAL(kept[0].source, order[k]);
    }
  }
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
      HRAD_TEST(some_are_kept),
      HRAD_TEST(points_are_numbered_as_leaves_name_them),
      HRAD_TEST(appended_ones_are_settled),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
