// The state of a solution between two stages: the hierarchy, its links, and the light on it.
// Floor 7 (stages).
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/memory_budget.h"
#include "hierarchy/forest.h"
#include "links/link_table.h"
#include "links/oracle.h"
#include "machine/thread_team.h"
#include "stages/link_journal.h"
#include "visibility/exposure.h"
#include "visibility/visibility.h"

namespace hrad {

// Light straight from bright emitters (linking=rows).
struct CornerLight {
  LinkTable mean;  // per node, of leaves: the mean over the leaf, from roots of emitters
  // What pictures and points are made of, linear between three points of a leaf
  // (Node::light_points). Per node the numbers of these points in the order of Forest::triangle;
  // -1: the node has no direct light or is no leaf. No point is shared by two surfaces. Empty in
  // other linking methods, and where means alone are wanted.
  std::vector<std::array<int32_t, 3>> of_leaf;
  std::vector<uint32_t> first;  // per point and one more: its run of links
  std::vector<Link> links;      // from roots of emitters
  // The points that belong to one leaf alone, ascending, and where they lie in it.
  struct OwnPoint {
    int32_t number;
    float x, y;
  };
  std::vector<OwnPoint> own;
  Span<const Link> links_of_point(int32_t point) const {
    const size_t at = static_cast<size_t>(point);
    return {links.data() + first[at], static_cast<size_t>(first[at + 1] - first[at])};
  }
  size_t point_count() const { return first.empty() ? 0 : first.size() - 1; }
};

struct State {
  State(const Scene& scene) : forest(scene), bands(scene.bands) {}

  Forest forest;
  int bands;
  LinkTable links;            // per receiver
  std::vector<NodeId> cells;  // linking=rows: the elements that own rows, all surfaces covered
  CornerLight direct;
  std::vector<float> radiosity;   // per node and band: mean over the exposed part
  std::vector<float> irradiance;  // likewise; between gather() and push_pull() what the node's own
                                  // links brought
  int64_t rays = 0, pairs = 0;
  LinkJournal journal;  // of linking or a round of refinement that is under way
  // Within such a round: nodes from this one on are those that it has made so far; -1: there is
  // none. All before it, with their links, are as they were when it began.
  int64_t nodes_in_order = -1;
  bool divided_in_order(const Node& node) const {
    return node.first_child >= 0 && (nodes_in_order < 0 || node.first_child < nodes_in_order);
  }
  MemoryBudget memory;  // of scene, ray engine, elements and links
};

// Where the three points of its own lie in a leaf, nullptr: it has none.
inline const CornerLight::OwnPoint* own_points(const State& state, NodeId leaf) {
  if (state.forest.nodes[leaf].light_points != at_own_points) return nullptr;
  const CornerLight& direct = state.direct;
  const int32_t first = direct.of_leaf[leaf][0];
  const auto found = std::lower_bound(
      direct.own.begin(), direct.own.end(), first,
      [](const CornerLight::OwnPoint& p, int32_t number) { return p.number < number; });
  return found != direct.own.end() && found->number == first ? &*found : nullptr;
}

class Exchange;

// What every stage needs of its surroundings.
struct StageTools {
  ThreadTeam& team;
  Exchange& exchange;
  const VisibilityEngine& engine;
  const Exposure& exposure;
  OracleSettings oracle;
  // Told the share of the stage that is done; false asks to stop.
  std::function<bool(double fraction)> progress;

  // For a part of the stage, from one share of it to another. These tools must outlive that.
  StageTools of_part(double from, double to) const {
    StageTools part = *this;
    part.progress = [this, from, to](double share) { return progress(from + (to - from) * share); };
    return part;
  }
};

// How strongly each node shines, as one number: the largest band, each in units of the scene's own
// mean irradiance. What the oracle weighs links by.
struct Brightness {
  std::vector<double> unit;    // per band: 1 / root mean square irradiance; 0 for a dark band
  std::vector<float> of_node;  // per node
  std::vector<float> spread;   // per node: largest deviation of a leaf's from the node's
};

}  // namespace hrad
