// Rough links: where their points lie, that guesses follow the geometry, and that estimates are
// right on the average.
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "links/cluster_ends.h"
#include "links/end_points.h"
#include "links/form_factor.h"
#include "links/link_guess.h"
#include "links/mean_factor.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// Two grids of n by n squares of 1/n, facing each other at the given height.
Scene facing_grids(int n, double height) {
  Scene scene;
  scene.add_material({});
  for (int upper = 0; upper < 2; ++upper)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double x = i / static_cast<double>(n), y = j / static_cast<double>(n), s = 1.0 / n;
        const double z = upper ? height : 0;
        const int32_t a = scene.add_vertex({x, y, z});
        scene.add_vertex({x + s, y, z});
        scene.add_vertex({x + s, y + s, z});
        scene.add_vertex({x, y + s, z});
        if (upper) {
          scene.add_patch(a, a + 2, a + 1, 0);
          scene.add_patch(a, a + 3, a + 2, 0);
        } else {
          scene.add_patch(a, a + 1, a + 2, 0);
          scene.add_patch(a, a + 2, a + 3, 0);
        }
      }
  return scene;
}

// The cluster of all surfaces that face up, or down.
NodeId cluster_facing(const Forest& forest, double z) {
  for (NodeId child : forest.cluster(forest.nodes[forest.top()]).child)
    if (forest.cluster(forest.nodes[child]).normal.z * z > 0.999) return child;
  return -1;
}

// Parallel unit squares at distance h, opposite each other: Howell's C-11 in closed form.
double opposite_squares(double h) {
  const double x = 1 / h, y2 = 1 + x * x;
  return 2 / (pi * x * x) *
         (std::log(std::sqrt(y2 * y2 / (1 + 2 * x * x))) +
          2 * x * std::sqrt(y2) * std::atan(x / std::sqrt(y2)) - 2 * x * std::atan(x));
}

struct Prepared : Workbench {
  explicit Prepared(Scene s) : Workbench(std::move(s)) {
    const LinkSampler measure = sampler();
    set_exposed_shares(state.forest, measure);
    add_clusters(state.forest);
  }
  Element end(NodeId id) const { return element_of(state.forest, state.forest.nodes[id]); }
};

void points_stand_for_the_exposed_area() {
  const Prepared bench(builtin_scene("furnace-boxes"));
  const Forest& forest = bench.state.forest;
  const PointPlacer placer = bench.sampler().placer();
  std::vector<double> met(static_cast<size_t>(forest.surface_count()), 0.0);
  const Element top = bench.end(forest.top());
  constexpr int draws = 4000;
  for (int draw = 0; draw < draws; ++draw) {
    EndPoints points;
    placer.place(top, mix(static_cast<uint64_t>(draw)), points);
    for (int k = 0; k < 16; ++k) {
      const Vec3 p = Vec3{points.x[k], points.y[k], points.z[k]} + placer.center;
      const Vec3 n{points.nx[k], points.ny[k], points.nz[k]};
      bool found = false;
      for (int32_t s = 0; s < forest.surface_count() && !found; ++s) {
        const Surface& surface = forest.surfaces[s];
        const Triangle t = forest.root_triangle(s);
        if (dot(n, surface.normal) < 0.999) continue;
        if (std::fabs(dot(p - t.a, surface.normal)) > 2 * placer.offset) continue;
        const Vec3 a = t.area_vector();
        const double u = dot(cross(p - t.a, t.c - t.a), a) / dot(a, a);
        const double v = dot(cross(t.b - t.a, p - t.a), a) / dot(a, a);
        if (u < -1e-4 || v < -1e-4 || u + v > 1 + 1e-4) continue;
        CHECK(!bench.exposure.sealed(surface.patch, surface.side, t.at(u, v)) || u < 1e-3 ||
              v < 1e-3 || u + v > 1 - 1e-3);
        met[s] += 1;
        found = true;
      }
      CHECK(found);
    }
  }
  for (int32_t s = 0; s < forest.surface_count(); ++s) {
    const double wanted = forest.surfaces[s].area * forest.nodes[s].exposed / top.area * 16 * draws;
    CHECK_NEAR(met[s], wanted, 0.06 * wanted + 60);
  }
}

// Means over many keys of a link between clusters, against the closed form.
void clusters_have_the_form_factor_of_what_they_hold() {
  for (double height : {1.8, 3.0}) {
    const Prepared bench(facing_grids(4, height));
    const Forest& forest = bench.state.forest;
    const Element up = bench.end(cluster_facing(forest, 1)),
                  down = bench.end(cluster_facing(forest, -1));
    LinkSampler sampler = bench.sampler();
    double sum = 0, weights = 0;
    constexpr int keys = 400;
    for (int k = 0; k < keys; ++k) {
      DrawnPairs drawn;
      LinkEstimate e;
      sampler.begin(up, down, mix(static_cast<uint64_t>(k)), drawn, e, 1);
      CHECK(e.by_points);
      sampler.trace(up, down, mix(static_cast<uint64_t>(k)), drawn, e);
      sum += e.factor / keys;
      weights += e.weight() / keys;
    }
    const double exact = opposite_squares(height);
    CHECK_NEAR(sum, exact, 0.01 * exact);
    CHECK_NEAR(weights, sum, 1e-6);  // nothing stands between
    // The guess is of the right size.
    const LinkGuess guess = guess_of(up, down);
    CHECK(guess.factor > exact / 2 && guess.factor < 2 * exact);
  }
}

// Touching patches, estimated roughly: right on the average, by factor and by weight.
void touching_patches_are_right_on_the_average() {
  Scene scene;
  scene.add_material({});
  add_box(scene, {0, 0, 0}, {1, 2, 3}, true);
  Prepared bench(std::move(scene));
  LinkSampler sampler = bench.sampler();
  for (NodeId receiver : {0, 4, 8})
    for (NodeId source = 0; source < 12; ++source) {
      const Element a = bench.end(receiver), b = bench.end(source);
      const double exact = mean_factor(a.corners, a.normal, b.corners).mean;
      if (exact < 0.01 || dot(a.normal, b.normal) > 0.5) continue;
      double sum = 0, weights = 0;
      constexpr int keys = 200;
      for (int k = 0; k < keys; ++k) {
        const uint64_t key =
            mix(static_cast<uint64_t>(k), static_cast<uint64_t>(receiver * 12 + source));
        DrawnPairs drawn;
        LinkEstimate e;
        sampler.begin(a, b, key, drawn, e, 1);
        CHECK(e.by_points);
        sampler.trace(a, b, key, drawn, e);
        CHECK(e.weight() <= 1);
        sum += e.factor / keys;
        weights += e.weight() / keys;
      }
      CHECK_NEAR(sum, exact, 0.03 * exact + 0.002);
      CHECK_NEAR(weights, sum, 1e-3 * sum);
    }
}

// A wall across a room.
void hidden_parts_are_hidden() {
  Scene scene;
  scene.add_material({});
  add_box(scene, {0, 0, 0}, {2, 1, 1}, true);
  add_box(scene, {0.95, 0, 0}, {1.05, 1, 1});
  Prepared bench(std::move(scene));
  LinkSampler sampler = bench.sampler();
  const Forest& forest = bench.state.forest;
  // The end walls don't see each other.
  NodeId left = -1, right = -1;
  for (NodeId root = 0; root < 12; ++root) {
    if (forest.surfaces[root].normal.x > 0.9) left = root;
    if (forest.surfaces[root].normal.x < -0.9) right = root;
  }
  for (uint64_t key = 0; key < 20; ++key) {
    DrawnPairs drawn;
    LinkEstimate e;
    sampler.begin(bench.end(left), bench.end(right), key, drawn, e, 1);
    sampler.trace(bench.end(left), bench.end(right), key, drawn, e);
    CHECK(e.factor > 0.01);
    CHECK_EQUAL(e.weight(), 0.0);
  }
}

void who_may_be_linked() {
  const Prepared bench(facing_grids(4, 3));
  const Forest& forest = bench.state.forest;
  const Element up = bench.end(cluster_facing(forest, 1)),
                down = bench.end(cluster_facing(forest, -1));
  const Element top = bench.end(forest.top()), patch = bench.end(0);
  const double margin = 1e-5;
  CHECK(meeting_of(up, down, margin) == Meeting::link);
  CHECK(meeting_of(down, up, margin) == Meeting::link);
  CHECK(meeting_of(patch, down, margin) == Meeting::link);
  // Its normals point both ways.
  CHECK(meeting_of(down, top, margin) == Meeting::descend_source);
  CHECK(meeting_of(top, down, margin) == Meeting::split_receiver);
  // In one plane.
  CHECK(meeting_of(up, up, margin) == Meeting::no_light);
  CHECK(meeting_of(patch, up, margin) == Meeting::no_light);
  CHECK(meeting_of(patch, patch, margin) == Meeting::no_light);
  // Too near each other.
  const Prepared close(facing_grids(4, 0.5));
  const Element low = close.end(cluster_facing(close.state.forest, 1));
  const Element high = close.end(cluster_facing(close.state.forest, -1));
  CHECK(meeting_of(low, high, margin) == Meeting::split_receiver ||
        meeting_of(low, high, margin) == Meeting::descend_source);
  CHECK(meeting_of(close.end(0), high, margin) == Meeting::descend_source);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(points_stand_for_the_exposed_area),
      HRAD_TEST(clusters_have_the_form_factor_of_what_they_hold),
      HRAD_TEST(touching_patches_are_right_on_the_average),
      HRAD_TEST(hidden_parts_are_hidden),
      HRAD_TEST(who_may_be_linked),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
