// The hierarchy: every exchanging side of a patch is a surface, the root of a tree of elements made
// by 4-way midpoint subdivision (paper, Section 2; Hanrahan, Saltzman, Aupperle 1991, Section 3).
// Clusters of surfaces may stand above the roots. Flat arrays. Floor 5 (hierarchy).
#pragma once

#include <cstdint>
#include <vector>

#include "base/growing_array.h"
#include "base/span.h"
#include "base/vec3.h"
#include "hierarchy/clusters.h"
#include "scene/scene.h"
#include "visibility/visibility.h"

namespace hrad {

// NodeId is an index into Forest::nodes. The first surface_count() nodes are the roots; the
// clusters follow, if there are any, and then the elements, parents before children.

constexpr int max_level = 15;  // lattice coordinates of an element fit into 16 bits

// One exchanging side of a patch: what a tree grows from.
struct Surface {
  int32_t patch = 0;
  int32_t side = 0;  // 0 front, 1 back
  Vec3 normal;       // towards the side the light comes from
  double area = 0;
};

// In one plane, and facing the same way.
inline bool share_plane(const Surface& a, const Surface& b) {
  return dot(a.normal, b.normal) > 1 - 1e-9;
}

// Where the direct light of a leaf is known (linking=rows).
enum LightPoints : uint8_t {
  at_corners,
  half_way_to_the_middle,  // from the corners
  at_own_points,           // of its exposed part
};

// An element, or a cluster, of which only parent and surface mean anything. An element's place in
// the patch is a triangle of the lattice that L subdivisions draw: with the point of coordinates
// (i,j) at u = i/2^L, v = j/2^L, an upright one has the corners (i,j), (i+1,j), (i,j+1), an
// inverted one (i+1,j+1), (i,j+1), (i+1,j). So a node needs no corners of its own, and neighbours
// share exactly the same ones.
struct Node {
  NodeId parent = -1;       // of a root the cluster that holds it
  NodeId first_child = -1;  // the four children stand side by side; -1: a leaf
  int32_t surface = 0;      // -1-c: cluster c
  uint16_t i = 0, j = 0;
  uint8_t level = 0;
  uint8_t inverted = 0;
  uint8_t light_points = 0;  // LightPoints
  uint8_t reserved = 0;
  float exposed = 1;  // share of the area that is not sealed (design: the exposure rule)
};
static_assert(sizeof(Node) <= 24, "nodes are to stay small");

// From (u,v) of the root triangle to (x,y) within an element, measured from its first corner, and
// back.
inline void element_coordinates(const Node& n, double u, double v, double* x, double* y) {
  const double scale = static_cast<double>(1 << n.level);
  *x = u * scale - n.i;
  *y = v * scale - n.j;
  if (n.inverted) {
    *x = 1 - *x;
    *y = 1 - *y;
  }
}
inline void root_coordinates(const Node& n, double x, double y, double* u, double* v) {
  const double scale = static_cast<double>(1 << n.level);
  *u = (n.i + (n.inverted ? 1 - x : x)) / scale;
  *v = (n.j + (n.inverted ? 1 - y : y)) / scale;
}

// The lattice place of one of the four children; 3 is the one in the middle.
Node child_place(const Node& parent, int child);

// Makes four nodes from `first` on, which are there already, the children of a leaf. Their exposure
// is that of the parent, which is right where it is whole.
void place_children(GrowingArray<Node>& nodes, NodeId parent, NodeId first);

// MEMORY when so many nodes are more than have numbers.
void require_numbers(size_t nodes);

class Forest {
 public:
  explicit Forest(const Scene& scene);

  int64_t surface_count() const { return static_cast<int64_t>(surfaces.size()); }
  static bool is_cluster(const Node& n) { return n.surface < 0; }
  const Cluster& cluster(const Node& n) const { return clusters.clusters[-1 - n.surface]; }
  // Where light enters the tree: the cluster of all surfaces, or the only surface.
  NodeId top() const { return clusters.empty() ? 0 : static_cast<NodeId>(surface_count()); }
  bool is_leaf(NodeId n) const { return nodes[n].first_child < 0; }
  double area(const Node& n) const {
    if (is_cluster(n)) return cluster(n).area;
    return surfaces[n.surface].area / static_cast<double>(int64_t{1} << (2 * n.level));
  }
  double total_area() const;  // of all surfaces
  // Corners of the patch as seen from the surface's side.
  Triangle root_triangle(int32_t surface) const;
  Triangle triangle(const Node& n) const;
  // The root of a side of a patch, -1 when that side exchanges nothing.
  NodeId root(int64_t patch, int32_t side) const;
  // The leaf of a surface that holds the point (u,v) of its root triangle.
  NodeId leaf_at(NodeId root, double u, double v) const;
  // The leaf that a ray has met, -1 where nothing that exchanges light on that side was met.
  NodeId leaf_met(const Hit& hit) const;
  // The same of many, which don't wait for memory one after the other.
  static constexpr size_t most_met = 16;
  void leaves_met(Span<const Hit> hits, NodeId* leaves) const;
  // All leaves in key order (patch, side, path).
  std::vector<NodeId> leaves() const;

  const Scene* scene;
  std::vector<Surface> surfaces;  // in key order (patch, side)
  GrowingArray<Node> nodes;
  ClusterTree clusters;

 private:
  NodeId root_met(const Hit& hit) const;
  NodeId child_at(const Node& node, double u, double v) const;
  std::vector<int32_t> first_surface_;  // per patch, -1 when it exchanges nothing
};

}  // namespace hrad
