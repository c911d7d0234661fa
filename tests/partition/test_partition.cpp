// Partitions: every patch has one owner, grids are those of the paper, halves have equal work.
#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "base/error.h"
#include "partition/partition.h"
#include "support/check.h"
#include "support/workbench.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// Points on a lattice of unit cubes, in an order that has nothing to do with their places.
std::vector<PartitionItem> lattice(int x, int y, int z) {
  std::vector<PartitionItem> items;
  const int count = x * y * z;
  for (int k = 0; k < count; ++k) {
    const int n = (k * 7 + 3) % count;  // 7 divides none of the counts used here
    items.push_back({k, {n % x + 0.5, n / x % y + 0.5, n / (x * y) + 0.5}, 1});
  }
  return items;
}

std::vector<double> work_of_ranks(const std::vector<PartitionItem>& items,
                                  const std::vector<int32_t>& ranks, int32_t count) {
  std::vector<double> work(static_cast<size_t>(count), 0.0);
  CHECK_EQUAL(items.size(), ranks.size());
  for (size_t k = 0; k < items.size(); ++k) {
    CHECK(ranks[k] >= 0 && ranks[k] < count);
    work[static_cast<size_t>(ranks[k])] += items[k].work;
  }
  return work;
}

void a_grid_has_cells_as_cubic_as_can_be() {
  // 8 x 4 x 2 cubes, 8 ranks: cells of 2 x 2 x 2 have less surface than slices or rods.
  const std::vector<PartitionItem> items = lattice(8, 4, 2);
  const std::vector<int32_t> ranks = divide_by_grid(items, 8);
  for (const double work : work_of_ranks(items, ranks, 8)) CHECK_NEAR(work, 8, 0);
  for (size_t a = 0; a < items.size(); ++a)
    for (size_t b = 0; b < items.size(); ++b) {
      const auto cell = [](Vec3 p) { return std::array<int, 2>{int(p.x / 2), int(p.y / 2)}; };
      CHECK_EQUAL(ranks[a] == ranks[b], cell(items[a].place) == cell(items[b].place));
    }
  // Along z for a tower, whatever the axes are called.
  const std::vector<PartitionItem> tower = lattice(1, 2, 12);
  const std::vector<int32_t> floors = divide_by_grid(tower, 4);
  for (size_t k = 0; k < tower.size(); ++k)
    CHECK_EQUAL(floors[k], static_cast<int32_t>(tower[k].place.z / 3));
}

void a_grid_takes_no_heed_of_work() {
  std::vector<PartitionItem> items = lattice(4, 4, 4);
  const std::vector<int32_t> even = divide_by_grid(items, 4);
  for (PartitionItem& item : items) item.work = item.place.x < 1 ? 100 : 1;
  CHECK(divide_by_grid(items, 4) == even);
}

void halves_have_equal_work() {
  std::vector<PartitionItem> items = lattice(20, 5, 4);
  for (PartitionItem& item : items)
    item.work = item.place.x < 2 ? 50 : 1 + 0.1 * static_cast<double>(item.patch % 7);
  for (const int32_t ranks : {2, 3, 5, 8, 16}) {
    double total = 0, largest_item = 0;
    for (const PartitionItem& item : items) {
      total += item.work;
      largest_item = std::max(largest_item, item.work);
    }
    const std::vector<double> work = work_of_ranks(items, divide_by_cost(items, ranks), ranks);
    // Each cut is off by half of one item at the most, and cuts are log2(ranks) deep.
    for (const double w : work) CHECK_NEAR(w, total / ranks, 2 * largest_item);
    const double grid = *std::max_element(work.begin(), work.end());
    const std::vector<double> uniform = work_of_ranks(items, divide_by_grid(items, ranks), ranks);
    CHECK(grid < *std::max_element(uniform.begin(), uniform.end()));
  }
}

// Halves are convex: the parts' places lie in boxes that don't overlap.
void halves_lie_apart() {
  const std::vector<PartitionItem> items = lattice(6, 9, 4);
  constexpr int32_t count = 6;
  const std::vector<int32_t> ranks = divide_by_cost(items, count);
  std::vector<Box> boxes(count);
  for (size_t k = 0; k < items.size(); ++k) boxes[ranks[k]].grow(items[k].place);
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < a; ++b) {
      int apart = 0;
      for (int axis = 0; axis < 3; ++axis)
        apart +=
            boxes[a].high[axis] < boxes[b].low[axis] || boxes[b].high[axis] < boxes[a].low[axis];
      // The work can't be cut evenly everywhere: a layer may be shared, item by item.
      int shared = 0;
      for (size_t k = 0; k < items.size() && !apart; ++k) {
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis)
          inside = inside && items[k].place[axis] >= boxes[b].low[axis] &&
                   items[k].place[axis] <= boxes[b].high[axis];
        shared += inside && ranks[k] == a;
      }
      CHECK(apart > 0 || shared <= 24);
    }
}

void odd_numbers_and_few_items_are_no_trouble() {
  for (const PartitionMethod& method : partition_methods()) {
    CHECK(method.divide({}, 7).empty());
    const std::vector<PartitionItem> one = {{0, {1, 2, 3}, 5}};
    CHECK_EQUAL(work_of_ranks(one, method.divide(one, 7), 7).size(), 7u);
    // All at one place, without work: nothing to tell them by.
    const std::vector<PartitionItem> heap(10, PartitionItem{0, {1, 1, 1}, 0});
    work_of_ranks(heap, method.divide(heap, 3), 3);
    const std::vector<PartitionItem> items = lattice(3, 3, 3);
    const std::vector<int32_t> ranks = method.divide(items, 1);
    CHECK_EQUAL(std::count(ranks.begin(), ranks.end(), 0), 27);
    // More ranks than items: no rank gets two while another that could have one gets none.
    const std::vector<int32_t> spread = method.divide(items, 64);
    CHECK_EQUAL(std::set<int32_t>(spread.begin(), spread.end()).size(), 27u);
  }
}

void loads_are_what_ranks_own() {
  Scene scene = builtin_scene("furnished-room");
  std::vector<double> work;
  for (int64_t p = 0; p < scene.patch_count(); ++p) work.push_back(static_cast<double>(p % 5));
  scene.flags[3] |= patch_blocker;
  const std::vector<PartitionItem> items = partition_items(scene, work);
  CHECK_EQUAL(static_cast<int64_t>(items.size()), scene.patch_count() - 1);
  const std::vector<int32_t> owners =
      owners_of(scene, items, partition_method("cost").divide(items, 5));
  CHECK_EQUAL(owners[3], 0);
  const std::vector<RankLoad> loads = loads_of(scene, items, owners, 5);
  int64_t patches = 0;
  double sum = 0, all = 0;
  for (const RankLoad& load : loads) {
    patches += load.patches;
    sum += load.work;
  }
  for (const PartitionItem& item : items) {
    all += item.work;
    const Box& box = loads[owners[item.patch]].box;
    const Vec3 corner = scene.triangle(item.patch).b;
    for (int axis = 0; axis < 3; ++axis)
      CHECK(corner[axis] >= box.low[axis] && corner[axis] <= box.high[axis]);
  }
  CHECK_EQUAL(patches, static_cast<int64_t>(items.size()));
  CHECK_NEAR(sum, all, 1e-9);
}

void unknown_methods_are_refused() {
  CHECK_FAILS(partition_method("random"), Status::argument, "cost, grid");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(a_grid_has_cells_as_cubic_as_can_be),
      HRAD_TEST(a_grid_takes_no_heed_of_work),
      HRAD_TEST(halves_have_equal_work),
      HRAD_TEST(halves_lie_apart),
      HRAD_TEST(odd_numbers_and_few_items_are_no_trouble),
      HRAD_TEST(loads_are_what_ranks_own),
      HRAD_TEST(unknown_methods_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
