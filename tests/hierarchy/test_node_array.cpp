// Nodes that share what their parent says are read as they were made.
#include <algorithm>

#include "base/hash.h"
#include "hierarchy/node_array.h"
#include "support/check.h"

using namespace hrad;
using namespace hrad_test;

namespace {

bool same_place(const LatticePlace& a, const LatticePlace& b) {
  return a.i == b.i && a.j == b.j && a.level == b.level && a.inverted == b.inverted;
}

// Three roots and two clusters, and below each root a path of families down to the smallest
// elements, through any children.
struct Deep {
  Deep() : nodes(3) {
    nodes.add_clusters(2);
    for (NodeId root = 0; root < 3; ++root) {
      NodeId parent = root;
      for (int level = 0; level < max_level; ++level) {
        const NodeId first = static_cast<NodeId>(nodes.size());
        nodes.resize(nodes.size() + 4);
        nodes.adopt(parent, first);
        // The first root's path keeps to the corner of the largest coordinates.
        parent = first + (root == 0 ? 1 : static_cast<NodeId>(mix(root, level) % 4));
      }
    }
  }
  NodeArray nodes;
};

void children_are_parts_of_their_parents() {
  const Deep deep;
  const NodeArray& nodes = deep.nodes;
  CHECK_EQUAL(nodes.first_element(), size_t{5});
  CHECK_EQUAL(nodes.size(), size_t{5 + 3 * 4 * max_level});
  int deepest = 0;
  for (size_t k = 0; k < nodes.size(); ++k) {
    const Node parent = nodes[k];
    CHECK_EQUAL(parent.first_child, nodes.first_child(k));
    if (parent.first_child < 0) continue;
    for (int c = 0; c < 4; ++c) {
      const Node child = nodes[static_cast<size_t>(parent.first_child + c)];
      CHECK(same_place(child, child_place(parent, c)));
      CHECK_EQUAL(child.parent, static_cast<NodeId>(k));
      CHECK_EQUAL(child.surface, parent.surface);
      deepest = std::max<int>(deepest, child.level);
    }
  }
  CHECK_EQUAL(deepest, max_level);
  CHECK_EQUAL(nodes[5 + 4 * (max_level - 1) + 1].i, (1 << max_level) - 1);
}

void tops_say_what_they_are() {
  Deep deep;
  deep.nodes.set_parent_of_top(1, 4);
  deep.nodes.set_parent_of_top(4, 3);
  CHECK_EQUAL(deep.nodes[1].parent, 4);
  CHECK_EQUAL(deep.nodes[4].parent, 3);
  CHECK_EQUAL(deep.nodes[0].parent, -1);
  CHECK_EQUAL(deep.nodes[2].surface, 2);
  CHECK_EQUAL(deep.nodes[3].surface, -1);
  CHECK_EQUAL(deep.nodes[4].surface, -2);
  CHECK_EQUAL(deep.nodes[2].level, 0);
}

void values_of_a_node_are_its_own() {
  Deep deep;
  NodeArray& nodes = deep.nodes;
  const auto share = [](size_t k) { return static_cast<float>(k % 17) / 16; };
  const auto points = [](size_t k) { return static_cast<LightPoints>(k % 3); };
  for (size_t k = 0; k < nodes.size(); ++k) {
    nodes.set_exposed(k, share(k));
    nodes.set_light_points(k, points(k));
  }
  size_t k = 0;
  for (const Node& node : nodes) {
    CHECK_EQUAL(node.exposed, share(k));
    CHECK_EQUAL(nodes.exposed(k), share(k));
    CHECK_EQUAL(static_cast<int>(node.light_points), static_cast<int>(points(k)));
    CHECK_EQUAL(node.first_child, nodes.first_child(k));
    ++k;
  }
  CHECK_EQUAL(k, nodes.size());
  // Children begin as exposed as their parent, with no light points of their own.
  const size_t first = nodes.size(), parent = first - 1;
  nodes.resize(first + 4);
  nodes.adopt(static_cast<NodeId>(parent), static_cast<NodeId>(first));
  CHECK_EQUAL(nodes[first + 2].exposed, share(parent));
  CHECK_EQUAL(static_cast<int>(nodes[first + 2].light_points), static_cast<int>(at_corners));
  CHECK_EQUAL(static_cast<int>(nodes[parent].light_points), static_cast<int>(points(parent)));
  nodes.lose_children(parent);
  nodes.resize(first);
  CHECK_EQUAL(nodes.first_child(parent), -1);
  CHECK_EQUAL(nodes[parent].exposed, share(parent));
}

// Down to the element that holds a point.
void a_point_lies_in_one_part() {
  for (uint64_t k = 0; k < 2000; ++k) {
    double u = unit_interval(mix(k, 1)), v = unit_interval(mix(k, 2));
    if (u + v > 1) u = 1 - u, v = 1 - v;
    LatticePlace place;
    WayDown way(u, v);
    double x, y;
    for (int level = 0; level < max_level; ++level) {
      element_coordinates(place, u, v, &x, &y);
      const int part = way.next();
      CHECK_EQUAL(part, x > 0.5 ? 1 : y > 0.5 ? 2 : x + y < 0.5 ? 0 : 3);
      place = part_of(place, part);
    }
    element_coordinates(place, u, v, &x, &y);
    CHECK(x >= -1e-9 && y >= -1e-9 && x + y <= 1 + 1e-9);
    double back_u, back_v;
    root_coordinates(place, x, y, &back_u, &back_v);
    CHECK_NEAR(back_u, u, 1e-15);
    CHECK_NEAR(back_v, v, 1e-15);
  }
}

void eleven_bytes_a_node() {
  NodeArray nodes(1);
  const size_t elements = 40000;
  nodes.resize(1 + elements);
  nodes.shrink_to_fit();
  CHECK_EQUAL(nodes.bytes(), static_cast<int64_t>(12 + 11 * elements));
  CHECK(nodes.bytes() <= NodeArray::most_bytes_of_a_node * static_cast<int64_t>(nodes.size()));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(children_are_parts_of_their_parents),
      HRAD_TEST(tops_say_what_they_are),
      HRAD_TEST(values_of_a_node_are_its_own),
      HRAD_TEST(a_point_lies_in_one_part),
      HRAD_TEST(eleven_bytes_a_node),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
