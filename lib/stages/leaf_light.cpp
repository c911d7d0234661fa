// Points of leaves and the weights of their mean. Floor 7 (stages).
#include "stages/leaf_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/hash.h"
#include "links/element.h"
#include "machine/pieces.h"
#include "stages/exchange.h"
#include "stages/state_memory.h"

namespace hrad {
namespace {

constexpr int64_t leaves_of_a_task = 256;

// Weights of corners, middles of edges and centroid. Light is not linear between the corners, and
// those lie in creases: their mean alone would be too dark. With the centroid the mean of every
// quadratic field is exact, with the middles that of every cubic one (Stroud, "Approximate
// calculation of multiple integrals", 1971, Section 8.8).
constexpr double corner_of_four = 1.0 / 12, centroid_of_four = 3.0 / 4;
constexpr double corner_of_seven = 1.0 / 20, middle_of_seven = 2.0 / 15,
                 centroid_of_seven = 9.0 / 20;
constexpr int number_of_centroid = 3;  // among the points that belong to a leaf alone

// Of a point of a triangle: it is Triangle::at(x, y). By areas, which a sliver has too.
void coordinates_in(const Triangle& t, Vec3 point, double* x, double* y) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, ap = point - t.a;
  const Vec3 n = cross(ab, ac);
  const double whole = dot(n, n);
  *x = *y = 1.0 / 3;
  if (!(whole > 0)) return;
  *x = std::clamp(dot(cross(ap, ac), n) / whole, 0.0, 1.0);
  *y = std::clamp(dot(cross(ab, ap), n) / whole, 0.0, 1.0);
}

}  // namespace

OrientedPoint middle_of(const Forest& forest, NodeId leaf) {
  const Node& node = forest.nodes[leaf];
  return {forest.triangle(node).centroid(), forest.surfaces[node.surface].normal};
}

KeyedPoint keyed_middle_of(const Forest& forest, NodeId leaf) {
  const Node& node = forest.nodes[leaf];
  return {node.surface, key_of(forest, node), middle_of(forest, leaf)};
}

// Of the mean of a leaf: numbers of sampled points, and their weights.
struct LeafLight::Shares {
  int count = 0;
  int32_t number[7];
  double weight[7];
  void add(int32_t point, double share) {
    number[count] = point;
    weight[count++] = share;
  }
};

std::vector<NodeId> LeafLight::new_leaves(Whose whose) {
  forget_divided();
  const NodeId first = named_, end = static_cast<NodeId>(forest_.nodes.size());
  named_ = end;
  state_.direct.mean.resize(forest_.nodes.size());
  return gathered<NodeId>(
      tools_.team, static_cast<size_t>(end - first), [&](size_t k, std::vector<NodeId>& leaves) {
        const NodeId id = first + static_cast<NodeId>(k);
        const Node& node = forest_.nodes[id];
        if (!Forest::is_cluster(node) && forest_.is_leaf(id) && node.exposed > 0 &&
            (whose == Whose::all || tools_.exchange.mine(node.surface)))
          leaves.push_back(id);
      });
}

bool LeafLight::name() {
  const std::vector<NodeId> leaves = new_leaves(Whose::own);
  state_.direct.of_leaf.resize(forest_.nodes.size());
  take_own_points(gathered<NodeId>(tools_.team, leaves.size(),
                                   [&](size_t k, std::vector<NodeId>& partly_sealed) {
                                     if (!take_corners(leaves[k]))
                                       partly_sealed.push_back(leaves[k]);
                                   }));
  const auto first_middle = static_cast<size_t>(corners_.asked());
  const std::vector<int32_t> centroids = ask_for_middles(leaves);
  const auto its_middle = [&](size_t k) { return keyed_middle_of(forest_, leaves[k]); };
  if (!open_cubes(grid_, leaves.size(), its_middle, state_, tools_)) return false;
  if (!corners_.sample(work_of_a_middle)) return false;
  add_up_means(leaves, centroids);
  corners_.forget_links(first_middle);
  return true;
}

// Numbers of the middles of the leaves that are to know theirs; -1: of others.
std::vector<int32_t> LeafLight::ask_for_middles(const std::vector<NodeId>& leaves) {
  const std::vector<size_t> wanted =
      gathered<size_t>(tools_.team, leaves.size(), [&](size_t k, std::vector<size_t>& some) {
        if (forest_.nodes[leaves[k]].light_points == at_corners) some.push_back(k);
      });
  const auto first = static_cast<int32_t>(corners_.asked());
  std::vector<int32_t> centroids(leaves.size(), -1);
  std::vector<PointOfElement> middles(wanted.size());
  for_each_thing(tools_.team, wanted.size(), [&](size_t k) {
    const NodeId leaf = leaves[wanted[k]];
    centroids[wanted[k]] = first + static_cast<int32_t>(k);
    middles[k] = {leaf, number_of_centroid, middle_of(forest_, leaf).place};
  });
  corners_.add(middles);
  return centroids;
}

void LeafLight::forget_divided() {
  auto none = gathered<LinkTable::NewRun>(
      tools_.team, static_cast<size_t>(named_),
      [&](size_t k, std::vector<LinkTable::NewRun>& runs) {
        const NodeId id = static_cast<NodeId>(k);
        if (forest_.is_leaf(id) || Forest::is_cluster(forest_.nodes[id])) return;
        if (!state_.direct.of_leaf.empty()) state_.direct.of_leaf.forget(static_cast<size_t>(id));
        if (state_.direct.mean[id].count() > 0) runs.push_back({id, {}});
      });
  state_.direct.mean.replace(std::move(none), &tools_.team);
}

// False: some are sealed.
bool LeafLight::take_corners(NodeId leaf) {
  const Node& node = forest_.nodes[leaf];
  LatticePoint point[3];
  if (node.light_points == half_way_to_the_middle)
    half_way_points(node, point);
  else
    lattice_corners(node, point);
  LeafPoints::Numbers number;
  for (int c = 0; c < 3; ++c) {
    number[c] = corners_.find(node.surface, point[c]);
    if (corners_.value(number[c]) < 0) return false;
  }
  state_.direct.of_leaf.name(static_cast<size_t>(leaf), number);
  return true;
}

// A leaf with sealed corners has points of its own instead, on its exposed part.
void LeafLight::take_own_points(const std::vector<NodeId>& leaves) {
  struct Found {
    bool any = false;
    Vec3 place[3];
    LeafPoints::Places within;
  };
  std::vector<Found> found(leaves.size());
  tools_.team.for_each(static_cast<int64_t>(leaves.size()), [&](int64_t task, int) {
    const size_t k = static_cast<size_t>(task);
    const Node node = forest_.nodes[leaves[k]];
    forest_.nodes.set_light_points(leaves[k], at_own_points);
    LatticePoint corner[3];
    lattice_corners(node, corner);
    found[k].any = corners_.points_of_exposed(leaves[k], corner, found[k].place);
    const Triangle triangle = forest_.triangle(node);
    for (int c = 0; c < 3 && found[k].any; ++c) {
      double x, y;
      coordinates_in(triangle, found[k].place[c], &x, &y);
      found[k].within[static_cast<size_t>(c)] = {static_cast<float>(x), static_cast<float>(y)};
    }
  });
  std::vector<PointOfElement> points;
  points.reserve(3 * leaves.size());
  for (size_t k = 0; k < leaves.size(); ++k) {
    if (!found[k].any) continue;
    const auto first = static_cast<int32_t>(corners_.asked()) + static_cast<int32_t>(points.size());
    state_.direct.of_leaf.name_own(static_cast<size_t>(leaves[k]), first, found[k].within);
    for (int c = 0; c < 3; ++c) points.push_back({leaves[k], c, found[k].place[c]});
  }
  corners_.add(points);
}

LeafLight::Shares LeafLight::shares_of_mean(NodeId leaf, int32_t centroid) const {
  const Node& node = forest_.nodes[leaf];
  const LeafPoints::Numbers points = state_.direct.of_leaf[static_cast<size_t>(leaf)];
  Shares shares;
  if (points[0] < 0) return shares;
  if (centroid < 0 || corners_.value(centroid) < 0) {
    for (int32_t number : points) shares.add(number, 1.0 / 3);
    return shares;
  }
  LatticePoint corner[3];
  lattice_corners(node, corner);
  int32_t middles[3];
  bool known = node.level < max_level;  // below there are no middles
  for (int c = 0; c < 3; ++c) {
    middles[c] = corners_.find(node.surface, middle(corner[c], corner[(c + 1) % 3]));
    known = known && middles[c] >= 0 && corners_.value(middles[c]) >= 0;
  }
  for (int32_t number : points) shares.add(number, known ? corner_of_seven : corner_of_four);
  for (int c = 0; c < 3 && known; ++c) shares.add(middles[c], middle_of_seven);
  shares.add(centroid, known ? centroid_of_seven : centroid_of_four);
  return shares;
}

// Appends one link for each source that lights the leaf by links, the sum of its weights.
void LeafLight::add_up(std::vector<Link>& all, const OrientedPoint& middle,
                       std::vector<Link>& run) const {
  std::stable_sort(all.begin(), all.end(),
                   [](const Link& a, const Link& b) { return a.source < b.source; });
  const auto& there = grid_.at(middle);
  for (size_t at = 0; at < all.size();) {
    double sum = 0;
    const NodeId source = all[at].source;
    for (; at < all.size() && all[at].source == source; ++at) sum += all[at].weight;
    if (grid_.by_links(grid_.emitters().of_node(source), middle, there))
      run.push_back({source, static_cast<float>(sum)});
  }
}

// One run of links for each leaf, so that sweeps need no corners.
void LeafLight::add_up_means(const std::vector<NodeId>& leaves,
                             const std::vector<int32_t>& centroids) {
  const int64_t count = static_cast<int64_t>(leaves.size());
  const int64_t tasks = (count + leaves_of_a_task - 1) / leaves_of_a_task;
  struct Result {
    std::vector<Link> links;
    std::vector<size_t> end;  // of each leaf's links
  };
  std::vector<Result> results(static_cast<size_t>(tasks));
  StageMemory memory(state_);  // of the links until they are in place
  tools_.team.for_each(tasks, [&](int64_t task, int) {
    Result& r = results[task];
    std::vector<Link> all;
    for (int64_t k = task * leaves_of_a_task; k < std::min(count, (task + 1) * leaves_of_a_task);
         ++k) {
      all.clear();
      const Shares shares = shares_of_mean(leaves[k], centroids[k]);
      const OrientedPoint middle = middle_of(forest_, leaves[k]);
      for (int p = 0; p < shares.count; ++p)
        for (const Link& link : corners_.links_of(shares.number[p]))
          all.push_back({link.source,
                         static_cast<float>(shares.weight[p] * static_cast<double>(link.weight))});
      add_up(all, middle, r.links);
      r.end.push_back(r.links.size());
    }
    memory.take(static_cast<int64_t>(r.links.capacity() * sizeof(Link)), "direct light of leaves");
  });
  std::vector<LinkTable::NewRun> runs(leaves.size());
  for_each_thing(tools_.team, leaves.size(), [&](size_t k) {
    const Result& r = results[k / leaves_of_a_task];
    const size_t in_task = k % leaves_of_a_task;
    const size_t begin = in_task ? r.end[in_task - 1] : 0;
    runs[k] = {leaves[k], {r.links.data() + begin, r.end[in_task] - begin}};
  });
  state_.direct.mean.replace(std::move(runs), &tools_.team);
}

}  // namespace hrad
