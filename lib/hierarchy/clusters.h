// Clusters: the patches' sides gathered into one tree above the roots, so that light between far
// groups of them needs one link (design: clusters as ordinary nodes). Built once, before anything
// is linked. Floor 5 (hierarchy).
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "hierarchy/node.h"

namespace hrad {

// Light is not taken to leave a cluster, or to arrive on it, as on one surface when its normals
// spread wider than this: rad from the mean one.
constexpr double widest_cone = 0.6;

struct Cluster {
  NodeId child[2] = {-1, -1};    // clusters or roots
  int32_t first = 0, count = 0;  // its surfaces in ClusterTree::order
  // All its surfaces lie within the sphere, and within `thickness` of the plane through its center.
  Vec3 center, normal;
  double radius = 0, thickness = 0;
  double cone = 0;  // largest angle between `normal` and that of a surface, rad
  double area = 0;  // of the exposed parts
  bool linkable() const { return cone <= widest_cone; }
};

// Parents before children; cluster c is node surface_count() + c of the forest. Over all surfaces,
// or over some (linking=rows: the lamps).
struct ClusterTree {
  std::vector<Cluster> clusters;
  std::vector<int32_t> order;       // surfaces, those of every cluster side by side
  std::vector<double> area_before;  // exposed area of those before each in `order`, and of all
  bool empty() const { return clusters.empty(); }
};

class Forest;

// Makes the tree over all surfaces and its nodes; the forest has no elements yet. Depends on the
// scene alone.
void add_clusters(Forest& forest);

// What a tree is built of: surfaces of one place and size stay together the longest.
struct ClusterItem {
  int32_t surface;
  Vec3 place;
  double size;
};

// The same over some of the surfaces.
void add_clusters(Forest& forest, const std::vector<ClusterItem>& items);

// Makes a tree again from its order of surfaces, which must name none twice, and of every cluster
// in turn how many surfaces its first child has. The forest has the nodes of the clusters already.
// False, and the tree is of no use, when there is no such tree or it is deeper than any that
// add_clusters() makes.
bool restore_clusters(Forest& forest, std::vector<int32_t> order, const std::vector<int32_t>& left);

// Areas from the roots' present exposed shares.
void measure_clusters(Forest& forest);

}  // namespace hrad
