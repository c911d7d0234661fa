// The tree of boxes against a walk over all of them.
#include <algorithm>
#include <vector>

#include "support/check.h"
#include "visibility/box_tree.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using hrad_test::Random;

bool touch(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis]) return false;
  return true;
}

Box random_box(Random& random, double size) {
  Box box;
  const Vec3 p = random.in_cube(1);
  box.grow(p);
  box.grow(p + random.in_cube(size));
  return box;
}

std::vector<int32_t> found(const BoxTree& tree, const Box& query) {
  std::vector<int32_t> result;
  tree.overlapping(query, [&](int32_t k) { result.push_back(k); });
  return result;
}

void finds_what_a_walk_finds() {
  Random random(61);
  for (int64_t count : {1, 7, 8, 9, 100, 3000}) {
    std::vector<Box> boxes;
    for (int64_t k = 0; k < count; ++k) {
      if (k % 13 == 5)
        boxes.push_back({});  // empty: never found
      else
        boxes.push_back(random_box(random, k % 3 ? 0.05 : 0.5));
    }
    const BoxTree tree(boxes);
    int64_t hits = 0;
    for (int k = 0; k < 200; ++k) {
      const Box query = random_box(random, 0.3);
      std::vector<int32_t> wanted, got = found(tree, query);
      for (int32_t b = 0; b < count; ++b)
        if (!boxes[b].empty() && touch(boxes[b], query)) wanted.push_back(b);
      std::sort(got.begin(), got.end());
      CHECK(got == wanted);
      hits += static_cast<int64_t>(got.size());
    }
    CHECK(count < 3000 || hits > 1000);
  }
}

void touching_counts() {
  const Box unit{{0, 0, 0}, {1, 1, 1}}, beside{{1, 0, 0}, {2, 1, 1}}, corner{{1, 1, 1}, {2, 2, 2}},
      apart{{1.0001, 0, 0}, {2, 1, 1}};
  const BoxTree tree({beside, corner, apart});
  CHECK(found(tree, unit) == (std::vector<int32_t>{0, 1}));
}

void flat_boxes_and_points_are_found() {
  const Box flat{{0, 0, 0.5}, {1, 1, 0.5}}, point{{0.2, 0.2, 0.5}, {0.2, 0.2, 0.5}};
  const BoxTree tree({flat, point});
  CHECK_EQUAL(found(tree, point).size(), size_t{2});
}

void equal_boxes_are_all_found_in_the_same_order() {
  const std::vector<Box> boxes(100, Box{{0, 0, 0}, {1, 1, 1}});
  const BoxTree a(boxes), b(boxes);
  const std::vector<int32_t> order = found(a, boxes[0]);
  CHECK_EQUAL(order.size(), boxes.size());
  CHECK(order == found(b, boxes[0]));
}

void nothing_is_found_in_nothing() {
  const Box everything{{-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}};
  CHECK(found(BoxTree({}), everything).empty());
  CHECK(found(BoxTree({Box{}, Box{}}), everything).empty());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(finds_what_a_walk_finds),
      HRAD_TEST(touching_counts),
      HRAD_TEST(flat_boxes_and_points_are_found),
      HRAD_TEST(equal_boxes_are_all_found_in_the_same_order),
      HRAD_TEST(nothing_is_found_in_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
