// Gathering and push-pull on trees split by hand: the identities that hold between a node, its
// children and its ancestors.
#include <algorithm>
#include <cmath>
#include <vector>

#include "stages/gather.h"
#include "stages/sweep.h"
#include "stages/sweep_kernels.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// Four triangles of unequal size, two bands unless told, of different reflectance and emission.
Scene some_triangles(int bands = 2) {
  Scene scene;
  scene.bands = bands;
  Random random(41);
  for (int k = 0; k < 4; ++k) {
    Material m;
    for (int b = 0; b < bands; ++b) {
      m.reflectance.push_back(0.9 * random.unit());
      m.emission.push_back(k == 1 ? 3 * random.unit() + 1 : 0);
    }
    scene.add_material(m);
    const int32_t first = scene.add_vertex(random.in_cube(2));
    scene.add_vertex(random.in_cube(2));
    scene.add_vertex(random.in_cube(2));
    scene.add_patch(first, first + 1, first + 2, k);
  }
  return scene;
}

// A forest of uneven depth whose leaves are sealed in part, with random gathered irradiance.
struct Tree : Workbench {
  explicit Tree(int bands = 2, bool sealed = true) : Workbench(some_triangles(bands), 3) {
    Forest& forest = state.forest;
    split_where(forest, 5, [&](const Node& node) {
      return node.level < 1 || mix(key_of(forest, node)) % 2 == 0;
    });
    for (size_t k = forest.nodes.size(); k-- > 0;) {
      const NodeId first = forest.nodes.first_child(k);
      float exposed = 0;
      if (first < 0)
        exposed = sealed ? static_cast<float>(mix(k) % 17) / 16 : 1;
      else
        for (int c = 0; c < 4; ++c) exposed += forest.nodes.exposed(first + c) / 4;
      forest.nodes.set_exposed(k, exposed);
    }
    prepare();
    for (size_t k = 0; k < state.irradiance.size(); ++k)
      state.irradiance[k] = static_cast<float>(unit_interval(mix(k, 7)));
  }

  const float* value(const GrowingArray<float>& of, NodeId id) const {
    return &of[static_cast<size_t>(id) * state.bands];
  }
  double emission(const Node& node, int b) const {
    return scene.emission[state.forest.surfaces[node.surface].patch * state.bands + b];
  }
  double reflectance(const Node& node, int b) const {
    return scene.reflectance[state.forest.surfaces[node.surface].patch * state.bands + b];
  }
};

void leaves_have_what_all_above_them_gathered() {
  for (int bands : {1, 2, 3, 5}) {
    Tree tree(bands);
    const Forest& forest = tree.state.forest;
    const GrowingArray<float> gathered = tree.state.irradiance;
    push_pull(tree.state, tree.team, tree.exchange);
    int lit = 0, sealed = 0;
    for (NodeId leaf : forest.leaves()) {
      const Node& node = forest.nodes[leaf];
      for (int b = 0; b < bands; ++b) {
        double irradiance = 0;
        for (NodeId id = leaf; id >= 0; id = forest.nodes[id].parent)
          irradiance += tree.value(gathered, id)[b];
        if (node.exposed <= 0) irradiance = 0;
        CHECK_NEAR(tree.value(tree.state.irradiance, leaf)[b], irradiance, 1e-6 * irradiance);
        const double radiosity = tree.emission(node, b) + tree.reflectance(node, b) * irradiance;
        CHECK_NEAR(tree.value(tree.state.radiosity, leaf)[b], radiosity, 1e-6 * radiosity);
      }
      (node.exposed > 0 ? lit : sealed)++;
    }
    CHECK(lit > 20 && sealed > 0);
  }
}

void parents_have_the_means_of_their_children() {
  Tree tree;
  const Forest& forest = tree.state.forest;
  push_pull(tree.state, tree.team, tree.exchange);
  for (size_t k = 0; k < forest.nodes.size(); ++k) {
    const Node& node = forest.nodes[k];
    if (node.first_child < 0) continue;
    for (int b = 0; b < 2; ++b) {
      double irradiance = 0, radiosity = 0, weight = 0;
      for (NodeId c = node.first_child; c < node.first_child + 4; ++c) {
        const double exposed = forest.nodes[c].exposed;
        weight += exposed;
        irradiance += exposed * tree.value(tree.state.irradiance, c)[b];
        radiosity += exposed * tree.value(tree.state.radiosity, c)[b];
      }
      const auto id = static_cast<NodeId>(k);
      const double h = weight > 0 ? irradiance / weight : 0;
      const double e = weight > 0 ? radiosity / weight : tree.emission(node, b);
      CHECK_NEAR(tree.value(tree.state.irradiance, id)[b], h, 1e-6 * h);
      CHECK_NEAR(tree.value(tree.state.radiosity, id)[b], e, 1e-6 * e);
      // Means keep B = E + rho H.
      const double leaving = tree.emission(node, b) + tree.reflectance(node, b) * h;
      CHECK_NEAR(tree.value(tree.state.radiosity, id)[b], leaving, 2e-6 * leaving);
    }
  }
}

void sealed_surfaces_only_emit() {
  Tree tree;
  NodeArray& nodes = tree.state.forest.nodes;
  for (size_t k = 0; k < nodes.size(); ++k) nodes.set_exposed(k, 0);
  push_pull(tree.state, tree.team, tree.exchange);
  for (size_t k = 0; k < tree.state.forest.nodes.size(); ++k)
    for (int b = 0; b < 2; ++b) {
      CHECK_EQUAL(tree.state.irradiance[2 * k + b], 0.0f);
      CHECK_NEAR(tree.state.radiosity[2 * k + b], tree.emission(tree.state.forest.nodes[k], b),
                 1e-6);
    }
}

void reset_leaves_emission_alone() {
  Tree tree;
  push_pull(tree.state, tree.team, tree.exchange);
  reset_to_emission(tree.state, tree.team, tree.exchange);
  const size_t count = tree.state.forest.nodes.size() * 2;
  CHECK_EQUAL(tree.state.radiosity.size(), count + State::floats_beyond);
  CHECK_EQUAL(tree.state.irradiance.size(), count);
  for (size_t k = 0; k < count; ++k) {
    CHECK_EQUAL(tree.state.irradiance[k], 0.0f);
    const auto emitted =
        static_cast<float>(tree.emission(tree.state.forest.nodes[k / 2], static_cast<int>(k % 2)));
    CHECK_EQUAL(tree.state.radiosity[k], emitted);
  }
}

// The totals are the leaves' irradiance times exposed area: whatever a parent gathers on its own
// arrives below.
void transported_light_is_that_of_the_leaves() {
  Tree tree;
  const Forest& forest = tree.state.forest;
  const std::vector<double> total = push_pull(tree.state, tree.team, tree.exchange);
  CHECK_EQUAL(total.size(), size_t{2});
  for (int b = 0; b < 2; ++b) {
    double wanted = 0;
    for (NodeId leaf : forest.leaves()) {
      const Node& node = forest.nodes[leaf];
      wanted += forest.area(node) * node.exposed * tree.value(tree.state.irradiance, leaf)[b];
    }
    CHECK_NEAR(total[b], wanted, 1e-12 * wanted);
    double of_roots = 0;
    for (NodeId root = 0; root < forest.surface_count(); ++root)
      of_roots += forest.area(forest.nodes[root]) * forest.nodes[root].exposed *
                  tree.value(tree.state.irradiance, root)[b];
    CHECK_NEAR(total[b], of_roots, 1e-5 * wanted);
  }
}

void gathering_is_the_product_of_links_and_radiosity() {
  for (int bands : {1, 2, 3, 4, 7}) {
    Tree tree(bands, false);
    State& state = tree.state;
    const size_t count = state.forest.nodes.size();
    for (size_t k = 0; k < state.irradiance.size(); ++k)
      state.radiosity[k] = static_cast<float>(unit_interval(mix(k, 8)));
    std::vector<double> wanted(count * bands, 0.0);
    for (size_t k = 0; k < count; ++k) {
      std::vector<Link> links;
      for (uint64_t m = 0; m < mix(k, 9) % 6; ++m)
        links.push_back({static_cast<NodeId>(mix(k, m, 3) % count),
                         static_cast<float>(unit_interval(mix(k, m, 4)))});
      state.links.replace({{static_cast<NodeId>(k), links}});
      for (const Link& link : links)
        for (int b = 0; b < bands; ++b)
          wanted[k * bands + b] +=
              static_cast<double>(link.weight) * tree.value(state.radiosity, link.source)[b];
    }
    gather(state, tree.team);
    for (size_t k = 0; k < wanted.size(); ++k)
      CHECK_EQUAL(state.irradiance[k], static_cast<float>(wanted[k]));
  }
}

// Runs around the length that the kernels look ahead, in every instruction set; some receivers have
// none.
void kernels_agree_to_the_bit() {
  constexpr size_t nodes = 500, receivers = 200;
  std::vector<Link> links;
  std::vector<GatherRun> runs;
  for (uint64_t k = 0; k < receivers; ++k) {
    if (k % 5 == 0) continue;
    const uint32_t first = static_cast<uint32_t>(links.size());
    for (uint64_t m = 0; m < 1 + mix(k, 1) % 70; ++m)
      links.push_back({static_cast<NodeId>(mix(k, m, 2) % nodes),
                       static_cast<float>(unit_interval(mix(k, m, 3)))});
    runs.push_back({first, static_cast<uint32_t>(links.size()), static_cast<uint32_t>(k)});
  }
  links.back() = {nodes - 1, 0.5f};
  for (int bands = 2; bands <= most_lanes; ++bands) {
    std::vector<float> sources, narrow(receivers * bands, 1.0f);
    for (uint64_t k = 0; k < nodes * bands; ++k)
      sources.push_back(static_cast<float>(unit_interval(mix(k, 4))));
    sources.resize(sources.size() + most_lanes);
    sweep_kernels_sse2.gather({links, runs}, sources.data(), bands, narrow.data());
    for (size_t k = 0; k < receivers; ++k)
      for (int b = 0; b < bands; ++b) CHECK((narrow[k * bands + b] > 1) == (k % 5 != 0));
    for (const SweepKernels* kernels : sweep_kernels()) {
      std::vector<float> other(narrow.size(), 1.0f);
      kernels->gather({links, runs}, sources.data(), bands, other.data());
      CHECK(other == narrow);
    }
  }
}

// Two plates that see each other, F = 1/2 both ways: B = E + rho F B' has a solution by hand.
void sweeps_reach_the_solution() {
  Scene scene;
  scene.bands = 1;
  scene.add_material({"lamp", {0.4}, {2}});
  scene.add_material({"wall", {0.8}, {0}});
  for (const Vec3& p : {Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}})
    scene.add_vertex(p);
  scene.add_patch(0, 1, 2, 0);
  scene.add_patch(3, 4, 5, 1);
  Workbench bench(std::move(scene), 2);
  bench.prepare();
  const Link to_lamp{0, 0.5f}, to_wall{1, 0.5f};
  bench.state.links.replace({{0, {&to_wall, 1}}, {1, {&to_lamp, 1}}});
  bench.sweep(59);
  gather(bench.state, bench.team);
  const std::vector<double> total = push_pull(bench.state, bench.team, bench.exchange);
  const double lamp = 2 / (1 - 0.4 * 0.5 * 0.8 * 0.5), wall = 0.8 * 0.5 * lamp;
  CHECK_NEAR(bench.state.radiosity[0], lamp, 1e-6);
  CHECK_NEAR(bench.state.radiosity[1], wall, 1e-6);
  CHECK_NEAR(bench.state.irradiance[0], 0.5 * wall, 1e-6);
  CHECK_NEAR(total[0], 0.5 * (0.5 * wall + 0.5 * lamp), 1e-6);
}

void threads_change_no_bit() {
  GrowingArray<float> radiosity;
  std::vector<double> total;
  for (int threads : {1, 2, 5}) {
    Workbench bench(builtin_scene("classroom"), threads);
    bench.prepare();
    for (size_t k = 0; k < bench.state.irradiance.size(); ++k)
      bench.state.irradiance[k] = static_cast<float>(unit_interval(mix(k, 7)));
    const std::vector<double> sum = push_pull(bench.state, bench.team, bench.exchange);
    if (threads == 1) {
      radiosity = bench.state.radiosity;
      total = sum;
    }
    CHECK(bench.state.radiosity == radiosity);
    CHECK(sum == total);
  }
}

void brightness_is_in_units_of_the_irradiance() {
  Tree tree;
  const Forest& forest = tree.state.forest;
  push_pull(tree.state, tree.team, tree.exchange);
  const Brightness brightness = tree.brightness();
  CHECK_EQUAL(brightness.unit.size(), size_t{2});
  CHECK_EQUAL(brightness.of_node.size(), forest.nodes.size());
  double area = 0;
  for (const Surface& surface : forest.surfaces) area += surface.area;
  for (int b = 0; b < 2; ++b) {
    double square = 0;
    for (NodeId leaf : forest.leaves()) {
      const Node& node = forest.nodes[leaf];
      const double h = tree.value(tree.state.irradiance, leaf)[b];
      square += forest.area(node) * node.exposed * h * h;
    }
    CHECK_NEAR(brightness.unit[b] * std::sqrt(square / area), 1, 1e-6);
  }
  for (size_t k = 0; k < forest.nodes.size(); ++k) {
    double largest = 0;
    for (int b = 0; b < 2; ++b)
      largest = std::max(largest, tree.state.radiosity[2 * k + b] * brightness.unit[b]);
    CHECK_NEAR(brightness.of_node[k], largest, 1e-6 * largest);
  }
}

// spread bounds how far any leaf below lies from the node's mean; leaves have none.
void spread_bounds_the_deviation_of_the_leaves() {
  Tree tree;
  Forest& forest = tree.state.forest;
  push_pull(tree.state, tree.team, tree.exchange);
  const Brightness brightness = tree.brightness();
  int uneven = 0;
  for (NodeId leaf : forest.leaves()) {
    CHECK_EQUAL(brightness.spread[leaf], 0.0f);
    for (NodeId id = forest.nodes[leaf].parent; id >= 0; id = forest.nodes[id].parent)
      for (int b = 0; b < 2; ++b) {
        const double deviation = std::fabs(tree.value(tree.state.radiosity, leaf)[b] -
                                           tree.value(tree.state.radiosity, id)[b]);
        CHECK(deviation * brightness.unit[b] <= brightness.spread[id] * (1 + 1e-5) + 1e-6);
        uneven += deviation > 0;
      }
  }
  CHECK(uneven > 100);
  // Even light has none.
  std::fill(tree.state.radiosity.begin(), tree.state.radiosity.end(), 0.5f);
  for (float spread : tree.brightness().spread) CHECK_EQUAL(spread, 0.0f);
}

void a_dark_band_has_no_unit() {
  Tree tree;
  for (size_t k = 0; k < tree.state.irradiance.size(); k += 2) tree.state.irradiance[k] = 0;
  push_pull(tree.state, tree.team, tree.exchange);
  const Brightness brightness = tree.brightness();
  CHECK_EQUAL(brightness.unit[0], 0.0);
  CHECK(brightness.unit[1] > 0);
}

// Before the first sweep: emitters stand out as they will, the rest by its reflectance.
void expected_brightness_foresees_the_measured_one() {
  Scene scene = builtin_scene("furnace");
  Workbench bench(std::move(scene), 1);
  bench.prepare();
  // E = 1, rho = 1/2: H = 2 and B = 2 everywhere.
  const Brightness expected = expected_brightness(bench.state);
  for (double unit : expected.unit) CHECK_NEAR(unit, 0.5, 1e-9);
  for (float value : expected.of_node) CHECK_NEAR(value, 1, 1e-6);
  std::fill(bench.state.irradiance.begin(), bench.state.irradiance.end(), 2.0f);
  push_pull(bench.state, bench.team, bench.exchange);
  const Brightness measured = bench.brightness();
  for (size_t b = 0; b < measured.unit.size(); ++b)
    CHECK_NEAR(measured.unit[b], expected.unit[b], 1e-6);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(leaves_have_what_all_above_them_gathered),
      HRAD_TEST(parents_have_the_means_of_their_children),
      HRAD_TEST(sealed_surfaces_only_emit),
      HRAD_TEST(reset_leaves_emission_alone),
      HRAD_TEST(transported_light_is_that_of_the_leaves),
      HRAD_TEST(gathering_is_the_product_of_links_and_radiosity),
      HRAD_TEST(kernels_agree_to_the_bit),
      HRAD_TEST(sweeps_reach_the_solution),
      HRAD_TEST(threads_change_no_bit),
      HRAD_TEST(brightness_is_in_units_of_the_irradiance),
      HRAD_TEST(spread_bounds_the_deviation_of_the_leaves),
      HRAD_TEST(a_dark_band_has_no_unit),
      HRAD_TEST(expected_brightness_foresees_the_measured_one),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
