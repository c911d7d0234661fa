// The Linking Stage: every pair of surfaces that face each other once, both directions, the same
// links on any number of threads.
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "stages/linking.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// Thresholds in the middle: some pairs are traced by packets, others by bundles.
OracleSettings settings() {
  OracleSettings s;
  s.mean_variance = 1e-3;
  s.point_variance = 1e-2;
  return s;
}

// Some of q lies before p's plane and some of p before q's.
bool face(const Workbench& bench, NodeId p, NodeId q) {
  const Forest& forest = bench.state.forest;
  const double margin = bench.engine->offset() / 2;
  const auto before = [&](NodeId plane, NodeId other) {
    const Triangle a = forest.root_triangle(plane), b = forest.root_triangle(other);
    for (const Vec3& corner : {b.a, b.b, b.c})
      if (dot(corner - a.centroid(), forest.surfaces[plane].normal) > margin) return true;
    return false;
  };
  return before(p, q) && before(q, p);
}

std::vector<Scene> scenes() {
  std::vector<Scene> result;
  result.push_back(builtin_scene("cornell"));
  result.push_back(builtin_scene("furnished-room"));
  result.push_back(random_soup(120, 0.5, 51));
  Scene two_sided = random_soup(60, 0.8, 52);
  for (size_t k = 0; k < two_sided.flags.size(); ++k)
    two_sided.flags[k] = k % 3 == 0 ? patch_two_sided : k % 7 == 0 ? patch_blocker : 0;
  for (double& e : two_sided.emission) e = 1;
  result.push_back(std::move(two_sided));
  return result;
}

void every_facing_pair_is_counted_once() {
  for (Scene& scene : scenes()) {
    Workbench bench(std::move(scene));
    bench.link(settings());
    int64_t wanted = 0;
    const NodeId count = static_cast<NodeId>(bench.state.forest.surface_count());
    for (NodeId p = 0; p < count; ++p)
      for (NodeId q = p + 1; q < count; ++q)
        wanted += bench.state.forest.nodes[p].exposed > 0 &&
                  bench.state.forest.nodes[q].exposed > 0 && face(bench, p, q);
    CHECK(wanted > 50);
    CHECK_EQUAL(bench.state.pairs, wanted);
  }
}

void links_go_both_ways_between_facing_pairs() {
  for (Scene& scene : scenes()) {
    Workbench bench(std::move(scene));
    bench.link(settings());
    const State& state = bench.state;
    std::map<std::pair<NodeId, NodeId>, float> weights;
    CHECK_EQUAL(state.links.size(), state.forest.nodes.size());
    for (size_t receiver = 0; receiver < state.links.size(); ++receiver) {
      NodeId last = -1;
      for (const Link& link : state.links[receiver].links()) {
        CHECK(link.source > last);  // in key order, no source twice
        last = link.source;
        CHECK(link.source != static_cast<NodeId>(receiver));
        CHECK(link.weight > 0 && link.weight <= 1);
        CHECK(face(bench, static_cast<NodeId>(receiver), link.source));
        weights[{static_cast<NodeId>(receiver), link.source}] = link.weight;
      }
    }
    CHECK(weights.size() > 100);
    // Light goes both ways over the exposed areas: A e F is the same. What is exposed of a partly
    // sealed surface is known from samples alone.
    double there = 0, back = 0;
    for (const auto& entry : weights) {
      const NodeId p = entry.first.first, q = entry.first.second;
      const auto other = weights.find({q, p});
      CHECK(other != weights.end());
      if (p > q || entry.second == 1 || other->second == 1) continue;  // cut to what is possible
      const Node &to = state.forest.nodes[p], &from = state.forest.nodes[q];
      const double forth = state.forest.area(to) * to.exposed * entry.second;
      const double reply = state.forest.area(from) * from.exposed * other->second;
      if (to.exposed == 1 && from.exposed == 1) CHECK_NEAR(forth / reply, 1, 1e-5);
      there += forth;
      back += reply;
    }
    CHECK_NEAR(there / back, 1, 0.05);
  }
}

bool same_links(const State& a, const State& b) {
  if (a.links.size() != b.links.size() || a.rays != b.rays || a.pairs != b.pairs) return false;
  for (size_t k = 0; k < a.links.size(); ++k) {
    const Span<const Link> x = a.links[k].links(), y = b.links[k].links();
    if (x.size() != y.size()) return false;
    for (size_t m = 0; m < x.size(); ++m)
      if (x[m].source != y[m].source || x[m].weight != y[m].weight) return false;
  }
  return true;
}

void threads_give_the_same_links() {
  for (const char* name : {"furnished-room", "cornell"}) {
    Workbench first(builtin_scene(name), 1);
    first.link(settings());
    CHECK(first.state.rays > 0);
    for (int threads : {2, 3, 6}) {
      Workbench other(builtin_scene(name), threads);
      other.link(settings());
      CHECK(same_links(first.state, other.state));
    }
  }
}

void seeds_give_other_links() {
  OracleSettings other = settings();
  other.seed = 2;
  Workbench a(builtin_scene("cornell")), b(builtin_scene("cornell"));
  a.link(settings());
  b.link(other);
  CHECK(!same_links(a.state, b.state));
}

// In a closed room what arrives comes from somewhere: rows add up to about one, on average closely.
void rows_of_a_closed_room_add_up_to_one() {
  Workbench bench(room_with_boxes(4, 53));
  OracleSettings s = settings();
  s.mean_variance = 0;  // every pair by whole packets
  bench.link(s);
  const State& state = bench.state;
  double area = 0, sum = 0;
  for (NodeId root = 0; root < 12; ++root) {
    double row = 0;
    for (const Link& link : state.links[root].links()) row += link.weight;
    CHECK_NEAR(row, 1, 0.25);
    area += state.forest.area(state.forest.nodes[root]);
    sum += state.forest.area(state.forest.nodes[root]) * row;
  }
  CHECK_NEAR(sum / area, 1, 0.05);
}

void what_is_hidden_is_not_linked() {
  Scene scene;
  add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add_quad(scene, {0, 0, 1}, {0, 1, 0}, {1, 0, 0});
  add_quad(scene, {-9, -9, 0.5}, {18, 0, 0}, {0, 18, 0});
  scene.emission[0] = 1;
  Workbench bench(std::move(scene));
  bench.link(settings());
  CHECK(bench.state.pairs > 4);
  for (NodeId low : {0, 1})
    for (const Link& link : bench.state.links[low].links()) CHECK(link.source >= 4);
  CHECK(bench.state.links[2].count() == 2 && bench.state.links[3].count() == 2);
}

void a_stop_leaves_the_state_as_it_was() {
  Workbench bench(builtin_scene("furnished-room"));
  bench.prepare();
  StageTools tools = bench.tools(settings());
  tools.progress = [](double) { return false; };
  CHECK(!link_pairs(bench.state, tools, expected_brightness(bench.state)));
  CHECK_EQUAL(bench.state.links.link_count(), int64_t{0});
  // And the stage can be done afterwards.
  double last = 0;
  tools.progress = [&](double fraction) {
    CHECK(fraction >= last && fraction <= 1);
    last = fraction;
    return true;
  };
  CHECK(link_pairs(bench.state, tools, expected_brightness(bench.state)));
  CHECK(bench.state.links[0].count() > 0);
  CHECK(last > 0);
}

void a_lone_surface_has_no_links() {
  Scene scene;
  add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Workbench bench(std::move(scene));
  bench.link(settings());
  CHECK_EQUAL(bench.state.pairs, int64_t{0});
  CHECK_EQUAL(bench.state.links[0].count(), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(every_facing_pair_is_counted_once),
      HRAD_TEST(links_go_both_ways_between_facing_pairs),
      HRAD_TEST(threads_give_the_same_links),
      HRAD_TEST(seeds_give_other_links),
      HRAD_TEST(rows_of_a_closed_room_add_up_to_one),
      HRAD_TEST(what_is_hidden_is_not_linked),
      HRAD_TEST(a_stop_leaves_the_state_as_it_was),
      HRAD_TEST(a_lone_surface_has_no_links),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
