// The geometry of an end of a link, element or cluster, worked out once for the many links it takes
// part in. Floor 6 (links).
#pragma once

#include "base/hash.h"
#include "hierarchy/forest.h"

namespace hrad {

struct EndPoints;

struct Element {
  Triangle corners;  // of a cluster none
  Vec3 normal, centroid;
  double area = 0;    // of a cluster that of its exposed parts
  double radius = 0;  // of the sphere around the centroid that holds the corners
  int32_t surface = 0;
  float exposed = 1;
  const Cluster* cluster = nullptr;   // none: an element
  const EndPoints* points = nullptr;  // where it is sampled, if that is known already
  double exposed_area() const { return cluster ? area : area * exposed; }
};

inline Element element_of(const Forest& forest, const Node& node) {
  Element e;
  if (Forest::is_cluster(node)) {
    e.cluster = &forest.cluster(node);
    e.normal = e.cluster->normal;
    e.centroid = e.cluster->center;
    e.area = e.cluster->area;
    e.radius = e.cluster->radius;
    e.surface = node.surface;
    e.exposed = node.exposed;
    return e;
  }
  e.corners = forest.triangle(node);
  e.normal = forest.surfaces[node.surface].normal;
  e.centroid = e.corners.centroid();
  e.area = forest.area(node);
  e.radius = e.corners.radius();
  e.surface = node.surface;
  e.exposed = node.exposed;
  return e;
}

// The ends of a link by size: what the smaller sees of the larger takes few points to tell.
struct EndsBySize {
  EndsBySize(const Element& receiver, const Element& source)
      : receiver_smaller(receiver.area <= source.area),
        small(receiver_smaller ? receiver : source),
        large(receiver_smaller ? source : receiver) {}
  bool receiver_smaller;
  const Element &small, &large;
};

// The name of an element, whatever the order in which elements were made.
inline uint64_t key_of(const Forest& forest, const Node& node) {
  if (Forest::is_cluster(node))
    return mix(0x636c7573746572u, static_cast<uint64_t>(-static_cast<int64_t>(node.surface)));
  const Surface& surface = forest.surfaces[node.surface];
  const uint64_t place = (static_cast<uint64_t>(node.level) << 33) |
                         (static_cast<uint64_t>(node.inverted) << 32) |
                         (static_cast<uint64_t>(node.i) << 16) | node.j;
  return mix((static_cast<uint64_t>(surface.patch) << 1) | static_cast<uint64_t>(surface.side),
             place);
}

}  // namespace hrad
