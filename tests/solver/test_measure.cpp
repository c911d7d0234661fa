// Measurements of a solution: the error estimate of right and of deliberately wrong solutions, and
// where the power goes in scenes whose balance is known.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "solver/measure.h"
#include "solver/ray_gather.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

OracleSettings settings(double scale = 1) {
  OracleSettings s;
  s.mean_variance = 2e-4 * scale;
  s.point_variance = 2e-2 * scale;
  s.point_area = 1e-2;
  s.min_area = 1e-3;
  return s;
}

void solve(Workbench& bench, int rounds = 4) {
  bench.link(settings());
  bench.sweep(25);
  for (int k = 0; k < rounds; ++k) {
    bench.refine(settings());
    bench.sweep(25);
  }
}

// A room of 2 x 2 x 1 with a lamp of 0.5 x 0.5 that hangs below the ceiling; reflectance of the
// walls.
Scene lit_room(double reflectance) {
  Scene scene;
  scene.bands = 2;
  scene.add_material({"wall", {reflectance, reflectance / 2}, {0, 0}});
  add_box(scene, {0, 0, 0}, {2, 2, 1}, true);
  const int32_t lamp = scene.add_material({"lamp", {0, 0}, {4, 8}});
  const int32_t first = scene.add_vertex({0.75, 0.75, 0.9});
  scene.add_vertex({0.75, 1.25, 0.9});
  scene.add_vertex({1.25, 1.25, 0.9});
  scene.add_vertex({1.25, 0.75, 0.9});
  scene.add_patch(first, first + 1, first + 2, lamp);
  scene.add_patch(first, first + 2, first + 3, lamp);
  return scene;
}

// Irradiance times a factor, on the patches that `wanted` says; with it the light they reflect.
template <class Wanted>
void spoil(Workbench& bench, double factor, Wanted&& wanted) {
  State& state = bench.state;
  for (size_t k = 0; k < state.forest.nodes.size(); ++k) {
    const int32_t patch = state.forest.surfaces[state.forest.nodes[k].surface].patch;
    if (!wanted(patch)) continue;
    for (int b = 0; b < state.bands; ++b) {
      const size_t at = k * state.bands + b, of = static_cast<size_t>(patch) * state.bands + b;
      state.irradiance[at] = static_cast<float>(state.irradiance[at] * factor);
      state.radiosity[at] = static_cast<float>(bench.scene.emission[of] +
                                               bench.scene.reflectance[of] * state.irradiance[at]);
    }
  }
}

bool everywhere(int32_t) { return true; }

ErrorEstimate estimate(Workbench& bench, double accuracy = 0.02) {
  return estimate_error(bench.state, bench.radiosity_of_all(), bench.tools(settings()), accuracy)
      .value();
}

void a_good_solution_is_found_good() {
  for (double reflectance : {0.0, 0.5, 0.8}) {
    Workbench bench(lit_room(reflectance));
    solve(bench);
    const ErrorEstimate e = estimate(bench);
    CHECK(e.error >= 0 && e.error < 0.03);
    CHECK(e.standard_error >= 0 && e.standard_error < 0.05);
    CHECK(e.rays > 10000);
  }
}

// Black walls reflect nothing on: the estimate is the error itself.
void a_wrong_level_is_measured() {
  for (double factor : {0.5, 0.9, 1.1, 1.4}) {
    Workbench bench(lit_room(0));
    solve(bench);
    spoil(bench, factor, everywhere);
    const double wanted = std::fabs(factor - 1) / factor;  // of what was solved
    CHECK_NEAR(estimate(bench).error, wanted, 0.03);
  }
}

// Light that is missing at one bounce is missing at all that follow.
void a_wrong_level_weighs_more_between_bright_walls() {
  Workbench bench(lit_room(0.8));
  solve(bench);
  const double good = estimate(bench).error;
  for (double factor : {0.8, 1.25}) {
    Workbench wrong(lit_room(0.8));
    solve(wrong);
    spoil(wrong, factor, everywhere);
    const ErrorEstimate e = estimate(wrong);
    CHECK(e.error > 0.1);
    CHECK(e.error > good + 3 * e.standard_error);
  }
}

// Too much here and too little there: no bias, yet an error.
void a_wrong_pattern_is_measured() {
  Workbench bench(lit_room(0));
  solve(bench);
  spoil(bench, 1.3, [](int32_t patch) { return patch % 2 == 0; });
  spoil(bench, 0.7, [](int32_t patch) { return patch % 2 == 1; });
  CHECK_NEAR(estimate(bench).error, 0.3, 0.06);
}

void one_wrong_patch_is_measured() {
  Workbench good(lit_room(0.5)), bad(lit_room(0.5));
  solve(good);
  solve(bad);
  // One half of the floor, the brightest there is, at twice its light.
  int32_t floor = -1;
  for (int32_t p = 0; p < 12 && floor < 0; ++p)
    if (good.scene.triangle(p).area_vector().z > 0) floor = p;
  spoil(bad, 2, [&](int32_t patch) { return patch == floor; });
  CHECK(estimate(bad).error > estimate(good).error + 0.1);
}

void measuring_depends_on_no_threads() {
  std::vector<double> first;
  for (int threads : {1, 2, 5}) {
    Workbench bench(lit_room(0.5), threads);
    solve(bench, 1);
    const ErrorEstimate e = estimate(bench);
    const PowerBalance balance =
        measure_balance(bench.state, bench.radiosity_of_all(), bench.tools(settings())).value();
    std::vector<double> all = {e.error, e.standard_error, balance.back_share};
    for (const auto* v :
         {&balance.emitted, &balance.absorbed, &balance.absorbed_back, &balance.escaped})
      all.insert(all.end(), v->begin(), v->end());
    if (first.empty()) first = all;
    CHECK(all == first);
  }
}

void without_dark_patches_there_is_no_estimate() {
  Workbench bench(builtin_scene("furnace"));
  bench.prepare();
  CHECK(estimate(bench).error < 0);
  Workbench dark(random_soup(10, 1, 81));
  dark.prepare();
  CHECK(estimate(dark).error < 0);
}

// In a closed room nothing is lost: all that is emitted is absorbed.
void power_adds_up_in_a_closed_room() {
  for (double reflectance : {0.0, 0.7}) {
    Workbench bench(lit_room(reflectance));
    solve(bench);
    const PowerBalance b =
        measure_balance(bench.state, bench.radiosity_of_all(), bench.tools(settings())).value();
    for (int band = 0; band < 2; ++band) {
      const double emitted = 0.25 * (band ? 8 : 4);
      CHECK_NEAR(b.emitted[band], emitted, 1e-9);
      CHECK_NEAR(b.escaped[band], 0, 1e-9);
      // The lamp is one-sided: its back takes what the ceiling throws down on it.
      if (reflectance == 0) CHECK_NEAR(b.absorbed_back[band], 0, 1e-9);
      CHECK_NEAR((b.absorbed[band] + b.absorbed_back[band]) / emitted, 1, 0.02);
    }
    CHECK((b.absorbed_back[0] > 0.001) == (reflectance > 0));
    CHECK((b.back_share > 0) == (reflectance > 0));
  }
}

// Black unit squares face to face: F = 0.1998 arrives, the rest escapes.
void power_adds_up_between_plates() {
  Workbench bench(builtin_scene("parallel-plates"));
  solve(bench);
  const PowerBalance b =
      measure_balance(bench.state, bench.radiosity_of_all(), bench.tools(settings())).value();
  for (int band = 0; band < 3; ++band) {
    CHECK_NEAR(b.emitted[band], 1, 1e-9);
    CHECK_NEAR(b.absorbed[band], 0.19982, 0.004);
    CHECK_NEAR(b.escaped[band], 1 - 0.19982, 0.01);
    CHECK_NEAR(b.absorbed_back[band], 0, 1e-9);
  }
}

// The same with the receiving plate turned over: its back is black.
void backs_absorb() {
  Scene scene = builtin_scene("parallel-plates");
  for (int64_t p = 0; p < scene.patch_count(); ++p)
    if (scene.triangle(p).a.z > 0.5) std::swap(scene.corners[p][1], scene.corners[p][2]);
  Workbench bench(std::move(scene));
  solve(bench);
  const PowerBalance b =
      measure_balance(bench.state, bench.radiosity_of_all(), bench.tools(settings())).value();
  for (int band = 0; band < 3; ++band) {
    CHECK_NEAR(b.absorbed[band], 0, 1e-9);
    CHECK_NEAR(b.absorbed_back[band], 0.19982, 0.01);
    CHECK_NEAR(b.escaped[band], 1 - 0.19982, 0.01);
  }
  CHECK_NEAR(b.back_share, 0.19982, 0.01);
}

void sealed_emission_is_absorbed_in_the_contact() {
  // A shining floor, half of it under a black box.
  Scene scene;
  scene.bands = 1;
  const int32_t black = scene.add_material({"black", {0}, {0}});
  add_box(scene, {0, 0, 0}, {2, 1, 1}, true);
  add_box(scene, {0, 0, 0}, {1, 1, 0.5});
  for (int64_t p = 0; p < 12; ++p) {
    const Triangle t = scene.triangle(p);
    if (t.a.z == 0 && t.b.z == 0 && t.c.z == 0) scene.emission[p] = 3;
  }
  CHECK_EQUAL(black, 0);
  Workbench bench(std::move(scene));
  solve(bench);
  const PowerBalance b =
      measure_balance(bench.state, bench.radiosity_of_all(), bench.tools(settings())).value();
  CHECK_NEAR(b.emitted[0], 6, 1e-9);
  CHECK_NEAR(b.absorbed_back[0], 3, 0.4);
  CHECK_NEAR(b.absorbed[0] + b.absorbed_back[0], 6, 0.3);
  CHECK_NEAR(b.escaped[0], 0, 1e-9);
}

// The mean of so many samples.
int64_t mean_of(const RayGather& rays, Vec3 x, Vec3 n, uint64_t key, uint32_t samples, double* mean,
                int bands) {
  Element point;
  point.centroid = x;
  point.normal = n;
  RayGather::NearEmitters space;
  const hrad::Draw& emitters = rays.emitters_near(point, space);
  int64_t traced = 0;
  std::fill(mean, mean + bands, 0.0);
  for (uint32_t k = 0; k < samples; ++k) {
    double one[2];
    traced += rays.sample(x, n, key, k, RayGather::shadow_rays, emitters, one);
    for (int b = 0; b < bands; ++b) mean[b] += one[b] / samples;
  }
  return traced;
}

// Rays from a point of a furnace whose light is known everywhere find that light.
void gathering_by_rays_finds_the_light() {
  Workbench bench(lit_room(0));
  bench.prepare();
  State& state = bench.state;
  // Walls that shine evenly, B = 1.5 by reflection; the lamp's own light left out.
  std::fill(bench.scene.emission.begin(), bench.scene.emission.end(), 0.0);
  std::fill(state.radiosity.begin(), state.radiosity.end(), 1.5f);
  const LightOfAll radiosity = bench.radiosity_of_all();
  const RayGather rays(state, radiosity, *bench.engine);
  double mean[2];
  CHECK(mean_of(rays, {0.3, 0.3, 0.4}, normalized({1, 2, 3}), 5, 256, mean, 2) >= 4096);
  // Only the black back of the lamp takes something away.
  for (double m : mean) CHECK_NEAR(m, 1.5, 0.1);
}

// Between walls that reflect much a doubted solution is asked at every other bounce only: of what
// it is wrong by the walls keep their share.
void a_doubted_solution_shows_what_is_lost_over_many_bounces() {
  for (double reflectance : {0.75, 0.9}) {
    Scene scene;
    scene.bands = 1;
    scene.add_material({"wall", {reflectance}, {0}});
    add_box(scene, {0, 0, 0}, {1, 1, 1}, true);
    Workbench bench(std::move(scene));
    bench.prepare();
    // There is no lamp: all of this light is a mistake.
    std::fill(bench.state.radiosity.begin(), bench.state.radiosity.end(), 1.0f);
    double trusted, doubted;
    const LightOfAll radiosity = bench.radiosity_of_all();
    const RayGather trusting(bench.state, radiosity, *bench.engine);
    const RayGather doubting(bench.state, radiosity, *bench.engine, RayGather::Solution::doubted);
    mean_of(trusting, {0.3, 0.3, 0.4}, {0, 0, 1}, 5, 4096, &trusted, 1);
    mean_of(doubting, {0.3, 0.3, 0.4}, {0, 0, 1}, 5, 4096, &doubted, 1);
    CHECK_NEAR(trusted, 1, 1e-6);
    // X = 1/2 + 1/2 0.9 X; at 0.75 nothing is doubted.
    CHECK_NEAR(doubted, reflectance > 0.8 ? 0.5 / 0.55 : 1, reflectance > 0.8 ? 2e-3 : 1e-6);
  }
}

// A lamp alone: irradiance under its middle, by the closed form, whatever the number of rays.
void gathering_by_rays_finds_the_lamp() {
  Workbench bench(lit_room(0));
  bench.prepare();
  const LightOfAll radiosity = bench.radiosity_of_all();
  const RayGather rays(bench.state, radiosity, *bench.engine);
  const double x = 0.25 / 0.4, r = std::sqrt(1 + x * x);
  const double factor = 4 * (2 * x / r * std::atan(x / r)) / (2 * pi);
  double mean[2], dark[2];
  mean_of(rays, {1, 1, 0.5}, {0, 0, 1}, 6, 256, mean, 2);
  CHECK_NEAR(mean[0], 4 * factor, 0.02 * 4 * factor);
  CHECK_NEAR(mean[1], 8 * factor, 0.02 * 8 * factor);
  // Its back is turned to the ceiling.
  mean_of(rays, {1, 1, 1 - 1e-6}, {0, 0, -1}, 7, 256, dark, 2);
  CHECK_NEAR(dark[0], 0, 1e-9);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(a_good_solution_is_found_good),
      HRAD_TEST(a_wrong_level_is_measured),
      HRAD_TEST(a_wrong_level_weighs_more_between_bright_walls),
      HRAD_TEST(a_wrong_pattern_is_measured),
      HRAD_TEST(one_wrong_patch_is_measured),
      HRAD_TEST(measuring_depends_on_no_threads),
      HRAD_TEST(without_dark_patches_there_is_no_estimate),
      HRAD_TEST(power_adds_up_in_a_closed_room),
      HRAD_TEST(power_adds_up_between_plates),
      HRAD_TEST(backs_absorb),
      HRAD_TEST(sealed_emission_is_absorbed_in_the_contact),
      HRAD_TEST(gathering_by_rays_finds_the_light),
      HRAD_TEST(a_doubted_solution_shows_what_is_lost_over_many_bounces),
      HRAD_TEST(gathering_by_rays_finds_the_lamp),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
