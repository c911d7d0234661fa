// Rows on a scene of a test's own, with a mesh of some five hundred cells.
#pragma once

#include <utility>

#include "stages/rows.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace hrad_test {

using namespace hrad;

struct Rows {
  explicit Rows(Scene s, RowSettings given = {}, int threads = 2)
      : bench(std::move(s), threads), settings(given) {
    double area = 0;
    for (const Surface& surface : bench.state.forest.surfaces) area += surface.area;
    settings.cell_area = area / 500;
    settings.least_cell_area = settings.cell_area / 256;
    settings.min_area = settings.cell_area / 1024;
    expose_roots();
  }
  void expose_roots() {
    const LinkSampler sampler = bench.sampler();
    set_exposed_shares(bench.state.forest, sampler);
  }
  bool link() { return link_rows(bench.state, bench.tools({}), settings); }

  // Weights of the rows of the cells above a leaf, and of its direct light.
  double weight_of_leaf(NodeId leaf) const {
    const State& state = bench.state;
    double sum = 0;
    for (NodeId id = leaf; id >= 0; id = state.forest.nodes[id].parent)
      for (const Link& link : state.links[id].links()) sum += link.weight;
    for (const Link& link : state.direct.mean[leaf].links()) sum += link.weight;
    return sum;
  }

  Workbench bench;
  RowSettings settings;
};

inline void set_light(Scene& scene, int64_t first, int64_t count, double emission,
                      double reflectance) {
  for (int64_t k = first * scene.bands; k < (first + count) * scene.bands; ++k) {
    scene.emission[static_cast<size_t>(k)] = emission;
    scene.reflectance[static_cast<size_t>(k)] = reflectance;
  }
}

// A closed room with a box on the floor and a lamp under the ceiling.
inline Scene room_with_lamp() {
  Scene scene;
  add_box(scene, {0, 0, 0}, {4, 3, 2.5}, true);
  add_box(scene, {1, 1, 0}, {1.6, 1.5, 0.8});
  const int64_t lamp = scene.patch_count();
  add_box(scene, {1.8, 1.3, 2.3}, {2.2, 1.7, 2.35});
  set_light(scene, 0, scene.patch_count(), 0, 0.5);
  set_light(scene, lamp, 2, 50, 0.5);
  return scene;
}

}  // namespace hrad_test
