// Linking by clusters: rows that sum to one, no light lost or made between clusters and elements,
// the same links for any number of threads, and the light that pairs bring.
#include <cmath>
#include <vector>

#include "stages/cluster_sweep.h"
#include "stages/refine.h"
#include "support/thorough.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

OracleSettings settings(double scale = 1, OracleKind kind = OracleKind::error) {
  OracleSettings s;
  s.kind = kind;
  s.power = 0.03 * scale;
  s.mean_variance = s.last_mean_variance = 2e-3 * scale;
  s.point_variance = s.last_point_variance = 2e-2 * scale;
  return s;
}

// Elements no smaller than the scene asks for.
OracleSettings fitted(OracleSettings s, const State& state) {
  const double area = state.forest.total_area();
  s.point_area = area / 2000;
  s.min_area = s.point_min_area = area / 20000;
  return s;
}

struct Clustered : Workbench {
  Clustered(Scene s, int rounds, int threads = 2, OracleSettings oracle = settings())
      : Workbench(std::move(s), threads) {
    oracle = fitted(oracle, state);
    link_by_clusters(oracle);
    sweep(8);
    for (int k = 0; k < rounds; ++k) {
      refine(oracle);
      sweep(8);
    }
  }

  // Links of a node and of all above it.
  double row_of(NodeId leaf) const {
    double row = 0;
    for (NodeId id = leaf; id >= 0; id = state.forest.nodes[id].parent)
      for (const Link& link : state.links[id].links()) row += link.weight;
    return row;
  }

  // Mean over the exposed area.
  double mean_row() const {
    double sum = 0, area = 0;
    for (NodeId leaf : state.forest.leaves()) {
      const Node& node = state.forest.nodes[leaf];
      const double exposed = state.forest.area(node) * node.exposed;
      if (!(exposed > 0)) continue;
      sum += exposed * row_of(leaf);
      area += exposed;
    }
    return sum / area;
  }
};

// Links by what they join: from and to clusters, patches, elements.
struct Kinds {
  int64_t from_clusters = 0, to_clusters = 0, between_clusters = 0, others = 0;
};
Kinds kinds_of(const State& state) {
  Kinds kinds;
  for (size_t k = 0; k < state.links.size(); ++k)
    for (const Link& link : state.links[k].links()) {
      const bool from = Forest::is_cluster(state.forest.nodes[link.source]);
      const bool to = Forest::is_cluster(state.forest.nodes[k]);
      kinds.from_clusters += from;
      kinds.to_clusters += to;
      kinds.between_clusters += from && to;
      kinds.others += !from && !to;
    }
  return kinds;
}

void rows_of_closed_scenes_sum_to_one() {
  for (const char* name : {"furnace", "furnace-sphere", "furnace-boxes"})
    for (int rounds : {1, 3}) {
      const Clustered bench(builtin_scene(name), rounds);
      std::printf("%s, %d rounds: mean row %.5f\n", name, rounds, bench.mean_row());
      CHECK_NEAR(bench.mean_row(), 1, 0.005);
    }
}

void weights_are_shares_of_the_view() {
  const Clustered bench(builtin_scene("furnished-room"), 2);
  const State& state = bench.state;
  for (size_t k = 0; k < state.links.size(); ++k)
    for (const Link& link : state.links[k].links()) {
      CHECK(link.weight > 0 && link.weight <= 1);
      CHECK(link.source >= 0 && link.source < static_cast<NodeId>(state.forest.nodes.size()));
    }
  const Kinds kinds = kinds_of(state);
  CHECK(kinds.from_clusters > 100 && kinds.to_clusters > 100 && kinds.between_clusters > 50);
  CHECK(kinds.others > 100);
}

// What is linked with a cluster is no part of it.
void no_cluster_lights_itself() {
  const Clustered bench(builtin_scene("furnished-room"), 1);
  const Forest& forest = bench.state.forest;
  const auto range_of = [&](NodeId id) {
    const Node& node = forest.nodes[id];
    if (!Forest::is_cluster(node)) return std::vector<int32_t>{node.surface};
    const Cluster& c = forest.cluster(node);
    const auto first = forest.clusters.order.begin() + c.first;
    return std::vector<int32_t>(first, first + c.count);
  };
  for (size_t k = 0; k < bench.state.links.size(); ++k)
    for (const Link& link : bench.state.links[k].links())
      for (int32_t from : range_of(link.source))
        for (int32_t to : range_of(static_cast<NodeId>(k))) CHECK(from != to);
}

// The power that leaves clusters and elements arrives, in a furnace all of it.
void a_furnace_has_two_everywhere() {
  for (const char* name : {"furnace-sphere", "furnace-boxes"}) {
    Scene scene = builtin_scene(name);
    for (double& e : scene.emission) e = 1;
    for (double& r : scene.reflectance) r = 0.5;
    Clustered bench(scene, 3);
    bench.sweep(20);
    const State& state = bench.state;
    double sum = 0, squares = 0, area = 0;
    for (NodeId root = 0; root < state.forest.surface_count(); ++root) {
      const Node& node = state.forest.nodes[root];
      const double exposed = state.forest.area(node) * node.exposed;
      if (!(exposed > 0)) continue;
      const double b = state.radiosity[static_cast<size_t>(root) * state.bands];
      sum += exposed * b;
      squares += exposed * (b - 2) * (b - 2);
      area += exposed;
    }
    std::printf("%s: mean %.5f, rms %.5f\n", name, sum / area, std::sqrt(squares / area));
    CHECK_NEAR(sum / area, 2, 0.01);
    CHECK(std::sqrt(squares / area) < 0.05);
    const size_t top = static_cast<size_t>(state.forest.top());
    CHECK_NEAR(state.radiosity[top * state.bands], sum / area, 1e-4);
  }
}

// Down: what arrives on a cluster arrives on all below it. Up: means by exposed area.
void light_is_pushed_and_pulled() {
  Workbench bench(builtin_scene("cornell"));
  State& state = bench.state;
  add_clusters(state.forest);
  bench.prepare();
  const size_t bands = static_cast<size_t>(state.bands), count = state.forest.nodes.size();
  for (size_t k = 0; k < count * bands; ++k)
    state.irradiance[k] = static_cast<float>(unit_interval(mix(k)));
  const GrowingArray<float> own = state.irradiance;
  for (NodeId root = 0; root < state.forest.surface_count(); ++root)
    state.forest.nodes.set_exposed(root, root % 4 == 1 ? 0.25f : 1.0f);
  measure_clusters(state.forest);
  push_pull(state, bench.team, bench.exchange);
  const Scene& scene = bench.scene;
  for (NodeId root = 0; root < state.forest.surface_count(); ++root)
    for (size_t b = 0; b < bands; ++b) {
      double wanted = 0;
      for (NodeId id = root; id >= 0; id = state.forest.nodes[id].parent)
        wanted += own[static_cast<size_t>(id) * bands + b];
      const size_t at = static_cast<size_t>(root) * bands + b;
      CHECK_NEAR(state.irradiance[at], wanted, 1e-5 * wanted);
      const size_t patch = static_cast<size_t>(state.forest.surfaces[root].patch) * bands + b;
      CHECK_NEAR(state.radiosity[at], scene.emission[patch] + scene.reflectance[patch] * wanted,
                 1e-5 * (1 + wanted));
    }
  for (const Cluster& cluster : state.forest.clusters.clusters) {
    const size_t id = static_cast<size_t>(&cluster - state.forest.clusters.clusters.data()) +
                      static_cast<size_t>(state.forest.surface_count());
    double sum = 0, area = 0;
    for (int32_t k = cluster.first; k < cluster.first + cluster.count; ++k) {
      const int32_t root = state.forest.clusters.order[k];
      const double a = state.forest.surfaces[root].area * state.forest.nodes[root].exposed;
      sum += a * state.radiosity[static_cast<size_t>(root) * bands];
      area += a;
    }
    CHECK_NEAR(state.radiosity[id * bands], sum / area, 1e-5 * sum / area);
  }
}

bool same(const State& a, const State& b) {
  if (a.forest.nodes.size() != b.forest.nodes.size() || a.rays != b.rays ||
      a.links.size() != b.links.size())
    return false;
  for (size_t k = 0; k < a.links.size(); ++k) {
    const Span<const Link> one = a.links[k].links(), other = b.links[k].links();
    if (one.size() != other.size() ||
        a.forest.nodes[k].first_child != b.forest.nodes[k].first_child ||
        a.forest.nodes[k].exposed != b.forest.nodes[k].exposed)
      return false;
    for (size_t l = 0; l < one.size(); ++l)
      if (one[l].source != other[l].source || one[l].weight != other[l].weight) return false;
  }
  return a.radiosity == b.radiosity && a.irradiance == b.irradiance;
}

void threads_change_no_bit() {
  for (OracleKind kind : {OracleKind::error, OracleKind::energy}) {
    const OracleSettings oracle = settings(3, kind);
    const Clustered first(builtin_scene("furnished-room"), 2, 1, oracle);
    CHECK(first.state.rays > 0);
    for (int threads = 2; threads <= 7; threads += static_cast<int>(every(5)))
      CHECK(
          same(first.state, Clustered(builtin_scene("furnished-room"), 2, threads, oracle).state));
  }
}

void a_stop_leaves_the_state_as_it_was() {
  Clustered bench(builtin_scene("furnished-room"), 1),
      untouched(builtin_scene("furnished-room"), 1);
  const Brightness brightness = bench.brightness();
  // After each number of calls in turn: among the clusters, and among the elements.
  for (int calls : {0, 3, 30}) {
    StageTools tools = bench.tools(fitted(settings(0.3), bench.state));
    int left = calls;
    tools.progress = [&](double) { return left-- > 0; };
    CHECK(!refine_links(bench.state, tools, brightness, bench.radiosity_of_all()));
    CHECK(same(bench.state, untouched.state));
  }
  bench.refine(fitted(settings(0.3), bench.state));
  untouched.refine(fitted(settings(0.3), bench.state));
  CHECK(same(bench.state, untouched.state));
}

// As a file may tell of: the top linked with itself, of any weight. It is as if there were no link
// yet.
void a_link_of_the_top_with_itself_is_met_anew() {
  for (OracleKind kind : {OracleKind::error, OracleKind::energy}) {
    const Clustered wanted(builtin_scene("furnished-room"), 0, 2, settings(1, kind));
    Workbench told(builtin_scene("furnished-room"));
    const OracleSettings oracle = fitted(settings(1, kind), told.state);
    told.prepare_clusters(oracle);
    const NodeId top = told.state.forest.top();
    const Link link{top, 0.7f};
    told.state.links.replace({{top, {&link, 1}}});
    CHECK(refine_links(told.state, told.tools(oracle), expected_brightness(told.state),
                       told.radiosity_of_all()));
    told.sweep(8);
    CHECK(same(told.state, wanted.state));
  }
}

// By pairs and by clusters, to the same settings: patch by patch the same light within what these
// allow, from fewer links.
void clusters_bring_the_light_of_pairs() {
  const OracleSettings oracle = settings(0.5);
  Clustered clusters(builtin_scene("furnished-room"), 0, 2, oracle);
  Workbench pairs(builtin_scene("furnished-room"));
  pairs.link(fitted(oracle, pairs.state));
  const Clustered coarse(builtin_scene("furnished-room"), 0, 2, settings(500));
  CHECK(2 * coarse.state.links.link_count() < pairs.state.links.link_count());
  for (Workbench* bench : {static_cast<Workbench*>(&clusters), &pairs}) {
    bench->sweep(8);
    for (int k = 0; k < 2; ++k) {
      bench->refine(fitted(oracle, bench->state));
      bench->sweep(8);
    }
  }
  double squares = 0, energy = 0, sum = 0, wanted = 0;
  const Forest& forest = clusters.state.forest;
  for (NodeId root = 0; root < forest.surface_count(); ++root) {
    const double area = forest.surfaces[root].area * forest.nodes[root].exposed;
    const size_t at = static_cast<size_t>(root) * 3;
    const double one = clusters.state.irradiance[at], other = pairs.state.irradiance[at];
    squares += area * (one - other) * (one - other);
    energy += area * other * other;
    sum += area * one;
    wanted += area * other;
  }
  std::printf("clusters against pairs: rms %.4f, sum %.4f\n", std::sqrt(squares / energy),
              sum / wanted);
  CHECK(std::sqrt(squares / energy) < 0.03);
  CHECK_NEAR(sum / wanted, 1, 0.01);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(rows_of_closed_scenes_sum_to_one),
      HRAD_TEST(weights_are_shares_of_the_view),
      HRAD_TEST(no_cluster_lights_itself),
      HRAD_TEST(a_furnace_has_two_everywhere),
      HRAD_TEST(light_is_pushed_and_pulled),
      HRAD_TEST(threads_change_no_bit),
      HRAD_TEST(a_stop_leaves_the_state_as_it_was),
      HRAD_TEST(a_link_of_the_top_with_itself_is_met_anew),
      HRAD_TEST(clusters_bring_the_light_of_pairs),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
