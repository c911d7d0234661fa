// The state of a solution between two stages: the hierarchy, its links, and the light on it.
// Floor 7 (stages).
#pragma once

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
#include "visibility/exposure.h"
#include "visibility/visibility.h"

namespace hrad {

// Light straight from bright emitters (linking=rows), known at the corners of the leaves and linear
// between them. No corner is shared by two surfaces.
struct CornerLight {
  // Per node the numbers of its corners, or of the points half way from them to the middle
  // (Node::half_way), in the order of Forest::triangle; -1: a corner without
  // light of its own, sealed, or a node that is no leaf. Empty in other linking methods.
  std::vector<std::array<int32_t, 3>> of_leaf;
  std::vector<uint32_t> first;  // per corner and one more: its run of links
  std::vector<Link> links;      // from roots of emitters
  std::vector<Vec3> place;      // per corner: where it was sampled; empty once rows are traced
  size_t corner_count() const { return first.empty() ? 0 : first.size() - 1; }
};

// Mean of values at the corners of a leaf (per corner and band), one band; sealed ones have none.
inline double mean_of_corners(const CornerLight& direct, const std::vector<float>& values,
                              NodeId leaf, int band, int bands) {
  double sum = 0;
  int count = 0;
  for (int32_t corner : direct.of_leaf[leaf]) {
    if (corner < 0) continue;
    sum += values[static_cast<size_t>(corner) * bands + band];
    ++count;
  }
  return count ? sum / count : 0;
}

struct State {
  State(const Scene& scene) : forest(scene), bands(scene.bands) {}

  Forest forest;
  int bands;
  LinkTable links;            // per receiver
  std::vector<NodeId> cells;  // linking=rows: the elements that own rows, all surfaces covered
  CornerLight direct;
  std::vector<float> radiosity;   // per node and band: mean over the exposed part
  std::vector<float> irradiance;  // likewise; between gather() and push_pull() what the node's own
                                  // links and corners brought
  int64_t rays = 0, pairs = 0;
  MemoryBudget memory;  // of scene, ray engine, elements and links
};

// What every stage needs of its surroundings.
struct StageTools {
  ThreadTeam& team;
  const VisibilityEngine& engine;
  const Exposure& exposure;
  OracleSettings oracle;
  // Told the share of the stage that is done; false asks to stop.
  std::function<bool(double fraction)> progress;
};

// How strongly each node shines, as one number: the largest band, each in units of the scene's own
// mean irradiance. What the oracle weighs links by.
struct Brightness {
  std::vector<double> unit;    // per band: 1 / root mean square irradiance; 0 for a dark band
  std::vector<float> of_node;  // per node
  std::vector<float> spread;   // per node: largest deviation of a leaf's from the node's
};

}  // namespace hrad
