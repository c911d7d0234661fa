// The cells of the mesh, and new elements. Floor 7 (stages).
#include <algorithm>
#include <cmath>
#include <utility>

#include "machine/pieces.h"
#include "stages/cell_contrast.h"
#include "stages/exchange.h"
#include "stages/exposed_shares.h"
#include "stages/row_mesh.h"

namespace hrad {
namespace {

// An edge over the root of the area of a cell, at the most: that of half a square has this. A pole
// is narrow, and yet the light on it varies from end to end.
constexpr double longest_edge = 2;
// Levels of narrow patches for the sake of their length, as far as those add no more cells than
// there are anyway, or so many.
constexpr int most_levels_of_length = 3;
constexpr double cells_of_length = 20000;

double square_of_longest_edge(const Triangle& t) {
  double largest = 0;
  for (const Vec3& edge : {t.b - t.a, t.c - t.b, t.a - t.c})
    largest = std::max(largest, dot(edge, edge));
  return largest;
}

}  // namespace

// Children of leaves, in the order of these; returns the first.
NodeId RowMesh::add_children(const std::vector<NodeId>& parents) {
  const size_t first = forest_.nodes.size();
  require_numbers(first + 4 * parents.size());
  forest_.nodes.resize(first + 4 * parents.size());
  for_each_thing(tools_.team, parents.size(), [&](size_t k) {
    forest_.nodes.adopt(parents[k], static_cast<NodeId>(first + 4 * k));
  });
  return static_cast<NodeId>(first);
}

bool RowMesh::measure_exposure(NodeId from) {
  const std::vector<NodeId> partly =
      gathered<NodeId>(tools_.team, forest_.nodes.size() - static_cast<size_t>(from),
                       [&](size_t k, std::vector<NodeId>& some) {
                         const NodeId id = from + static_cast<NodeId>(k);
                         const float exposed = forest_.nodes[id].exposed;
                         if (exposed > 0 && exposed < 1) some.push_back(id);
                       });
  return hrad::measure_exposure(state_, tools_, partly);
}

bool RowMesh::is_too_long(const Node& node) const {
  return square_of_longest_edge(forest_.triangle(node)) >
         longest_edge * longest_edge * settings_.cell_area;
}

// Down to which narrow elements are divided because they are long.
int RowMesh::levels_of_length() const {
  double cells = 0, longer[most_levels_of_length] = {};  // by each level
  for (NodeId root = 0; root < forest_.surface_count(); ++root) {
    const double area = forest_.surfaces[root].area / settings_.cell_area;
    cells += std::max(1.0, area);
    const double square = square_of_longest_edge(forest_.root_triangle(root)) / settings_.cell_area;
    double parts = 1;
    for (double& added : longer) {
      if (area <= parts && square > longest_edge * longest_edge * parts) added += 3 * parts;
      parts *= 4;
    }
  }
  int levels = 0;
  double added = 0;
  while (levels < most_levels_of_length &&
         (added += longer[levels]) <= std::max(cells, cells_of_length))
    ++levels;
  return levels;
}

// Level by level.
bool RowMesh::make_cells() {
  const int levels = levels_of_length();
  const auto is_too_large = [&](const Node& node) {
    return node.level < max_level &&
           (forest_.area(node) > settings_.cell_area || (node.level < levels && is_too_long(node)));
  };
  size_t from = 0;
  while (from < forest_.nodes.size()) {
    const size_t end = forest_.nodes.size();
    const auto those = [&](bool large) {
      return gathered<NodeId>(tools_.team, end - from, [&](size_t k, std::vector<NodeId>& some) {
        const Node& node = forest_.nodes[from + k];
        if (!Forest::is_cluster(node) && is_too_large(node) == large)
          some.push_back(static_cast<NodeId>(from + k));
      });
    };
    const std::vector<NodeId> cells = those(false);
    state_.cells.insert(state_.cells.end(), cells.begin(), cells.end());
    add_children(those(true));
    if (!measure_exposure(static_cast<NodeId>(end))) return false;
    memory_.settle();
    from = end;
  }
  return true;
}

std::vector<NodeId> RowMesh::exposed_of(const std::vector<NodeId>& elements) const {
  return gathered<NodeId>(tools_.team, elements.size(), [&](size_t k, std::vector<NodeId>& some) {
    if (forest_.nodes[elements[k]].exposed > 0) some.push_back(elements[k]);
  });
}

// Per cell, whether it is to be divided: for all to know.
std::vector<uint8_t> RowMesh::uneven_cells(const Brightness& brightness) {
  if (!names_) names_ = std::make_unique<CornerNames>(forest_);
  const std::vector<float> contrast =
      contrast_of_cells(state_, brightness, *names_, tools_.team, tools_.exchange);
  std::vector<uint8_t> divide(state_.cells.size(), 0);
  for_each_thing(tools_.team, divide.size(), [&](size_t k) {
    if (!is_mine(state_.cells[k])) return;
    const Node& node = forest_.nodes[state_.cells[k]];
    const double area = forest_.area(node);
    divide[k] = area >= 4 * settings_.least_cell_area && node.level < max_level &&
                contrast[k] * std::sqrt(area / settings_.cell_area) > settings_.contrast;
  });
  tools_.exchange.share_marks(divide);
  return divide;
}

// Gives children to these leaves, and asks for the light that they have to know.
void RowMesh::divide_leaves(const std::vector<NodeId>& leaves) {
  const NodeId first = add_children(leaves);
  if (settings_.means_only) return;
  corners_.want(gathered<ElementPoints>(
      tools_.team, leaves.size(), [&](size_t k, std::vector<ElementPoints>& wanted) {
        if (!is_mine(leaves[k])) return;
        if (forest_.nodes[leaves[k]].light_points == half_way_to_the_middle) {
          const NodeId child = first + 4 * static_cast<NodeId>(k);
          for (NodeId id = child; id < child + 4; ++id) {
            forest_.nodes.set_light_points(id, half_way_to_the_middle);
            wanted.push_back({id, PointsOf::half_way_to_the_middle});
          }
        } else {
          wanted.push_back({leaves[k], PointsOf::corners});
          wanted.push_back({leaves[k], PointsOf::middles_of_edges});
        }
      }));
}

// By their children, all in ascending order.
void RowMesh::replace_cells(const std::vector<NodeId>& divided, std::vector<NodeId>& new_cells) {
  enum : uint8_t { no_cell, old_cell, new_cell };
  std::vector<uint8_t> kind(forest_.nodes.size(), no_cell);
  for_each_thing(tools_.team, state_.cells.size(),
                 [&](size_t k) { kind[static_cast<size_t>(state_.cells[k])] = old_cell; });
  for_each_thing(tools_.team, divided.size(), [&](size_t k) {
    kind[static_cast<size_t>(divided[k])] = no_cell;
    std::fill_n(&kind[static_cast<size_t>(forest_.nodes[divided[k]].first_child)], 4, new_cell);
  });
  const auto all_from = [&](uint8_t least) {
    return gathered<NodeId>(tools_.team, kind.size(), [&](size_t k, std::vector<NodeId>& some) {
      if (kind[k] >= least) some.push_back(static_cast<NodeId>(k));
    });
  };
  state_.cells = all_from(old_cell);
  new_cells = all_from(new_cell);
}

bool RowMesh::divide_cells(const Brightness& brightness, std::vector<NodeId>& new_cells) {
  const std::vector<uint8_t> divide = uneven_cells(brightness);
  const std::vector<NodeId> divided =
      gathered<NodeId>(tools_.team, divide.size(), [&](size_t k, std::vector<NodeId>& some) {
        if (divide[k]) some.push_back(state_.cells[k]);
      });
  const std::vector<NodeId> leaves =
      gathered<NodeId>(tools_.team, divided.size(), [&](size_t k, std::vector<NodeId>& some) {
        if (forest_.is_leaf(divided[k])) some.push_back(divided[k]);
      });
  const NodeId end = static_cast<NodeId>(forest_.nodes.size());
  divide_leaves(leaves);
  if (!sample_corners()) return false;
  if (!measure_exposure(end)) return false;
  replace_cells(divided, new_cells);
  state_.links.replace(
      gathered<LinkTable::NewRun>(tools_.team, divided.size(),
                                  [&](size_t k, std::vector<LinkTable::NewRun>& dropped) {
                                    dropped.push_back({divided[k], {}});
                                  }),
      &tools_.team);
  return name_leaves();
}

}  // namespace hrad
