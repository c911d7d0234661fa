// The hierarchy: every exchanging side of a patch is a surface, the root of a tree of elements made
// by 4-way midpoint subdivision (paper, Section 2; Hanrahan, Saltzman, Aupperle 1991, Section 3).
// Clusters of surfaces may stand above the roots. Flat arrays. Floor 5 (hierarchy).
#pragma once

#include <cstdint>
#include <vector>

#include "base/span.h"
#include "base/vec3.h"
#include "hierarchy/clusters.h"
#include "hierarchy/node_array.h"
#include "scene/scene.h"
#include "visibility/visibility.h"

namespace hrad {

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

class Forest {
 public:
  explicit Forest(const Scene& scene);

  int64_t surface_count() const { return static_cast<int64_t>(surfaces.size()); }
  static bool is_cluster(const Node& n) { return n.surface < 0; }
  const Cluster& cluster(const Node& n) const { return clusters.clusters[-1 - n.surface]; }
  // Where light enters the tree: the cluster of all surfaces, or the only surface.
  NodeId top() const { return clusters.empty() ? 0 : static_cast<NodeId>(surface_count()); }
  bool is_leaf(NodeId n) const { return nodes.first_child(n) < 0; }
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
  int64_t leaf_count() const {
    return surface_count() + 3 * static_cast<int64_t>(nodes.size() - nodes.first_element()) / 4;
  }
  // All leaves in key order (patch, side, path).
  std::vector<NodeId> leaves() const;

  const Scene* scene;
  std::vector<Surface> surfaces;  // in key order (patch, side)
  NodeArray nodes;
  ClusterTree clusters;

 private:
  NodeId root_met(const Hit& hit) const;
  std::vector<int32_t> first_surface_;  // per patch, -1 when it exchanges nothing
};

}  // namespace hrad
