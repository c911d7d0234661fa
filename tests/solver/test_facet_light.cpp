// Light on facets: what chance gave each of them is evened out, what belongs to their surface
// stays, and other surfaces have no part in it.
#include <cmath>
#include <memory>

#include "base/hash.h"
#include "physics/solids.h"
#include "solver/facet_light.h"
#include "solver/linear_field.h"
#include "support/check.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// A scene whose cells are its surfaces, with light on them.
struct Facets {
  template <class Light>
  Facets(Scene s, Light&& light_of) : scene(std::move(s)), forest(scene) {
    for (NodeId root = 0; root < forest.surface_count(); ++root) {
      cells.push_back(root);
      light.push_back(light_of(root, forest));
    }
  }
  double area(NodeId root) const { return forest.surfaces[static_cast<size_t>(root)].area; }
  double power() const {
    double sum = 0;
    for (NodeId root : cells) sum += area(root) * forest.nodes[root].exposed * light[root];
    return sum;
  }
  // Root mean square of what the light deviates from what it should be.
  template <class Wanted>
  double deviation(Wanted&& wanted) const {
    double square = 0, all = 0;
    for (NodeId root : cells) {
      const double off = light[root] - wanted(root, forest);
      square += area(root) * off * off;
      all += area(root);
    }
    return std::sqrt(square / all);
  }
  Scene scene;
  Forest forest;
  std::vector<NodeId> cells;
  std::vector<float> light;
};

Scene sphere() {
  Scene scene;
  for (const auto& face : physics::sphere_faces({0, 0, 0}, 1, 4, false)) {
    const auto at = [&](size_t k) { return Vec3{face[k].x, face[k].y, face[k].z}; };
    add_triangle(scene, at(0), at(1), at(2));
  }
  return scene;
}

double lit_from_above(NodeId root, const Forest& forest) {
  return 2 + forest.surfaces[root].normal.z;
}

float noisy(NodeId root, const Forest& forest) {
  const double noise = 2 * unit_interval(mix(static_cast<uint64_t>(root), 7)) - 1;
  return static_cast<float>(lit_from_above(root, forest) + noise);
}

// A plate of many small squares.
void add_plate(Scene& scene, Vec3 corner, Vec3 x, Vec3 y) {
  constexpr int squares = 8;
  const auto at = [&](int i, int j) {
    return corner + x * (i / double{squares}) + y * (j / double{squares});
  };
  for (int i = 0; i < squares; ++i)
    for (int j = 0; j < squares; ++j) {
      add_triangle(scene, at(i, j), at(i + 1, j), at(i + 1, j + 1));
      add_triangle(scene, at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
}

void noise_goes_and_the_mean_stays() {
  Facets facets(sphere(), noisy);
  const double noise = facets.deviation(lit_from_above), power = facets.power();
  even_out_facets(facets.forest, 1, facets.cells, 60 * facets.area(0), facets.light);
  CHECK(noise > 0.5);
  CHECK(facets.deviation(lit_from_above) < noise / 5);
  CHECK_NEAR(facets.power() / power, 1, 1e-6);
}

// Facets that contacts seal in part count for what is left of them.
void sealed_parts_have_no_say() {
  Facets facets(sphere(), noisy);
  for (NodeId root : facets.cells)
    facets.forest.nodes.set_exposed(root, static_cast<float>(root % 4) / 4);
  for (NodeId root : facets.cells)
    if (root % 4 == 0) facets.light[root] = 1000;
  const double power = facets.power();
  even_out_facets(facets.forest, 1, facets.cells, 60 * facets.area(0), facets.light);
  CHECK_NEAR(facets.power() / power, 1, 1e-6);
  for (NodeId root : facets.cells) CHECK(root % 4 == 0 || facets.light[root] < 4);
}

// Patches as large as other cells have rays enough.
void large_patches_keep_what_they_have() {
  Facets facets(sphere(), noisy);
  const std::vector<float> before = facets.light;
  even_out_facets(facets.forest, 1, facets.cells, 3 * facets.area(0), facets.light);
  CHECK(facets.light == before);
}

// Neither across a right angle, nor from the one side of a sheet to the other, nor around the fold
// of one that is folded flat.
void light_stays_on_its_side_of_an_edge() {
  Scene scene;
  add_plate(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add_plate(scene, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  const double slope = 0.02;
  add_plate(scene, {1, 0, 0}, {-1, 0, -slope}, {0, 1, 0});
  for (uint8_t& flag : scene.flags) flag |= patch_two_sided;
  const auto light_of = [](NodeId root, const Forest& forest) {
    const Surface& surface = forest.surfaces[root];
    return static_cast<float>(1 << (2 * (surface.patch / 128) + surface.side));
  };
  Facets facets(std::move(scene), light_of);
  const std::vector<float> before = facets.light;
  even_out_facets(facets.forest, 1, facets.cells, 0.5, facets.light);
  for (NodeId root : facets.cells) CHECK_NEAR(facets.light[root], before[root], 1e-5);
}

// With facet_area, a field has one value where facets of a sphere meet.
double largest_step(const Facets& facets, double facet_area) {
  const auto mean = [&](NodeId id, double* values) {
    *values = facets.light[id];
    return 1.0;
  };
  const LinearField field(
      facets.forest, 1, facets.cells, LinearField::Known::over_elements,
      [&](NodeId id, int, double* values) { return mean(id, values); }, mean, facet_area);
  CornerIndex corners(facets.forest, 4 * physics::pi);
  std::vector<double> low, high;
  for (NodeId root : facets.cells) {
    double value[3];
    field.corners(root, value);
    LatticePoint corner[3];
    lattice_corners(facets.forest.nodes[root], corner);
    for (int c = 0; c < 3; ++c) {
      const size_t at = static_cast<size_t>(corners.number(root, corner[c]));
      if (at == low.size()) {
        low.push_back(value[c]);
        high.push_back(value[c]);
      }
      low[at] = std::min(low[at], value[c]);
      high[at] = std::max(high[at], value[c]);
    }
  }
  double largest = 0;
  for (size_t k = 0; k < low.size(); ++k) largest = std::max(largest, high[k] - low[k]);
  return largest;
}

void facets_meet_in_one_value() {
  const Facets facets(sphere(), noisy);
  CHECK(largest_step(facets, 0) > 1);
  CHECK_EQUAL(largest_step(facets, 2 * facets.area(0)), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(noise_goes_and_the_mean_stays),     HRAD_TEST(sealed_parts_have_no_say),
      HRAD_TEST(large_patches_keep_what_they_have), HRAD_TEST(light_stays_on_its_side_of_an_edge),
      HRAD_TEST(facets_meet_in_one_value),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
