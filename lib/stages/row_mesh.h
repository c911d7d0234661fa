// The mesh of linking by rows: cells, the elements that own rows of rays, and below them smaller
// elements where light straight from bright emitters varies (design: `rows`). Floor 7 (stages).
#pragma once

#include <memory>
#include <vector>

#include "hierarchy/corner_names.h"
#include "links/link_sampler.h"
#include "stages/corner_light.h"
#include "stages/leaf_light.h"
#include "stages/rows.h"
#include "stages/state_memory.h"

namespace hrad {

class RowMesh {
 public:
  // State, light, grid and memory must outlive this.
  RowMesh(State& state, StageTools tools, const RowSettings& settings, const DirectLight& light,
          LightGrid& grid, const Brightness& brightness, StageMemory& memory);

  // Cells of even size, and direct light on a mesh as fine as it needs. False: stopped.
  bool build();

  // Divides the cells in which reflected light varies too much, by the present light on their rows.
  // new_cells: those without a row. False: stopped.
  bool divide_cells(const Brightness& brightness, std::vector<NodeId>& new_cells);

  // Of the work of linking, the share that build() is: guessed once it has begun.
  double share_of_work() const { return share_; }

  // Keeps the points and links that leaves need: the mesh is as it is to be.
  void keep_what_is_named() { corners_.keep_what_is_named(); }

 private:
  bool is_mine(NodeId id) const;
  NodeId add_children(const std::vector<NodeId>& parents);
  bool measure_exposure(NodeId from);
  std::vector<NodeId> exposed_of(const std::vector<NodeId>& elements) const;
  bool open_grid(const std::vector<NodeId>& cells);
  void guess_share(const std::vector<NodeId>& cells, const std::vector<OrientedPoint>& points);
  bool sample_corners();
  bool is_too_long(const Node& node) const;
  int levels_of_length() const;
  bool make_cells();
  bool keep_small_patches(std::vector<NodeId>& open);
  bool refine(std::vector<NodeId> open);
  double points_after(double of_level, double of_level_before) const;
  std::vector<uint8_t> fate_of(const std::vector<NodeId>& open,
                               const std::vector<size_t>& asked) const;
  std::vector<ElementPoints> points_of_own(const std::vector<NodeId>& elements,
                                           PointsOf which) const;
  std::vector<uint8_t> uneven_cells(const Brightness& brightness);
  void divide_leaves(const std::vector<NodeId>& leaves);
  void replace_cells(const std::vector<NodeId>& divided, std::vector<NodeId>& new_cells);
  bool may_divide(NodeId id) const;
  double light_at(int32_t surface, LatticePoint corner) const;
  double deviation(NodeId id) const;
  double weighed(double deviation, double area) const;
  bool name_leaves();

  State& state_;
  Forest& forest_;
  double share_ = 0.3;
  int64_t small_patches_ = 0;  // left as they are
  const StageTools tools_;
  const RowSettings settings_;
  const DirectLight& light_;
  LightGrid& grid_;
  CornerSampler corners_;
  LeafLight leaves_;
  std::unique_ptr<CornerNames> names_;  // once cells are compared
  StageMemory& memory_;
};

}  // namespace hrad
