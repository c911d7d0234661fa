// The sum of all rows: few rays a cell bring all light together, and leave little to chance.
#include <cmath>

#include "stages/rows_bench.h"

namespace {

using namespace hrad;
using namespace hrad_test;

constexpr int seeds = 8, sweeps = 40;

// What is absorbed, over what is emitted: one in a closed scene, but for chance.
double absorbed_share(Rows& rows) {
  State& state = rows.bench.state;
  const StageTools tools = rows.bench.tools({});
  const Scene& scene = rows.bench.scene;
  for (int k = 0; k < sweeps; ++k) sweep(state, tools.team, tools.exchange, {});
  double emitted = 0, absorbed = 0;
  for (NodeId leaf : state.forest.leaves()) {
    const Node& node = state.forest.nodes[leaf];
    const size_t patch = static_cast<size_t>(state.forest.surfaces[node.surface].patch);
    const double area = state.forest.area(node);
    emitted += area * scene.emission[patch * static_cast<size_t>(state.bands)];
    absorbed += area * node.exposed *
                (1 - scene.reflectance[patch * static_cast<size_t>(state.bands)]) *
                state.irradiance[static_cast<size_t>(leaf) * static_cast<size_t>(state.bands)];
  }
  return absorbed / emitted;
}

// Over seeds, where cells are to have four rays or eight.
void the_sum_of_coarse_rows_is_sure() {
  double sum = 0, squares = 0;
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    Rows rows(room_with_lamp());
    rows.settings.rays_of_cell = 8;
    rows.settings.least_rays = 4;
    rows.settings.contrast = 0.3;
    rows.settings.seed = seed;
    CHECK(rows.link());
    const double share = absorbed_share(rows);
    sum += share;
    squares += share * share;
  }
  const double mean = sum / seeds;
  const double deviation = std::sqrt(std::max(0.0, squares / seeds - mean * mean));
  CHECK_NEAR(mean, 1, 2e-3);
  CHECK(deviation < 1e-3);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(the_sum_of_coarse_rows_is_sure),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
