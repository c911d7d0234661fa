// The state of a solution between two stages: the hierarchy, its links, and the light on it.
// Floor 7 (stages).
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/memory_budget.h"
#include "hierarchy/forest.h"
#include "links/link_table.h"
#include "links/oracle.h"
#include "machine/thread_team.h"
#include "stages/leaf_points.h"
#include "stages/light_places.h"
#include "stages/link_journal.h"
#include "visibility/exposure.h"
#include "visibility/visibility.h"

namespace hrad {

// Light straight from bright emitters (linking=rows).
struct CornerLight {
  LinkTable mean;  // per node, of leaves: the mean over the leaf, from roots of emitters
  // What pictures and points are made of, linear between three points of a leaf
  // (Node::light_points). No point is shared by two surfaces. Empty in other linking methods, and
  // where means alone are wanted.
  LeafPoints of_leaf;
  std::vector<uint32_t> first;  // per point and one more: its run of links
  std::vector<Link> links;      // from roots of emitters
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
  // Per place of a node and band: the mean over the exposed part. And a few values more that don't
  // count, for whoever reads four at a time.
  static constexpr size_t floats_beyond = 4;
  LightPlaces places;
  GrowingArray<float> radiosity;
  // Likewise, but of own places; between gather() and push_pull() what the node's own links
  // brought.
  GrowingArray<float> irradiance;
  // Of a node that has a place.
  const float* radiosity_of(NodeId id) const { return &radiosity[values_before(id)]; }
  const float* irradiance_of(NodeId id) const { return &irradiance[values_before(id)]; }
  float* radiosity_of(NodeId id) { return &radiosity[values_before(id)]; }
  float* irradiance_of(NodeId id) { return &irradiance[values_before(id)]; }
  size_t values_before(NodeId id) const { return places[id] * static_cast<size_t>(bands); }
  // Room for light at all places; at new ones it is 0, or anything.
  void resize_light() {
    const size_t irradiance_before = irradiance.size(), radiosity_before = radiosity.size();
    resize_light_for_overwrite();
    for (size_t k = irradiance_before; k < irradiance.size(); ++k) irradiance[k] = 0;
    for (size_t k = std::max(radiosity_before, floats_beyond) - floats_beyond; k < radiosity.size();
         ++k)
      radiosity[k] = 0;
  }
  void resize_light_for_overwrite() {
    const size_t own = places.end_of_own() * static_cast<size_t>(bands);
    irradiance.reserve(own);  // not an eighth more, as it may be
    irradiance.resize_for_overwrite(own);
    const size_t values = places.count() * static_cast<size_t>(bands);
    radiosity.reserve(values + floats_beyond);
    radiosity.resize_for_overwrite(values + floats_beyond);
    for (size_t k = values; k < radiosity.size(); ++k) radiosity[k] = 0;
  }
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
  std::vector<float> spread;   // per node: largest deviation of a leaf's from the node's; empty
                               // where nobody wants to know
};

}  // namespace hrad
