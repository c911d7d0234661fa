// One walk over the leaves. Floor 7 (stages).
#include "stages/point_numbers.h"

#include <algorithm>
#include <utility>

#include "machine/pieces.h"

namespace hrad {

void number_points_by_leaves(CornerLight& direct, size_t points,
                             const std::function<bool(NodeId leaf)>& keep_leaf,
                             const std::function<Span<const Link>(int32_t point)>& links_of,
                             ThreadTeam* team) {
  constexpr int32_t unnamed = -1;
  std::vector<int32_t> number(points, unnamed), order;
  const auto number_of = [&](int32_t point) {
    int32_t& given = number[static_cast<size_t>(point)];
    if (given == unnamed) {
      given = static_cast<int32_t>(order.size());
      order.push_back(point);
    }
    return given;
  };
  LeafPoints named;
  for (size_t id = 0; id < direct.of_leaf.size(); ++id) {
    LeafPoints::Numbers numbers = direct.of_leaf[id];
    if (numbers[0] < 0 || !keep_leaf(static_cast<NodeId>(id))) {
      named.append(LeafPoints::none);
      continue;
    }
    for (int32_t& point : numbers) point = number_of(point);
    if (const LeafPoints::Places* own = direct.of_leaf.own_places(id))
      named.append_own(numbers[0], *own);
    else
      named.append(numbers);
  }
  named.shrink_to_fit();
  const auto for_each_point = [&](const std::function<void(size_t)>& body) {
    if (team) return for_each_thing(*team, order.size(), body);
    for (size_t k = 0; k < order.size(); ++k) body(k);
  };
  std::vector<Span<const Link>> kept(order.size());
  for_each_point([&](size_t k) { kept[k] = links_of(order[k]); });
  std::vector<uint32_t> first(order.size() + 1, 0);
  for (size_t k = 0; k < order.size(); ++k)
    first[k + 1] = first[k] + static_cast<uint32_t>(kept[k].size());
  std::vector<Link> links(first.back());
  for_each_point(
      [&](size_t k) { std::copy(kept[k].begin(), kept[k].end(), links.data() + first[k]); });
  direct.of_leaf = std::move(named);
  direct.links = std::move(links);
  direct.first = std::move(first);
}

}  // namespace hrad
