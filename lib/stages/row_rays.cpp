// Rays by area, by variance, and as many more as the sum of all light needs. Floor 7 (stages).
#include "stages/row_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "machine/pieces.h"
#include "stages/exchange.h"

namespace hrad {
namespace {

// Deviation of what a ray brings, in units of the mean irradiance, for which the ordinary number of
// rays is meant, and how many times that there may be.
constexpr double ordinary_deviation = 0.15, most_more_rays = 64;

// What the rays of all rows together may deviate by, as a share of what is emitted: the power
// balance is off by that.
constexpr double deviation_of_the_sum = 8.5e-4;
// The further rays that this takes are no more than so many, and these times those that there are:
// where walls reflect nearly all, the little that is emitted is no measure.
constexpr double most_further_rays = 1 << 18, most_further_share = 2;
constexpr double most_rays_of_a_row = 1 << 24;
// Of finding their number; each brings fewer of them, and few change much.
constexpr int most_steps = 16;

// Variance of what one ray of a row brings.
double variance_of(const State& state, NodeId cell, const Brightness& light,
                   const BrightSpots& spots) {
  double mean = 0, square = 0;
  for (const Link& link : state.links[cell].links()) {
    if (spots.sends_to(link.source, cell)) continue;
    const double weight = link.weight, brightness = light.of_node[link.source];
    mean += weight * brightness;
    square += weight * brightness * brightness;
  }
  return std::max(0.0, square - mean * mean);
}

// Per cell; what the few pilot rays of a cell missed those of the others on its surface may have
// met. Others' cells are left out.
std::vector<double> variance_of_cells(const State& state, const StageTools& tools,
                                      const Brightness& light, const BrightSpots& spots) {
  const Forest& forest = state.forest;
  std::vector<double> variance(state.cells.size(), 0.0);
  std::vector<double> sum(static_cast<size_t>(forest.surface_count()), 0.0), area = sum;
  const auto is_mine = [&](size_t k) {
    return tools.exchange.mine(forest.nodes[state.cells[k]].surface);
  };
  for_each_thing(tools.team, variance.size(), [&](size_t k) {
    if (is_mine(k)) variance[k] = variance_of(state, state.cells[k], light, spots);
  });
  for (size_t k = 0; k < variance.size(); ++k) {
    if (!is_mine(k)) continue;
    const Node& node = forest.nodes[state.cells[k]];
    sum[node.surface] += forest.area(node) * variance[k];
    area[node.surface] += forest.area(node);
  }
  for_each_thing(tools.team, variance.size(), [&](size_t k) {
    const int32_t surface = forest.nodes[state.cells[k]].surface;
    if (is_mine(k)) variance[k] = (variance[k] + sum[surface] / area[surface]) / 2;
  });
  return variance;
}

// What is emitted, in the units of the light: in the band that has the least of it.
double least_emitted(const State& state, const Brightness& light) {
  const Scene& scene = *state.forest.scene;
  std::vector<double> emitted(light.unit.size(), 0.0);
  for (const Surface& surface : state.forest.surfaces)
    for (size_t b = 0; b < emitted.size(); ++b)
      emitted[b] += surface.area * light.unit[b] *
                    scene.emission[static_cast<size_t>(surface.patch) * emitted.size() + b];
  double least = std::numeric_limits<double>::infinity();
  for (double power : emitted)
    if (power > 0) least = std::min(least, power);
  return least;
}

// The row of a cell, as a part of the sum of all.
struct Part {
  double deviation = 0;  // of the power that comes with a single ray, were it the only one
  double rays = 0;
};

// Of each process's own parts, added up.
double variance_of_sum(const std::vector<Part>& parts, Exchange& exchange) {
  std::vector<ExactSum> sum(1);
  for (const Part& part : parts)
    if (part.rays > 0) sum[0].add(part.deviation * part.deviation / part.rays);
  exchange.add_up(sum);
  return sum[0].value();
}

// How many rays rows with fewer of them get for each unit of deviation, so that the sum of all has
// no more than this variance and they are the fewest; 0: it hasn't, as they are.
double rays_per_deviation(const std::vector<Part>& parts, double variance) {
  double per_deviation = std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps; ++step) {
    double lacking = 0, of_others = 0;
    for (const Part& part : parts) {
      if (part.deviation > part.rays / per_deviation)
        lacking += part.deviation;
      else if (part.rays > 0)
        of_others += part.deviation * part.deviation / part.rays;
    }
    if (!(lacking > 0)) return 0;
    const double before = per_deviation;
    per_deviation = lacking / (variance - of_others);  // never more than before
    if (!(per_deviation < before)) break;
  }
  return per_deviation;
}

// Small cells have more rays than their part of all light is worth, for the sake of their own
// means: where the sum errs by too much, large ones get further rays.
void serve_the_sum(const State& state, const StageTools& tools, const RowSettings& settings,
                   const Brightness& light, const std::vector<double>& variance,
                   std::vector<int>& rays) {
  const Forest& forest = state.forest;
  std::vector<Part> parts(rays.size());
  for_each_thing(tools.team, parts.size(), [&](size_t k) {
    const Node& node = forest.nodes[state.cells[k]];
    if (!tools.exchange.mine(node.surface)) return;
    // A few rays deviate less from their own mean than from the true one.
    const double few = std::max(2, settings.rays_of(forest.area(node)) / pilot_share);
    parts[k] = {forest.area(node) * node.exposed * std::sqrt(variance[k] * few / (few - 1)),
                static_cast<double>(rays[k])};
  });
  const double wanted = deviation_of_the_sum * least_emitted(state, light);
  if (variance_of_sum(parts, tools.exchange) <= wanted * wanted) return;
  tools.exchange.share(
      parts, [&](size_t k) { return forest.nodes[state.cells[k]].surface; }, tools.team);
  double deviation = 0, all = 0;
  for (const Part& part : parts) {
    deviation += part.deviation;
    all += part.rays;
  }
  const double most = (most_further_rays + most_further_share * all) / deviation;
  const double per_deviation = std::min(most, rays_per_deviation(parts, wanted * wanted));
  for_each_thing(tools.team, parts.size(), [&](size_t k) {
    if (tools.exchange.mine(forest.nodes[state.cells[k]].surface))
      rays[k] = std::max(rays[k], static_cast<int>(std::min(most_rays_of_a_row,
                                                            per_deviation * parts[k].deviation)));
  });
}

}  // namespace

std::vector<int> rays_by_area(const State& state, const StageTools& tools,
                              const RowSettings& settings, const std::vector<NodeId>& cells) {
  std::vector<int> rays(cells.size());
  for_each_thing(tools.team, cells.size(), [&](size_t k) {
    rays[k] = settings.rays_of(state.forest.area(state.forest.nodes[cells[k]]));
  });
  return rays;
}

std::vector<int> rays_by_variance(const State& state, const StageTools& tools,
                                  const RowSettings& settings, const Brightness& light,
                                  const BrightSpots& spots) {
  const Forest& forest = state.forest;
  const std::vector<double> variance = variance_of_cells(state, tools, light, spots);
  std::vector<int> rays(variance.size(), 0);
  for_each_thing(tools.team, rays.size(), [&](size_t k) {
    const Node& node = forest.nodes[state.cells[k]];
    if (!tools.exchange.mine(node.surface)) return;
    const double share = std::sqrt(variance[k]) / ordinary_deviation;
    rays[k] = static_cast<int>(settings.rays_of(forest.area(node)) *
                               std::max(1.0, std::min(most_more_rays, share)));
  });
  serve_the_sum(state, tools, settings, light, variance, rays);
  return rays;
}

int RowSettings::rays_of(double area) const {
  return std::max(
      least_rays,
      static_cast<int>(std::ceil(rays_of_cell * std::sqrt(std::min(1.0, area / cell_area)))));
}

double RowSettings::power_of_spot_rays() const {
  return ordinary_deviation * ordinary_deviation / rays_of_cell;
}

}  // namespace hrad
