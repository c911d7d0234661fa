// One walk over the leaves. Floor 7 (stages).
#include "stages/point_numbers.h"

#include <algorithm>
#include <utility>

#include "machine/pieces.h"

namespace hrad {

void number_points_by_leaves(CornerLight& direct, const std::function<bool(NodeId leaf)>& keep_leaf,
                             const std::function<bool(int32_t point, const Link&)>& keep_link) {
  number_points_by_leaves(
      direct, direct.point_count(), keep_leaf,
      [&](int32_t point, std::vector<Link>& links) {
        for (const Link& link : direct.links_of_point(point))
          if (keep_link(point, link)) links.push_back(link);
      },
      nullptr);
}

void number_points_by_leaves(
    CornerLight& direct, size_t points, const std::function<bool(NodeId leaf)>& keep_leaf,
    const std::function<void(int32_t point, std::vector<Link>& links)>& take_links,
    ThreadTeam* team) {
  constexpr int32_t unnamed = -1;
  std::vector<int32_t> number(points, unnamed), order;
  for (size_t id = 0; id < direct.of_leaf.size(); ++id) {
    auto& named = direct.of_leaf[id];
    if (named[0] < 0) continue;
    if (!keep_leaf(static_cast<NodeId>(id))) {
      named = {-1, -1, -1};
      continue;
    }
    for (int32_t& point : named) {
      int32_t& given = number[static_cast<size_t>(point)];
      if (given == unnamed) {
        given = static_cast<int32_t>(order.size());
        order.push_back(point);
      }
      point = given;
    }
  }
  std::vector<uint32_t> first(order.size() + 1, 0);
  std::vector<std::vector<Link>> kept(std::max<size_t>(1, team ? pieces_of(order.size()) : 1));
  const auto keep_some = [&](size_t piece, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      const size_t before = kept[piece].size();
      take_links(order[k], kept[piece]);
      first[k + 1] = static_cast<uint32_t>(kept[piece].size() - before);
    }
  };
  if (team)
    for_each_piece(*team, order.size(), keep_some);
  else
    keep_some(0, 0, order.size());
  for (size_t k = 0; k < order.size(); ++k) first[k + 1] += first[k];
  size_t own = 0;
  for (const CornerLight::OwnPoint& point : direct.own)
    if (number[static_cast<size_t>(point.number)] != unnamed)
      direct.own[own++] = {number[static_cast<size_t>(point.number)], point.x, point.y};
  direct.own.resize(own);
  std::sort(direct.own.begin(), direct.own.end(),
            [](const auto& a, const auto& b) { return a.number < b.number; });
  direct.links = team ? joined(*team, kept) : std::move(kept.front());
  direct.first = std::move(first);
}

}  // namespace hrad
