// Refinement of the links of one receiver subtree: the work of one task. Floor 7 (stages).
#pragma once

#include <memory>
#include <vector>

#include "stages/light_of_all.h"
#include "stages/state.h"

namespace hrad {

// An element of the subtree as the task sees it: an old one, or one it has just made.
struct SubtreeNode {
  Node place;
  NodeId old_id = -1;        // -1: new
  int32_t parent = -1;       // index into SubtreeResult::nodes
  int32_t first_child = -1;  // likewise
  std::vector<Link> run;     // its links after the round
  // For a child handed on: links that came down to it, and sources that it is yet to meet.
  std::vector<Link> arriving;
  std::vector<NodeId> meeting;
};

struct SubtreeResult {
  std::vector<SubtreeNode> nodes;  // the task's root first, parents before children
  bool handed_on = false;          // the root's children are tasks of the next pass
  int64_t rays = 0;
};

int64_t bytes_of(const SubtreeResult& result);

class SubtreeRefiner {
 public:
  // points: of the ends in the present state, where there are clusters.
  SubtreeRefiner(const State& state, const StageTools& tools, const Brightness& brightness,
                 const LightOfAll& radiosity, const EndPointsTable* points = nullptr)
      : state_(state),
        points_(points),
        tools_(tools),
        brightness_(brightness),
        radiosity_(radiosity),
        sampler_(state.forest, tools.engine, tools.exposure, tools.oracle.seed,
                 tools.oracle.near_ratio) {}

  // Refines `arriving` and the old links of `root` and below, and links `root` with the sources of
  // `met`, which came down from the clusters above. hand_on: only the root's own links; its
  // children get theirs in SubtreeNode::arriving.
  SubtreeResult refine(NodeId root, Span<const Link> arriving, Span<const NodeId> met,
                       bool hand_on);

 private:
  struct Work {
    Element element;
    std::unique_ptr<EndPoints> points;
    uint64_t key = 0;
    bool known = false;
    std::vector<Link> out;
    std::vector<float> seen;  // beside out: visible share, 1 where it doesn't matter
    double uneven = 0;        // sum of the kept links' light times deviation of its visibility
  };

  int32_t add(const Node& place, NodeId old_id, int32_t parent);
  void adopt_children(int32_t at);
  void make_children(int32_t at);
  const Element& element(int32_t at);
  void weigh(int32_t at, Link link);
  void weigh_known(int32_t at, Link link, const Element& source, const LinkEstimate& estimate);
  Decision judge(int32_t at, const LinkLoad& load, const Element& source,
                 const LinkEstimate& estimate);
  void follow(Decision decision, int32_t at, Link link, const Element& source,
              const LinkEstimate& estimate);
  bool refined_unseen(int32_t at, NodeId id, const Element& source, const LinkEstimate& estimate);
  void keep(int32_t at, Link link, double seen = 1);
  void split_uneven(int32_t at);
  void add_quarters(int32_t at, NodeId source, double quarter[4]);
  void split(int32_t at, const Element& source, Link link, double visible);
  void descend(int32_t at, Link link, double visible);
  void meet(int32_t at, NodeId source, double visible);
  LinkLoad load_of(int32_t at, const Link& link, double source_area) const;
  Element source_of(NodeId id) const;
  double allowed_of(int32_t at, NodeId source) const;
  LinkEstimate traced(int32_t at, const Element& source, uint64_t source_key, NodeId source_id,
                      DrawnPairs& drawn, LinkEstimate begun);

  const State& state_;
  const EndPointsTable* points_;
  const StageTools& tools_;
  const Brightness& brightness_;
  const LightOfAll& radiosity_;
  LinkSampler sampler_;
  SubtreeResult result_;
  std::vector<Work> work_;  // beside result_.nodes
  bool hand_on_ = false;
};

}  // namespace hrad
