// The tree: complete, its boxes around everything below, of bounded size, and the same for any
// number of threads.
#include <set>

#include "support/check.h"
#include "visibility/brute_force.h"
#include "visibility/tree_build.h"

using namespace hrad;
using namespace hrad_test;

namespace {

struct Walk {
  const Scene& scene;
  const Tree& tree;
  Vec3 center;
  std::set<int32_t> patches;
  int deepest = 0;

  // Everything below lies within the box; returns the number of triangles.
  void node(uint32_t number, int depth, const float* low, const float* high) {
    deepest = std::max(deepest, depth);
    const TreeNode& n = tree.nodes[number];
    for (int i = 0; i < tree_width; ++i) {
      if (n.low[0][i] == tree_nowhere) continue;
      float child_low[3], child_high[3];
      for (int axis = 0; axis < 3; ++axis) {
        child_low[axis] = n.low[axis][i];
        child_high[axis] = n.high[axis][i];
        CHECK(child_low[axis] >= low[axis] && child_high[axis] <= high[axis]);
      }
      if (n.child[i] & tree_leaf_bit)
        leaf(leaf_number(n.child[i]), leaf_lanes(n.child[i]), child_low, child_high);
      else
        node(n.child[i], depth + 1, child_low, child_high);
    }
  }
  void leaf(uint32_t number, uint32_t lanes, const float* low, const float* high) {
    CHECK(number < tree.leaves.size());
    int triangles = 0;
    for (int i = 0; i < tree_width; ++i) {
      const int32_t patch = tree.leaves[number].patch[i];
      CHECK_EQUAL(patch >= 0, (lanes >> i & 1) != 0);
      if (patch < 0) continue;
      ++triangles;
      CHECK(patches.insert(patch).second);
      const Triangle triangle = scene.triangle(patch);
      for (Vec3 p : {triangle.a, triangle.b, triangle.c})
        for (int axis = 0; axis < 3; ++axis) {
          const double x = p[axis] - center[axis];
          CHECK(x >= low[axis] && x <= high[axis]);
        }
    }
    CHECK(triangles > 0);
  }
};

void check_tree(const Scene& scene) {
  ThreadTeam team(1);
  const Box box = scene.bounds();
  const Vec3 center = box.empty() ? Vec3{} : box.center();
  const double radius = box.empty() ? 1 : 0.5 * length(box.extent());
  const float padding = static_cast<float>(1e-6 * radius);
  const Tree tree = build_tree(scene, center, padding, team);
  Walk walk{scene, tree, center, {}};
  const float low[3] = {-1e30f, -1e30f, -1e30f}, high[3] = {1e30f, 1e30f, 1e30f};
  walk.node(0, 0, low, high);
  int64_t wanted = 0;
  for (int64_t p = 0; p < scene.patch_count(); ++p) wanted += !scene.has(p, patch_dropped);
  CHECK_EQUAL(static_cast<int64_t>(walk.patches.size()), wanted);
  CHECK(walk.deepest < tree_max_depth);
  for (int threads : {2, 3, 8}) {
    ThreadTeam more(threads);
    CHECK_EQUAL(hash_of(build_tree(scene, center, padding, more)), hash_of(tree));
  }
}

}  // namespace

static void shapes() {
  for (int64_t n : {0, 1, 2, 8, 9, 17, 300}) check_tree(random_soup(n, 0.3, n));
  check_tree(room_with_boxes(500, 2));
}

// Enough for splitting by all threads together.
static void large() {
  Scene scene = random_soup(60000, 0.02, 1);
  for (int64_t p = 0; p < scene.patch_count(); p += 7) scene.flags[p] |= patch_dropped;
  check_tree(scene);
}

// What no plane can separate, and sizes that make for a tree like a list.
static void unfriendly() {
  Scene heap;
  for (int i = 0; i < 10000; ++i) add_triangle(heap, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  check_tree(heap);
  Scene geometric;
  for (int i = 0; i < 400; ++i) {
    const double x = std::pow(0.8, i);
    add_triangle(geometric, {x, 0, 0}, {x, x, 0}, {x, 0, x});
  }
  check_tree(geometric);
}

static void memory() {
  ThreadTeam team(2);
  const int64_t triangles = 100000;
  const Scene scene = random_soup(triangles, 0.02, 4);
  const auto engine = make_visibility_engine(scene, "builtin", "auto", team);
  CHECK(engine->bytes() < 150 * triangles);
  CHECK(engine->bytes() > 40 * triangles);
}

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(shapes),
      HRAD_TEST(large),
      HRAD_TEST(unfriendly),
      HRAD_TEST(memory),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
