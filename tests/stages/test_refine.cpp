// Refinement: what a round leaves behind is a proper forest with proper links, whatever the number
// of threads and however the work was cut.
#include <cmath>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "stages/refine.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

OracleSettings settings(OracleKind kind, double scale = 1) {
  OracleSettings s;
  s.kind = kind;
  s.power = 2e-3 * scale;
  s.mean_variance = 1e-4 * scale;
  s.point_variance = 1e-2 * scale;
  s.point_area = 1e-3;
  s.min_area = 1e-3;
  return s;
}

// A closed room of 2 x 2 x 1 whose ceiling shines on grey walls; a lamp over one corner of the
// floor.
Scene small_room() {
  Scene scene;
  scene.add_material({"grey", {0.5, 0.4, 0.3}, {0, 0, 0}});
  add_box(scene, {0, 0, 0}, {2, 2, 1}, true);
  scene.add_material({"lamp", {0, 0, 0}, {20, 20, 20}});
  const int32_t first = scene.add_vertex({0.4, 0.4, 0.5});
  scene.add_vertex({0.4, 0.5, 0.5});
  scene.add_vertex({0.5, 0.4, 0.5});
  scene.add_patch(first, first + 1, first + 2, 1);
  return scene;
}

// Linked, swept, and refined by some rounds.
struct Refined : Workbench {
  Refined(Scene s, OracleKind kind, int rounds, int threads = 2, double scale = 1)
      : Workbench(std::move(s), threads) {
    link(settings(kind, scale));
    sweep(8);
    for (int k = 0; k < rounds; ++k) {
      refine(settings(kind, scale));
      sweep(8);
    }
  }
};

constexpr OracleKind kinds[] = {OracleKind::error, OracleKind::energy};

bool same(const Node& a, const Node& b) {
  return a.parent == b.parent && a.first_child == b.first_child && a.surface == b.surface &&
         a.i == b.i && a.j == b.j && a.level == b.level && a.inverted == b.inverted &&
         a.exposed == b.exposed;
}

bool same(Span<const Link> a, Span<const Link> b) {
  if (a.size() != b.size()) return false;
  for (size_t k = 0; k < a.size(); ++k)
    if (a[k].source != b[k].source || a[k].weight != b[k].weight) return false;
  return true;
}

bool same(const State& a, const State& b) {
  const size_t count = a.forest.nodes.size();
  if (b.forest.nodes.size() != count || a.links.size() != b.links.size() || a.rays != b.rays)
    return false;
  for (size_t k = 0; k < count; ++k)
    if (!same(a.forest.nodes[k], b.forest.nodes[k]) ||
        !same(a.links[k].links(), b.links[k].links()))
      return false;
  return a.radiosity == b.radiosity && a.irradiance == b.irradiance;
}

void forests_are_well_formed() {
  for (OracleKind kind : kinds) {
    Refined bench(builtin_scene("cornell"), kind, 3);
    const Forest& forest = bench.state.forest;
    const NodeId count = static_cast<NodeId>(forest.nodes.size());
    CHECK(count > 4 * forest.surface_count());
    CHECK_EQUAL(bench.state.links.size(), forest.nodes.size());
    CHECK_EQUAL(bench.state.radiosity.size(), forest.nodes.size() * 3 + State::floats_beyond);
    CHECK_EQUAL(bench.state.irradiance.size(), forest.nodes.size() * 3);
    for (NodeId id = 0; id < count; ++id) {
      const Node& node = forest.nodes[id];
      CHECK((node.parent < 0) == (id < forest.surface_count()));
      CHECK(node.parent < id);
      if (node.first_child < 0) continue;
      CHECK(node.first_child > id && node.first_child + 4 <= count);
      for (int c = 0; c < 4; ++c) {
        const Node& child = forest.nodes[node.first_child + c];
        const Node place = child_place(node, c);
        CHECK_EQUAL(child.parent, id);
        CHECK(child.i == place.i && child.j == place.j && child.level == place.level &&
              child.inverted == place.inverted && child.surface == place.surface);
      }
    }
  }
}

void weights_are_shares_of_the_view() {
  for (OracleKind kind : kinds) {
    Refined bench(builtin_scene("cornell"), kind, 3);
    int64_t links = 0;
    for (size_t k = 0; k < bench.state.links.size(); ++k)
      for (const Link& link : bench.state.links[k].links()) {
        CHECK(link.weight > 0 && link.weight <= 1);
        CHECK(link.source >= 0 && link.source < static_cast<NodeId>(bench.state.links.size()));
        ++links;
      }
    CHECK(links > 500);
  }
}

// In a closed room the links of a leaf and of all above it cover the whole of what it sees.
void leaves_see_the_whole_room() {
  for (OracleKind kind : kinds) {
    Refined bench(small_room(), kind, 3);
    const State& state = bench.state;
    const Forest& forest = state.forest;
    double area = 0, seen = 0, square = 0;
    for (NodeId leaf : forest.leaves()) {
      if (forest.surfaces[forest.nodes[leaf].surface].patch == 12) continue;  // the lamp
      double row = 0;
      for (NodeId id = leaf; id >= 0; id = forest.nodes[id].parent)
        for (const Link& link : state.links[id].links()) row += link.weight;
      const double of_leaf = forest.area(forest.nodes[leaf]);
      area += of_leaf;
      seen += of_leaf * row;
      square += of_leaf * (row - 1) * (row - 1);
    }
    CHECK_NEAR(area, 16, 1e-9);
    CHECK_NEAR(seen / area, 1, 0.02);
    CHECK(std::sqrt(square / area) < 0.3);
  }
}

void elements_are_small_near_the_lamp() {
  for (OracleKind kind : kinds) {
    Refined bench(small_room(), kind, 3);
    const Forest& forest = bench.state.forest;
    const auto level_at = [&](double x, double y) {
      for (NodeId root = 0; root < forest.surface_count(); ++root) {
        const Triangle t = forest.root_triangle(root);
        if (t.a.z != 0 || t.b.z != 0 || t.c.z != 0) continue;
        const Vec3 n = t.area_vector(), p{x, y, 0};
        const double u = dot(cross(p - t.a, t.c - t.a), n) / dot(n, n);
        const double v = dot(cross(t.b - t.a, p - t.a), n) / dot(n, n);
        if (u < 0 || v < 0 || u + v > 1) continue;
        return static_cast<int>(forest.nodes[forest.leaf_at(root, u, v)].level);
      }
      return -1;
    };
    CHECK(level_at(1.81, 1.73) >= 0);
    CHECK(level_at(0.44, 0.43) > level_at(1.81, 1.73));
  }
}

void elements_stay_above_the_smallest_area() {
  for (OracleKind kind : kinds) {
    Workbench bench(small_room());
    OracleSettings s = settings(kind, 0.03);
    s.min_area = 0.02;
    bench.link(s);
    bench.sweep(4);
    for (int round = 0; round < 4; ++round) {
      bench.refine(s);
      bench.sweep(4);
    }
    double smallest = 1;
    for (const Node& node : bench.state.forest.nodes)
      if (node.level > 0) smallest = std::min(smallest, bench.state.forest.area(node));
    CHECK(smallest > 0.02 / 4);
    CHECK(smallest <= 0.02);  // and were refined as far as they may be
  }
}

void what_is_good_enough_stays() {
  for (OracleKind kind : kinds) {
    Refined bench(builtin_scene("cornell"), kind, 1), untouched(builtin_scene("cornell"), kind, 1);
    bench.refine(settings(kind, 1e12));
    CHECK(same(bench.state, untouched.state));
  }
}

void a_round_keeps_what_was_there() {
  for (OracleKind kind : kinds) {
    Refined before(builtin_scene("cornell"), kind, 1), after(builtin_scene("cornell"), kind, 1);
    after.refine(settings(kind, 0.3));
    const Forest &a = before.state.forest, &b = after.state.forest;
    CHECK(b.nodes.size() > a.nodes.size());
    // The old ones keep their numbers; the new come four by four behind their parents.
    for (size_t k = 0; k < b.nodes.size(); ++k) {
      if (k < a.nodes.size()) {
        CHECK(a.nodes[k].parent == b.nodes[k].parent && a.nodes[k].i == b.nodes[k].i &&
              a.nodes[k].j == b.nodes[k].j && a.nodes[k].level == b.nodes[k].level);
        CHECK(a.nodes[k].first_child < 0 || a.nodes[k].first_child == b.nodes[k].first_child);
      } else {
        const Node& parent = b.nodes[b.nodes[k].parent];
        CHECK(b.nodes[k].parent < static_cast<NodeId>(k));
        CHECK(static_cast<size_t>(parent.first_child) == k - (k - a.nodes.size()) % 4);
      }
      // New elements begin with the light of their parents.
      if (k < a.nodes.size()) continue;
      for (int band = 0; band < 3; ++band)
        CHECK_EQUAL(after.state.radiosity[3 * k + band],
                    after.state.radiosity[3 * static_cast<size_t>(b.nodes[k].parent) + band]);
    }
  }
}

void threads_change_no_bit() {
  for (OracleKind kind : kinds)
    for (const char* name : {"cornell", "furnace-boxes"}) {
      const double scale = name[0] == 'f' ? 30 : 2;
      Refined first(builtin_scene(name), kind, 2, 1, scale);
      CHECK(first.state.rays > 0);
      for (int threads : {2, 3, 7}) {
        Refined other(builtin_scene(name), kind, 2, threads, scale);
        CHECK(same(first.state, other.state));
      }
    }
}

void a_stop_leaves_the_state_as_it_was() {
  for (OracleKind kind : kinds) {
    Refined bench(builtin_scene("cornell"), kind, 1), untouched(builtin_scene("cornell"), kind, 1);
    const Brightness brightness = bench.brightness();
    StageTools tools = bench.tools(settings(kind, 0.3));
    tools.progress = [](double) { return false; };
    CHECK(!refine_links(bench.state, tools, brightness, bench.radiosity_of_all()));
    CHECK(same(bench.state, untouched.state));
    // And the round can be done afterwards, to the same result.
    double last = 0;
    tools.progress = [&](double fraction) {
      CHECK(fraction >= last && fraction <= 1);
      last = fraction;
      return true;
    };
    CHECK(refine_links(bench.state, tools, brightness, bench.radiosity_of_all()));
    untouched.refine(settings(kind, 0.3));
    CHECK(same(bench.state, untouched.state));
  }
}

// Every element by its key: its links by the keys of their sources, those without weight left out.
using LinksByKey = std::map<uint64_t, std::vector<std::pair<uint64_t, float>>>;
LinksByKey by_key(const State& state) {
  LinksByKey result;
  for (size_t k = 0; k < state.links.size(); ++k) {
    auto& links = result[key_of(state.forest, state.forest.nodes[k])];
    for (const Link& link : state.links[k].links())
      if (link.weight > 0)
        links.emplace_back(key_of(state.forest, state.forest.nodes[link.source]), link.weight);
  }
  return result;
}

void add_weightless_links(State& state, NodeId receiver, int count) {
  const Span<const Link> old = state.links[receiver].links();
  std::vector<Link> links(old.begin(), old.end());
  links.resize(links.size() + static_cast<size_t>(count), Link{0, 0.0f});
  state.links.replace({{receiver, links}});
}

// Many links that carry nothing make tasks that are cut into their children's, and change nothing
// else. All surfaces but the last are cut, or one alone, so that others are refined before it.
void cut_subtrees_give_the_same_links() {
  for (OracleKind kind : kinds)
    for (NodeId only : {-1, 0, 5}) {
      Refined whole(small_room(), kind, 1), cut(small_room(), kind, 1);
      for (NodeId root = 0; root < cut.state.forest.surface_count(); ++root)
        if (only < 0 ? root % 3 != 2 : root == only) add_weightless_links(cut.state, root, 25000);
      // An element in the middle of a tree besides, so that its children are cut off in turn.
      const NodeId inner = cut.state.forest.nodes[0].first_child;
      if (only <= 0 && inner >= 0) add_weightless_links(cut.state, inner, 25000);
      whole.refine(settings(kind, 0.2));
      cut.refine(settings(kind, 0.2));
      CHECK(whole.state.forest.nodes.size() > 13 * 16);
      CHECK_EQUAL(cut.state.forest.nodes.size(), whole.state.forest.nodes.size());
      CHECK(by_key(cut.state) == by_key(whole.state));
    }
}

// The weightless links themselves stay where they were, none lost or doubled.
void cut_subtrees_keep_their_own_links() {
  Refined bench(small_room(), OracleKind::error, 1);
  add_weightless_links(bench.state, 0, 25000);
  bench.refine(settings(OracleKind::error, 0.2));
  int64_t weightless = 0;
  for (size_t k = 0; k < bench.state.links.size(); ++k)
    for (const Link& link : bench.state.links[k].links()) weightless += link.weight == 0;
  CHECK_EQUAL(weightless, int64_t{25000});
}

void exposed_shares_are_the_means_of_the_children() {
  Refined bench(builtin_scene("furnace-boxes"), OracleKind::error, 0);
  bench.refine(settings(OracleKind::error, 10));
  const Forest& forest = bench.state.forest;
  int partly = 0;
  for (const Node& node : forest.nodes) {
    CHECK(node.exposed >= 0 && node.exposed <= 1);
    if (node.first_child < 0) continue;
    double mean = 0;
    for (int c = 0; c < 4; ++c) mean += forest.nodes[node.first_child + c].exposed / 4;
    CHECK_NEAR(node.exposed, mean, 1e-6);
    partly += node.exposed < 1;
  }
  CHECK(partly > 0);
  // What is sealed has no links of its own.
  for (size_t k = 0; k < forest.nodes.size(); ++k)
    if (forest.nodes[k].exposed <= 0 && forest.nodes[k].parent >= 0)
      CHECK_EQUAL(bench.state.links[k].count(), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(forests_are_well_formed),
      HRAD_TEST(weights_are_shares_of_the_view),
      HRAD_TEST(leaves_see_the_whole_room),
      HRAD_TEST(elements_are_small_near_the_lamp),
      HRAD_TEST(elements_stay_above_the_smallest_area),
      HRAD_TEST(what_is_good_enough_stays),
      HRAD_TEST(a_round_keeps_what_was_there),
      HRAD_TEST(threads_change_no_bit),
      HRAD_TEST(a_stop_leaves_the_state_as_it_was),
      HRAD_TEST(cut_subtrees_give_the_same_links),
      HRAD_TEST(cut_subtrees_keep_their_own_links),
      HRAD_TEST(exposed_shares_are_the_means_of_the_children),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
