// Direct light as the mean over each leaf alone, where it is wanted at no points. Floor 7 (stages).
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/hash.h"
#include "base/low_discrepancy.h"
#include "base/triangle_points.h"
#include "links/element.h"
#include "stages/exchange.h"
#include "stages/leaf_light.h"
#include "stages/state_memory.h"
#include "stages/task_names.h"

namespace hrad {
namespace {

constexpr size_t leaves_of_a_batch = 8192;
constexpr size_t fewest_points_of_a_mean = 6;
constexpr int tries_of_a_mean = 16 * points_of_a_mean;

}  // namespace

std::vector<OrientedPoint> LeafLight::points_over(NodeId leaf, double large) const {
  const Node& node = forest_.nodes[leaf];
  const Surface& surface = forest_.surfaces[node.surface];
  const Triangle corners = forest_.triangle(node);
  Exposure::Part part(tools_.exposure, surface.patch, surface.side, corners);
  const LowDiscrepancy spread(mix(key_of(forest_, node), tools_.oracle.seed, 0x6d65616eu));
  const double share = std::sqrt(std::min(1.0, forest_.area(node) / large));
  const size_t wanted =
      std::max(fewest_points_of_a_mean, static_cast<size_t>(share * points_of_a_mean));
  std::vector<OrientedPoint> points;
  for (int k = 0; k < tries_of_a_mean && points.size() < wanted; ++k) {
    double p[4], x, y;
    spread.point(static_cast<uint32_t>(k), p);
    even_in_triangle(p[0], p[1], &x, &y);
    const Vec3 place = corners.at(x, y);
    if (!part.sealed(place)) points.push_back({place, surface.normal});
  }
  return points;
}

bool LeafLight::name_means(const DirectLight& light, double large) {
  const std::vector<NodeId> leaves = new_leaves(Whose::all);
  const size_t count = leaves.size();
  for (size_t first = 0; first < count; first += leaves_of_a_batch) {
    const size_t some = std::min(leaves_of_a_batch, count - first);
    const auto is_mine = [&](size_t k) {
      return tools_.exchange.mine(forest_.nodes[leaves[first + k]].surface);
    };
    std::vector<std::vector<OrientedPoint>> points(some);
    tools_.team.for_each(static_cast<int64_t>(some), [&](int64_t turn, int) {
      const size_t k = static_cast<size_t>(turn);
      if (is_mine(k)) points[k] = points_over(leaves[first + k], large);
    });
    std::vector<KeyedPoint> all;
    for (size_t k = 0; k < some; ++k) {
      if (!is_mine(k)) continue;
      const KeyedPoint middle = keyed_middle_of(forest_, leaves[first + k]);
      all.push_back(middle);
      for (size_t p = 0; p < points[k].size(); ++p)
        all.push_back({middle.surface, mix(middle.key, p), points[k][p]});
    }
    if (!open_cubes(
            grid_, all.size(), [&](size_t k) { return all[k]; }, state_, tools_))
      return false;
    state_.journal.next_pass();
    const auto is_emitter = [&](NodeId source) { return grid_.emitters().is_emitter(source); };
    std::vector<std::vector<Link>> runs(some);
    std::vector<int64_t> rays(some, 0);
    std::vector<uint8_t> is_new(some, 0);
    const auto name_of = [&](size_t k) { return name_of_element(forest_, leaves[first + k]); };
    StageMemory memory(state_);
    const bool going_on = state_.journal.for_each(
        tools_.team, static_cast<int64_t>(some),
        [&](int64_t turn, int) {
          const size_t k = static_cast<size_t>(turn);
          if (!is_mine(k)) return;
          is_new[k] = !state_.journal.known_run(name_of(k), is_emitter, runs[k], rays[k]);
          if (is_new[k]) {
            const uint64_t key = key_of(forest_, forest_.nodes[leaves[first + k]]);
            std::vector<Link> links;
            for (size_t p = 0; p < points[k].size(); ++p)
              rays[k] += light.sample(points[k][p], mix(key, tools_.oracle.seed, p), links);
            for (Link& link : links) link.weight /= static_cast<float>(points[k].size());
            add_up(links, middle_of(forest_, leaves[first + k]), runs[k]);
          }
          memory.take(static_cast<int64_t>(runs[k].capacity() * sizeof(Link)),
                      "direct light of leaves");
        },
        [&](int64_t done) {
          return tools_.progress((static_cast<double>(first) + static_cast<double>(done)) /
                                 static_cast<double>(count));
        },
        [&](LinkStep& step, int64_t turn) {
          const size_t k = static_cast<size_t>(turn);
          if (is_new[k]) step.add_run(name_of(k), runs[k], rays[k]);
        });
    if (!tools_.exchange.all_go_on(going_on)) return false;
    std::vector<LinkTable::NewRun> all_runs;
    for (size_t k = 0; k < some; ++k) {
      state_.rays += rays[k];
      all_runs.push_back({leaves[first + k], runs[k]});
    }
    state_.direct.mean.replace(std::move(all_runs), &tools_.team);
  }
  return true;
}

}  // namespace hrad
