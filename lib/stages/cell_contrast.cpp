// Lowest and highest row at every corner: of those on the borders of surfaces plane by plane, of
// the rest surface by surface. Floor 7 (stages).
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
// Small planes and surfaces are looked at together.
constexpr uint32_t cells_of_a_task = 256;

constexpr int points_of_a_cell = 6;
using Points = std::array<LatticePoint, points_of_a_cell>;

// A larger cell has the corners of smaller neighbours in the middles of its edges.
Points points_of(const Node& node) {
  LatticePoint corner[3];
  lattice_corners(node, corner);
  Points points;
  for (int c = 0; c < 3; ++c) {
    points[c] = corner[c];
    points[3 + c] = middle(corner[c], corner[(c + 1) % 3]);
  }
  return points;
}

// Of its surface: other surfaces may have the point, too.
bool is_on_the_border(LatticePoint p) { return p.i == 0 || p.j == 0 || p.i + p.j == lattice_size; }

float light_of_row(const State& state, const Brightness& brightness, NodeId cell) {
  double sum = 0;
  for (const Link& link : state.links[cell].links())
    sum += static_cast<double>(link.weight) * brightness.of_node[link.source];
  return static_cast<float>(sum);
}

// Numbers of cells, those of each group together.
struct CellsByGroup {
  std::vector<uint32_t> cells;
  std::vector<uint32_t> first;  // per group with cells, and one more: of its cells
};

// group_of(surface): its group is that of another surface, or its own; -1: it doesn't matter.
template <class GroupOf>
CellsByGroup group_cells(const State& state, ThreadTeam& team, const GroupOf& group_of) {
  const Forest& forest = state.forest;
  std::vector<int32_t> group(state.cells.size());
  for_each_thing(team, group.size(), [&](size_t k) {
    const Node& node = forest.nodes[state.cells[k]];
    group[k] = node.exposed > 0 ? group_of(node.surface) : -1;
  });
  std::vector<uint32_t> next(static_cast<size_t>(forest.surface_count()), 0);
  for (int32_t its : group)
    if (its >= 0) ++next[its];
  CellsByGroup result;
  uint32_t sum = 0;
  for (uint32_t& of_group : next) {
    const uint32_t count = of_group;
    if (count > 0) result.first.push_back(sum);
    of_group = sum;
    sum += count;
  }
  result.first.push_back(sum);
  result.cells.resize(sum);
  for (size_t k = 0; k < group.size(); ++k)
    if (group[k] >= 0) result.cells[next[group[k]]++] = static_cast<uint32_t>(k);
  return result;
}

// The groups of each task, from first[k] up to first[k + 1].
std::vector<uint32_t> groups_of_tasks(const CellsByGroup& groups) {
  std::vector<uint32_t> first{0};
  const uint32_t count = static_cast<uint32_t>(groups.first.size()) - 1;
  for (uint32_t group = 0; group < count; ++group)
    if (groups.first[group + 1] - groups.first[first.back()] >= cells_of_a_task)
      first.push_back(group + 1);
  if (first.back() < count) first.push_back(count);
  return first;
}

// One group after the other, at its points on borders or at the rest of them.
class Corners {
 public:
  Corners(const State& state, const CornerNames& names, bool on_borders)
      : state_(state), names_(names), on_borders_(on_borders) {}

  void measure(Span<const uint32_t> cells, const std::vector<float>& light,
               std::vector<float>& contrast) {
    number_.clear();
    range_.clear();
    touched_.clear();
    for (uint32_t k : cells) {
      const Node& node = state_.forest.nodes[state_.cells[k]];
      for (const LatticePoint& point : points_of(node)) {
        if (is_on_the_border(point) != on_borders_) continue;
        const int32_t number = number_of(node.surface, point);
        touched_.push_back({k, number});
        Range& range = range_[number];
        range.low = std::min(range.low, light[k]);
        range.high = std::max(range.high, light[k]);
      }
    }
    for (const Touched& touched : touched_) {
      const Range& range = range_[touched.number];
      float& largest = contrast[touched.cell];
      largest = std::max(largest, error_of_a_step * (range.high - range.low));
    }
  }

 private:
  struct Range {
    float low = 1e30f, high = -1e30f;
  };
  struct Touched {
    uint32_t cell;
    int32_t number;
  };

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
  const bool on_borders_;
  NumberTable number_;
  std::vector<Range> range_;
  std::vector<Touched> touched_;
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
  exchange.share(
      light, [&](size_t k) { return forest.nodes[state.cells[k]].surface; }, team);
  const auto measure = [&](const CellsByGroup& groups, bool on_borders) {
    const std::vector<uint32_t> first = groups_of_tasks(groups);
    team.for_each(static_cast<int64_t>(first.size()) - 1, [&](int64_t task, int) {
      Corners corners(state, names, on_borders);
      for (uint32_t group = first[task]; group < first[task + 1]; ++group) {
        const uint32_t begin = groups.first[group], end = groups.first[group + 1];
        corners.measure({&groups.cells[begin], end - begin}, light, contrast);
      }
    });
  };
  std::vector<uint8_t> matters(static_cast<size_t>(forest.surface_count()), 0);  // planes
  for (int32_t s = 0; s < static_cast<int32_t>(matters.size()); ++s)
    if (exchange.mine(s)) matters[names.plane(s)] = 1;
  measure(group_cells(state, team,
                      [&](int32_t s) { return matters[names.plane(s)] ? names.plane(s) : -1; }),
          true);
  measure(group_cells(state, team, [&](int32_t s) { return exchange.mine(s) ? s : -1; }), false);
  return contrast;
}

}  // namespace hrad
