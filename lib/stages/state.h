// The state of a solution between two stages: the hierarchy, its links, and the light on it.
// Floor 7 (stages).
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/memory_budget.h"
#include "hierarchy/forest.h"
#include "links/link.h"
#include "links/oracle.h"
#include "machine/thread_team.h"
#include "visibility/exposure.h"
#include "visibility/visibility.h"

namespace hrad {

struct State {
  State(const Scene& scene) : forest(scene), bands(scene.bands) {}

  Forest forest;
  int bands;
  LinkTable links;                // per receiver
  std::vector<float> radiosity;   // per node and band: mean over the exposed part
  std::vector<float> irradiance;  // likewise
  std::vector<float> gathered;    // irradiance through the node's own links alone
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
  std::vector<double> unit;      // per band: 1 / root mean square irradiance; 0 for a dark band
  std::vector<float> of_node;    // per node
};

}  // namespace hrad
