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
         scene.reflectance.data(), state.irradiance.data(), state.radiosity.data()},
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
  exchange.add_up(sums);
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

float spread_below(const State& state, NodeId id, const std::vector<double>& unit,
                   std::vector<float>& spread) {
  const Node& node = state.forest.nodes[id];
  spread[id] = 0;
  if (node.first_child < 0) return 0;
  const int bands = state.bands;
  const float* mean = &state.radiosity[static_cast<size_t>(id) * bands];
  for (int child = 0; child < 4; ++child) {
    const NodeId below = node.first_child + child;
    const float inner = spread_below(state, below, unit, spread);
    const float* value = &state.radiosity[static_cast<size_t>(below) * bands];
    double difference = 0;
    for (int b = 0; b < bands; ++b)
      difference =
          std::max(difference, std::fabs(static_cast<double>(value[b]) - mean[b]) * unit[b]);
    spread[id] = std::max(spread[id], static_cast<float>(difference + inner));
  }
  return spread[id];
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

void reset_to_emission(State& state, ThreadTeam& team) {
  const Scene& scene = *state.forest.scene;
  const size_t bands = static_cast<size_t>(state.bands);
  const size_t values = state.forest.nodes.size() * bands;
  if (state.irradiance.size() != values) {
    for (auto* light : {&state.irradiance, &state.radiosity})
      *light = GrowingArray<float>();  // nothing is to be kept
    state.irradiance.resize_for_overwrite(values);
    state.radiosity.reserve(values + State::floats_beyond);
    state.radiosity.resize_for_overwrite(values);
  }
  state.resize_light();  // and what lies beyond
  for_each_thing(team, state.forest.nodes.size(), [&](size_t k) {
    std::fill_n(&state.irradiance[k * bands], bands, 0.0f);
    if (Forest::is_cluster(state.forest.nodes[k])) return;
    const int32_t patch = state.forest.surfaces[state.forest.nodes[k].surface].patch;
    for (size_t b = 0; b < bands; ++b)
      state.radiosity[k * bands + b] =
          static_cast<float>(scene.emission[static_cast<size_t>(patch) * bands + b]);
  });
  pull_to_clusters(state);
}

Brightness brightness_of_nodes(const State& state, ThreadTeam& team, const Exchange& exchange) {
  const double area = state.forest.total_area();
  Brightness brightness;
  brightness.unit = surface_sums(state, team, exchange, [&](NodeId root, double* row) {
    visit_leaves(state.forest, root, [&](NodeId id, double leaf_area) {
      const float* irradiance = &state.irradiance[static_cast<size_t>(id) * state.bands];
      for (int b = 0; b < state.bands; ++b)
        row[b] += leaf_area * static_cast<double>(irradiance[b]) * irradiance[b];
    });
  });
  for (double& unit : brightness.unit) unit = unit > 0 ? 1 / std::sqrt(unit / area) : 0;
  brightness.of_node.resize(state.forest.nodes.size());
  for_each_thing(team, brightness.of_node.size(), [&](size_t k) {
    brightness.of_node[k] = brightness_of(&state.radiosity[k * state.bands], brightness.unit);
  });
  return brightness;
}

Brightness measure_brightness(const State& state, ThreadTeam& team, const Exchange& exchange) {
  Brightness brightness = brightness_of_nodes(state, team, exchange);
  brightness.spread.resize(state.forest.nodes.size());
  for_each_root(state, team, [&](NodeId root) {
    spread_below(state, root, brightness.unit, brightness.spread);
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
