// Points of a floor on which a chest stands: spread evenly over what it leaves free.
#include <cmath>

#include "base/hash.h"
#include "links/exposed_cells.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

constexpr int draws = 20000;

// A floor of one square metre, `free` of it along x not under the chest.
Workbench floor_under_a_chest(double free) {
  Scene scene;
  add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add_quad(scene, {0, 0, 0}, {0, 1, 0}, {1 - free, 0, 0});
  return Workbench(std::move(scene));
}

ExposedCells cells_of(const Workbench& bench, NodeId root) {
  const Forest& forest = bench.state.forest;
  return {bench.exposure, forest.surfaces[static_cast<size_t>(root)], forest.root_triangle(root)};
}

// The first triangle of the floor holds y < x: centroid and second moments of its strip are known.
void draws_are_spread_evenly() {
  const double free = 0.1, low = 1 - free;
  const Workbench bench = floor_under_a_chest(free);
  ExposedCells cells = cells_of(bench, 0);
  double x = 0, y = 0, xx = 0, yy = 0;
  for (uint64_t k = 0; k < draws; ++k) {
    float u = 0, v = 0;
    CHECK(cells.draw(mix(k, 1), &u, &v));
    const Vec3 p = bench.state.forest.root_triangle(0).at(u, v);
    CHECK(p.x >= low && p.x <= 1 && p.y >= 0 && p.y <= p.x + 1e-6);
    x += p.x / draws;
    y += p.y / draws;
    xx += p.x * p.x / draws;
    yy += p.y * p.y / draws;
  }
  // Integrals of x^n over the strip from low to 1.
  const auto power = [&](int n) { return (1 - std::pow(low, n + 1)) / (n + 1); };
  const double area = power(1);
  CHECK_NEAR(x, power(2) / area, 0.001);
  CHECK_NEAR(xx, power(3) / area, 0.002);
  CHECK_NEAR(y, power(2) / 2 / area, 0.01);
  CHECK_NEAR(yy, power(3) / 3 / area, 0.01);
}

// A thousandth of the floor, by nearly all.
void little_is_found() {
  const Workbench bench = floor_under_a_chest(0.001);
  ExposedCells cells = cells_of(bench, 0);
  int found = 0;
  for (uint64_t k = 0; k < 1000; ++k) {
    float u = 0, v = 0;
    found += cells.draw(mix(k, 2), &u, &v);
  }
  CHECK(found > 900);
}

void nothing_is_found_where_nothing_is_free() {
  const Workbench bench = floor_under_a_chest(-0.1);
  for (NodeId root : {0, 1}) {
    ExposedCells cells = cells_of(bench, root);
    float u = 0.25f, v = 0.5f;
    CHECK(!cells.draw(3, &u, &v));
    CHECK(!cells.exposed(0.25, 0.5));
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(draws_are_spread_evenly),
      HRAD_TEST(little_is_found),
      HRAD_TEST(nothing_is_found_where_nothing_is_free),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
