// Estimates, four dim pairs at a time. Floor 7 (stages).
#include "stages/pair_linker.h"

#include <algorithm>

namespace hrad {
namespace {

std::vector<Element> roots_of(const Forest& forest) {
  std::vector<Element> roots;
  for (NodeId k = 0; k < forest.surface_count(); ++k)
    roots.push_back(element_of(forest, forest.nodes[k]));
  return roots;
}

}  // namespace

PairLinker::PairLinker(const State& state, const StageTools& tools, const Brightness& brightness)
    : tools_(tools),
      brightness_(brightness),
      roots_(roots_of(state.forest)),
      facing_(roots_, tools.engine.center(), tools.engine.offset() / 2) {
  for (size_t k = 0; k < roots_.size(); ++k)
    keys_.push_back(key_of(state.forest, state.forest.nodes[k]));
}

PairsFound PairLinker::link(const PairTask& task, const std::function<bool(NodeId)>& wanted,
                            const Partners& known, LinkSampler& sampler) const {
  PairsFound result;
  if (roots_[task.p].exposed <= 0) return result;
  const int64_t rays_before = sampler.rays();
  std::vector<uint8_t> faces(static_cast<size_t>(task.end - task.first));
  facing_.find(static_cast<size_t>(task.p), static_cast<size_t>(task.first), faces.size(),
               faces.data());
  Bundle bundle;
  for (size_t k = 0; k < faces.size(); ++k) {
    const NodeId q = task.first + static_cast<NodeId>(k);
    if (!faces[k] || known[k] || roots_[q].exposed <= 0 || !wanted(q)) continue;
    result.looked_at[k] = true;
    ++result.pairs;
    estimate(task.p, q, sampler, bundle, result.found);
  }
  flush(task.p, sampler, bundle, result.found);
  // Bundles are late: back to ascending order.
  std::sort(result.found.begin(), result.found.end(),
            [](const Reciprocal& a, const Reciprocal& b) { return a.other < b.other; });
  result.found.shrink_to_fit();
  result.rays = sampler.rays() - rays_before;
  return result;
}

void PairLinker::estimate(NodeId p, NodeId q, LinkSampler& sampler, Bundle& bundle,
                          std::vector<Reciprocal>& found) const {
  const Element &receiver = roots_[p], &source = roots_[q];
  const uint64_t key = sampler.link_key(keys_[p], keys_[q]);
  DrawnPairs& drawn = bundle.drawn[bundle.count];
  LinkEstimate& e = bundle.estimate[bundle.count];
  sampler.begin(receiver, source, key, drawn, e);
  if (!(e.factor > 0)) return;
  const LinkLoad load = load_of(p, q, e.factor);
  if (e.factor * load.brightness > tools_.oracle.mean_variance ||
      !LinkSampler::may_probe(receiver, source)) {
    trace_as_wanted(tools_.oracle, load, sampler, receiver, source, key, drawn, e);
    keep(p, q, e, found);
    return;
  }
  bundle.other[bundle.count++] = q;
  if (bundle.count == 4) flush(p, sampler, bundle, found);
}

// The brighter of the two directions, seen from the receiver p.
LinkLoad PairLinker::load_of(NodeId p, NodeId q, double factor) const {
  LinkLoad load;
  const double back = roots_[p].area / roots_[q].area;
  load.brightness = std::max<double>(brightness_.of_node[q], brightness_.of_node[p] * back);
  load.weight = factor;
  load.receiver_area = load.patch_area = roots_[p].area;
  return load;
}

void PairLinker::flush(NodeId p, LinkSampler& sampler, Bundle& bundle,
                       std::vector<Reciprocal>& found) const {
  if (bundle.count == 0) return;
  SegmentPacket packet;
  packet.active = 0;
  for (int k = 0; k < bundle.count; ++k) {
    const SegmentPacket& from = bundle.drawn[k].samples.packet;
    for (int m = 0; m < 4; ++m) {
      const int to = 4 * k + m, lane = 4 * m;
      packet.take(to, from, lane);
      packet.active |= 1u << to;
    }
  }
  const uint32_t blocked = tools_.engine.blocked(packet);
  for (int k = 0; k < bundle.count; ++k) {
    uint32_t lanes = 0;
    for (int m = 0; m < 4; ++m) lanes |= (blocked >> (4 * k + m) & 1) << (4 * m);
    sampler.add(bundle.drawn[k], quick_pairs, lanes, bundle.estimate[k]);
    keep(p, bundle.other[k], bundle.estimate[k], found);
  }
  bundle.count = 0;
}

void PairLinker::keep(NodeId p, NodeId q, const LinkEstimate& e,
                      std::vector<Reciprocal>& found) const {
  const double weight = e.weight();
  if (!(weight > 0)) return;
  // Reciprocity holds between the exposed parts.
  const double back = (roots_[p].area * roots_[p].exposed) / (roots_[q].area * roots_[q].exposed);
  found.push_back({q, static_cast<float>(std::min(1.0, weight)),
                   static_cast<float>(std::min(1.0, weight * back))});
}

}  // namespace hrad
