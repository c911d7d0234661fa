// Direct light of the leaves: the points at which each of them knows it, and its mean.
// Floor 7 (stages).
#pragma once

#include <vector>

#include "stages/corner_light.h"
#include "stages/open_cubes.h"

namespace hrad {

// What LightGrid decides by.
OrientedPoint middle_of(const Forest& forest, NodeId leaf);
KeyedPoint keyed_middle_of(const Forest& forest, NodeId leaf);

// Of points that the mean of a large leaf is made of where it is known at no points of its own.
constexpr int points_of_a_mean = 16;

// Of sampling the middle of a leaf, beside points of a mesh that is being divided.
constexpr double work_of_a_middle = 0.75;

class LeafLight {
 public:
  // All must outlive this.
  LeafLight(State& state, const StageTools& tools, LightGrid& grid, CornerSampler& corners)
      : state_(state), forest_(state.forest), tools_(tools), grid_(grid), corners_(corners) {}

  // Gives the leaves made since the last time their points and means, and takes those of elements
  // that are no longer leaves. The corners of the leaves must be known. False: stopped.
  bool name();
  // The same where means alone are wanted: points spread over the exposed part of each, fewer on
  // leaves below the area `large`, by its root.
  bool name_means(const DirectLight& light, double large);

 private:
  struct Shares;
  enum class Whose { own, all };
  std::vector<NodeId> new_leaves(Whose whose);
  void forget_divided();
  bool take_corners(NodeId leaf);
  void take_own_points(const std::vector<NodeId>& leaves);
  std::vector<int32_t> ask_for_middles(const std::vector<NodeId>& leaves);
  Shares shares_of_mean(NodeId leaf, int32_t centroid) const;
  std::vector<OrientedPoint> points_over(NodeId leaf, double large) const;
  void add_up(std::vector<Link>& all, const OrientedPoint& middle, std::vector<Link>& run) const;
  void add_up_means(const std::vector<NodeId>& leaves, const std::vector<int32_t>& centroids);

  State& state_;
  Forest& forest_;
  const StageTools& tools_;
  LightGrid& grid_;
  CornerSampler& corners_;
  NodeId named_ = 0;  // nodes before this one have been looked at
};

}  // namespace hrad
