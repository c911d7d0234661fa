// One walk over the leaves. Floor 7 (stages).
#include "stages/point_numbers.h"

#include <algorithm>
#include <utility>

namespace hrad {

void number_points_by_leaves(CornerLight& direct, const std::function<bool(NodeId leaf)>& keep_leaf,
                             const std::function<bool(int32_t point, const Link&)>& keep_link) {
  constexpr int32_t unnamed = -1;
  std::vector<int32_t> number(direct.point_count(), unnamed), order;
  for (size_t id = 0; id < direct.of_leaf.size(); ++id) {
    auto& points = direct.of_leaf[id];
    if (points[0] < 0) continue;
    if (!keep_leaf(static_cast<NodeId>(id))) {
      points = {-1, -1, -1};
      continue;
    }
    for (int32_t& point : points) {
      int32_t& given = number[static_cast<size_t>(point)];
      if (given == unnamed) {
        given = static_cast<int32_t>(order.size());
        order.push_back(point);
      }
      point = given;
    }
  }
  std::vector<Link> links;
  std::vector<uint32_t> first(1, 0);
  for (int32_t point : order) {
    for (const Link& link : direct.links_of_point(point))
      if (keep_link(point, link)) links.push_back(link);
    first.push_back(static_cast<uint32_t>(links.size()));
  }
  size_t own = 0;
  for (const CornerLight::OwnPoint& point : direct.own)
    if (number[static_cast<size_t>(point.number)] != unnamed)
      direct.own[own++] = {number[static_cast<size_t>(point.number)], point.x, point.y};
  direct.own.resize(own);
  std::sort(direct.own.begin(), direct.own.end(),
            [](const auto& a, const auto& b) { return a.number < b.number; });
  direct.links = std::move(links);
  direct.first = std::move(first);
}

}  // namespace hrad
