// Weighing links, splitting receivers, descending sources, within one subtree. Floor 7 (stages).
#include "stages/subtree_refiner.h"

#include <algorithm>
#include <utility>

namespace hrad {
namespace {

// A link this well seen is taken to be seen whole until a ray says otherwise.
constexpr double clear_view = 0.999;

}  // namespace

SubtreeResult SubtreeRefiner::refine(NodeId root, Span<const Link> arriving, bool hand_on) {
  result_ = SubtreeResult{};
  work_.clear();
  hand_on_ = hand_on;
  const int64_t rays_before = sampler_.rays();
  add(state_.forest.nodes[root], root, -1);
  adopt_children(0);
  for (const Link& link : arriving) weigh(0, link);
  // Nodes are appended while the loop runs: children, old and new, come after their parents.
  for (size_t at = 0; at < result_.nodes.size(); ++at) {
    const NodeId id = result_.nodes[at].old_id;
    const bool own = id >= 0 && (!hand_on || at == 0);
    if (own)
      for (const Link& link : state_.links[id].links()) weigh(static_cast<int32_t>(at), link);
    if (!hand_on && at > 0 && id >= 0) adopt_children(static_cast<int32_t>(at));
  }
  result_.handed_on = hand_on && result_.nodes[0].first_child >= 0;
  for (size_t at = 0; at < result_.nodes.size(); ++at) {
    if (result_.handed_on && at > 0)
      result_.nodes[at].arriving = std::move(work_[at].out);
    else
      result_.nodes[at].run.assign(work_[at].out.begin(), work_[at].out.end());
  }
  result_.rays = sampler_.rays() - rays_before;
  return std::move(result_);
}

int32_t SubtreeRefiner::add(const Node& place, NodeId old_id, int32_t parent) {
  SubtreeNode node;
  node.place = place;
  node.old_id = old_id;
  node.parent = parent;
  result_.nodes.push_back(std::move(node));
  work_.emplace_back();
  return static_cast<int32_t>(result_.nodes.size() - 1);
}

void SubtreeRefiner::adopt_children(int32_t at) {
  const NodeId first = result_.nodes[at].place.first_child;
  if (first < 0 || result_.nodes[at].first_child >= 0) return;
  for (int child = 0; child < 4; ++child) {
    const int32_t index = add(state_.forest.nodes[first + child], first + child, at);
    if (child == 0) result_.nodes[at].first_child = index;
  }
}

void SubtreeRefiner::make_children(int32_t at) {
  adopt_children(at);
  if (result_.nodes[at].first_child >= 0) return;
  const Node parent = result_.nodes[at].place;
  for (int child = 0; child < 4; ++child) {
    Node place = child_place(parent, child);
    place.exposed = sampler_.exposed_share(place);
    const int32_t index = add(place, -1, at);
    if (child == 0) result_.nodes[at].first_child = index;
  }
}

const Element& SubtreeRefiner::element(int32_t at) {
  Work& work = work_[at];
  if (!work.known) {
    work.element = element_of(state_.forest, result_.nodes[at].place);
    work.key = key_of(state_.forest, result_.nodes[at].place);
    work.known = true;
  }
  return work.element;
}

LinkLoad SubtreeRefiner::load_of(int32_t at, const Link& link, double source_area) const {
  const Forest& forest = state_.forest;
  const Node& place = result_.nodes[at].place;
  const Node& source = forest.nodes[link.source];
  LinkLoad load;
  load.weight = link.weight;
  load.brightness = brightness_.of_node[link.source];
  load.source_spread = brightness_.spread[link.source];
  load.receiver_area = forest.area(place);
  load.patch_area = forest.surfaces[place.surface].area;
  load.source_area = source_area;
  load.may_split = place.level < max_level && load.receiver_area > tools_.oracle.min_area;
  // Children that an earlier pass of this round has made don't count yet: the round sees the state
  // that it began with.
  load.may_descend = source.first_child >= 0 &&
                     static_cast<size_t>(source.first_child) < brightness_.of_node.size();
  const float* radiosity = &state_.radiosity[static_cast<size_t>(link.source) * state_.bands];
  if (tools_.oracle.kind == OracleKind::energy)
    for (int band = 0; band < state_.bands; ++band)
      load.power = std::max(load.power, link.weight * radiosity[band] * load.receiver_area);
  return load;
}

// An old link, or one that came down from an earlier pass: the weight is known, the geometry isn't.
void SubtreeRefiner::weigh(int32_t at, Link link) {
  const LinkLoad load = load_of(at, link, state_.forest.area(state_.forest.nodes[link.source]));
  if (surely_good(tools_.oracle, load) || (!load.may_split && !load.may_descend)) {
    work_[at].out.push_back(link);
    return;
  }
  const Node& source_node = state_.forest.nodes[link.source];
  const Element source = element_of(state_.forest, source_node);
  DrawnPairs drawn;
  LinkEstimate estimate;
  if (tools_.oracle.kind == OracleKind::error || load.may_split) {
    const Element& receiver = element(at);
    const uint64_t key = sampler_.link_key(work_[at].key, key_of(state_.forest, source_node));
    sampler_.begin(receiver, source, key, drawn, estimate);
  }
  weigh_known(at, link, source, estimate);
}

void SubtreeRefiner::weigh_known(int32_t at, Link link, const Element& source,
                                 const LinkEstimate& estimate) {
  const LinkLoad load = load_of(at, link, source.area);
  Decision decision;
  if (surely_good(tools_.oracle, load)) {
    decision = Decision::keep;
  } else if (tools_.oracle.kind == OracleKind::energy) {
    decision = judge_energy(tools_.oracle, load);
  } else {
    const double distance = length(source.centroid - element(at).centroid);
    const double size = element(at).radius + source.radius;
    decision = judge_error(tools_.oracle, load, estimate, distance > 0 ? size / distance : 1);
  }
  if (decision == Decision::keep) {
    work_[at].out.push_back(link);
    return;
  }
  const double visible = estimate.factor > 0 ? std::min(1.0, link.weight / estimate.factor) : 0;
  if (decision == Decision::split_receiver)
    split(at, source, link, visible);
  else
    descend(at, link, visible);
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
    sampler_.begin(receiver, source, key, drawn[child], estimate[child]);
    any = any || estimate[child].factor > 0;
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
        packet.ox[to] = packet.oy[to] = packet.oz[to] = 0;
        packet.dx[to] = packet.dy[to] = packet.dz[to] = 0;
        continue;
      }
      const SegmentPacket& from = drawn[child].samples.packet;
      packet.ox[to] = from.ox[lane];
      packet.oy[to] = from.oy[lane];
      packet.oz[to] = from.oz[lane];
      packet.dx[to] = from.dx[lane];
      packet.dy[to] = from.dy[lane];
      packet.dz[to] = from.dz[lane];
    }
    blocked = tools_.engine.blocked(packet) & packet.active;
    probed = 1;
  }
  for (int child = 0; child < 4; ++child) {
    LinkEstimate& e = estimate[child];
    if (!(e.factor > 0)) continue;
    const uint32_t mine = blocked >> (4 * child) & 0xf;
    if (probed && mine == 0) sampler_.add(drawn[child], quick_pairs, 0, e);
    if (!(e.kernel_sum > 0)) {
      e = traced(first + child, source, source_key, link.source, drawn[child], e);
    }
    const double weight = std::min(1.0, e.weight());
    if (!(weight > 0)) continue;
    const Link next{link.source, static_cast<float>(weight)};
    if (hand_on_)
      work_[first + child].out.push_back(next);
    else
      weigh_known(first + child, next, source, e);
  }
}

void SubtreeRefiner::descend(int32_t at, Link link, double visible) {
  const NodeId first = state_.forest.nodes[link.source].first_child;
  for (int child = 0; child < 4; ++child) {
    const NodeId id = first + child;
    const Node& place = state_.forest.nodes[id];
    if (place.exposed <= 0) continue;
    const Element source = element_of(state_.forest, place);
    const uint64_t source_key = key_of(state_.forest, place);
    DrawnPairs drawn;
    LinkEstimate e;
    const Element& receiver = element(at);
    sampler_.begin(receiver, source, sampler_.link_key(work_[at].key, source_key), drawn, e);
    if (!(e.factor > 0)) continue;
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
}

LinkEstimate SubtreeRefiner::traced(int32_t at, const Element& source, uint64_t source_key,
                                    NodeId source_id, DrawnPairs& drawn, LinkEstimate begun) {
  const LinkLoad load = load_of(at, {source_id, static_cast<float>(begun.factor)}, source.area);
  trace_as_wanted(tools_.oracle, load, sampler_, element(at), source,
                  sampler_.link_key(work_[at].key, source_key), drawn, begun);
  return begun;
}

}  // namespace hrad
