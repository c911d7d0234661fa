// Each point is counted at the first leaf that names it. Floor 7 (stages).
#include "stages/point_numbers.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "machine/pieces.h"

namespace hrad {
namespace {

constexpr NodeId no_leaf = std::numeric_limits<NodeId>::max();

void lower_to(std::atomic<NodeId>& first, NodeId leaf) {
  NodeId before = first.load(std::memory_order_relaxed);
  while (leaf < before && !first.compare_exchange_weak(before, leaf, std::memory_order_relaxed)) {
  }
}

// All points that leaves name, in the order in which they do.
std::vector<int32_t> points_in_order(const LeafPoints& of_leaf, size_t points, ThreadTeam& team) {
  std::vector<std::atomic<NodeId>> first(points);
  for_each_thing(team, points,
                 [&](size_t k) { first[k].store(no_leaf, std::memory_order_relaxed); });
  for_each_thing(team, of_leaf.size(), [&](size_t id) {
    for (int32_t point : of_leaf[id])
      if (point >= 0) lower_to(first[static_cast<size_t>(point)], static_cast<NodeId>(id));
  });
  return gathered<int32_t>(team, of_leaf.size(), [&](size_t id, std::vector<int32_t>& some) {
    const LeafPoints::Numbers numbers = of_leaf[id];
    for (auto point = numbers.begin(); point != numbers.end() && *point >= 0; ++point)
      if (first[static_cast<size_t>(*point)].load(std::memory_order_relaxed) ==
              static_cast<NodeId>(id) &&
          std::find(numbers.begin(), point, *point) == point)
        some.push_back(*point);
  });
}

}  // namespace

void number_points_by_leaves(CornerLight& direct, size_t points,
                             const std::function<Span<const Link>(int32_t point)>& links_of,
                             ThreadTeam& team) {
  const std::vector<int32_t> order = points_in_order(direct.of_leaf, points, team);
  std::vector<int32_t> number(points, -1);
  std::vector<Span<const Link>> kept(order.size());
  for_each_thing(team, order.size(), [&](size_t k) {
    number[static_cast<size_t>(order[k])] = static_cast<int32_t>(k);
    kept[k] = links_of(order[k]);
  });
  direct.of_leaf.renumber(number, team);
  std::vector<uint32_t> first(order.size() + 1, 0);
  for (size_t k = 0; k < order.size(); ++k)
    first[k + 1] = first[k] + static_cast<uint32_t>(kept[k].size());
  std::vector<Link> links(first.back());
  for_each_thing(team, order.size(), [&](size_t k) {
    std::copy(kept[k].begin(), kept[k].end(), links.data() + first[k]);
  });
  direct.links = std::move(links);
  direct.first = std::move(first);
}

}  // namespace hrad
