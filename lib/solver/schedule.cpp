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

}  // namespace

OracleSettings oracle_of_round(const Params& params, const State& state, int round, double scale) {
  double area = 0;
  for (const Surface& surface : state.forest.surfaces) area += surface.area;
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
  if (round == 0) ease = 1;  // initial links stay: their visibility must serve the last round

  OracleSettings s;
  s.kind = params.oracle == "energy" ? OracleKind::energy : OracleKind::error;
  s.power =
      ease * (params.bf_epsilon > 0 ? params.bf_epsilon : power * power_share * params.accuracy);
  const double mean = params.tolerance > 0 ? params.tolerance : mean_share * accuracy;
  const double point =
      params.tolerance > 0 ? 4 * params.tolerance : point_share * std::sqrt(accuracy);
  s.mean_variance = ease * mean * mean;
  s.point_variance = ease * point * point;
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

double sweep_tolerance(const Params& params, int round) {
  return round < first_rounds ? 1e-3 : std::min(1e-5, params.accuracy * 1e-2);
}

}  // namespace hrad
