// Points put in the order of their names. Floor 7 (stages).
#include "stages/open_cubes.h"

#include <algorithm>

#include "stages/exchange.h"

namespace hrad {

int64_t open_cubes(LightGrid& grid, const std::vector<KeyedPoint>& own, const StageTools& tools) {
  std::vector<KeyedPoint> closed;
  for (const KeyedPoint& p : own)
    if (grid.is_closed(p.point)) closed.push_back(p);
  tools.exchange.unite(closed);
  if (closed.empty()) return 0;
  std::sort(closed.begin(), closed.end(), [](const KeyedPoint& a, const KeyedPoint& b) {
    return a.surface != b.surface ? a.surface < b.surface : a.key < b.key;
  });
  std::vector<OrientedPoint> points;
  for (const KeyedPoint& p : closed) points.push_back(p.point);
  return grid.open(points, tools.team, tools.exchange.comm());
}

}  // namespace hrad
