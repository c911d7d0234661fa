// The tree of clusters: every surface once, bounds that hold what they should, nothing by chance.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "hierarchy/clusters.h"
#include "links/element.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

const char* const names[] = {"cornell", "furnished-room", "furnace-sphere", "building"};

struct Clustered {
  explicit Clustered(Scene s) : scene(std::move(s)), forest(scene) { add_clusters(forest); }
  Scene scene;
  Forest forest;
};

// Roots below a node, from the left to the right.
void collect(const Forest& forest, NodeId id, std::vector<int32_t>& roots) {
  const Node& node = forest.nodes[id];
  if (!Forest::is_cluster(node)) {
    roots.push_back(node.surface);
    return;
  }
  for (NodeId child : forest.cluster(node).child) collect(forest, child, roots);
}

// A tree over some surfaces leaves the others alone, and holds together what lies at one place.
void a_tree_may_hold_some_surfaces() {
  const Scene scene = builtin_scene("furnished-room");
  Forest forest(scene);
  std::vector<ClusterItem> items;
  for (int32_t k = 0; k < static_cast<int32_t>(forest.surface_count()); k += 3)
    items.push_back({k, Vec3{static_cast<double>(items.size() / 2), 0, 0}, 0.1});
  add_clusters(forest, items);
  CHECK_EQUAL(forest.clusters.clusters.size(), items.size() - 1);
  std::vector<int32_t> roots;
  collect(forest, forest.top(), roots);
  std::sort(roots.begin(), roots.end());
  CHECK_EQUAL(roots.size(), items.size());
  for (size_t k = 0; k < roots.size(); ++k) CHECK_EQUAL(roots[k], items[k].surface);
  for (NodeId root = 0; root < static_cast<NodeId>(forest.surface_count()); ++root)
    CHECK_EQUAL(forest.nodes[root].parent >= 0, root % 3 == 0);
}

// A tree made again from its order is the same to the last bit: what is linked may depend on it.
void a_tree_is_restored_bit_by_bit() {
  for (const char* name : names) {
    const Clustered c(builtin_scene(name));
    Forest again(c.scene);
    again.nodes.add_clusters(c.forest.clusters.clusters.size());
    std::vector<int32_t> left;
    for (const Cluster& cluster : c.forest.clusters.clusters) {
      const Node& first = c.forest.nodes[cluster.child[0]];
      left.push_back(Forest::is_cluster(first) ? c.forest.cluster(first).count : 1);
    }
    CHECK(restore_clusters(again, c.forest.clusters.order, left));
    CHECK_EQUAL(again.clusters.clusters.size(), left.size());
    for (size_t k = 0; k < left.size(); ++k) {
      const Cluster &one = c.forest.clusters.clusters[k], &other = again.clusters.clusters[k];
      for (int axis = 0; axis < 3; ++axis) {
        CHECK(one.normal[axis] == other.normal[axis]);
        CHECK(one.center[axis] == other.center[axis]);
      }
      CHECK(one.radius == other.radius && one.thickness == other.thickness);
      CHECK(one.cone == other.cone && one.first == other.first && one.count == other.count);
      CHECK(one.child[0] == other.child[0] && one.child[1] == other.child[1]);
    }
  }
}

void every_surface_hangs_in_the_tree_once() {
  for (const char* name : names) {
    const Clustered c(builtin_scene(name));
    const Forest& forest = c.forest;
    const NodeId surfaces = static_cast<NodeId>(forest.surface_count());
    CHECK_EQUAL(forest.clusters.clusters.size(), static_cast<size_t>(surfaces - 1));
    CHECK_EQUAL(forest.nodes.size(), static_cast<size_t>(2 * surfaces - 1));
    CHECK_EQUAL(forest.top(), surfaces);
    CHECK_EQUAL(forest.nodes[surfaces].parent, -1);
    for (NodeId id = 0; id < static_cast<NodeId>(forest.nodes.size()); ++id) {
      CHECK_EQUAL(Forest::is_cluster(forest.nodes[id]), id >= surfaces);
      CHECK(forest.is_leaf(id));  // of elements
      if (id < surfaces) continue;
      const Cluster& cluster = forest.cluster(forest.nodes[id]);
      for (NodeId child : cluster.child) {
        CHECK(child < surfaces || child > id);  // parents before children
        CHECK_EQUAL(forest.nodes[child].parent, id);
      }
      std::vector<int32_t> roots;
      collect(forest, id, roots);
      CHECK_EQUAL(roots.size(), static_cast<size_t>(cluster.count));
      for (int32_t k = 0; k < cluster.count; ++k)
        CHECK_EQUAL(roots[k], forest.clusters.order[cluster.first + k]);
    }
    std::vector<int32_t> all;
    collect(forest, forest.top(), all);
    std::vector<bool> met(static_cast<size_t>(surfaces), false);
    for (int32_t root : all) {
      CHECK(!met[root]);
      met[root] = true;
    }
    CHECK_EQUAL(all.size(), static_cast<size_t>(surfaces));
  }
}

void bounds_hold_what_is_in_them() {
  for (const char* name : names) {
    const Clustered c(builtin_scene(name));
    const Forest& forest = c.forest;
    for (const Cluster& cluster : forest.clusters.clusters) {
      const double margin = 1e-12 * (1 + cluster.radius + length(cluster.center));
      double area = 0, widest = 0, farthest = 0;
      for (int32_t k = cluster.first; k < cluster.first + cluster.count; ++k) {
        const Surface& surface = forest.surfaces[forest.clusters.order[k]];
        area += surface.area;
        const double angle = angle_of(length(cross(surface.normal, cluster.normal)),
                                      dot(surface.normal, cluster.normal));
        widest = std::max(widest, angle);
        const Triangle t = forest.root_triangle(forest.clusters.order[k]);
        for (const Vec3& p : {t.a, t.b, t.c}) {
          farthest = std::max(farthest, length(p - cluster.center));
          CHECK(std::fabs(dot(p - cluster.center, cluster.normal)) <= cluster.thickness + margin);
        }
      }
      CHECK_NEAR(cluster.area, area, 1e-9 * area);
      CHECK_NEAR(cluster.radius, farthest, margin);
      CHECK(widest <= cluster.cone + 1e-9);
      CHECK_EQUAL(cluster.linkable(), cluster.cone <= widest_cone);
    }
  }
}

// Surfaces of one direction stand together: what can't be linked ends within a few levels.
void few_clusters_are_unlinkable() {
  const Clustered boxes(builtin_scene("building"));
  int unlinkable = 0;
  for (const Cluster& cluster : boxes.forest.clusters.clusters) unlinkable += !cluster.linkable();
  CHECK(unlinkable > 0 && unlinkable < 32);
  const Clustered sphere(builtin_scene("furnace-sphere"));
  unlinkable = 0;
  for (const Cluster& cluster : sphere.forest.clusters.clusters) unlinkable += !cluster.linkable();
  CHECK(unlinkable > 0 && unlinkable < 256);
}

// A floor among small things doesn't make all of them large.
void large_surfaces_stand_apart() {
  Scene scene;
  scene.add_material({});
  const int32_t first = scene.add_vertex({0, 0, 0});
  scene.add_vertex({20, 0, 0});
  scene.add_vertex({0, 20, 0});
  scene.add_patch(first, first + 1, first + 2, 0);
  for (int k = 0; k < 64; ++k) {
    const double x = k % 8, y = k / 8;
    const int32_t at = scene.add_vertex({x, y, 0.5});
    scene.add_vertex({x + 0.5, y, 0.5});
    scene.add_vertex({x, y + 0.5, 0.5});
    scene.add_patch(at, at + 1, at + 2, 0);
  }
  const Clustered c(std::move(scene));
  for (const Cluster& cluster : c.forest.clusters.clusters)
    if (cluster.count > 1 && cluster.count < 65) CHECK(cluster.radius < 8);
}

// The same place for all of them, or a single surface: still a tree.
void degenerate_scenes() {
  Scene stack;
  stack.add_material({});
  for (int k = 0; k < 300; ++k) {
    const int32_t at = stack.add_vertex({0, 0, 0});
    stack.add_vertex({1, 0, 0});
    stack.add_vertex({0, 1, 0});
    stack.add_patch(at, at + 1, at + 2, 0);
  }
  const Clustered c(std::move(stack));
  for (const Cluster& cluster : c.forest.clusters.clusters) CHECK(cluster.radius < 1);
  Scene one;
  one.add_material({});
  one.add_vertex({0, 0, 0});
  one.add_vertex({1, 0, 0});
  one.add_vertex({0, 1, 0});
  one.add_patch(0, 1, 2, 0);
  const Clustered alone(std::move(one));
  CHECK(alone.forest.clusters.empty());
  CHECK_EQUAL(alone.forest.nodes.size(), size_t{1});
}

void areas_are_those_of_the_exposed_parts() {
  Clustered c(builtin_scene("cornell"));
  Forest& forest = c.forest;
  for (NodeId root = 0; root < forest.surface_count(); ++root)
    forest.nodes.set_exposed(root, root % 3 == 0 ? 0.0f : 0.5f);
  measure_clusters(forest);
  for (const Cluster& cluster : forest.clusters.clusters) {
    double area = 0;
    for (int32_t k = cluster.first; k < cluster.first + cluster.count; ++k) {
      const int32_t root = forest.clusters.order[k];
      area += forest.surfaces[root].area * forest.nodes[root].exposed;
    }
    CHECK_NEAR(cluster.area, area, 1e-9);
  }
}

// Clusters have names of their own.
void keys_differ() {
  const Clustered c(builtin_scene("furnished-room"));
  std::vector<uint64_t> keys;
  for (const Node& node : c.forest.nodes) keys.push_back(key_of(c.forest, node));
  std::sort(keys.begin(), keys.end());
  for (size_t k = 1; k < keys.size(); ++k) CHECK(keys[k] != keys[k - 1]);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(a_tree_may_hold_some_surfaces),
      HRAD_TEST(a_tree_is_restored_bit_by_bit),
      HRAD_TEST(every_surface_hangs_in_the_tree_once),
      HRAD_TEST(bounds_hold_what_is_in_them),
      HRAD_TEST(few_clusters_are_unlinkable),
      HRAD_TEST(large_surfaces_stand_apart),
      HRAD_TEST(degenerate_scenes),
      HRAD_TEST(areas_are_those_of_the_exposed_parts),
      HRAD_TEST(keys_differ),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
