// Two linear passes over the clusters: these are few beside the elements. Floor 7 (stages).
#include "stages/cluster_sweep.h"

#include <cmath>

namespace hrad {
namespace {

size_t first_cluster(const Forest& forest) { return static_cast<size_t>(forest.surface_count()); }
size_t end_of_clusters(const Forest& forest) {
  return first_cluster(forest) + forest.clusters.clusters.size();
}

// f(cluster, exposed areas of its two children, their ids), the lowest clusters first.
template <class F>
void upwards(const Forest& forest, F&& f) {
  for (size_t id = end_of_clusters(forest); id-- > first_cluster(forest);) {
    const NodeId* child = forest.cluster(forest.nodes[id]).child;
    double area[2];
    for (int k = 0; k < 2; ++k) {
      const Node& node = forest.nodes[child[k]];
      area[k] = forest.area(node) * node.exposed;
    }
    f(id, area, child);
  }
}

double mean(const double area[2], double a, double b) {
  const double sum = area[0] + area[1];
  return sum > 0 ? (area[0] * a + area[1] * b) / sum : 0;
}

}  // namespace

void push_to_roots(State& state) {
  const Forest& forest = state.forest;
  for (size_t id = first_cluster(forest); id < end_of_clusters(forest); ++id) {
    const NodeId parent = forest.nodes[id].parent;
    if (parent < 0) continue;
    for (int b = 0; b < state.bands; ++b)
      state.irradiance_of(static_cast<NodeId>(id))[b] += state.irradiance_of(parent)[b];
  }
}

void pull_to_clusters(State& state) {
  const size_t bands = static_cast<size_t>(state.bands);  // places of roots and clusters are ids
  upwards(state.forest, [&](size_t id, const double area[2], const NodeId child[2]) {
    for (auto* light : {&state.radiosity, &state.irradiance})
      for (size_t b = 0; b < bands; ++b)
        (*light)[id * bands + b] =
            static_cast<float>(mean(area, (*light)[static_cast<size_t>(child[0]) * bands + b],
                                    (*light)[static_cast<size_t>(child[1]) * bands + b]));
  });
}

void brighten_clusters(const Forest& forest, Brightness& brightness) {
  upwards(forest, [&](size_t id, const double area[2], const NodeId child[2]) {
    brightness.of_node[id] =
        static_cast<float>(mean(area, brightness.of_node[child[0]], brightness.of_node[child[1]]));
  });
  spread_to_clusters(forest, brightness);
}

void spread_to_clusters(const Forest& forest, Brightness& brightness) {
  upwards(forest, [&](size_t id, const double area[2], const NodeId child[2]) {
    double square[2];
    for (int k = 0; k < 2; ++k) {
      const double apart = brightness.of_node[child[k]] - brightness.of_node[id];
      const double within = brightness.spread[child[k]];
      square[k] = apart * apart + within * within;
    }
    brightness.spread[id] = static_cast<float>(std::sqrt(mean(area, square[0], square[1])));
  });
}

}  // namespace hrad
