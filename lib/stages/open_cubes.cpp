// Points put in the order of their names; what a cube has found is kept in the journal. Floor 7
// (stages).
#include "stages/open_cubes.h"

#include <algorithm>

#include "machine/pieces.h"
#include "stages/exchange.h"

namespace hrad {
namespace {

using Opened = LightGrid::Opened;

// An emitter and whether it is hidden, as one number.
void put_cube(const Opened& cube, Bytes& bytes) {
  put(bytes, &cube.rays, 1);
  std::vector<uint32_t> codes;
  for (const LightGrid::Candidate& c : cube.candidates)
    codes.push_back(static_cast<uint32_t>(c.emitter) << 1 | (c.hidden ? 1 : 0));
  put_list(bytes, codes);
}

// Ascending, of so many emitters. False: it is no such result.
bool take_cube(KnownResult& known, size_t emitters, Opened& cube) {
  int64_t rays = 0;
  std::vector<uint32_t> codes;
  if (!known.take(&rays, 1) || !is_count(rays) || !known.take_list(codes) || !known.at_end())
    return false;
  for (size_t k = 0; k < codes.size(); ++k)
    if (codes[k] >> 1 >= emitters || (k > 0 && codes[k] >> 1 <= codes[k - 1] >> 1)) return false;
  cube.rays = rays;
  for (uint32_t code : codes)
    cube.candidates.push_back({static_cast<int32_t>(code >> 1), (code & 1) != 0});
  return true;
}

}  // namespace

bool open_cubes(LightGrid& grid, const std::vector<OrientedPoint>& points, State& state,
                const StageTools& tools) {
  const size_t emitters = grid.emitters().all().size();
  const auto opener = [&](std::vector<Opened>& cubes, const std::function<void(size_t)>& find) {
    return state.journal.next_pass_of(
        tools.team, cubes.size(),
        {[&](size_t k) { return cubes[k].name; },
         [&](size_t k, KnownResult& known) { return take_cube(known, emitters, cubes[k]); },
         [&](size_t k, int) { find(k); },
         [&](size_t k, Bytes& bytes) { put_cube(cubes[k], bytes); }},
        [&](int64_t) { return tools.progress(0); });
  };
  return grid.open(points, tools.team, tools.exchange.comm(), opener, state.rays);
}

bool open_cubes(LightGrid& grid, size_t count, const std::function<KeyedPoint(size_t)>& own,
                State& state, const StageTools& tools) {
  std::vector<KeyedPoint> closed =
      gathered<KeyedPoint>(tools.team, count, [&](size_t k, std::vector<KeyedPoint>& found) {
        const KeyedPoint point = own(k);
        if (grid.is_closed(point.point)) found.push_back(point);
      });
  tools.exchange.unite(closed);
  if (closed.empty()) return true;
  std::sort(closed.begin(), closed.end(), [](const KeyedPoint& a, const KeyedPoint& b) {
    return a.surface != b.surface ? a.surface < b.surface : a.key < b.key;
  });
  std::vector<OrientedPoint> points;
  for (const KeyedPoint& p : closed) points.push_back(p.point);
  return open_cubes(grid, points, state, tools);
}

}  // namespace hrad
