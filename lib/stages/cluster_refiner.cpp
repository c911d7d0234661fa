// Weighing the links of a cluster, descending sources, handing down. Floor 7 (stages).
#include "stages/cluster_refiner.h"

#include <algorithm>
#include <utility>

#include "links/cluster_ends.h"

namespace hrad {

ClusterResult ClusterRefiner::refine(NodeId cluster, Span<const NodeId> met) {
  result_ = ClusterResult{};
  const int64_t rays_before = sampler_.rays();
  const Node& node = state_.forest.nodes[cluster];
  receiver_ = end_of(cluster);
  key_ = key_of(state_.forest, node);
  for (NodeId source : met) meet(source);
  for (const Link& link : state_.links[cluster].links()) weigh(link);
  result_.rays = sampler_.rays() - rays_before;
  return std::move(result_);
}

Element ClusterRefiner::end_of(NodeId id) const {
  Element end = element_of(state_.forest, state_.forest.nodes[id]);
  end.points = points_.of(id);
  return end;
}

void ClusterRefiner::descend(NodeId source_id) {
  const Node& source = state_.forest.nodes[source_id];
  if (Forest::is_cluster(source)) {
    for (NodeId child : state_.forest.cluster(source).child) meet(child);
  } else {
    for (int child = 0; child < 4; ++child) meet(source.first_child + child);
  }
}

LinkLoad ClusterRefiner::load_of(NodeId source_id, const Element& source, double weight) const {
  const Node& node = state_.forest.nodes[source_id];
  LinkLoad load;
  load.weight = weight;
  load.brightness = brightness_.of_node[source_id];
  load.source_spread = brightness_.spread[source_id];
  load.receiver_area = load.patch_area = receiver_.area;
  load.source_area = source.area;
  load.may_split = true;
  load.may_descend = source.cluster || node.first_child >= 0;
  const float* radiosity = radiosity_[source_id];
  if (tools_.oracle.kind == OracleKind::energy)
    for (int band = 0; band < state_.bands; ++band)
      load.power = std::max(load.power, weight * radiosity[band] * load.receiver_area);
  return load;
}

Decision ClusterRefiner::judge(const LinkLoad& load, const LinkEstimate& estimate,
                               const Element& source) const {
  return tools_.oracle.kind == OracleKind::energy
             ? judge_energy(tools_.oracle, load)
             : judge_with_clusters(tools_.oracle, load, estimate, receiver_, source);
}

void ClusterRefiner::follow(Decision decision, Link link) {
  switch (decision) {
    case Decision::keep:
      result_.run.push_back(link);
      break;
    case Decision::split_receiver:
      result_.down.push_back(link.source);
      break;
    case Decision::descend_source:
      descend(link.source);
      break;
  }
}

void ClusterRefiner::meet(NodeId id) {
  const Node& place = state_.forest.nodes[id];
  if (place.exposed <= 0) return;
  const Element source = end_of(id);
  switch (meeting_of(receiver_, source, tools_.engine.offset() / 2)) {
    case Meeting::no_light:
      return;
    case Meeting::split_receiver:
      result_.down.push_back(id);
      return;
    case Meeting::descend_source:
      descend(id);
      return;
    case Meeting::link:
      break;
  }
  const uint64_t key = sampler_.link_key(key_, key_of(state_.forest, place));
  DrawnPairs drawn;
  LinkEstimate estimate;
  sampler_.begin(receiver_, source, key, drawn, estimate, 1);
  // What would be too coarse even if all of it were seen needs no rays.
  LinkLoad load = load_of(id, source, estimate.factor);
  Decision decision = judge(load, estimate, source);
  if (decision != Decision::keep) {
    follow(decision, {id, 0});
    return;
  }
  if (!(estimate.factor > 0)) return;
  trace_as_wanted(tools_.oracle, load, sampler_, receiver_, source, key, drawn, estimate);
  load.weight = std::min(1.0, estimate.weight());
  if (!(load.weight > 0)) return;
  follow(judge(load, estimate, source), {id, static_cast<float>(load.weight)});
}

void ClusterRefiner::weigh(Link link) {
  const Node& place = state_.forest.nodes[link.source];
  const Element source = end_of(link.source);
  const LinkLoad load = load_of(link.source, source, link.weight);
  if (surely_good(tools_.oracle, load)) {
    result_.run.push_back(link);
    return;
  }
  DrawnPairs drawn;
  LinkEstimate estimate;
  sampler_.begin(receiver_, source, sampler_.link_key(key_, key_of(state_.forest, place)), drawn,
                 estimate, 1);
  follow(judge(load, estimate, source), link);
}

}  // namespace hrad
