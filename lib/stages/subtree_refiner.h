// Refinement of the links of one receiver subtree: the work of one task. Floor 7 (stages).
#pragma once

#include <vector>

#include "stages/state.h"

namespace hrad {

// An element of the subtree as the task sees it: an old one, or one it has just made.
struct SubtreeNode {
  Node place;
  NodeId old_id = -1;          // -1: new
  int32_t parent = -1;         // index into SubtreeResult::nodes
  int32_t first_child = -1;    // likewise
  std::vector<Link> run;       // its links after the round
  std::vector<Link> arriving;  // for a child handed on: links that came down to it
};

struct SubtreeResult {
  std::vector<SubtreeNode> nodes;  // the task's root first, parents before children
  bool handed_on = false;          // the root's children are tasks of the next pass
  int64_t rays = 0;
};

class SubtreeRefiner {
 public:
  SubtreeRefiner(const State& state, const StageTools& tools, const Brightness& brightness)
      : state_(state),
        tools_(tools),
        brightness_(brightness),
        sampler_(state.forest, tools.engine, tools.exposure, tools.oracle.seed,
                 tools.oracle.near_ratio) {}

  // Refines `arriving` and the old links of `root` and below. hand_on: only the root's own links;
  // its children get theirs in SubtreeNode::arriving.
  SubtreeResult refine(NodeId root, Span<const Link> arriving, bool hand_on);

 private:
  struct Work {
    Element element;
    uint64_t key = 0;
    bool known = false;
    std::vector<Link> out;
  };

  int32_t add(const Node& place, NodeId old_id, int32_t parent);
  void adopt_children(int32_t at);
  void make_children(int32_t at);
  const Element& element(int32_t at);
  void weigh(int32_t at, Link link);
  void weigh_known(int32_t at, Link link, const Element& source, const LinkEstimate& estimate);
  void split(int32_t at, const Element& source, Link link, double visible);
  void descend(int32_t at, Link link, double visible);
  LinkLoad load_of(int32_t at, const Link& link, double source_area) const;
  LinkEstimate traced(int32_t at, const Element& source, uint64_t source_key, NodeId source_id,
                      DrawnPairs& drawn, LinkEstimate begun);

  const State& state_;
  const StageTools& tools_;
  const Brightness& brightness_;
  LinkSampler sampler_;
  SubtreeResult result_;
  std::vector<Work> work_;  // beside result_.nodes
  bool hand_on_ = false;
};

}  // namespace hrad
