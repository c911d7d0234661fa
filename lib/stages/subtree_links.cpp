// Weighing links within one subtree: splitting receivers, descending sources. Floor 7 (stages).
#include <algorithm>

#include "links/cluster_ends.h"
#include "stages/subtree_refiner.h"

namespace hrad {
namespace {

// A link this well seen is taken to be seen whole until a ray says otherwise.
constexpr double clear_view = 0.999;

}  // namespace

Decision SubtreeRefiner::judge(int32_t at, const LinkLoad& load, const Element& source,
                               const LinkEstimate& estimate) {
  if (!estimate.by_points && surely_good(tools_.oracle, load)) return Decision::keep;
  if (tools_.oracle.kind == OracleKind::energy) return judge_energy(tools_.oracle, load);
  if (points_) return judge_with_clusters(tools_.oracle, load, estimate, element(at), source);
  const double distance = length(source.centroid - element(at).centroid);
  const double size = element(at).radius + source.radius;
  return judge_error(tools_.oracle, load, estimate, distance > 0 ? size / distance : 1);
}

void SubtreeRefiner::follow(Decision decision, int32_t at, Link link, const Element& source,
                            const LinkEstimate& estimate) {
  const double visible = estimate.factor > 0 ? std::min(1.0, link.weight / estimate.factor) : 0;
  if (decision == Decision::split_receiver)
    split(at, source, link, visible);
  else
    descend(at, link, visible);
}

// What would be too coarse even if all of it were seen needs no rays.
bool SubtreeRefiner::refined_unseen(int32_t at, NodeId id, const Element& source,
                                    const LinkEstimate& estimate) {
  if (!estimate.by_points) return false;
  const Link whole{id, static_cast<float>(estimate.factor)};
  const Decision decision = judge(at, load_of(at, whole, source.area), source, estimate);
  if (decision == Decision::keep) return false;
  if (hand_on_ && at > 0) {  // a later task's
    result_.nodes[static_cast<size_t>(at)].meeting.push_back(id);
    return true;
  }
  LinkEstimate unseen = estimate;
  unseen.factor = 0;
  follow(decision, at, whole, source, unseen);
  return true;
}

void SubtreeRefiner::split(int32_t at, const Element& source, Link link, double visible) {
  make_children(at);
  const int32_t first = result_.nodes[at].first_child;
  const uint64_t source_key = key_of(state_.forest, state_.forest.nodes[link.source]);
  DrawnPairs drawn[4];
  LinkEstimate estimate[4];
  bool any = false;
  for (int child = 0; child < 4; ++child) {
    const Element& receiver = element(first + child);
    if (receiver.exposed <= 0) continue;
    const uint64_t key = sampler_.link_key(work_[first + child].key, source_key);
    sampler_.begin(receiver, source, key, drawn[child], estimate[child],
                   allowed_of(first + child, link.source));
    any = any || estimate[child].potential() > 0;
  }
  if (!any) return;
  // A clear view is probed by four rays from each child, in one packet.
  uint32_t probed = 0, blocked = 0;
  if (visible >= clear_view && LinkSampler::may_probe(element(at), source)) {
    SegmentPacket packet;
    packet.active = all_pairs;
    for (int to = 0; to < 16; ++to) {
      const int child = to / 4, lane = 4 * (to % 4);
      if (!(estimate[child].factor > 0)) {
        packet.active &= ~(1u << to);
        packet.set(to, Vec3{0, 0, 0}, Vec3{0, 0, 0});
        continue;
      }
      packet.take(to, drawn[child].samples.packet, lane);
    }
    blocked = tools_.engine.blocked(packet) & packet.active;
    probed = 1;
  }
  for (int child = 0; child < 4; ++child) {
    LinkEstimate& e = estimate[child];
    if (refined_unseen(first + child, link.source, source, e) || !(e.factor > 0)) continue;
    const uint32_t mine = blocked >> (4 * child) & 0xf;
    if (probed && mine == 0) sampler_.add(drawn[child], quick_pairs, 0, e);
    if (!(e.kernel_sum > 0)) {
      e = traced(first + child, source, source_key, link.source, drawn[child], e);
    }
    const double weight = std::min(1.0, e.weight());
    if (!(weight > 0)) continue;
    const Link next{link.source, static_cast<float>(weight)};
    if (hand_on_)
      keep(first + child, next);
    else
      weigh_known(first + child, next, source, e);
  }
}

void SubtreeRefiner::descend(int32_t at, Link link, double visible) {
  const Node& source = state_.forest.nodes[link.source];
  if (Forest::is_cluster(source)) {
    for (NodeId child : state_.forest.cluster(source).child) meet(at, child, visible);
  } else {
    for (int child = 0; child < 4; ++child) meet(at, source.first_child + child, visible);
  }
}

// A source that there is no link with yet. visible: share that is seen of what it is a part of.
void SubtreeRefiner::meet(int32_t at, NodeId id, double visible) {
  const Node& place = state_.forest.nodes[id];
  if (place.exposed <= 0) return;
  const Element source = source_of(id);
  const Element& receiver = element(at);
  // Parts of a patch that is faced need no further look.
  const Meeting meeting =
      place.level > 0 ? Meeting::link : meeting_of(receiver, source, tools_.engine.offset() / 2);
  if (meeting == Meeting::no_light) return;
  if (meeting == Meeting::descend_source) {
    descend(at, {id, 0}, visible);
    return;
  }
  const uint64_t source_key = key_of(state_.forest, place);
  DrawnPairs drawn;
  LinkEstimate e;
  sampler_.begin(receiver, source, sampler_.link_key(work_[at].key, source_key), drawn, e,
                 allowed_of(at, id));
  if (refined_unseen(at, id, source, e) || !(e.factor > 0)) return;
  if (visible >= clear_view && LinkSampler::may_probe(receiver, source)) {
    SegmentPacket probe = drawn.samples.packet;
    probe.active = quick_pairs;
    const uint32_t blocked = tools_.engine.blocked(probe);
    if ((blocked & quick_pairs) == 0) sampler_.add(drawn, quick_pairs, 0, e);
  }
  if (!(e.kernel_sum > 0)) e = traced(at, source, source_key, id, drawn, e);
  const double weight = std::min(1.0, e.weight());
  if (weight > 0) weigh_known(at, {id, static_cast<float>(weight)}, source, e);
}

LinkEstimate SubtreeRefiner::traced(int32_t at, const Element& source, uint64_t source_key,
                                    NodeId source_id, DrawnPairs& drawn, LinkEstimate begun) {
  const LinkLoad load = load_of(at, {source_id, static_cast<float>(begun.factor)}, source.area);
  trace_as_wanted(tools_.oracle, load, sampler_, element(at), source,
                  sampler_.link_key(work_[at].key, source_key), drawn, begun);
  return begun;
}

}  // namespace hrad
