// Push and pull, surface by surface. Floor 7 (stages).
#include "stages/sweep.h"

#include <algorithm>
#include <cmath>

#include "machine/pieces.h"
#include "stages/cluster_sweep.h"
#include "stages/sweep_kernels.h"

namespace hrad {
namespace {

constexpr size_t surfaces_of_a_task = 64;
// Few large surfaces have most of the elements: many tasks, so that none has many of those.
constexpr size_t tasks_of_pushing = 128;

template <class Body>
void for_each_root(const State& state, ThreadTeam& team, const Body& body) {
  const auto some = [&](size_t, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) body(static_cast<NodeId>(k));
  };
  for_each_piece(team, static_cast<size_t>(state.forest.surface_count()), some, surfaces_of_a_task);
}

// Of those that are this process's own.
template <class Body>
void for_each_surface(const State& state, ThreadTeam& team, const Exchange& exchange, Body&& body) {
  for_each_root(state, team, [&](NodeId root) {
    if (exchange.mine(root)) body(root);
  });
}

// Per surface one row of `bands` sums, made by row_of(root, row), then added in key order: the same
// bits however many threads and processes.
template <class RowOf>
std::vector<double> surface_sums(const State& state, ThreadTeam& team, const Exchange& exchange,
                                 RowOf&& row_of) {
  const size_t bands = static_cast<size_t>(state.bands);
  std::vector<double> rows(static_cast<size_t>(state.forest.surface_count()) * bands, 0.0);
  for_each_surface(state, team, exchange,
                   [&](NodeId root) { row_of(root, &rows[static_cast<size_t>(root) * bands]); });
  exchange.share_rows(
      rows, bands, [](size_t k) { return static_cast<int32_t>(k); }, team);
  std::vector<double> total(bands, 0.0);
  for (size_t k = 0; k < rows.size();)
    for (size_t b = 0; b < bands; ++b) total[b] += rows[k++];
  return total;
}

// Returns the sums of irradiance times exposed area, each thread having added up some of them.
std::vector<double> push_pull_all(State& state, ThreadTeam& team, Exchange& exchange) {
  const Scene& scene = *state.forest.scene;
  const Forest& forest = state.forest;
  const size_t bands = static_cast<size_t>(state.bands);
  const PushPull push_pull = sweep_kernels()[0]->push_pull;
  std::vector<std::vector<ExactSum>> of_thread(static_cast<size_t>(team.size()));
  for (std::vector<ExactSum>& sums : of_thread) sums.resize(bands);
  const std::vector<NodeId>& own = exchange.own_surfaces();  // whose numbers are those of roots
  const size_t of_a_task = std::clamp(own.size() / tasks_of_pushing, size_t{1}, surfaces_of_a_task);
  const auto some = [&](int64_t task, int thread) {
    double rows[surfaces_of_a_task * most_bands];
    const NodeId* roots = &own[static_cast<size_t>(task) * of_a_task];
    const size_t count = std::min<size_t>(of_a_task, own.data() + own.size() - roots);
    push_pull(
        {&forest.nodes, forest.surfaces.data(), roots, count, state.bands, scene.emission.data(),
         scene.reflectance.data(), &state.places, state.irradiance.data(), state.radiosity.data()},
        rows);
    std::vector<ExactSum>& sums = of_thread[static_cast<size_t>(thread)];
    const double* value = rows;
    for (size_t k = 0; k < count; ++k)
      for (size_t b = 0; b < bands; ++b)
        sums[b].add(*value++ * forest.surfaces[static_cast<size_t>(roots[k])].area);
  };
  team.for_each(static_cast<int64_t>(pieces_of(own.size(), of_a_task)), some);
  std::vector<ExactSum>& sums = of_thread.front();
  for (size_t thread = 1; thread < of_thread.size(); ++thread)
    for (size_t b = 0; b < bands; ++b) sums[b].add(of_thread[thread][b]);
  exchange.add_up_transported(sums);
  std::vector<double> transported;
  for (const ExactSum& sum : sums) transported.push_back(sum.value());
  return transported;
}

// The sum over the leaves below of f(node id, exposed area), in key order.
template <class F>
void visit_leaves(const Forest& forest, NodeId id, F&& f) {
  const Node& node = forest.nodes[id];
  if (node.first_child < 0) {
    f(id, forest.area(node) * node.exposed);
    return;
  }
  for (int child = 0; child < 4; ++child) visit_leaves(forest, node.first_child + child, f);
}

float pull_exposure_below(NodeArray& nodes, NodeId id) {
  const NodeId first = nodes.first_child(id);
  if (first < 0) return nodes.exposed(id);
  float sum = 0;
  for (int child = 0; child < 4; ++child) sum += pull_exposure_below(nodes, first + child);
  nodes.set_exposed(id, sum / 4);
  return sum / 4;
}

float brightness_of(const float* radiosity, const std::vector<double>& unit) {
  double largest = 0;
  for (size_t b = 0; b < unit.size(); ++b) largest = std::max(largest, radiosity[b] * unit[b]);
  return static_cast<float>(largest);
}

float spread_below(const Forest& forest, const LightOfAll& radiosity, NodeId id,
                   const std::vector<double>& unit, std::vector<float>& spread) {
  const NodeId first = forest.nodes.first_child(id);
  spread[id] = 0;
  if (first < 0) return 0;
  const float* mean = radiosity[id];
  for (NodeId below = first; below < first + 4; ++below) {
    const float inner = spread_below(forest, radiosity, below, unit, spread);
    const float* value = radiosity[below];
    double difference = 0;
    for (size_t b = 0; b < unit.size(); ++b)
      difference =
          std::max(difference, std::fabs(static_cast<double>(value[b]) - mean[b]) * unit[b]);
    spread[id] = std::max(spread[id], static_cast<float>(difference + inner));
  }
  return spread[id];
}

// Dark yet, in the units that are measured.
Brightness in_units_of_irradiance(const State& state, ThreadTeam& team, const Exchange& exchange) {
  const double area = state.forest.total_area();
  Brightness brightness;
  brightness.unit = surface_sums(state, team, exchange, [&](NodeId root, double* row) {
    visit_leaves(state.forest, root, [&](NodeId id, double leaf_area) {
      const float* irradiance = state.irradiance_of(id);
      for (int b = 0; b < state.bands; ++b)
        row[b] += leaf_area * static_cast<double>(irradiance[b]) * irradiance[b];
    });
  });
  for (double& unit : brightness.unit) unit = unit > 0 ? 1 / std::sqrt(unit / area) : 0;
  brightness.of_node.resize(state.forest.nodes.size());
  return brightness;
}

}  // namespace

std::vector<double> sweep(State& state, ThreadTeam& team, Exchange& exchange, const OwnRuns& runs) {
  if (runs.all()) exchange.finish_update(state, team);  // they may wait
  gather_what_is_here(state, team, runs, exchange);
  exchange.finish_update(state, team);
  gather_what_has_come(state, team, runs);
  std::vector<double> transported = push_pull(state, team, exchange);
  exchange.start_update(state, team);
  return transported;
}

std::vector<double> push_pull(State& state, ThreadTeam& team, Exchange& exchange) {
  push_to_roots(state);
  std::vector<double> transported = push_pull_all(state, team, exchange);
  if (!state.forest.clusters.empty()) {
    exchange.share_roots_of_clusters(state, team);
    pull_to_clusters(state);
  }
  return transported;
}

void pull_exposure(State& state, ThreadTeam& team) {
  for_each_root(state, team, [&](NodeId root) { pull_exposure_below(state.forest.nodes, root); });
}

void reset_to_emission(State& state, ThreadTeam& team, const Exchange& exchange) {
  const Scene& scene = *state.forest.scene;
  const size_t bands = static_cast<size_t>(state.bands);
  const NodeArray& nodes = state.forest.nodes;
  // Nothing is to be kept: what has to grow need not be moved.
  if (state.places.nodes() != nodes.size())
    for (auto* light : {&state.irradiance, &state.radiosity}) *light = GrowingArray<float>();
  exchange.make_places_for_light(state);
  state.resize_light_for_overwrite();
  for_each_piece(team, nodes.size(), [&](size_t, size_t begin, size_t end) {
    state.places.for_each_stretch(begin, end, [&](size_t node, size_t place, size_t count) {
      if (place < state.places.end_of_own())
        std::fill_n(&state.irradiance[place * bands], count * bands, 0.0f);
      for (float* to = &state.radiosity[place * bands]; count-- > 0; ++node, to += bands) {
        const int32_t surface = nodes[node].surface;
        if (surface < 0) {  // a cluster
          std::fill_n(to, bands, 0.0f);
          continue;
        }
        const size_t patch = static_cast<size_t>(state.forest.surfaces[surface].patch);
        for (size_t b = 0; b < bands; ++b)
          to[b] = static_cast<float>(scene.emission[patch * bands + b]);
      }
    });
  });
  pull_to_clusters(state);
}

Brightness brightness_of_known(const State& state, ThreadTeam& team, const Exchange& exchange) {
  Brightness brightness = in_units_of_irradiance(state, team, exchange);
  const size_t bands = static_cast<size_t>(state.bands);
  for_each_piece(team, brightness.of_node.size(), [&](size_t, size_t begin, size_t end) {
    state.places.for_each_stretch(begin, end, [&](size_t node, size_t place, size_t count) {
      const float* radiosity = &state.radiosity[place * bands];
      for (; count-- > 0; radiosity += bands)
        brightness.of_node[node++] = brightness_of(radiosity, brightness.unit);
    });
  });
  return brightness;
}

Brightness measure_brightness(const State& state, const LightOfAll& radiosity, ThreadTeam& team,
                              const Exchange& exchange) {
  Brightness brightness = in_units_of_irradiance(state, team, exchange);
  for_each_thing(team, brightness.of_node.size(), [&](size_t k) {
    brightness.of_node[k] = brightness_of(radiosity[static_cast<NodeId>(k)], brightness.unit);
  });
  brightness.spread.resize(state.forest.nodes.size());
  for_each_root(state, team, [&](NodeId root) {
    spread_below(state.forest, radiosity, root, brightness.unit, brightness.spread);
  });
  spread_to_clusters(state.forest, brightness);
  return brightness;
}

Brightness expected_brightness(State& state) {
  const Scene& scene = *state.forest.scene;
  const Forest& forest = state.forest;
  const int bands = state.bands;
  std::vector<double> power(bands, 0.0), reflecting(bands, 0.0);
  double area = 0;
  for (const Surface& surface : forest.surfaces) {
    area += surface.area;
    for (int b = 0; b < bands; ++b) {
      const size_t at = static_cast<size_t>(surface.patch) * bands + b;
      power[b] += surface.area * scene.emission[at];
      reflecting[b] += surface.area * scene.reflectance[at];
    }
  }
  // In an enclosure of mean reflectance rho the power P brings the mean irradiance P/(A (1-rho)).
  Brightness brightness;
  brightness.unit.assign(bands, 0.0);
  for (int b = 0; b < bands; ++b)
    if (power[b] > 0) brightness.unit[b] = (area - reflecting[b]) / power[b];
  brightness.of_node.resize(state.forest.nodes.size());
  brightness.spread.assign(state.forest.nodes.size(), 0.0f);
  for (size_t k = 0; k < brightness.of_node.size(); ++k) {
    if (Forest::is_cluster(forest.nodes[k])) continue;
    const int32_t patch = forest.surfaces[forest.nodes[k].surface].patch;
    double largest = 0;
    for (int b = 0; b < bands; ++b) {
      const size_t at = static_cast<size_t>(patch) * bands + b;
      if (brightness.unit[b] > 0)
        largest =
            std::max(largest, scene.emission[at] * brightness.unit[b] + scene.reflectance[at]);
    }
    brightness.of_node[k] = static_cast<float>(largest);
  }
  brighten_clusters(state.forest, brightness);
  return brightness;
}

}  // namespace hrad
