// The order of the steps: mesh by direct light, cells by pilot rows, final rows; once more from the
// beginning where pilot rows find far less light than was expected. Floor 7 (stages).
#include "stages/rows.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "stages/bright_spots.h"
#include "stages/exchange.h"
#include "stages/row_mesh.h"
#include "stages/row_rays.h"
#include "stages/row_tracer.h"
#include "stages/sweep.h"

namespace hrad {
namespace {

constexpr int pilot_rounds = 3;
// Bounces after which it is known well enough where that is.
constexpr int pilot_sweeps = 6;

// Of all work on rows, about.
constexpr double pilot_work = 0.4;

// Where a few bright spots make the root mean square, everything else would seem even: the unit is
// no larger than twice the mean.
void stay_near_the_mean(const State& state, Brightness& light) {
  double sum = 0, area = 0;
  for (NodeId root = 0; root < state.forest.surface_count(); ++root) {
    const double exposed = state.forest.surfaces[root].area * state.forest.nodes[root].exposed;
    double largest = 0;
    for (int b = 0; b < state.bands; ++b)
      largest = std::max(largest, light.unit[b] * state.irradiance_of(root)[b]);
    sum += exposed * largest;
    area += exposed;
  }
  if (!(sum > 0) || 2 * sum >= area) return;
  const double factor = area / (2 * sum);
  for (double& unit : light.unit) unit *= factor;
  for (float& value : light.of_node) value = static_cast<float>(value * factor);
}

Brightness light_of_pilot_rows(State& state, const StageTools& tools) {
  reset_to_emission(state, tools.team, tools.exchange);
  // Emitters, whose light the leaves have links to before there are rows.
  tools.exchange.ask_for_sources(state, tools.team);
  const OwnRuns runs(state, tools.exchange, tools.team);
  for (int k = 0; k < pilot_sweeps; ++k) sweep(state, tools.team, tools.exchange, runs);
  tools.exchange.finish_update(state, tools.team);
  tools.exchange.share_roots(state, tools.team);
  Brightness light = brightness_of_known(state, tools.team, tools.exchange);
  stay_near_the_mean(state, light);
  return light;
}

// Of the light that an enclosure would have: with less than this, as where lamps shine out of the
// scene, tolerances follow what there is. But for no less than the least: black surfaces around a
// lamp may have all the light, and need no mesh that is so fine.
constexpr double far_less = 0.5, least_share = 1.0 / 64;

// Sixteen rays err by an eighth at the most.
constexpr double most_of_a_group = 8;

enum class Outcome { done, stopped, too_dark };

// Of the rows of these cells what comes by rays from spots, and then by their own.
bool trace_cells(State& state, const StageTools& tools, const RowSettings& settings,
                 const LightGrid& grid, BrightSpots& spots, const std::vector<NodeId>& cells,
                 const std::vector<int>& rays_of_cell, StageMemory& memory) {
  double of_rows = 1;
  for (int rays : rays_of_cell) of_rows += rays;
  const double of_spots = spots.rays(), share = of_spots / (of_spots + of_rows);
  return spots.trace(state, tools.of_part(0, share), cells, memory) &&
         trace_rows(state, tools.of_part(share, 1), settings, grid, spots, cells, rays_of_cell,
                    memory);
}

// The RMS of reflected light over what is expected, where nothing is emitted.
double light_over_expected(const State& state, const Brightness& expected) {
  const Scene& scene = *state.forest.scene;
  double found = 0, wanted = 0;
  for (NodeId root = 0; root < state.forest.surface_count(); ++root) {
    const Surface& surface = state.forest.surfaces[root];
    if (scene.emits(surface.patch)) continue;
    for (int b = 0; b < state.bands; ++b) {
      const double reflectance =
          scene.reflectance[static_cast<size_t>(surface.patch) * state.bands + b];
      const double light = expected.unit[b] * state.radiosity_of(root)[b];
      found += surface.area * light * light;
      wanted += surface.area * reflectance * reflectance;
    }
  }
  return wanted > 0 ? std::sqrt(found / wanted) : 1;
}

// share: of the light of an enclosure, that is expected. Where pilot rows find far less of it, that
// is what it gets to be, and the state is of no use until it is cleared.
Outcome link_rows_once(State& state, const StageTools& tools, const RowSettings& settings,
                       double& share) {
  const auto expect = [&] {
    Brightness brightness = expected_brightness(state);
    for (double& unit : brightness.unit) unit /= share;
    for (float& value : brightness.of_node) value = static_cast<float>(value / share);
    return brightness;
  };
  Emitters emitters(state.forest, tools.exposure, expect().of_node, settings.least_bright);
  emitters.join(state.forest, tools.exposure);
  const Brightness expected = expect();
  LightGrid grid(emitters, tools.engine, settings.grid_size,
                 most_of_a_group * settings.shadow_noise);
  const double noise = settings.means_only ? settings.shadow_noise * std::sqrt(points_of_a_mean)
                                           : settings.shadow_noise;
  const DirectLight light(state.forest, tools.engine, emitters, grid, noise);
  StageMemory memory(state);
  RowMesh mesh(state, tools, settings, light, grid, expected, memory);
  if (!mesh.build()) return Outcome::stopped;
  pull_exposure(state, tools.team);
  const double meshed = mesh.share_of_work();
  const double piloted = meshed + pilot_work * (1 - meshed);

  // The rows that cells are divided by aren't kept: those that chance made bright would be traced
  // anew and those that it made dark would stay.
  RowSettings pilot = settings;
  pilot.rays_of_cell = settings.rays_of_cell / pilot_share;
  pilot.seed = mix(settings.seed, 0x70696c6f74u);
  std::vector<NodeId> cells = state.cells;
  Brightness seen = light_of_pilot_rows(state, tools);
  for (int round = 0; !cells.empty(); ++round) {
    BrightSpots spots(state, tools, pilot, seen, emitters);
    const double step = (piloted - meshed) / pilot_rounds, from = meshed + round * step;
    const StageTools part = tools.of_part(from, from + step);
    if (!trace_cells(state, part, pilot, grid, spots, cells,
                     rays_by_area(state, tools, pilot, cells), memory))
      return Outcome::stopped;
    seen = light_of_pilot_rows(state, tools);
    if (round == 0 && share == 1) {
      const double found = light_over_expected(state, expected);
      if (found > 0 && found < far_less) {
        share = std::max(found, least_share);
        return Outcome::too_dark;
      }
    }
    if (round + 1 == pilot_rounds) break;
    if (!mesh.divide_cells(seen, cells)) return Outcome::stopped;
    pull_exposure(state, tools.team);
  }
  BrightSpots spots(state, tools, settings, seen, emitters);
  const StageTools last = tools.of_part(piloted, 1);
  // Many a source of the pilot rows is one no longer.
  tools.exchange.forget(state);
  if (!trace_cells(state, last, settings, grid, spots, state.cells,
                   rays_by_variance(state, tools, settings, seen, spots), memory))
    return Outcome::stopped;
  mesh.keep_what_is_named();
  reset_to_emission(state, tools.team, tools.exchange);
  shrink_to_fit(state);
  memory.settle();
  return Outcome::done;
}

}  // namespace

bool link_rows(State& state, const StageTools& tools, const RowSettings& settings) {
  std::vector<float> exposed;
  for (NodeId root = 0; root < state.forest.surface_count(); ++root)
    exposed.push_back(state.forest.nodes[root].exposed);
  double done = 0, share = 1;
  StageTools first = tools;
  first.progress = [&](double fraction) { return tools.progress(done = fraction); };
  Outcome outcome = link_rows_once(state, first, settings, share);
  if (outcome == Outcome::too_dark) {
    clear(state);
    counted(state, [&] { tools.exchange.forget(state); });
    for (size_t root = 0; root < exposed.size(); ++root)
      state.forest.nodes.set_exposed(root, exposed[root]);
    outcome = link_rows_once(state, tools.of_part(done, 1), settings, share);
  }
  return outcome == Outcome::done;
}

}  // namespace hrad
