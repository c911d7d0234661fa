// Links between pairs of surfaces: form factors and visible fractions of one surface with a stretch
// of later ones, the work of one task. Floor 7 (stages).
#pragma once

#include <functional>
#include <vector>

#include "stages/facing_table.h"
#include "stages/pair_record.h"
#include "stages/state.h"

namespace hrad {

class PairLinker {
 public:
  PairLinker(const State& state, const StageTools& tools, const Brightness& brightness);

  const FacingTable& facing() const { return facing_; }

  // Those pairs of the task that are wanted, but for the known ones; found in the order of the
  // latter surfaces.
  PairsFound link(const PairTask& task, const std::function<bool(NodeId)>& wanted,
                  const Partners& known, LinkSampler& sampler) const;

 private:
  // Up to four dim pairs that share a packet, four rays each.
  struct Bundle {
    int count = 0;
    NodeId other[4];
    DrawnPairs drawn[4];
    LinkEstimate estimate[4];
  };

  LinkLoad load_of(NodeId p, NodeId q, double factor) const;
  void estimate(NodeId p, NodeId q, LinkSampler& sampler, Bundle& bundle,
                std::vector<Reciprocal>& found) const;
  void flush(NodeId p, LinkSampler& sampler, Bundle& bundle, std::vector<Reciprocal>& found) const;
  void keep(NodeId p, NodeId q, const LinkEstimate& e, std::vector<Reciprocal>& found) const;

  const StageTools& tools_;
  const Brightness& brightness_;
  std::vector<Element> roots_;
  std::vector<uint64_t> keys_;
  FacingTable facing_;
};

}  // namespace hrad
