// Push and pull, surface by surface. Floor 7 (stages).
#include "stages/sweep.h"

#include <algorithm>
#include <cmath>

namespace hrad {
namespace {

constexpr int64_t surfaces_of_a_task = 64;
constexpr int most_bands = 16;

template <class Body>
void for_each_surface(const State& state, ThreadTeam& team, Body&& body) {
  const int64_t count = state.forest.surface_count();
  team.for_each((count + surfaces_of_a_task - 1) / surfaces_of_a_task, [&](int64_t task, int) {
    const int64_t end = std::min(count, (task + 1) * surfaces_of_a_task);
    for (int64_t k = task * surfaces_of_a_task; k < end; ++k) body(static_cast<NodeId>(k));
  });
}

void push_pull_below(State& state, NodeId id, const double* emission, const double* reflectance,
                     const double* from_above) {
  const int bands = state.bands;
  const Node& node = state.forest.nodes[id];
  const size_t at = static_cast<size_t>(id) * bands;
  double down[most_bands];
  for (int b = 0; b < bands; ++b) down[b] = from_above[b] + state.gathered[at + b];
  if (node.first_child < 0) {
    for (int b = 0; b < bands; ++b) {
      const double irradiance = node.exposed > 0 ? down[b] : 0;
      state.irradiance[at + b] = static_cast<float>(irradiance);
      state.radiosity[at + b] = static_cast<float>(emission[b] + reflectance[b] * irradiance);
    }
    return;
  }
  double weight = 0;
  double radiosity[most_bands] = {}, irradiance[most_bands] = {};
  for (int child = 0; child < 4; ++child) {
    const NodeId below = node.first_child + child;
    push_pull_below(state, below, emission, reflectance, down);
    const double exposed = state.forest.nodes[below].exposed;
    const size_t from = static_cast<size_t>(below) * bands;
    weight += exposed;
    for (int b = 0; b < bands; ++b) {
      radiosity[b] += exposed * state.radiosity[from + b];
      irradiance[b] += exposed * state.irradiance[from + b];
    }
  }
  for (int b = 0; b < bands; ++b) {
    state.radiosity[at + b] = static_cast<float>(weight > 0 ? radiosity[b] / weight : emission[b]);
    state.irradiance[at + b] = static_cast<float>(weight > 0 ? irradiance[b] / weight : 0);
  }
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

// Per surface one row of `bands` sums, then added in key order: the same bits however many threads.
template <class F>
std::vector<double> surface_sums(const State& state, ThreadTeam& team, F&& add) {
  const int bands = state.bands;
  std::vector<double> rows(static_cast<size_t>(state.forest.surface_count()) * bands, 0.0);
  for_each_surface(state, team, [&](NodeId root) {
    double* row = &rows[static_cast<size_t>(root) * bands];
    visit_leaves(state.forest, root, [&](NodeId id, double area) { add(id, area, row); });
  });
  std::vector<double> total(bands, 0.0);
  for (size_t k = 0; k < rows.size(); ++k) total[k % bands] += rows[k];
  return total;
}

float brightness_of(const float* radiosity, const std::vector<double>& unit) {
  double largest = 0;
  for (size_t b = 0; b < unit.size(); ++b) largest = std::max(largest, radiosity[b] * unit[b]);
  return static_cast<float>(largest);
}

float spread_below(State& state, NodeId id, const std::vector<double>& unit) {
  Node& node = state.forest.nodes[id];
  node.spread = 0;
  if (node.first_child < 0) return 0;
  const int bands = state.bands;
  const float* mean = &state.radiosity[static_cast<size_t>(id) * bands];
  for (int child = 0; child < 4; ++child) {
    const NodeId below = node.first_child + child;
    const float inner = spread_below(state, below, unit);
    const float* value = &state.radiosity[static_cast<size_t>(below) * bands];
    double difference = 0;
    for (int b = 0; b < bands; ++b)
      difference =
          std::max(difference, std::fabs(static_cast<double>(value[b]) - mean[b]) * unit[b]);
    node.spread = std::max(node.spread, static_cast<float>(difference + inner));
  }
  return node.spread;
}

}  // namespace

void push_pull(State& state, ThreadTeam& team) {
  const Scene& scene = *state.forest.scene;
  const double nothing[most_bands] = {};
  for_each_surface(state, team, [&](NodeId root) {
    const size_t patch = static_cast<size_t>(state.forest.surfaces[root].patch) * state.bands;
    push_pull_below(state, root, &scene.emission[patch], &scene.reflectance[patch], nothing);
  });
}

void pull_exposure(Forest& forest) {
  for (size_t k = forest.nodes.size(); k-- > 0;) {
    Node& node = forest.nodes[k];
    if (node.first_child < 0) continue;
    const Node* child = &forest.nodes[node.first_child];
    node.exposed = (child[0].exposed + child[1].exposed + child[2].exposed + child[3].exposed) / 4;
  }
}

void reset_to_emission(State& state) {
  const Scene& scene = *state.forest.scene;
  const size_t count = state.forest.nodes.size();
  state.radiosity.resize(count * state.bands);
  state.irradiance.assign(count * state.bands, 0.0f);
  state.gathered.assign(count * state.bands, 0.0f);
  for (size_t k = 0; k < count; ++k) {
    const int32_t patch = state.forest.surfaces[state.forest.nodes[k].surface].patch;
    for (int b = 0; b < state.bands; ++b)
      state.radiosity[k * state.bands + b] =
          static_cast<float>(scene.emission[static_cast<size_t>(patch) * state.bands + b]);
  }
}

std::vector<double> transported(const State& state, ThreadTeam& team) {
  return surface_sums(state, team, [&](NodeId id, double area, double* row) {
    const float* irradiance = &state.irradiance[static_cast<size_t>(id) * state.bands];
    for (int b = 0; b < state.bands; ++b) row[b] += area * irradiance[b];
  });
}

Brightness measure_brightness(State& state, ThreadTeam& team) {
  const double area = state.forest.total_area();
  Brightness brightness;
  brightness.unit = surface_sums(state, team, [&](NodeId id, double leaf_area, double* row) {
    const float* irradiance = &state.irradiance[static_cast<size_t>(id) * state.bands];
    for (int b = 0; b < state.bands; ++b)
      row[b] += leaf_area * static_cast<double>(irradiance[b]) * irradiance[b];
  });
  for (double& unit : brightness.unit) unit = unit > 0 ? 1 / std::sqrt(unit / area) : 0;
  brightness.of_node.resize(state.forest.nodes.size());
  for (size_t k = 0; k < brightness.of_node.size(); ++k)
    brightness.of_node[k] = brightness_of(&state.radiosity[k * state.bands], brightness.unit);
  for_each_surface(state, team, [&](NodeId root) { spread_below(state, root, brightness.unit); });
  return brightness;
}

Brightness expected_brightness(const State& state) {
  const Scene& scene = *state.forest.scene;
  const int bands = state.bands;
  std::vector<double> power(bands, 0.0), reflecting(bands, 0.0);
  double area = 0;
  for (const Surface& surface : state.forest.surfaces) {
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
  for (size_t k = 0; k < brightness.of_node.size(); ++k) {
    const int32_t patch = state.forest.surfaces[state.forest.nodes[k].surface].patch;
    double largest = 0;
    for (int b = 0; b < bands; ++b) {
      const size_t at = static_cast<size_t>(patch) * bands + b;
      if (brightness.unit[b] > 0)
        largest =
            std::max(largest, scene.emission[at] * brightness.unit[b] + scene.reflectance[at]);
    }
    brightness.of_node[k] = static_cast<float>(largest);
  }
  return brightness;
}

}  // namespace hrad
