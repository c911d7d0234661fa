// Dividing elements level by level of all surfaces together, so that each step is one even batch of
// work. Floor 7 (stages).
#include "stages/row_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "machine/pieces.h"
#include "stages/exchange.h"

namespace hrad {
namespace {

// An element whose middles are known already is divided for this share of the tolerance.
constexpr double worth_keeping = 0.5;

// Of an open element: whether it is divided, and its children opened.
enum Fate : uint8_t { stays, is_divided, goes_on };

// To guess how much work there will be: points of direct light for each cell, and for each that is
// a patch, as most of these are left as they are; work on a point beside its shadow rays, and on a
// ray of a row with all that follows from it, in shadow rays.
constexpr double points_of_a_cell = 8, points_of_a_small_patch = 3.5;
constexpr double work_of_a_point = 10, work_of_a_row_ray = 12;
// Points of a level over those of the one before, at the most.
constexpr double most_growth = 0.6;
constexpr size_t most_looked_at = 4096;

StageTools reporting_to_share(StageTools tools, const double& share) {
  tools.progress = [whole = std::move(tools.progress), &share](double fraction) {
    return whole(share * fraction);
  };
  return tools;
}

}  // namespace

RowMesh::RowMesh(State& state, StageTools tools, const RowSettings& settings,
                 const DirectLight& light, LightGrid& grid, const Brightness& brightness,
                 StageMemory& memory)
    : state_(state),
      forest_(state.forest),
      tools_(reporting_to_share(std::move(tools), share_)),
      settings_(settings),
      light_(light),
      grid_(grid),
      corners_(state, tools_, light, grid, brightness, settings.seed),
      leaves_(state, tools_, grid, corners_),
      memory_(memory) {}

bool RowMesh::build() {
  if (!make_cells()) return false;
  std::vector<NodeId> open = exposed_of(state_.cells);
  if (!open_grid(open)) return false;
  if (settings_.means_only) return name_leaves();
  if (!keep_small_patches(open)) return false;
  corners_.want(points_of_own(open, PointsOf::corners));
  return sample_corners() && refine(std::move(open)) && name_leaves();
}

// By points from all over the scene, before the first that are sampled, whose places are special.
bool RowMesh::open_grid(const std::vector<NodeId>& cells) {
  std::vector<OrientedPoint> points(3 * cells.size());
  for_each_thing(tools_.team, cells.size(), [&](size_t k) {
    const OrientedPoint middle = middle_of(forest_, cells[k]);
    const Triangle t = forest_.triangle(forest_.nodes[cells[k]]);
    OrientedPoint* next = &points[3 * k];
    for (const Vec3& corner : {t.a, t.b, t.c})
      *next++ = {(corner + middle.place) * 0.5, middle.normal};
  });
  if (!open_cubes(grid_, points, state_, tools_)) return false;
  guess_share(cells, points);
  return true;
}

// points: three of each cell.
void RowMesh::guess_share(const std::vector<NodeId>& cells,
                          const std::vector<OrientedPoint>& points) {
  const auto points_of = [&](NodeId cell) {
    return forest_.nodes[cell].level == 0 ? points_of_a_small_patch : points_of_a_cell;
  };
  double expected = 0;
  for (NodeId cell : cells) expected += points_of(cell);
  corners_.expect(expected);
  const size_t step = cells.size() / most_looked_at + 1;
  std::vector<double> shadow_rays((cells.size() + step - 1) / step);
  for_each_thing(tools_.team, shadow_rays.size(),
                 [&](size_t k) { shadow_rays[k] = light_.rays_at(points[3 * step * k]); });
  double shadow = 0, rows = 0;
  for (size_t k = 0; k < shadow_rays.size(); ++k) {
    shadow += points_of(cells[step * k]) * (work_of_a_point + shadow_rays[k]);
    rows += work_of_a_row_ray * settings_.rays_of(forest_.area(forest_.nodes[cells[step * k]]));
  }
  if (shadow > 0) share_ = shadow / (shadow + rows);
}

bool RowMesh::is_mine(NodeId id) const { return tools_.exchange.mine(forest_.nodes[id].surface); }

bool RowMesh::sample_corners() {
  if (!corners_.sample()) return false;
  memory_.settle();
  return true;
}

// Patches no larger than a cell: three points half way to the middle have the mean of every
// quadratic field, while corners lie in creases and contacts. Where these agree the patch is left
// as it is, and taken out of `open`.
bool RowMesh::keep_small_patches(std::vector<NodeId>& open) {
  std::vector<NodeId> small;
  for (NodeId id : open)
    if (forest_.nodes[id].level == 0) small.push_back(id);
  corners_.want(points_of_own(small, PointsOf::half_way_to_the_middle));
  if (!sample_corners()) return false;
  std::vector<uint8_t> kept(open.size(), 0);
  for_each_thing(tools_.team, open.size(), [&](size_t k) {
    const Node& node = forest_.nodes[open[k]];
    if (node.level > 0 || !is_mine(open[k])) return;
    LatticePoint point[3];
    half_way_points(node, point);
    double low = 1e300, high = -1;
    for (const LatticePoint& p : point) {
      low = std::min(low, corners_.value(node.surface, p));
      high = std::max(high, corners_.value(node.surface, p));
    }
    kept[k] = low >= 0 && weighed((high - low) / 2, forest_.area(node)) <= 1;
  });
  tools_.exchange.share(
      kept, [&](size_t k) { return forest_.nodes[open[k]].surface; }, tools_.team);
  std::vector<NodeId> rest;
  for (size_t k = 0; k < open.size(); ++k) {
    if (kept[k])
      forest_.nodes.set_light_points(open[k], half_way_to_the_middle);
    else
      rest.push_back(open[k]);
  }
  small_patches_ = static_cast<int64_t>(open.size() - rest.size());
  open.swap(rest);
  return true;
}

// Of this process's own among the elements.
std::vector<ElementPoints> RowMesh::points_of_own(const std::vector<NodeId>& elements,
                                                  PointsOf which) const {
  return gathered<ElementPoints>(tools_.team, elements.size(),
                                 [&](size_t k, std::vector<ElementPoints>& own) {
                                   if (is_mine(elements[k])) own.push_back({elements[k], which});
                                 });
}

// To guess how much work there will be, of the points that two levels ask for: later levels go on
// as these did, each of their points brings a leaf, and each leaf but small patches asks for its
// middle.
double RowMesh::points_after(double of_level, double of_level_before) const {
  const double growth =
      of_level_before > 0 ? std::min(most_growth, of_level / of_level_before) : most_growth;
  const double of_later_levels = of_level * growth / (1 - growth);
  const double leaves =
      static_cast<double>(static_cast<int64_t>(forest_.nodes.size()) - small_patches_) * 3 / 4;
  return work_of_a_middle * (leaves + of_level + of_later_levels) + of_later_levels;
}

// Divides the open elements, whose corners are known, until direct light is linear between them.
bool RowMesh::refine(std::vector<NodeId> open) {
  double of_level_before = 0;
  while (!open.empty()) {
    const std::vector<size_t> asked =
        gathered<size_t>(tools_.team, open.size(), [&](size_t k, std::vector<size_t>& some) {
          if (is_mine(open[k]) && may_divide(open[k])) some.push_back(k);
        });
    const int64_t asked_before = corners_.asked();
    std::vector<ElementPoints> middles;
    middles.reserve(asked.size());
    for (size_t k : asked) middles.push_back({open[k], PointsOf::middles_of_edges});
    corners_.want(middles);
    const double of_level = static_cast<double>(corners_.asked() - asked_before);
    corners_.expect(points_after(of_level, of_level_before));
    of_level_before = of_level;
    if (!sample_corners()) return false;
    const std::vector<uint8_t> fate = fate_of(open, asked);
    const std::vector<NodeId> parents =
        gathered<NodeId>(tools_.team, open.size(), [&](size_t k, std::vector<NodeId>& some) {
          if (fate[k] != stays) some.push_back(open[k]);
        });
    const NodeId first = add_children(parents);
    if (!measure_exposure(first)) return false;
    open = gathered<NodeId>(tools_.team, open.size(), [&](size_t k, std::vector<NodeId>& children) {
      if (fate[k] != goes_on) return;
      const NodeId child = forest_.nodes[open[k]].first_child;
      for (NodeId id = child; id < child + 4; ++id)
        if (forest_.nodes[id].exposed > 0) children.push_back(id);
    });
  }
  return true;
}

// Of each open element. asked: of these, which middles have been asked for.
std::vector<uint8_t> RowMesh::fate_of(const std::vector<NodeId>& open,
                                      const std::vector<size_t>& asked) const {
  std::vector<uint8_t> fate(open.size(), stays);
  for_each_thing(tools_.team, asked.size(), [&](size_t k) {
    const double error = deviation(open[asked[k]]);
    fate[asked[k]] = error > 1 ? goes_on : error > worth_keeping ? is_divided : stays;
  });
  tools_.exchange.share_marks(fate);
  return fate;
}

bool RowMesh::may_divide(NodeId id) const {
  const Node& node = forest_.nodes[id];
  const double area = forest_.area(node);
  if (node.level >= max_level || area < 4 * settings_.min_area) return false;
  // Where little arrives, or on little area, nothing can deviate by much.
  LatticePoint corner[3];
  lattice_corners(node, corner);
  double largest = 1;
  for (const LatticePoint& c : corner) largest = std::max(largest, corners_.value(node.surface, c));
  return weighed(largest, area) > 1;
}

// Error between corners over what is tolerated: equal shares of the sum of squares over the area.
double RowMesh::weighed(double deviation, double area) const {
  return deviation * std::sqrt(std::min(1.0, area / settings_.cell_area)) / settings_.tolerance;
}

double RowMesh::light_at(int32_t surface, LatticePoint corner) const {
  return std::max(0.0, corners_.value(surface, corner));  // nothing arrives where it is sealed
}

// Of the middles of the edges from the means of their ends.
double RowMesh::deviation(NodeId id) const {
  const Node& node = forest_.nodes[id];
  LatticePoint corner[3];
  lattice_corners(node, corner);
  double largest = 0;
  for (int c = 0; c < 3; ++c) {
    const LatticePoint from = corner[c], to = corner[(c + 1) % 3];
    const double ends = light_at(node.surface, from) + light_at(node.surface, to);
    largest = std::max(largest, std::fabs(light_at(node.surface, middle(from, to)) - ends / 2));
  }
  return weighed(largest, forest_.area(node));
}

bool RowMesh::name_leaves() {
  state_.links.resize(forest_.nodes.size());
  const bool going_on =
      settings_.means_only ? leaves_.name_means(light_, settings_.cell_area) : leaves_.name();
  memory_.settle();
  return going_on;
}

}  // namespace hrad
