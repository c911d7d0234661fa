// Links estimated in scenes whose form factors and visible fractions are known.
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "links/link_sampler.h"
#include "support/workbench.h"
#include "visibility/brute_force.h"

namespace {

using namespace hrad;
using namespace hrad_test;

// Parallel unit squares, the second at height z and facing the first; further patches may follow.
Scene parallel_squares(double z) {
  Scene scene;
  add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add_quad(scene, {0, 0, z}, {0, 1, 0}, {1, 0, 0});
  return scene;
}

double squares_factor(double z) {
  const double x = 1 / z, r = std::sqrt(1 + x * x);
  return 2 / (pi * x * x) *
         (std::log(r * r / std::sqrt(1 + 2 * x * x)) + 2 * x * r * std::atan(x / r) -
          2 * x * std::atan(x));
}

struct Pair {
  Element receiver, source;
  uint64_t key;
};

Pair pair_of(const Workbench& bench, const LinkSampler& sampler, NodeId receiver, NodeId source) {
  const Forest& forest = bench.state.forest;
  const Node &r = forest.nodes[receiver], &s = forest.nodes[source];
  return {element_of(forest, r), element_of(forest, s),
          sampler.link_key(key_of(forest, r), key_of(forest, s))};
}

LinkEstimate traced(const Workbench& bench, LinkSampler& sampler, NodeId receiver, NodeId source,
                    int packets) {
  const Pair pair = pair_of(bench, sampler, receiver, source);
  DrawnPairs drawn;
  LinkEstimate estimate;
  sampler.begin(pair.receiver, pair.source, pair.key, drawn, estimate);
  sampler.trace(pair.receiver, pair.source, pair.key, drawn, estimate);
  if (packets > 1) sampler.trace_more(pair.receiver, pair.source, pair.key, packets, estimate);
  return estimate;
}

double factor_of(const Workbench& bench, LinkSampler sampler, NodeId receiver, NodeId source) {
  const Pair pair = pair_of(bench, sampler, receiver, source);
  DrawnPairs drawn;
  LinkEstimate estimate;
  sampler.begin(pair.receiver, pair.source, pair.key, drawn, estimate);
  return estimate.factor;
}

// From the elements of the first two patches to the roots of the next two, weighted by area.
double squares_by_links(Workbench& bench, LinkSampler sampler) {
  const Forest& forest = bench.state.forest;
  double sum = 0;
  for (NodeId leaf : forest.leaves()) {
    const Node& node = forest.nodes[leaf];
    if (node.surface > 1) continue;
    for (NodeId source : {2, 3}) sum += forest.area(node) * factor_of(bench, sampler, leaf, source);
  }
  return sum;
}

void parallel_squares_have_their_closed_form() {
  for (double z : {0.3, 1.0, 3.0}) {
    Workbench bench(parallel_squares(z), 1);
    split_all(bench.state.forest, 3);
    CHECK_NEAR(squares_by_links(bench, bench.sampler(0)) / squares_factor(z), 1, 5e-3);
  }
  // Few points of large elements: coarser, not wrong.
  Workbench coarse(parallel_squares(1), 1);
  CHECK_NEAR(squares_by_links(coarse, coarse.sampler(0)) / squares_factor(1), 1, 0.1);
}

// The sampled kernel, over many seeds, and one of them.
void distant_squares_have_their_closed_form() {
  const double wanted = squares_factor(6);
  Workbench bench(parallel_squares(6), 1);
  double mean = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const double found = squares_by_links(bench, bench.sampler(0.5, seed));
    CHECK_NEAR(found / wanted, 1, 0.03);
    mean += found / 200;
  }
  CHECK_NEAR(mean / wanted, 1, 1e-3);
}

void near_is_by_size_over_distance() {
  Workbench bench(parallel_squares(6), 1);
  // Two radii of 0.745 at a distance of 6.
  for (double ratio : {0.1, 0.2, 0.3, 0.5}) {
    LinkSampler sampler = bench.sampler(ratio);
    const Pair pair = pair_of(bench, sampler, 0, 2);
    DrawnPairs drawn;
    LinkEstimate estimate;
    sampler.begin(pair.receiver, pair.source, pair.key, drawn, estimate);
    const double size = pair.receiver.radius + pair.source.radius;
    CHECK(estimate.near == (size > ratio * length(pair.source.centroid - pair.receiver.centroid)));
    CHECK_NEAR(estimate.mean_error, 0, estimate.near ? 0.1 * estimate.factor : 0.0);
  }
}

void reciprocity_holds() {
  Scene scene = parallel_squares(0.7);
  add_quad(scene, {0.6, 0.3, 0.1}, {0, 0, 0.3}, {0, 0.2, 0});
  Workbench bench(std::move(scene), 1);
  LinkSampler sampler = bench.sampler(0.4);
  const auto area = [&](NodeId id) { return bench.state.forest.surfaces[id].area; };
  int unequal = 0;
  for (NodeId p = 0; p < 6; ++p)
    for (NodeId q = 0; q < p; ++q) {
      const double there = area(p) * factor_of(bench, sampler, p, q);
      const double back = area(q) * factor_of(bench, sampler, q, p);
      if (area(p) == area(q)) {
        CHECK_NEAR(there, back, 0.15 * (there + back) / 2);
      } else if (there > 0 && back > 0) {
        // Both integrate over the smaller one.
        CHECK_NEAR(there / back, 1, 1e-9);
        ++unequal;
      }
    }
  CHECK(unequal >= 4);
}

void an_open_view_is_seen_whole() {
  Workbench bench(parallel_squares(1), 1);
  LinkSampler sampler = bench.sampler();
  for (NodeId receiver : {0, 1})
    for (NodeId source : {2, 3}) {
      const LinkEstimate e = traced(bench, sampler, receiver, source, 1);
      CHECK_EQUAL(e.visible(), 1.0);
      CHECK_EQUAL(e.weight(), e.factor);
      CHECK_EQUAL(e.pairs, 16);
    }
  CHECK_EQUAL(sampler.rays(), int64_t{64});
}

void a_full_plate_hides_everything() {
  Scene scene = parallel_squares(1);
  add_quad(scene, {-1, -1, 0.5}, {3, 0, 0}, {0, 3, 0});
  Workbench bench(std::move(scene), 1);
  LinkSampler sampler = bench.sampler();
  const LinkEstimate e = traced(bench, sampler, 0, 2, 4);
  CHECK(e.factor > 0.05);
  CHECK_EQUAL(e.pairs, 64);
  CHECK_EQUAL(e.visible(), 0.0);
  CHECK_EQUAL(e.weight(), 0.0);
}

// A small receiver under a square of side 2, a plate halfway up that ends above the receiver: half
// of the square is hidden, and by symmetry half of its kernel.
void half_a_plate_hides_half() {
  Scene scene;
  add_triangle(scene, {-1e-3, -1e-3, 0}, {1e-3, -1e-3, 0}, {0, 2e-3, 0});
  add_quad(scene, {-1, -1, 2}, {0, 2, 0}, {2, 0, 0});
  add_quad(scene, {-3, -3, 1}, {3, 0, 0}, {0, 6, 0});
  Workbench bench(std::move(scene), 1);
  LinkSampler sampler = bench.sampler();
  const LinkEstimate a = traced(bench, sampler, 0, 1, 64);
  const LinkEstimate b = traced(bench, sampler, 0, 2, 64);
  CHECK_EQUAL(a.pairs, 1024);
  CHECK_NEAR((a.weight() + b.weight()) / (a.factor + b.factor), 0.5, 0.03);
  // Lit is the half x > 0: in triangle (-1,-1) (1,1) (1,-1)... the shares of the two differ.
  CHECK(std::fabs(a.visible() - b.visible()) > 0.3);
}

void more_packets_add_up() {
  Workbench bench(parallel_squares(6), 1);
  LinkSampler sampler = bench.sampler(0.5);
  const LinkEstimate one = traced(bench, sampler, 0, 2, 1);
  CHECK_EQUAL(sampler.rays(), int64_t{16});
  const LinkEstimate many = traced(bench, sampler, 0, 2, 50);
  CHECK_EQUAL(sampler.rays(), int64_t{16 * 51});
  CHECK_EQUAL(many.pairs, 16 * 50);
  CHECK(!many.near);
  // A far link's factor is the mean of all kernels by now.
  CHECK_NEAR(many.factor, many.kernel_sum / many.pairs * many.source_area, 1e-15);
  CHECK(many.factor != one.factor);
}

void some_lanes_count_alone() {
  Workbench bench(parallel_squares(6), 1);
  LinkSampler sampler = bench.sampler(0.5);
  const Pair pair = pair_of(bench, sampler, 0, 2);
  DrawnPairs drawn;
  LinkEstimate estimate;
  sampler.begin(pair.receiver, pair.source, pair.key, drawn, estimate);
  sampler.add(drawn, quick_pairs, 0x0010, estimate);
  CHECK_EQUAL(sampler.rays(), int64_t{4});
  CHECK_EQUAL(estimate.pairs, 4);
  const float* kernel = drawn.samples.kernel;
  const double all = static_cast<double>(kernel[0]) + kernel[4] + kernel[8] + kernel[12];
  CHECK_NEAR(estimate.kernel_sum, all, 1e-15);
  CHECK_NEAR(estimate.visible_sum, all - kernel[4], 1e-15);
}

void seeds_draw_other_pairs_of_the_same_link() {
  Workbench bench(parallel_squares(6), 1);
  const LinkSampler a = bench.sampler(0.5, 1), b = bench.sampler(0.5, 2);
  CHECK(a.link_key(3, 4) != b.link_key(3, 4));
  CHECK(a.link_key(3, 4) != a.link_key(4, 3));
  CHECK(factor_of(bench, a, 0, 2) != factor_of(bench, b, 0, 2));
  CHECK_EQUAL(factor_of(bench, a, 0, 2), factor_of(bench, a, 0, 2));
}

// A room of 4 x 4 x 2, a box of 2 x 4 x 0.5 on its floor: the part x < 2 of the floor is sealed.
Scene room_with_a_sealed_floor() {
  Scene scene;
  add_box(scene, {0, 0, 0}, {4, 4, 2}, true);
  add_box(scene, {0, 0, 0}, {2, 4, 0.5});
  return scene;
}

// The nodes of the room's floor or ceiling.
bool lies_at(const Workbench& bench, const Node& node, double z, double up) {
  const Element e = element_of(bench.state.forest, node);
  return e.normal.z == up && e.centroid.z == z &&
         bench.state.forest.surfaces[node.surface].patch < 12;
}

void exposed_shares_are_those_of_the_areas() {
  Workbench bench(room_with_a_sealed_floor(), 1);
  Forest& forest = bench.state.forest;
  split_all(forest, 4);
  LinkSampler sampler = bench.sampler();
  double exposed = 0, whole = 0;
  int partly = 0;
  for (NodeId leaf : forest.leaves()) {
    const Node& node = forest.nodes[leaf];
    if (!lies_at(bench, node, 0, 1)) continue;
    const float share = sampler.exposed_share(node);
    const Triangle t = forest.triangle(node);
    const double low = std::min(std::min(t.a.x, t.b.x), t.c.x);
    const double high = std::max(std::max(t.a.x, t.b.x), t.c.x);
    if (high <= 2) CHECK_EQUAL(share, 0.0f);
    if (low >= 2) CHECK_EQUAL(share, 1.0f);
    whole += forest.area(node);
    exposed += forest.area(node) * share;
  }
  CHECK_NEAR(whole, 16, 1e-9);
  CHECK_NEAR(exposed, 8, 1e-9);
  for (NodeId root = 0; root < forest.surface_count(); ++root) {
    const float share = sampler.exposed_share(forest.nodes[root]);
    if (lies_at(bench, forest.nodes[root], 0, 1)) {
      // Of one half of the floor a quarter lies beyond x = 2, of the other three quarters.
      CHECK(std::fabs(share - 0.25) < 0.1 || std::fabs(share - 0.75) < 0.1);
      ++partly;
    }
    if (lies_at(bench, forest.nodes[root], 2, -1)) CHECK_EQUAL(share, 1.0f);
  }
  CHECK_EQUAL(partly, 2);
}

// Pairs are drawn from the exposed part of either end, so that light goes both ways over that
// alone.
void sealed_parts_see_nothing() {
  Workbench bench(room_with_a_sealed_floor(), 1);
  Forest& forest = bench.state.forest;
  LinkSampler sampler = bench.sampler();
  std::vector<NodeId> floor, ceiling;
  for (NodeId root = 0; root < forest.surface_count(); ++root) {
    forest.nodes.set_exposed(root, sampler.exposed_share(forest.nodes[root]));
    const Node node = forest.nodes[root];
    if (lies_at(bench, node, 0, 1)) floor.push_back(root);
    if (lies_at(bench, node, 2, -1)) ceiling.push_back(root);
  }
  CHECK(floor.size() == 2 && ceiling.size() == 2);
  const double center = bench.engine->center().x;
  for (NodeId f : floor)
    for (NodeId c : ceiling) {
      const double share = forest.nodes[f].exposed < 0.5 ? 0.25 : 0.75;  // node's is an estimate
      const Pair down = pair_of(bench, sampler, f, c);
      DrawnPairs drawn;
      LinkEstimate estimate;
      sampler.begin(down.receiver, down.source, down.key, drawn, estimate);
      sampler.trace(down.receiver, down.source, down.key, drawn, estimate);
      CHECK_EQUAL(estimate.pairs, 16);
      CHECK_EQUAL(drawn.exposed, all_pairs);
      CHECK(estimate.exposed_only);
      for (int k = 0; k < 16; ++k) CHECK(drawn.samples.packet.ox[k] + center > 2 - 1e-5);
      CHECK_EQUAL(estimate.source_area, down.source.area);
      CHECK_EQUAL(estimate.exposed, 1.0);

      const Pair up = pair_of(bench, sampler, c, f);
      LinkEstimate back;
      sampler.begin(up.receiver, up.source, up.key, drawn, back);
      sampler.trace(up.receiver, up.source, up.key, drawn, back);
      // Close by, points of the larger end are drawn sealed or not; sealed ones count as blocked.
      CHECK(back.close_pairs && !back.exposed_only);
      for (int k = 0; k < 16; ++k) {
        const float end = drawn.samples.packet.ox[k] + drawn.samples.packet.dx[k];
        CHECK((end + center > 2) == ((drawn.exposed >> k & 1) != 0));
      }
      sampler.trace_more(up.receiver, up.source, up.key, 1000, back);
      sampler.trace_more(down.receiver, down.source, down.key, 1000, estimate);
      // The side of the box takes a few.
      CHECK(estimate.visible() > 0.8);
      const double there = down.receiver.area * share * estimate.weight();
      CHECK_NEAR(up.receiver.area * back.weight() / there, 1, 0.05);
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(parallel_squares_have_their_closed_form),
      HRAD_TEST(distant_squares_have_their_closed_form),
      HRAD_TEST(near_is_by_size_over_distance),
      HRAD_TEST(reciprocity_holds),
      HRAD_TEST(an_open_view_is_seen_whole),
      HRAD_TEST(a_full_plate_hides_everything),
      HRAD_TEST(half_a_plate_hides_half),
      HRAD_TEST(more_packets_add_up),
      HRAD_TEST(some_lanes_count_alone),
      HRAD_TEST(seeds_draw_other_pairs_of_the_same_link),
      HRAD_TEST(exposed_shares_are_those_of_the_areas),
      HRAD_TEST(sealed_parts_see_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
