// A scene with its emitters as linking by rows sees them, and floors under lamps.
#pragma once

#include <vector>

#include "links/direct_light.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace hrad_test {

using namespace hrad;

inline void open(LightGrid& grid, const std::vector<OrientedPoint>& points, Workbench& bench) {
  int64_t rays = 0;
  const auto opener = [&](std::vector<LightGrid::Opened>& cubes,
                          const std::function<void(size_t)>& find) {
    return bench.team.for_each(static_cast<int64_t>(cubes.size()),
                               [&](int64_t k, int) { find(static_cast<size_t>(k)); });
  };
  CHECK(grid.open(points, bench.team, bench.comm, opener, rays));
}

inline State& with_exposed_shares(Workbench& bench) {
  const LinkSampler sampler = bench.sampler();
  set_exposed_shares(bench.state.forest, sampler);
  return bench.state;
}

struct Lit {
  explicit Lit(Scene s, double noise = 1e-6, double least_bright = 1e-9)
      : bench(std::move(s)),
        expected(expected_brightness(with_exposed_shares(bench))),
        emitters(bench.state.forest, bench.exposure, expected.of_node, least_bright),
        grid(emitters, *bench.engine, 0.7, 8 * noise),
        light(bench.state.forest, *bench.engine, emitters, grid, noise) {}

  double at(Vec3 x, Vec3 normal, uint64_t key = 1) {
    open(grid, {{x, normal}}, bench);
    std::vector<Link> links;
    rays = light.sample({x, normal}, key, links);
    double sum = 0;
    for (const Link& link : links) sum += link.weight;
    return sum;
  }

  Workbench bench;
  Brightness expected;
  Emitters emitters;
  LightGrid grid;
  DirectLight light;
  int64_t rays = 0;
};

// The same with groups.
struct LitByGroups : Lit {
  explicit LitByGroups(Scene s, double noise) : Lit(std::move(s), noise) {
    emitters.join(bench.state.forest, bench.exposure);
  }
};

inline void make_last_emit(Scene& scene, int64_t patches, double emission) {
  const size_t first = scene.emission.size() - static_cast<size_t>(patches * scene.bands);
  for (size_t k = first; k < scene.emission.size(); ++k) scene.emission[k] = emission;
}

// A floor of side 10 under a square lamp of side `side` at height 1, which shines down.
inline Scene floor_and_lamp(double side) {
  Scene scene;
  add_quad(scene, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0});
  add_quad(scene, {-side / 2, -side / 2, 1}, {0, side, 0}, {side, 0, 0});
  make_last_emit(scene, 2, 100);
  return scene;
}

const Vec3 up{0, 0, 1};

}  // namespace hrad_test
