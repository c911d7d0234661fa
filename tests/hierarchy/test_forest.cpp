// The hierarchy: elements tile their parents, are found by points and named by keys.
#include <algorithm>
#include <set>
#include <vector>

#include "hierarchy/forest.h"
#include "links/element.h"
#include "support/workbench.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// Three triangles in general position: one-sided, two-sided, and of great size.
Scene three_triangles() {
  Scene scene;
  scene.add_material({});
  Material both;
  both.two_sided = true;
  scene.add_material(both);
  const Vec3 points[9] = {{0.3, 0.1, 0.2}, {1.4, 0.2, -0.3}, {0.1, 1.7, 0.9},
                          {-2, 0, 1},      {-2, 3, 1},       {-4, 1, 2},
                          {100, 0, 0},     {900, 20, 3},     {0, 500, 70}};
  for (const Vec3& p : points) scene.add_vertex(p);
  scene.add_patch(0, 1, 2, 0);
  scene.add_patch(3, 4, 5, 1);
  scene.add_patch(6, 7, 8, 0);
  return scene;
}

// A tree that is deep in some places and shallow in others.
void split_unevenly(Forest& forest, int level) {
  split_where(forest, level, [&](const Node& node) {
    return node.level < 1 || mix(key_of(forest, node)) % 5 < 2;
  });
}

// Barycentric coordinates of a point of the plane: weights of b and c.
void place_in(const Triangle& t, Vec3 p, double* u, double* v) {
  const Vec3 n = t.area_vector();
  *u = dot(cross(p - t.a, t.c - t.a), n) / dot(n, n);
  *v = dot(cross(t.b - t.a, p - t.a), n) / dot(n, n);
}

bool holds(const Triangle& t, Vec3 p, double margin) {
  double u, v;
  place_in(t, p, &u, &v);
  return u >= -margin && v >= -margin && u + v <= 1 + margin;
}

void children_tile_their_parent() {
  const Scene scene = three_triangles();
  Forest forest(scene);
  split_all(forest, 4);
  for (size_t k = 0; k < forest.nodes.size(); ++k) {
    const Node& node = forest.nodes[k];
    if (node.first_child < 0) continue;
    const Triangle parent = forest.triangle(node);
    const double size = length(parent.area_vector());
    Triangle child[4];
    double area = 0;
    for (int c = 0; c < 4; ++c) {
      child[c] = forest.triangle(forest.nodes[node.first_child + c]);
      area += forest.area(forest.nodes[node.first_child + c]);
      // The same plane, orientation and a quarter of the area.
      CHECK_NEAR(length(child[c].area_vector() - parent.area_vector() * 0.25) / size, 0, 1e-11);
    }
    CHECK_EQUAL(area, forest.area(node));
    // Every inner point lies in exactly one child.
    for (uint64_t m = 0; m < 16; ++m) {
      double u = unit_interval(mix(k, m, 1)), v = unit_interval(mix(k, m, 2));
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      int inside = 0;
      for (const Triangle& t : child) inside += holds(t, parent.at(u, v), 0);
      CHECK_EQUAL(inside, 1);
    }
    // Child c keeps corner c, the last one has the midpoints.
    const Vec3 corners[3] = {parent.a, parent.b, parent.c};
    const Vec3 kept[3] = {child[0].a, child[1].b, child[2].c};
    for (int c = 0; c < 3; ++c)
      CHECK_NEAR(length(corners[c] - kept[c]) * length(corners[c] - kept[c]) / size, 0, 1e-20);
    CHECK_NEAR(length(child[3].a - (parent.b + parent.c) * 0.5) / std::sqrt(size), 0, 1e-11);
  }
}

void areas_are_those_of_the_corners() {
  const Scene scene = three_triangles();
  Forest forest(scene);
  split_unevenly(forest, 6);
  for (const Node& node : forest.nodes) {
    const double of_corners = length(forest.triangle(node).area_vector()) / 2;
    CHECK_NEAR(forest.area(node) / of_corners, 1, 1e-9);
  }
}

// The corners of all elements of a level are the points of one lattice.
void neighbours_share_their_corners() {
  const Scene scene = three_triangles();
  Forest forest(scene);
  split_all(forest, 5);
  std::set<std::vector<double>> corners;
  for (const Node& node : forest.nodes) {
    if (node.surface != 0 || node.level != 5) continue;
    const Triangle t = forest.triangle(node);
    for (const Vec3& p : {t.a, t.b, t.c}) {
      // Rounded to a grid far finer than the elements, far coarser than rounding.
      corners.insert({std::round(p.x * 1e9), std::round(p.y * 1e9), std::round(p.z * 1e9)});
    }
  }
  // A triangle cut into 4^5 has (32+1)(32+2)/2 corners.
  CHECK_EQUAL(corners.size(), size_t{33 * 34 / 2});
}

void the_deepest_level_fits_the_lattice() {
  const Scene scene = three_triangles();
  const Forest forest(scene);
  for (uint64_t path = 0; path < 2000; ++path) {
    Node node = forest.nodes[0];
    uint64_t choices = mix(path);
    for (int level = 0; level < max_level; ++level) {
      node = child_place(node, path < 4 ? static_cast<int>(path) : static_cast<int>(choices % 4));
      choices /= 4;
    }
    CHECK_EQUAL(static_cast<int>(node.level), max_level);
    CHECK(node.i + node.j + node.inverted < (1 << max_level));
    const Triangle root = forest.root_triangle(0);
    CHECK(holds(root, forest.triangle(node).centroid(), 1e-9));
  }
}

void leaf_at_finds_the_leaf_around_a_point() {
  const Scene scene = three_triangles();
  Forest forest(scene);
  split_unevenly(forest, 9);
  for (NodeId root = 0; root < forest.surface_count(); ++root) {
    const Triangle whole = forest.root_triangle(root);
    for (uint64_t k = 0; k < 5000; ++k) {
      double u = unit_interval(mix(k, 5)), v = unit_interval(mix(k, 6));
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const NodeId leaf = forest.leaf_at(root, u, v);
      CHECK(forest.is_leaf(leaf));
      CHECK_EQUAL(forest.nodes[leaf].surface, root);
      CHECK(holds(forest.triangle(forest.nodes[leaf]), whole.at(u, v), 1e-9));
    }
    // Corners and points on the edges end in a leaf of the surface too.
    for (double s : {0.0, 0.25, 0.5, 1.0})
      for (const auto& uv : {std::pair<double, double>{s, 0}, {0, s}, {s, 1 - s}}) {
        const NodeId leaf = forest.leaf_at(root, uv.first, uv.second);
        CHECK(holds(forest.triangle(forest.nodes[leaf]), whole.at(uv.first, uv.second), 1e-9));
      }
  }
}

// Of any number of hits side by side as of each alone, those that meet nothing among them.
void leaves_are_met_together_as_one_by_one() {
  const Scene scene = three_triangles();
  Forest forest(scene);
  split_unevenly(forest, 9);
  for (size_t count = 0; count <= Forest::most_met; ++count)
    for (uint64_t draw = 0; draw < 50; ++draw) {
      std::vector<Hit> hits(count);
      size_t of_nothing = 0;
      for (size_t k = 0; k < count; ++k) {
        const uint64_t h = mix(draw, count, k);
        Hit& hit = hits[k];
        hit.patch = static_cast<int64_t>(mix(h, 1) % (scene.patch_count() + 1)) - 1;
        hit.back = mix(h, 2) & 1;
        hit.u = unit_interval(mix(h, 3));
        hit.v = unit_interval(mix(h, 4)) * (1 - hit.u);
        of_nothing += hit.patch < 0;
      }
      std::vector<NodeId> leaves(count, -7);
      forest.leaves_met({hits.data(), count}, leaves.data());
      for (size_t k = 0; k < count; ++k) {
        CHECK_EQUAL(leaves[k], forest.leaf_met(hits[k]));
        of_nothing -= hits[k].patch < 0 && leaves[k] == -1;
      }
      CHECK_EQUAL(of_nothing, size_t{0});
    }
}

// Order of keys: patch, side, path from the root; the leaves cover every surface once.
void leaves_come_in_key_order() {
  const Scene scene = three_triangles();
  Forest forest(scene);
  split_unevenly(forest, 7);
  std::vector<std::vector<int>> paths;
  std::vector<double> area(forest.surfaces.size(), 0);
  for (NodeId leaf : forest.leaves()) {
    CHECK(forest.is_leaf(leaf));
    std::vector<int> path;
    for (NodeId id = leaf; forest.nodes[id].parent >= 0; id = forest.nodes[id].parent)
      path.insert(path.begin(), id - forest.nodes[forest.nodes[id].parent].first_child);
    path.insert(path.begin(), forest.nodes[leaf].surface);
    paths.push_back(path);
    area[forest.nodes[leaf].surface] += forest.area(forest.nodes[leaf]);
  }
  CHECK(std::is_sorted(paths.begin(), paths.end()));
  CHECK(std::adjacent_find(paths.begin(), paths.end()) == paths.end());
  for (size_t k = 0; k < area.size(); ++k) CHECK_NEAR(area[k] / forest.surfaces[k].area, 1, 1e-12);
}

void keys_are_unique() {
  const Scene scene = three_triangles();
  Forest forest(scene);
  split_all(forest, 6);
  std::set<uint64_t> keys;
  for (const Node& node : forest.nodes) keys.insert(key_of(forest, node));
  CHECK_EQUAL(keys.size(), forest.nodes.size());
}

// Whatever the order in which elements are made.
void keys_do_not_depend_on_the_order_of_splitting() {
  const Scene scene = three_triangles();
  Forest forward(scene), backward(scene);
  for (NodeId root = 0; root < forward.surface_count(); ++root) split_node(forward, root);
  for (NodeId root = 3; root >= 0; --root) split_node(backward, root);
  std::vector<uint64_t> a, b;
  for (NodeId leaf : forward.leaves()) a.push_back(key_of(forward, forward.nodes[leaf]));
  for (NodeId leaf : backward.leaves()) b.push_back(key_of(backward, backward.nodes[leaf]));
  CHECK(a == b);
}

void two_sided_patches_have_two_roots() {
  const Scene scene = three_triangles();
  const Forest forest(scene);
  CHECK_EQUAL(forest.surface_count(), int64_t{4});
  CHECK_EQUAL(forest.root(0, 0), 0);
  CHECK_EQUAL(forest.root(0, 1), -1);
  CHECK_EQUAL(forest.root(1, 0), 1);
  CHECK_EQUAL(forest.root(1, 1), 2);
  CHECK_EQUAL(forest.root(2, 0), 3);
  const Surface &front = forest.surfaces[1], &back = forest.surfaces[2];
  CHECK_EQUAL(front.patch, back.patch);
  CHECK(front.side == 0 && back.side == 1);
  CHECK_EQUAL(front.area, back.area);
  CHECK_EQUAL(length(front.normal + back.normal), 0.0);
  for (int32_t k = 0; k < 4; ++k) {
    // Anticlockwise seen from the surface's own side.
    const Vec3 normal = normalized(forest.root_triangle(k).area_vector());
    CHECK_NEAR(dot(normal, forest.surfaces[k].normal), 1, 1e-14);
  }
  // The same point of the patch: u and v change places.
  const Vec3 seen = forest.root_triangle(1).at(0.2, 0.5) - forest.root_triangle(2).at(0.5, 0.2);
  CHECK_NEAR(length(seen), 0, 1e-15);
}

void dropped_patches_and_blockers_have_no_roots() {
  Scene scene = three_triangles();
  Material blocker;
  blocker.blocker = true;
  scene.add_material(blocker);
  scene.add_patch(0, 1, 5, 2);
  scene.flags[0] |= patch_dropped;
  const Forest forest(scene);
  CHECK_EQUAL(forest.surface_count(), int64_t{3});
  for (int32_t side : {0, 1}) {
    CHECK_EQUAL(forest.root(0, side), -1);
    CHECK_EQUAL(forest.root(3, side), -1);
  }
  CHECK_EQUAL(forest.root(1, 0), 0);
  CHECK_EQUAL(forest.root(2, 0), 2);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(children_tile_their_parent),
      HRAD_TEST(areas_are_those_of_the_corners),
      HRAD_TEST(neighbours_share_their_corners),
      HRAD_TEST(the_deepest_level_fits_the_lattice),
      HRAD_TEST(leaf_at_finds_the_leaf_around_a_point),
      HRAD_TEST(leaves_are_met_together_as_one_by_one),
      HRAD_TEST(leaves_come_in_key_order),
      HRAD_TEST(keys_are_unique),
      HRAD_TEST(keys_do_not_depend_on_the_order_of_splitting),
      HRAD_TEST(two_sided_patches_have_two_roots),
      HRAD_TEST(dropped_patches_and_blockers_have_no_roots),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
