// Guesses and a few thousand rays. Floor 8 (solver).
#include "solver/partition_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/draw.h"
#include "base/frame.h"
#include "base/hash.h"
#include "base/triangle_points.h"
#include "solver/schedule.h"

namespace hrad {
namespace {

constexpr int rays_of_the_sample = 32768;

// Of rows: points of direct light of a cell, more of a surface that others stand or hang on, whose
// shadows begin there, for each root of its cells, and what a point takes in rays of a row.
constexpr double points_of_a_cell = 2, points_of_contacts = 40, rays_of_a_point = 22;
// Of links between elements: leaves at accuracy 1, links of each, and rays of a link.
constexpr double leaves_at_one = 2500, links_of_a_leaf = 20, rays_of_a_link = 16;

// Elements that a surface is cut into: quarters until they are no larger than this.
double cells_of(double area, double largest) {
  double cells = 1;
  for (int level = 0; level < max_level && area / cells > largest; ++level) cells *= 4;
  return cells;
}

// Something of some size stands or hangs on it, and does not cover it.
bool has_contacts(const Forest& forest, int32_t root, const Exposure& exposure) {
  constexpr double of_some_size = 0.03, nearly_all = 0.97;
  const Surface& surface = forest.surfaces[root];
  if (!exposure.can_be_sealed(surface.patch, surface.side)) return false;
  const Exposure::Part part(exposure, surface.patch, surface.side, forest.root_triangle(root));
  const double pressed = part.pressed_share();
  return pressed > of_some_size && pressed < nearly_all;
}

}  // namespace

std::vector<double> predicted_work(const Params& params, const State& state,
                                   const Inspection& inspection, const Exposure& exposure) {
  const Forest& forest = state.forest;
  const double surfaces = static_cast<double>(forest.surface_count());
  const double total_area = forest.total_area();
  const bool rows = by_rows(params, forest, inspection);
  const RowSettings settings = rows_of(params, forest, inspection.mean_distance, 1);
  std::vector<double> work(static_cast<size_t>(forest.scene->patch_count()), 0.0);
  for (int32_t root = 0; root < forest.surface_count(); ++root) {
    const Surface& surface = forest.surfaces[root];
    double rays = 0;
    if (rows) {
      const double cells = cells_of(surface.area, settings.cell_area);
      double points = points_of_a_cell * cells;
      if (has_contacts(forest, root, exposure))
        points += points_of_contacts * std::sqrt(surface.area / settings.cell_area);
      rays = cells * settings.rays_of(surface.area / cells) + rays_of_a_point * points;
    } else {
      const double leaves = leaves_at_one / params.accuracy * surface.area / total_area;
      rays = rays_of_a_link * links_of_a_leaf * std::max(1.0, leaves);
      // By pairs every surface meets every other; half of them face each other, and of two one
      // traces the rays.
      if (params.linking != "clusters") rays += rays_of_a_link * surfaces / 4;
    }
    work[static_cast<size_t>(surface.patch)] += rays;
  }
  return work;
}

PartitionPlan plan_partition(const State& state, const VisibilityEngine& engine,
                             std::vector<double> work, const std::string& method, int32_t ranks) {
  const Forest& forest = state.forest;
  const Scene& scene = *forest.scene;
  PartitionPlan plan;
  plan.work = std::move(work);
  const std::vector<PartitionItem> items = partition_items(scene, plan.work);
  plan.owners = owners_of(scene, items, partition_method(method).divide(items, ranks));
  plan.loads = loads_of(scene, items, plan.owners, ranks);

  std::vector<int64_t> met(static_cast<size_t>(ranks), 0), of_others = met;
  std::vector<double> weights;
  for (const Surface& surface : forest.surfaces)
    weights.push_back(plan.work[static_cast<size_t>(surface.patch)]);
  const Draw draw(weights);
  for (int k = 0; k < rays_of_the_sample && draw.total() > 0; ++k) {
    const uint64_t h = mix(static_cast<uint64_t>(k), 0x706172747au);
    const auto root = static_cast<NodeId>(draw.pick((k + unit_interval(h)) / rays_of_the_sample));
    const Surface& surface = forest.surfaces[root];
    double u = unit_interval(mix(h, 1)), v = unit_interval(mix(h, 2));
    fold_into_triangle(u, v);
    const Vec3 direction =
        Frame(surface.normal).cosine_direction(unit_interval(mix(h, 3)), unit_interval(mix(h, 4)));
    const Vec3 point = forest.root_triangle(root).at(u, v);
    const Hit hit = engine.nearest(point + surface.normal * engine.offset(), direction, 0);
    if (forest.leaf_met(hit) < 0) continue;
    const auto owner = static_cast<size_t>(plan.owners[static_cast<size_t>(surface.patch)]);
    ++met[owner];
    of_others[owner] += plan.owners[static_cast<size_t>(hit.patch)] != static_cast<int32_t>(owner);
  }
  for (size_t rank = 0; rank < met.size(); ++rank)
    plan.remote.push_back(
        met[rank] ? static_cast<double>(of_others[rank]) / static_cast<double>(met[rank]) : 0);
  return plan;
}

}  // namespace hrad
