// Lowest and highest row at every corner, plane by plane. Floor 7 (stages).
#include "stages/cell_contrast.h"

#include <algorithm>
#include <array>

#include "base/number_table.h"
#include "machine/pieces.h"
#include "stages/exchange.h"

namespace hrad {
namespace {

// Root mean square over a cell of what a step within it leaves, as a share of its height.
constexpr float error_of_a_step = 0.25f;
// Small planes are looked at together.
constexpr uint32_t cells_of_a_task = 256;

float light_of_row(const State& state, const Brightness& brightness, NodeId cell) {
  double sum = 0;
  for (const Link& link : state.links[cell].links())
    sum += static_cast<double>(link.weight) * brightness.of_node[link.source];
  return static_cast<float>(sum);
}

// Numbers of cells, those of each plane together.
struct CellsByPlane {
  std::vector<uint32_t> cells;
  std::vector<uint32_t> first;  // per plane with cells, and one more: of its cells
};

// Exposed cells on planes that hold an own surface: no others matter here.
CellsByPlane cells_by_plane(const State& state, const CornerNames& names,
                            const Exchange& exchange) {
  const Forest& forest = state.forest;
  const int32_t surfaces = static_cast<int32_t>(forest.surface_count());
  std::vector<uint8_t> matters(static_cast<size_t>(surfaces), 0);
  for (int32_t s = 0; s < surfaces; ++s)
    if (exchange.mine(s)) matters[names.plane(s)] = 1;
  std::vector<int32_t> plane(state.cells.size(), -1);
  std::vector<uint32_t> next(static_cast<size_t>(surfaces), 0);
  for (size_t k = 0; k < plane.size(); ++k) {
    const Node& node = forest.nodes[state.cells[k]];
    const int32_t its = names.plane(node.surface);
    if (!matters[its] || !(node.exposed > 0)) continue;
    plane[k] = its;
    ++next[its];
  }
  CellsByPlane result;
  uint32_t sum = 0;
  for (uint32_t& of_plane : next) {
    const uint32_t count = of_plane;
    if (count > 0) result.first.push_back(sum);
    of_plane = sum;
    sum += count;
  }
  result.first.push_back(sum);
  result.cells.resize(sum);
  for (size_t k = 0; k < plane.size(); ++k)
    if (plane[k] >= 0) result.cells[next[plane[k]]++] = static_cast<uint32_t>(k);
  return result;
}

// The planes of each task, from first[k] up to first[k + 1].
std::vector<uint32_t> planes_of_tasks(const CellsByPlane& planes) {
  std::vector<uint32_t> first{0};
  const uint32_t count = static_cast<uint32_t>(planes.first.size()) - 1;
  for (uint32_t plane = 0; plane < count; ++plane)
    if (planes.first[plane + 1] - planes.first[first.back()] >= cells_of_a_task)
      first.push_back(plane + 1);
  if (first.back() < count) first.push_back(count);
  return first;
}

// One plane after the other.
class Corners {
 public:
  Corners(const State& state, const CornerNames& names) : state_(state), names_(names) {}

  void measure(Span<const uint32_t> cells, const std::vector<float>& light,
               std::vector<float>& contrast) {
    number_.clear();
    range_.clear();
    touched_.clear();
    for (uint32_t k : cells) {
      touched_.push_back(touched_by(state_.forest.nodes[state_.cells[k]]));
      for (int32_t number : touched_.back()) {
        Range& range = range_[number];
        range.low = std::min(range.low, light[k]);
        range.high = std::max(range.high, light[k]);
      }
    }
    for (size_t at = 0; at < cells.size(); ++at)
      for (int32_t number : touched_[at]) {
        const Range& range = range_[number];
        float& largest = contrast[cells[at]];
        largest = std::max(largest, error_of_a_step * (range.high - range.low));
      }
  }

 private:
  struct Range {
    float low = 1e30f, high = -1e30f;
  };

  // A larger cell has the corners of smaller neighbours in the middles of its edges.
  std::array<int32_t, 6> touched_by(const Node& node) {
    LatticePoint corner[3];
    lattice_corners(node, corner);
    std::array<int32_t, 6> touched;
    for (int c = 0; c < 3; ++c) {
      touched[c] = number_of(node.surface, corner[c]);
      touched[3 + c] = number_of(node.surface, middle(corner[c], corner[(c + 1) % 3]));
    }
    return touched;
  }
  int32_t number_of(int32_t surface, LatticePoint point) {
    int32_t& number = number_.at(names_.name(surface, point));
    if (number == NumberTable::none) {
      number = static_cast<int32_t>(range_.size());
      range_.emplace_back();
    }
    return number;
  }

  const State& state_;
  const CornerNames& names_;
  NumberTable number_;
  std::vector<Range> range_;
  std::vector<std::array<int32_t, 6>> touched_;
};

}  // namespace

std::vector<float> contrast_of_cells(const State& state, const Brightness& brightness,
                                     const CornerNames& names, ThreadTeam& team,
                                     const Exchange& exchange) {
  const Forest& forest = state.forest;
  std::vector<float> light(state.cells.size(), 0.0f), contrast = light;
  for_each_thing(team, light.size(), [&](size_t k) {
    if (exchange.mine(forest.nodes[state.cells[k]].surface))
      light[k] = light_of_row(state, brightness, state.cells[k]);
  });
  exchange.share(light, [&](size_t k) { return forest.nodes[state.cells[k]].surface; });
  const CellsByPlane planes = cells_by_plane(state, names, exchange);
  const std::vector<uint32_t> first = planes_of_tasks(planes);
  team.for_each(static_cast<int64_t>(first.size()) - 1, [&](int64_t task, int) {
    Corners corners(state, names);
    for (uint32_t plane = first[task]; plane < first[task + 1]; ++plane) {
      const uint32_t begin = planes.first[plane], end = planes.first[plane + 1];
      corners.measure({&planes.cells[begin], end - begin}, light, contrast);
    }
  });
  return contrast;
}

}  // namespace hrad
