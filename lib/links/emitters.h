// The bright emitters, those whose light comes through links of its own rather than by chance:
// joined where they lie in one plane, side by side, with the same emission; and groups of such, one
// emitter seen from afar. Floor 6 (links).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hierarchy/forest.h"
#include "visibility/exposure.h"

namespace hrad {

// Emitting surfaces that shine alike: of one plane, or a group of such emitters.
struct Emitter {
  Vec3 center, normal;
  double radius = 0, area = 0, exposed_area = 0;
  double thickness = 0;   // how far from the plane through the center a group reaches
  double brightness = 0;  // radiosity over the scene's mean, in units of the mean irradiance
  std::vector<NodeId> surfaces;
  std::vector<double> exposed;  // the share of each surface that isn't sealed
  // The middle of what is exposed, and what it would be if that were spread evenly over each
  // surface.
  Vec3 exposed_center, even_center;
  // Points spread over its exposed part by area, as each sixteen in a row are.
  static constexpr size_t point_count = 64;
  Vec3 point(size_t k) const {
    return {center.x + from_center[k][0], center.y + from_center[k][1],
            center.z + from_center[k][2]};
  }
  std::array<std::array<float, 3>, point_count> from_center;
  // Of a group: its cluster, the source of its links, and the numbers of the emitters in it.
  NodeId cluster = -1;
  std::vector<int32_t> members;
  std::vector<int32_t> parts;  // the smaller groups and single emitters that it falls into
  int32_t group = -1;          // the number of the smallest group that it is in
};

class Emitters {
 public:
  // brightness: per root, its radiosity in units of the scene's mean irradiance, reflected light
  // included. least_bright: what brightness squared times form factor must reach for an emitter to
  // be bright where it is seen so large. The forest's roots know how much of them is exposed, and
  // exposure where; what is sealed sends no light. It need not outlive this.
  Emitters(const Forest& forest, const Exposure& exposure, const std::vector<float>& brightness,
           double least_bright);

  // Where there are many, makes groups of those that face the same way and shine alike, and gives
  // the forest, of roots alone so far, a tree of clusters over the emitting surfaces.
  void join(Forest& forest, const Exposure& exposure);

  // The single ones, then the groups, larger ones before those within.
  const std::vector<Emitter>& all() const { return emitters_; }
  // Those in no group.
  const std::vector<int32_t>& tops() const { return tops_; }
  // Number of the emitter that a root belongs to, or of the group of a cluster; -1: it is none.
  int32_t of_node(NodeId id) const { return of_node_[id]; }
  // Whether any node can be the source of links from emitters: one that there is.
  bool is_emitter(NodeId id) const {
    return id >= 0 && static_cast<size_t>(id) < of_node_.size() && of_node_[id] >= 0;
  }
  // About the emitter's form factor at x on a surface of this normal, 0 behind a horizon: a matter
  // of geometry alone, whether it is seen or not.
  static double rough_factor(const Emitter& emitter, Vec3 x, Vec3 normal);
  bool is_bright(const Emitter& emitter, double factor) const {
    return emitter.brightness * emitter.brightness * factor > least_bright_;
  }
  bool bright(const Emitter& emitter, Vec3 x, Vec3 normal) const {
    return is_bright(emitter, rough_factor(emitter, x, normal));
  }
  // Whether the emitter is to be sampled at a point: also where it is not quite bright, but may be
  // so in the middle of a leaf that the point belongs to.
  bool is_sampled(const Emitter& emitter, double factor) const {
    return is_bright(emitter, factor * sampling_margin);
  }
  // What rough_factor may be at the most at a point of this ball.
  static double largest_factor(const Emitter& emitter, Vec3 center, double radius);

 private:
  static constexpr double sampling_margin = 2;

  std::vector<int32_t> members_of(const Forest& forest, const Cluster& cluster) const;
  void find_groups(const Forest& forest, const Exposure& exposure, NodeId id, int32_t around);

  std::vector<Emitter> emitters_;
  std::vector<int32_t> tops_;
  std::vector<int32_t> of_node_;  // of roots and clusters
  double least_bright_;
};

}  // namespace hrad
