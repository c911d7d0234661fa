// Spots: leaves that are far brighter than the scene is on the mean, without being emitters, as the
// inside of a lamp. Few rays of a row would meet one, and each would bring much too much. So rays
// leave from the spot instead, as many as its power is worth, and each that arrives at a cell
// brings it the same (reciprocity of form factors: A_i F_ij = A_j F_ji). Floor 7 (stages).
#pragma once

#include <vector>

#include "links/emitters.h"
#include "stages/rows.h"
#include "stages/state_memory.h"

namespace hrad {

class BrightSpots {
 public:
  // brightness: of the nodes that there were when it was measured, the first ones. state must
  // outlive this, and have the same elements until then.
  BrightSpots(const State& state, const StageTools& tools, const RowSettings& settings,
              const Brightness& brightness, const Emitters& emitters);

  // Whether light from this leaf to this cell comes by rays from the leaf, not by those of the row:
  // a matter of what they are, not of what was traced.
  bool sends_to(NodeId leaf, NodeId cell) const;

  // Sends the rays of all spots out to these cells. False: stopped.
  bool trace(State& state, const StageTools& tools, const std::vector<NodeId>& cells,
             StageMemory& memory);
  // About how many rays that are.
  double rays() const;
  // What arrived at the k-th of these cells, which is this process's own, by source.
  Span<const Link> links_to(size_t k) const {
    if (first_.empty()) return {};
    return {links_.data() + first_[k], first_[k + 1] - first_[k]};
  }

 private:
  struct Arrival {
    int32_t cell;  // which of those that are traced for
    Link link;
  };
  NodeId cell_around(NodeId leaf) const;
  void send(const StageTools& tools, NodeId spot, std::vector<Link>& met) const;
  bool take(KnownResult& known, std::vector<Link>& met) const;
  void deal_out(std::vector<Arrival>& arrivals, size_t cells);
  double exposed_area(NodeId id) const;

  const State& state_;
  const uint64_t seed_;
  const RowSettings settings_;
  std::vector<NodeId> spots_;
  std::vector<int32_t> rays_;     // per node, of spots; empty: there are none
  std::vector<int32_t> cell_of_;  // per node, -1: not one of those that are traced for
  std::vector<size_t> first_;     // per cell and one more
  std::vector<Link> links_;
};

}  // namespace hrad
