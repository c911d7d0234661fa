// The calibrated relations between accuracy and thresholds. They are a start: the promise is kept
// by measuring after the solve and tightening. Floor 8 (solver).
#include "solver/schedule.h"

#include <algorithm>
#include <cmath>

namespace hrad {
namespace {

// Error of a patch mean that links may add up to, as a share of the accuracy.
constexpr double mean_share = 0.5;
// Error at points: this times the root of the accuracy. Means gain from a finer mesh only by what
// it changes at the next bounce, so points may err more the more accurate the means are to be.
constexpr double point_share = 0.4;
// Elements smaller than this share of all area count for less of the error at points.
constexpr double point_area_share = 1.0 / 4000;
// Smallest element as a share of all area, at accuracy 1; falls with the square of the accuracy.
constexpr double smallest_share = 1.0 / 400;
// Smallest element that is split for the sake of points, as a share of all area: at accuracy 1, and
// at the least. Shadows have edges at every scale, and means don't need them resolved.
constexpr double smallest_point_share = 1e-4;
constexpr double least_point_share = 2e-6;
// The energy oracle's default: the power of a link as a share of all emitted power, at accuracy 1.
constexpr double power_share = 1.0 / 20000;
// Thresholds fall by this factor from round to round (in power; errors by its root).
constexpr double fall = 4;

// Rows: what serves this accuracy. Cells shrink with the root of the accuracy and have rays in
// proportion to its inverse, so that the rays over an area grow with its inverse square, and the
// noise of a patch falls with it.
constexpr double row_accuracy = 0.02;
constexpr double finest_of_rows = 0.004;
constexpr int64_t most_of_fine_pairs = 200;
// Of the mean distance between surfaces.
constexpr double row_leg = 0.35, largest_row_leg = 0.45;
constexpr double fewest_cells = 1000, cells_of_a_surface = 64, cells_of_a_scene = 2000;
constexpr double row_contrast = 0.03;
constexpr double row_rays = 64, least_row_rays = 16, fewest_rays = 4;
constexpr double direct_tolerance = 0.1;  // at the most: what is coarser misses whole shadows
constexpr double least_bright = 0.1;
constexpr double least_cube = 1e-4;  // of the root of all area: cubes have names of limited length
constexpr double least_cell_share = 1.0 / 256, least_element_share = 1.0 / (1 << 20);

}  // namespace

OracleSettings oracle_of_round(const Params& params, const State& state, int round, double scale) {
  const double area = state.forest.total_area();
  const Scene& scene = *state.forest.scene;
  double power = 0;
  for (int b = 0; b < scene.bands; ++b) {
    double of_band = 0;
    for (const Surface& surface : state.forest.surfaces)
      of_band +=
          surface.area * scene.emission[static_cast<size_t>(surface.patch) * scene.bands + b];
    power = std::max(power, of_band);
  }
  const double accuracy = params.accuracy * scale;
  double ease = 1;
  for (int k = round; k < first_rounds; ++k) ease *= fall;
  if (round == 0 && params.linking != "clusters")
    ease = 1;  // initial links stay: their visibility must serve the last round

  OracleSettings s;
  s.kind = params.oracle == "energy" ? OracleKind::energy : OracleKind::error;
  s.power =
      ease * (params.bf_epsilon > 0 ? params.bf_epsilon : power * power_share * params.accuracy);
  const double mean = params.tolerance > 0 ? params.tolerance : mean_share * accuracy;
  const double point =
      params.tolerance > 0 ? 4 * params.tolerance : point_share * std::sqrt(accuracy);
  s.mean_variance = ease * mean * mean;
  s.point_variance = ease * point * point;
  s.last_mean_variance = mean * mean;
  s.last_point_variance = point * point;
  s.point_area = area * point_area_share;
  s.point_min_area = params.min_area > 0
                         ? params.min_area
                         : area * std::max(least_point_share, smallest_point_share * accuracy);
  s.min_area = params.min_area > 0 ? params.min_area : area * smallest_share * accuracy * accuracy;
  // The kernel between sampled points errs with the square of size over distance.
  s.near_ratio = std::min(0.5, 3 * std::sqrt(accuracy));
  s.seed = static_cast<uint64_t>(params.seed);
  s.most_packets = 16;
  return s;
}

bool by_rows(const Params& params, const Forest& forest, const Inspection& inspection) {
  if (params.linking != "auto") return params.linking == "rows";
  // Thresholds of links ask for links.
  if (params.oracle == "energy" || params.tolerance > 0) return false;
  // Form factors hold where patches are too small for rays.
  if (2 * inspection.unresolved > forest.surface_count()) return false;
  // Rays grow with the inverse square of the accuracy, links between few patches much less.
  return params.accuracy >= finest_of_rows || forest.surface_count() > most_of_fine_pairs;
}

RowSettings rows_of(const Params& params, const Forest& forest, double distance, double scale) {
  const double ratio = params.accuracy * scale / row_accuracy;
  const double leg = distance * std::min(row_leg * std::sqrt(ratio), largest_row_leg);
  RowSettings s;
  // Surfaces that all but touch must not make cells without number.
  const double area = forest.total_area();
  const double most_cells =
      cells_of_a_surface * static_cast<double>(forest.surface_count()) + cells_of_a_scene / ratio;
  s.cell_area = std::max(std::min(leg * leg / 2, area / fewest_cells), area / most_cells);
  s.least_cell_area = s.cell_area * least_cell_share;
  s.contrast = row_contrast * ratio;
  s.rays_of_cell = static_cast<int>(std::ceil(row_rays / ratio));
  s.least_rays = static_cast<int>(std::ceil(std::max(fewest_rays, least_row_rays / ratio)));
  s.tolerance = direct_tolerance * std::min(ratio, 1.0);
  s.means_only = params.detail == "means";
  s.shadow_noise = s.tolerance / 2;
  s.least_bright = least_bright;
  s.grid_size = std::max(distance / 2, least_cube * std::sqrt(area));
  s.min_area = params.min_area > 0 ? params.min_area : s.cell_area * least_element_share;
  s.seed = static_cast<uint64_t>(params.seed);
  return s;
}

// Between that of small patches, which only get more rays, and that of large ones, where rays grow
// with the inverse square.
double growth_of_linking(double tightening) { return 1 / (tightening * std::sqrt(tightening)); }

double sweep_tolerance(const Params& params, int round) {
  return round < first_rounds ? 1e-3 : std::min(1e-4, params.accuracy * 5e-3);
}

}  // namespace hrad
