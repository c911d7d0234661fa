// The elements of one subtree and the links that each keeps. Floor 7 (stages).
#include "stages/subtree_refiner.h"

#include <algorithm>
#include <utility>

namespace hrad {
namespace {

// Links of which more than this is seen cut no edge.
constexpr float seen_whole = 0.98f;
// What varies by the same edges from quarter to quarter of a receiver weighs as an edge does. The
// bound without a look at the quarters: half of that.
constexpr double quarter_weight = 8, at_most_weight = 4;

}  // namespace

int64_t bytes_of(const SubtreeResult& result) {
  size_t bytes = result.nodes.size() * sizeof(SubtreeNode);
  for (const SubtreeNode& node : result.nodes)
    bytes += (node.run.size() + node.arriving.size()) * sizeof(Link);
  return static_cast<int64_t>(bytes);
}

SubtreeResult SubtreeRefiner::refine(NodeId root, Span<const Link> arriving, Span<const NodeId> met,
                                     bool hand_on) {
  result_ = SubtreeResult{};
  work_.clear();
  hand_on_ = hand_on;
  const int64_t rays_before = sampler_.rays();
  add(state_.forest.nodes[root], root, -1);
  adopt_children(0);
  for (const Link& link : arriving) weigh(0, link);
  if (result_.nodes[0].place.exposed > 0)
    for (NodeId source : met) meet(0, source, 0);
  // Nodes are appended while the loop runs: children, old and new, come after their parents.
  for (size_t at = 0; at < result_.nodes.size(); ++at) {
    const NodeId id = result_.nodes[at].old_id;
    const bool own = id >= 0 && (!hand_on || at == 0);
    if (own)
      for (const Link& link : state_.links[id].links()) weigh(static_cast<int32_t>(at), link);
    if (points_ && (!hand_on || at == 0)) split_uneven(static_cast<int32_t>(at));
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
    if (points_) {
      work.points = std::make_unique<EndPoints>();
      sampler_.placer().place(work.element, work.key, *work.points);
      work.element.points = work.points.get();
    }
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
  load.may_descend = Forest::is_cluster(source) ||
                     (source.first_child >= 0 &&
                      static_cast<size_t>(source.first_child) < brightness_.of_node.size());
  const float* radiosity = radiosity_[link.source];
  if (tools_.oracle.kind == OracleKind::energy)
    for (int band = 0; band < state_.bands; ++band)
      load.power = std::max(load.power, link.weight * radiosity[band] * load.receiver_area);
  return load;
}

Element SubtreeRefiner::source_of(NodeId id) const {
  Element source = element_of(state_.forest, state_.forest.nodes[id]);
  if (points_) source.points = points_->of(id);
  return source;
}

// What LinkSampler::begin allows: no more than what serves the last round.
double SubtreeRefiner::allowed_of(int32_t at, NodeId source) const {
  if (!points_) return 0;
  const Node& place = result_.nodes[at].place;
  const double share = state_.forest.area(place) / state_.forest.surfaces[place.surface].area;
  return tools_.oracle.last_mean_variance /
         std::max(1e-9, share * static_cast<double>(brightness_.of_node[source]));
}

// An old link, or one that came down from an earlier pass: the weight is known, the geometry isn't.
void SubtreeRefiner::weigh(int32_t at, Link link) {
  const LinkLoad load = load_of(at, link, state_.forest.area(state_.forest.nodes[link.source]));
  if (surely_good(tools_.oracle, load) || (!load.may_split && !load.may_descend)) {
    keep(at, link);
    return;
  }
  const Node& source_node = state_.forest.nodes[link.source];
  const Element source = source_of(link.source);
  DrawnPairs drawn;
  LinkEstimate estimate;
  if (tools_.oracle.kind == OracleKind::error || load.may_split) {
    const Element& receiver = element(at);
    const uint64_t key = sampler_.link_key(work_[at].key, key_of(state_.forest, source_node));
    sampler_.begin(receiver, source, key, drawn, estimate, allowed_of(at, link.source));
  }
  weigh_known(at, link, source, estimate);
}

void SubtreeRefiner::weigh_known(int32_t at, Link link, const Element& source,
                                 const LinkEstimate& estimate) {
  const LinkLoad load = load_of(at, link, source.area);
  const Decision decision = judge(at, load, source, estimate);
  if (decision == Decision::keep) {
    const double seen = estimate.factor > 0 ? std::min(1.0, link.weight / estimate.factor) : 1;
    work_[at].uneven += estimate.potential() * load.brightness * std::sqrt(seen * (1 - seen));
    keep(at, link, seen);
  } else
    follow(decision, at, link, source, estimate);
}

void SubtreeRefiner::keep(int32_t at, Link link, double seen) {
  work_[at].out.push_back(link);
  work_[at].seen.push_back(static_cast<float>(seen));
}

// Many links that carry little each are cut off by the same edge: what is within a link's tolerance
// adds up, in a gap behind a cupboard to all the light there is.
void SubtreeRefiner::split_uneven(int32_t at) {
  const Node& place = result_.nodes[at].place;
  const OracleSettings& s = tools_.oracle;
  const double area = state_.forest.area(place);
  if (s.kind == OracleKind::energy || place.level >= max_level || area <= s.point_min_area ||
      area <= s.min_area)
    return;
  const double share = std::min(1.0, area / s.point_area);
  const double at_most = work_[at].uneven;
  if (at_most * at_most * at_most_weight * share <= s.point_variance) return;
  double quarter[4] = {};
  for (size_t k = 0; k < work_[at].out.size(); ++k)
    if (work_[at].seen[k] < seen_whole) add_quarters(at, work_[at].out[k].source, quarter);
  const auto range = std::minmax({quarter[0], quarter[1], quarter[2], quarter[3]});
  const double half = (range.second - range.first) / 2;
  if (half * half * quarter_weight * share <= s.point_variance) return;
  const std::vector<Link> links = std::move(work_[at].out);
  const std::vector<float> seen = std::move(work_[at].seen);
  work_[at].out.clear();
  work_[at].seen.clear();
  for (size_t k = 0; k < links.size(); ++k) {
    if (seen[k] >= seen_whole)
      keep(at, links[k], seen[k]);
    else
      split(at, source_of(links[k].source), links[k], seen[k]);
  }
}

// Adds what each quarter of the receiver sees of the source.
void SubtreeRefiner::add_quarters(int32_t at, NodeId id, double quarter[4]) {
  const Element source = source_of(id);
  const uint64_t key =
      sampler_.link_key(work_[at].key, key_of(state_.forest, state_.forest.nodes[id]));
  DrawnPairs drawn;
  LinkEstimate e;
  sampler_.begin(element(at), source, key, drawn, e, allowed_of(at, id));
  sampler_.trace(element(at), source, key, drawn, e);
  for (int q = 0; q < 4; ++q)
    quarter[q] += e.quarter_sum[q] / 4 * e.source_area * brightness_.of_node[id];
}

}  // namespace hrad
