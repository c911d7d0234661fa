// Points put in the order of their names. Floor 7 (stages).
#include "stages/open_cubes.h"

#include <algorithm>
#include <vector>

#include "machine/pieces.h"
#include "stages/exchange.h"

namespace hrad {

int64_t open_cubes(LightGrid& grid, size_t count, const std::function<KeyedPoint(size_t)>& own,
                   const StageTools& tools) {
  std::vector<KeyedPoint> closed =
      gathered<KeyedPoint>(tools.team, count, [&](size_t k, std::vector<KeyedPoint>& found) {
        const KeyedPoint point = own(k);
        if (grid.is_closed(point.point)) found.push_back(point);
      });
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
