// Refinement of the links of one receiving cluster: the work of one task. Floor 7 (stages).
#pragma once

#include <vector>

#include "stages/light_of_all.h"
#include "stages/state.h"

namespace hrad {

struct ClusterResult {
  std::vector<Link> run;     // the cluster's links after the round
  std::vector<NodeId> down;  // sources that its two children have yet to meet
  int64_t rays = 0;
};

class ClusterRefiner {
 public:
  ClusterRefiner(const State& state, const StageTools& tools, const Brightness& brightness,
                 const LightOfAll& radiosity, const EndPointsTable& points)
      : state_(state),
        points_(points),
        tools_(tools),
        brightness_(brightness),
        radiosity_(radiosity),
        sampler_(state.forest, tools.engine, tools.exposure, tools.oracle.seed,
                 tools.oracle.near_ratio) {}

  // Refines the old links of the cluster, and links it with the sources of `met`, which came down
  // from above.
  ClusterResult refine(NodeId cluster, Span<const NodeId> met);

 private:
  Element end_of(NodeId id) const;
  void meet(NodeId source_id);
  void weigh(Link link);
  void descend(NodeId source_id);
  LinkLoad load_of(NodeId source_id, const Element& source, double weight) const;
  Decision judge(const LinkLoad& load, const LinkEstimate& estimate, const Element& source) const;
  void follow(Decision decision, Link link);

  const State& state_;
  const EndPointsTable& points_;
  const StageTools& tools_;
  const Brightness& brightness_;
  const LightOfAll& radiosity_;
  LinkSampler sampler_;
  Element receiver_;
  uint64_t key_ = 0;
  ClusterResult result_;
};

}  // namespace hrad
