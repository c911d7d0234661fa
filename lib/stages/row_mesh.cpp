// Dividing elements level by level of all surfaces together, so that each step is one even batch of
// work. Floor 7 (stages).
#include "stages/row_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stages/cell_contrast.h"
#include "stages/exchange.h"

namespace hrad {
namespace {

// An element whose middles are known already is divided for this share of the tolerance.
constexpr double worth_keeping = 0.5;

// Of an open element: whether it is divided, and its children opened.
enum Fate : uint8_t { stays, is_divided, goes_on };

// To guess how much work there will be: points of direct light for each cell, work on a point
// beside its shadow rays, and on a ray of a row with all that follows from it, in shadow rays.
constexpr int64_t points_of_a_cell = 8;
constexpr double work_of_a_point = 10, work_of_a_row_ray = 9;
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
      sampler_(state.forest, tools_.engine, tools_.exposure, tools_.oracle.seed,
               tools_.oracle.near_ratio),
      light_(light),
      grid_(grid),
      corners_(state, tools_, light, grid, brightness, settings.seed),
      leaves_(state, tools_, grid, corners_),
      memory_(memory) {}

bool RowMesh::build() {
  make_cells();
  std::vector<NodeId> open;
  for (NodeId id : state_.cells)
    if (forest_.nodes[id].exposed > 0) open.push_back(id);
  open_grid(open);
  if (settings_.means_only) return name_leaves();
  if (!keep_small_patches(open)) return false;
  for (NodeId id : open)
    if (is_mine(id)) want_corners(id);
  return sample_corners() && refine(std::move(open)) && name_leaves();
}

// Children of a leaf. Their exposure is that of the parent where it is whole.
NodeId RowMesh::add_children(NodeId parent) {
  const NodeId first = static_cast<NodeId>(forest_.nodes.size());
  for (int k = 0; k < 4; ++k) {
    Node child = child_place(forest_.nodes[parent], k);
    child.parent = parent;
    child.first_child = -1;
    forest_.nodes.push_back(child);
  }
  forest_.nodes[parent].first_child = first;
  return first;
}

// By points from all over the scene, before the first that are sampled, whose places are special.
void RowMesh::open_grid(const std::vector<NodeId>& cells) {
  std::vector<OrientedPoint> points;
  for (NodeId id : cells) {
    const OrientedPoint middle = middle_of(forest_, id);
    const Triangle t = forest_.triangle(forest_.nodes[id]);
    for (const Vec3& corner : {t.a, t.b, t.c})
      points.push_back({(corner + middle.place) * 0.5, middle.normal});
  }
  state_.rays += grid_.open(points, tools_.team, tools_.exchange.comm());
  guess_share(cells, points);
}

// points: three of each cell.
void RowMesh::guess_share(const std::vector<NodeId>& cells,
                          const std::vector<OrientedPoint>& points) {
  corners_.expect(points_of_a_cell * static_cast<int64_t>(cells.size()));
  double shadow = 0, rows = 0;
  const size_t step = cells.size() / most_looked_at + 1;
  for (size_t k = 0; k < cells.size(); k += step) {
    const double shadow_rays = static_cast<double>(light_.rays_at(points[3 * k]));
    shadow += points_of_a_cell * (work_of_a_point + shadow_rays);
    rows += work_of_a_row_ray * settings_.rays_of(forest_.area(forest_.nodes[cells[k]]));
  }
  if (shadow > 0) share_ = shadow / (shadow + rows);
}

bool RowMesh::is_mine(NodeId id) const { return tools_.exchange.mine(forest_.nodes[id].surface); }

bool RowMesh::sample_corners() {
  if (!corners_.sample()) return false;
  memory_.settle();
  return true;
}

void RowMesh::measure_exposure(NodeId from) {
  std::vector<NodeId> partly;
  for (NodeId id = from; id < static_cast<NodeId>(forest_.nodes.size()); ++id)
    if (forest_.nodes[id].exposed > 0 && forest_.nodes[id].exposed < 1) partly.push_back(id);
  std::vector<float> exposed(partly.size());
  tools_.team.for_each(static_cast<int64_t>(partly.size()), [&](int64_t k, int) {
    const Node& node = forest_.nodes[partly[k]];
    if (is_mine(partly[k])) exposed[k] = sampler_.exposed_share(node);
  });
  tools_.exchange.share(exposed, [&](size_t k) { return forest_.nodes[partly[k]].surface; });
  for (size_t k = 0; k < partly.size(); ++k) forest_.nodes[partly[k]].exposed = exposed[k];
}

void RowMesh::make_cells() {
  NodeId from = 0;
  while (from < static_cast<NodeId>(forest_.nodes.size())) {
    const NodeId end = static_cast<NodeId>(forest_.nodes.size());
    for (NodeId id = from; id < end; ++id) {
      const Node& node = forest_.nodes[id];
      if (Forest::is_cluster(node)) continue;
      if (forest_.area(node) > settings_.cell_area && node.level < max_level)
        add_children(id);
      else
        state_.cells.push_back(id);
    }
    measure_exposure(end);
    from = end;
  }
}

// Patches no larger than a cell: three points half way to the middle have the mean of every
// quadratic field, while corners lie in creases and contacts. Where these agree the patch is left
// as it is, and taken out of `open`.
bool RowMesh::keep_small_patches(std::vector<NodeId>& open) {
  for (NodeId id : open)
    if (forest_.nodes[id].level == 0 && is_mine(id)) want_half_way(id);
  if (!sample_corners()) return false;
  std::vector<uint8_t> kept(open.size(), 0);
  for (size_t k = 0; k < open.size(); ++k) {
    Node& node = forest_.nodes[open[k]];
    if (node.level > 0 || !is_mine(open[k])) continue;
    LatticePoint point[3];
    half_way_points(node, point);
    double low = 1e300, high = -1;
    for (const LatticePoint& p : point) {
      low = std::min(low, corners_.value(node.surface, p));
      high = std::max(high, corners_.value(node.surface, p));
    }
    kept[k] = low >= 0 && weighed((high - low) / 2, forest_.area(node)) <= 1;
  }
  tools_.exchange.share(kept, [&](size_t k) { return forest_.nodes[open[k]].surface; });
  std::vector<NodeId> rest;
  for (size_t k = 0; k < open.size(); ++k) {
    if (kept[k])
      forest_.nodes[open[k]].light_points = half_way_to_the_middle;
    else
      rest.push_back(open[k]);
  }
  open.swap(rest);
  return true;
}

void RowMesh::want_half_way(NodeId id) {
  LatticePoint point[3];
  half_way_points(forest_.nodes[id], point);
  for (const LatticePoint& p : point) corners_.want(forest_.nodes[id].surface, p);
}

void RowMesh::want_corners(NodeId id) {
  LatticePoint corner[3];
  lattice_corners(forest_.nodes[id], corner);
  for (const LatticePoint& c : corner) corners_.want(forest_.nodes[id].surface, c);
}

void RowMesh::want_middles(NodeId id) {
  LatticePoint corner[3];
  lattice_corners(forest_.nodes[id], corner);
  for (int c = 0; c < 3; ++c)
    corners_.want(forest_.nodes[id].surface, middle(corner[c], corner[(c + 1) % 3]));
}

// Divides the open elements, whose corners are known, until direct light is linear between them.
bool RowMesh::refine(std::vector<NodeId> open) {
  while (!open.empty()) {
    std::vector<uint8_t> asked(open.size(), 0);
    int64_t count = 0;
    for (size_t k = 0; k < open.size(); ++k) {
      asked[k] = is_mine(open[k]) && may_divide(open[k]);
      if (asked[k]) want_middles(open[k]);
      count += asked[k];
    }
    // Later levels together ask for about as many, and each leaf for its middle.
    const int64_t leaves = static_cast<int64_t>(forest_.nodes.size()) * 3 / 4;
    corners_.expect(corners_.asked() + count + leaves);
    if (!sample_corners()) return false;
    std::vector<uint8_t> fate(open.size(), stays);
    for (size_t k = 0; k < open.size(); ++k) {
      if (!asked[k]) continue;
      const double error = deviation(open[k]);
      fate[k] = error > 1 ? goes_on : error > worth_keeping ? is_divided : stays;
    }
    tools_.exchange.share(fate, [&](size_t k) { return forest_.nodes[open[k]].surface; });
    const NodeId end = static_cast<NodeId>(forest_.nodes.size());
    std::vector<NodeId> families;
    for (size_t k = 0; k < open.size(); ++k) {
      if (fate[k] == stays) continue;
      const NodeId first = add_children(open[k]);
      if (fate[k] == goes_on) families.push_back(first);
    }
    measure_exposure(end);
    open.clear();
    for (NodeId first : families)
      for (NodeId child = first; child < first + 4; ++child)
        if (forest_.nodes[child].exposed > 0) open.push_back(child);
  }
  return true;
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

bool RowMesh::divide_cells(const Brightness& brightness, std::vector<NodeId>& new_cells) {
  new_cells.clear();
  const std::vector<float> contrast = contrast_of_cells(state_, brightness, tools_.exchange);
  std::vector<uint8_t> divide(state_.cells.size());
  for (size_t k = 0; k < divide.size(); ++k) {
    const Node& node = forest_.nodes[state_.cells[k]];
    const double area = forest_.area(node);
    divide[k] = area >= 4 * settings_.least_cell_area && node.level < max_level &&
                contrast[k] * std::sqrt(area / settings_.cell_area) > settings_.contrast;
  }
  std::vector<NodeId> leaves, cells;
  for (size_t k = 0; k < divide.size(); ++k) {
    const NodeId cell = state_.cells[k];
    if (!divide[k])
      cells.push_back(cell);
    else if (forest_.is_leaf(cell))
      leaves.push_back(cell);
  }
  const NodeId end = static_cast<NodeId>(forest_.nodes.size());
  for (NodeId id : leaves) {
    const NodeId first = add_children(id);
    if (settings_.means_only || !is_mine(id)) continue;
    if (forest_.nodes[id].light_points == half_way_to_the_middle) {
      for (NodeId child = first; child < first + 4; ++child) {
        forest_.nodes[child].light_points = half_way_to_the_middle;
        want_half_way(child);
      }
    } else {
      want_corners(id);
      want_middles(id);
    }
  }
  if (!sample_corners()) return false;
  measure_exposure(end);
  std::vector<LinkTable::NewRun> dropped;
  for (size_t k = 0; k < divide.size(); ++k) {
    if (!divide[k]) continue;
    const NodeId cell = state_.cells[k];
    dropped.push_back({cell, {}});
    for (int child = 0; child < 4; ++child)
      new_cells.push_back(forest_.nodes[cell].first_child + child);
  }
  std::sort(new_cells.begin(), new_cells.end());
  cells.insert(cells.end(), new_cells.begin(), new_cells.end());
  std::sort(cells.begin(), cells.end());
  state_.cells.swap(cells);
  state_.links.replace(std::move(dropped));
  return name_leaves();
}

bool RowMesh::name_leaves() {
  state_.links.resize(forest_.nodes.size());
  const bool going_on =
      settings_.means_only ? leaves_.name_means(light_, settings_.cell_area) : leaves_.name();
  memory_.settle();
  return going_on;
}

}  // namespace hrad
