// Linking by rows: rows that sum to one, light counted once, a mesh that follows the light.
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "hierarchy/lattice.h"
#include "stages/corner_light.h"
#include "stages/rows_bench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// Where nothing is brighter than the rest a row of a closed scene sums to one, whatever is sealed.
void rows_of_a_closed_scene_sum_to_one() {
  Scene scene = room_with_lamp();
  set_light(scene, 0, scene.patch_count(), 1, 0.5);
  Rows rows(scene);
  CHECK(rows.link());
  const State& state = rows.bench.state;
  CHECK(state.direct.links.empty());
  int64_t exposed = 0;
  for (NodeId cell : state.cells) {
    if (!(state.forest.nodes[cell].exposed > 0)) {
      CHECK_EQUAL(state.links[cell].count(), 0);
      continue;
    }
    ++exposed;
    double sum = 0;
    for (const Link& link : state.links[cell].links()) {
      CHECK(link.weight > 0);
      sum += link.weight;
    }
    CHECK_NEAR(sum, 1, 1e-6);
  }
  CHECK(exposed > 400);
}

// What comes straight from the lamp and what comes by rays together is all there is: one on the
// average, a little off by chance.
void counts_all_light_once(Rows& rows) {
  const State& state = rows.bench.state;
  double sum = 0, squares = 0, area = 0;
  for (NodeId leaf : state.forest.leaves()) {
    const Node& node = state.forest.nodes[leaf];
    if (!(node.exposed > 0)) continue;
    const double weight = rows.weight_of_leaf(leaf), a = state.forest.area(node) * node.exposed;
    sum += a * weight;
    squares += a * (weight - 1) * (weight - 1);
    area += a;
  }
  CHECK_NEAR(sum / area, 1, 5e-4);
  CHECK(std::sqrt(squares / area) < 0.02);
}

void light_of_a_lamp_is_counted_once() {
  Rows rows(room_with_lamp());
  rows.settings.rays_of_cell = 256;
  CHECK(rows.link());
  CHECK(!rows.bench.state.direct.links.empty());
  counts_all_light_once(rows);
}

// The same where means alone are wanted, without any points.
void means_of_lamps_are_counted_once() {
  Rows rows(room_with_lamp());
  rows.settings.rays_of_cell = 256;
  rows.settings.means_only = true;
  CHECK(rows.link());
  const State& state = rows.bench.state;
  CHECK(state.direct.links.empty() && state.direct.of_leaf.empty());
  int64_t lit = 0;
  for (NodeId cell : state.cells) {
    CHECK(state.forest.is_leaf(cell));
    lit += state.direct.mean[cell].count() > 0;
  }
  CHECK(lit > 200);
  counts_all_light_once(rows);
}

// Two halls, one above the other, each parted by a wall with a door in it; 64 lamps.
Scene halls_of_many_lamps() {
  Scene scene;
  for (double z : {0.0, 4.0}) {
    add_box(scene, {0, 0, z}, {32, 8, z + 3}, true);
    add_box(scene, {15.9, 0, z}, {16.1, 3, z + 3});
    add_box(scene, {15.9, 5, z}, {16.1, 8, z + 3});
    add_box(scene, {5, 2, z}, {7, 3, z + 0.8});
  }
  const int64_t first_lamp = scene.patch_count();
  for (double z : {2.8, 6.8})
    for (int k = 0; k < 32; ++k) {
      const double x = 2.0 * (k % 16) + 0.8, y = 4.0 * (k / 16) + 1.8;
      add_box(scene, {x, y, z}, {x + 0.3, y + 0.3, z + 0.1});
    }
  set_light(scene, 0, scene.patch_count(), 0, 0.5);
  for (int64_t lamp = first_lamp; lamp < scene.patch_count(); lamp += 12)
    set_light(scene, lamp, 2, 50, 0.5);
  return scene;
}

// The same where lamps far away are groups, some of them seen only in part.
void light_of_many_lamps_is_counted_once() {
  Rows rows(halls_of_many_lamps());
  rows.settings.rays_of_cell = 256;
  rows.settings.grid_size = 1.5;
  rows.settings.tolerance = 0.02;
  CHECK(rows.link());
  const State& state = rows.bench.state;
  int64_t groups = 0, lamps = 0;
  for (const Link& link : state.direct.links)
    (Forest::is_cluster(state.forest.nodes[link.source]) ? groups : lamps) += 1;
  CHECK(groups > 1000 && lamps > 1000);
  counts_all_light_once(rows);
}

// Every surface is covered by cells once, and every exposed leaf has light at its corners.
void cells_cover_all_surfaces() {
  Rows rows(room_with_lamp());
  CHECK(rows.link());
  const State& state = rows.bench.state;
  std::vector<double> covered(static_cast<size_t>(state.forest.surface_count()), 0.0);
  for (NodeId cell : state.cells) {
    const Node& node = state.forest.nodes[cell];
    covered[node.surface] += state.forest.area(node);
    for (NodeId above = node.parent; above >= 0; above = state.forest.nodes[above].parent)
      CHECK_EQUAL(state.links[above].count(), 0);
  }
  for (size_t k = 0; k < covered.size(); ++k)
    CHECK_NEAR(covered[k] / state.forest.surfaces[k].area, 1, 1e-12);
  for (NodeId id = 0; id < static_cast<NodeId>(state.forest.nodes.size()); ++id)
    for (int32_t corner : state.direct.of_leaf[id]) {
      const bool may_have = state.forest.is_leaf(id) && state.forest.nodes[id].exposed > 0;
      if (!may_have) {
        CHECK_EQUAL(corner, -1);
        CHECK_EQUAL(state.direct.mean[id].count(), 0);
      }
      CHECK(corner < static_cast<int32_t>(state.direct.point_count()));
    }
}

// Around the box that stands on it, the floor knows its light where it is exposed: the light at the
// points of a leaf's own has the mean of the leaf, and the whole floor that of a dense grid of
// points, each of which sees the lamp by a quadrature of its own.
void contacts_have_the_light_of_the_exposed_part() {
  Scene scene = room_with_lamp();
  set_light(scene, 0, scene.patch_count(), 0, 0.5);
  const int64_t lamp = 24;
  set_light(scene, lamp, 2, 50, 0.5);
  Rows rows(scene);
  CHECK(rows.link());
  const State& state = rows.bench.state;
  const Forest& forest = state.forest;
  int own = 0;
  double solved = 0;
  for (NodeId leaf : forest.leaves()) {
    const Node& node = forest.nodes[leaf];
    if (forest.surfaces[node.surface].patch > 1) continue;
    double mean = 0, at_points = 0;
    for (const Link& link : state.direct.mean[leaf].links()) mean += link.weight;
    solved += mean * forest.area(node) * node.exposed;
    if (node.light_points != at_own_points || state.direct.of_leaf[leaf][0] < 0) continue;
    ++own;
    for (int32_t number : state.direct.of_leaf[leaf])
      for (uint32_t k = state.direct.first[number]; k < state.direct.first[number + 1]; ++k)
        at_points += state.direct.links[k].weight / 3.0;
    CHECK_NEAR(mean, at_points, 1e-6);
  }
  CHECK(own > 0);
  const LeafPoints& of_leaf = state.direct.of_leaf;
  for (size_t k = 0; k < of_leaf.own_count(); ++k) {
    CHECK(of_leaf.first_own(k) >= 0 &&
          of_leaf.first_own(k) + 2 < static_cast<int32_t>(state.direct.point_count()));
    for (const LeafPoints::Place& place : of_leaf.own(k))
      CHECK(place.x > -1e-3 && place.y > -1e-3 && place.x + place.y < 1 + 1e-3);
  }
  // Lambert's cosines over the square of the distance, from grid to grid, by rays one at a time.
  constexpr int steps = 120, lamp_steps = 6;
  double wanted = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const Vec3 x{4.0 * (i + 0.5) / steps, 3.0 * (j + 0.5) / steps, 1e-4};
      if (x.x > 1 && x.x < 1.6 && x.y > 1 && x.y < 1.5) continue;
      for (int k = 0; k < lamp_steps * lamp_steps; ++k) {
        const Vec3 y{1.8 + 0.4 * (k % lamp_steps + 0.5) / lamp_steps,
                     1.3 + 0.4 * (k / lamp_steps + 0.5) / lamp_steps, 2.3 - 1e-4};
        const Vec3 d = y - x;
        if (rows.bench.engine->nearest(x, d, 0).t < 1) continue;
        const double square = dot(d, d);
        wanted += d.z * d.z / (pi * square * square) * 0.16 / (lamp_steps * lamp_steps) * 12 /
                  (steps * steps);
      }
    }
  CHECK_NEAR(solved / wanted, 1, 0.005);
}

// The three points of a leaf one of whose corners is sealed have the means of x, y and their
// products over what is exposed: a trapezoid, where the box stands across a corner of the floor.
void points_of_a_contact_have_the_means_of_quadratic_fields() {
  Scene scene;
  add_quad(scene, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});  // a floor of two triangles
  add_box(scene, {-1, -1, 0}, {1.5, 9, 1});          // over x < 1.5
  set_light(scene, 0, scene.patch_count(), 1, 0.5);
  Workbench bench(scene);
  const LinkSampler sampler = bench.sampler();
  set_exposed_shares(bench.state.forest, sampler);
  const Brightness none{{1, 1, 1}, std::vector<float>(bench.state.forest.nodes.size(), 0.0f), {}};
  const Emitters emitters(bench.state.forest, bench.exposure, none.of_node, 1);
  LightGrid grid(emitters, *bench.engine, 1, 1);
  const DirectLight light(bench.state.forest, *bench.engine, emitters, grid, 0.1);
  const StageTools tools = bench.tools({});
  CornerSampler corners(bench.state, tools, light, grid, none, 1);
  int trapezoids = 0;
  for (NodeId root = 0; root < 2; ++root) {
    LatticePoint corner[3];
    lattice_corners(bench.state.forest.nodes[root], corner);
    Vec3 point[3];
    CHECK(corners.points_of_exposed(root, corner, point));
    const Triangle t = bench.state.forest.root_triangle(root);
    double wanted[5] = {}, count = 0, found[5] = {};
    constexpr int steps = 1500;
    const auto add = [](Vec3 p, double weight, double* sum) {
      const double field[5] = {p.x, p.y, p.x * p.x, p.x * p.y, p.y * p.y};
      for (int k = 0; k < 5; ++k) sum[k] += weight * field[k];
    };
    for (int i = 0; i < steps; ++i)
      for (int j = 0; i + j < steps; ++j) {
        const Vec3 p = t.at((i + 1.0 / 3) / steps, (j + 1.0 / 3) / steps);
        if (p.x < 1.5) continue;
        add(p, 1, wanted);
        ++count;
      }
    for (const Vec3& p : point) add(p, 1.0 / 3, found);
    for (int k = 0; k < 5; ++k) CHECK_NEAR(found[k], wanted[k] / count, 0.02 * wanted[k] / count);
    int sealed_corners = 0;
    for (const Vec3& p : {t.a, t.b, t.c}) sealed_corners += p.x < 1.5;
    trapezoids += sealed_corners == 1;
  }
  CHECK_EQUAL(trapezoids, 1);
}

// Leaves are small at the edge of the shadow that a plate throws, and large away from it.
void the_mesh_follows_the_shadow() {
  Scene scene;
  add_quad(scene, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  add_quad(scene, {0, 0, 0.3}, {2, 0, 0}, {0, 4, 0});  // its edge above x = 2
  add_quad(scene, {1.99, 1.99, 2}, {0, 0.02, 0}, {0.02, 0, 0});
  set_light(scene, 0, 4, 0, 0.5);
  set_light(scene, 4, 2, 1e5, 0.5);
  Rows rows(scene);
  CHECK(rows.link());
  const Forest& forest = rows.bench.state.forest;
  double near = 0, far = 0;
  int n_near = 0, n_far = 0;
  for (NodeId leaf : forest.leaves()) {
    if (forest.nodes[leaf].surface > 1) continue;
    const double x = forest.triangle(forest.nodes[leaf]).centroid().x;
    const double leg = std::sqrt(2 * forest.area(forest.nodes[leaf]));
    if (std::fabs(x - 2) < 0.02) near += leg, ++n_near;
    if (x < 1.5) far += leg, ++n_far;
  }
  CHECK(n_near > 0 && n_far > 0);
  CHECK(near / n_near < 0.25 * far / n_far);
}

// Points of one solution are within the noise of another seed's.
void seeds_differ_by_noise_alone() {
  std::vector<double> totals;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    Rows rows(room_with_lamp());
    rows.settings.seed = seed;
    CHECK(rows.link());
    rows.bench.sweep(29);
    gather(rows.bench.state, rows.bench.team);
    totals.push_back(push_pull(rows.bench.state, rows.bench.team, rows.bench.exchange)[0]);
  }
  for (const double& total : totals) {
    CHECK_NEAR(total, totals[0], 0.01 * totals[0]);
    if (&total != &totals[0]) CHECK(total != totals[0]);
  }
}

void a_stop_is_heeded() {
  for (double at : {0.0, 0.2, 0.5, 0.9}) {
    Rows rows(room_with_lamp());
    StageTools tools = rows.bench.tools({});
    double reached = 0;
    tools.progress = [&](double fraction) {
      CHECK(fraction >= 0 && fraction <= 1);
      reached = fraction;
      return fraction < at;
    };
    CHECK(!link_rows(rows.bench.state, tools, rows.settings));
    CHECK(reached >= at);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(rows_of_a_closed_scene_sum_to_one),
      HRAD_TEST(light_of_a_lamp_is_counted_once),
      HRAD_TEST(light_of_many_lamps_is_counted_once),
      HRAD_TEST(means_of_lamps_are_counted_once),
      HRAD_TEST(cells_cover_all_surfaces),
      HRAD_TEST(the_mesh_follows_the_shadow),
      HRAD_TEST(seeds_differ_by_noise_alone),
      HRAD_TEST(a_stop_is_heeded),
      HRAD_TEST(contacts_have_the_light_of_the_exposed_part),
      HRAD_TEST(points_of_a_contact_have_the_means_of_quadratic_fields),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
