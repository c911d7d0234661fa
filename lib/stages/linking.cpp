// Pairs of surfaces that face each other, their form factors and visible fractions.
// Floor 7 (stages).
#include "stages/linking.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "stages/exchange.h"
#include "stages/remote_links.h"
#include "stages/state_memory.h"

namespace hrad {
namespace {

// A pair of which the lower-numbered surface took care: weights in both directions.
struct Reciprocal {
  NodeId other;
  float to_this, to_other;
};

// Corners and planes of all surfaces side by side in single precision: facing tests of one surface
// against all others run along these arrays.
struct FacingTable {
  std::vector<float> corner[3][3];  // [corner][axis]
  std::vector<float> normal[3], distance;

  FacingTable(const std::vector<Element>& roots, Vec3 center) {
    for (const Element& e : roots) {
      const Vec3 points[3] = {e.corners.a - center, e.corners.b - center, e.corners.c - center};
      for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis)
          corner[k][axis].push_back(static_cast<float>(points[k][axis]));
      for (int axis = 0; axis < 3; ++axis)
        normal[axis].push_back(static_cast<float>(e.normal[axis]));
      distance.push_back(static_cast<float>(dot(e.normal, e.centroid - center)));
    }
  }

  // faces[q - first] = 1 where some of q lies before p's plane and some of p before q's.
  void find(size_t p, size_t first, size_t count, float margin, uint8_t* faces) const {
    const float nx = normal[0][p], ny = normal[1][p], nz = normal[2][p];
    const float limit = distance[p] + margin;
    float px[3], py[3], pz[3];
    for (int k = 0; k < 3; ++k) {
      px[k] = corner[k][0][p];
      py[k] = corner[k][1][p];
      pz[k] = corner[k][2][p];
    }
    const float *ax = &corner[0][0][first], *ay = &corner[0][1][first], *az = &corner[0][2][first];
    const float *bx = &corner[1][0][first], *by = &corner[1][1][first], *bz = &corner[1][2][first];
    const float *cx = &corner[2][0][first], *cy = &corner[2][1][first], *cz = &corner[2][2][first];
    const float *mx = &normal[0][first], *my = &normal[1][first], *mz = &normal[2][first];
    const float* d = &distance[first];
    for (size_t q = 0; q < count; ++q) {
      const float a = ax[q] * nx + ay[q] * ny + az[q] * nz;
      const float b = bx[q] * nx + by[q] * ny + bz[q] * nz;
      const float c = cx[q] * nx + cy[q] * ny + cz[q] * nz;
      const float e = px[0] * mx[q] + py[0] * my[q] + pz[0] * mz[q];
      const float f = px[1] * mx[q] + py[1] * my[q] + pz[1] * mz[q];
      const float g = px[2] * mx[q] + py[2] * my[q] + pz[2] * mz[q];
      const float own = d[q] + margin;
      faces[q] = static_cast<uint8_t>(((a > limit) | (b > limit) | (c > limit)) &
                                      ((e > own) | (f > own) | (g > own)));
    }
  }
};

class PairLinker {
 public:
  PairLinker(const State& state, const StageTools& tools, const Brightness& brightness)
      : forest_(state.forest),
        tools_(tools),
        brightness_(brightness),
        remote_(tools.exchange.comm().size(), tools.exchange.owners()) {
    const size_t count = static_cast<size_t>(forest_.surface_count());
    roots_.reserve(count);
    for (size_t k = 0; k < count; ++k) {
      roots_.push_back(element_of(forest_, forest_.nodes[k]));
      keys_.push_back(key_of(forest_, forest_.nodes[k]));
    }
    facing_ = std::make_unique<FacingTable>(roots_, tools.engine.center());
    found_.resize(count);
  }

  // Pairs of surface p with later ones: those that belong to one owner, or those of two.
  enum class Which { of_one_owner, of_two_owners };
  bool has_any(NodeId p, Which which) const {
    for (int32_t other = 0; other < tools_.exchange.comm().size(); ++other)
      if (is_mine(p, other, which)) return true;
    return false;
  }
  void link(NodeId p, Which which, LinkSampler& sampler, int64_t* pairs) {
    const size_t first = static_cast<size_t>(p) + 1, count = roots_.size() - first;
    if (count == 0 || roots_[p].exposed <= 0) return;
    std::vector<uint8_t> faces(count);
    facing_->find(p, first, count, static_cast<float>(tools_.engine.offset() / 2), faces.data());
    Bundle bundle;
    for (size_t k = 0; k < count; ++k) {
      const NodeId q = static_cast<NodeId>(first + k);
      if (!faces[k] || !is_mine(p, tools_.exchange.owner(q), which)) continue;
      if (roots_[q].exposed <= 0) continue;
      ++*pairs;
      estimate(p, q, sampler, bundle);
    }
    flush(p, sampler, bundle);
    // Bundles are late: back to ascending order.
    std::sort(found_[p].begin(), found_[p].end(),
              [](const Reciprocal& a, const Reciprocal& b) { return a.other < b.other; });
    found_[p].shrink_to_fit();
  }

  int64_t bytes_found(int64_t p) const {
    return static_cast<int64_t>(found_[p].size() * sizeof(Reciprocal));
  }

  // To every owner the links of its receivers that were found here.
  std::vector<Bytes> for_others() const {
    const Exchange& exchange = tools_.exchange;
    std::vector<Bytes> to(static_cast<size_t>(exchange.comm().size()));
    for (size_t k = 0; k < found_.size(); ++k) {
      const NodeId p = static_cast<NodeId>(k);
      for (const Reciprocal& r : found_[k]) {
        const FoundLink links[2] = {{p, {r.other, r.to_this}}, {r.other, {p, r.to_other}}};
        for (const FoundLink& link : links)
          if (!exchange.mine(link.receiver)) put(to[exchange.owner(link.receiver)], &link, 1);
      }
    }
    return to;
  }

  // Sorts the found links to their receivers: for each the sources in ascending order.
  LinkTable collect(const std::vector<Bytes>& from_others) {
    LinkTable table;
    std::vector<std::vector<Link>> earlier(found_.size());
    std::vector<int32_t> counts(found_.size(), 0);
    const Exchange& exchange = tools_.exchange;
    for (const auto& list : found_)
      for (const Reciprocal& r : list) ++counts[r.other];
    for (size_t k = 0; k < found_.size(); ++k)
      earlier[k].reserve(static_cast<size_t>(counts[k]) + found_[k].size());
    for (const Bytes& bytes : from_others) {
      Taker taker(bytes);
      for (size_t k = 0; k < bytes.size() / sizeof(FoundLink); ++k) {
        FoundLink found;
        taker.take(&found, 1);
        earlier[found.receiver].push_back(found.link);
      }
    }
    for (size_t p = 0; p < found_.size(); ++p) {
      // All surfaces before p have added theirs to earlier[p] by now.
      for (const Reciprocal& r : found_[p]) {
        if (exchange.mine(static_cast<int32_t>(p))) earlier[p].push_back({r.other, r.to_this});
        if (exchange.mine(r.other))
          earlier[r.other].push_back({static_cast<NodeId>(p), r.to_other});
      }
      if (!exchange.alone())
        std::sort(earlier[p].begin(), earlier[p].end(),
                  [](const Link& a, const Link& b) { return a.source < b.source; });
      table.append(earlier[p]);
      std::vector<Link>().swap(earlier[p]);
      std::vector<Reciprocal>().swap(found_[p]);
    }
    table.shrink_to_fit();
    return table;
  }

 private:
  // Whether this process is to look at pairs of p with surfaces of that owner.
  bool is_mine(NodeId p, int32_t other, Which which) const {
    const int32_t owner = tools_.exchange.owner(p);
    return (owner == other) == (which == Which::of_one_owner) &&
           remote_.computed_by(owner, other) == tools_.exchange.comm().rank();
  }

  // Up to four dim pairs that share a packet, four rays each.
  struct Bundle {
    int count = 0;
    NodeId other[4];
    DrawnPairs drawn[4];
    LinkEstimate estimate[4];
  };

  void estimate(NodeId p, NodeId q, LinkSampler& sampler, Bundle& bundle) {
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
      keep(p, q, e);
      return;
    }
    bundle.other[bundle.count++] = q;
    if (bundle.count == 4) flush(p, sampler, bundle);
  }

  // The brighter of the two directions, seen from the receiver p.
  LinkLoad load_of(NodeId p, NodeId q, double factor) const {
    LinkLoad load;
    const double back = roots_[p].area / roots_[q].area;
    load.brightness = std::max<double>(brightness_.of_node[q], brightness_.of_node[p] * back);
    load.weight = factor;
    load.receiver_area = load.patch_area = roots_[p].area;
    return load;
  }

  void flush(NodeId p, LinkSampler& sampler, Bundle& bundle) {
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
      keep(p, bundle.other[k], bundle.estimate[k]);
    }
    bundle.count = 0;
  }

  void keep(NodeId p, NodeId q, const LinkEstimate& e) {
    const double weight = e.weight();
    if (!(weight > 0)) return;
    // Reciprocity holds between the exposed parts.
    const double back = (roots_[p].area * roots_[p].exposed) / (roots_[q].area * roots_[q].exposed);
    found_[p].push_back({q, static_cast<float>(std::min(1.0, weight)),
                         static_cast<float>(std::min(1.0, weight * back))});
  }

  const Forest& forest_;
  const StageTools& tools_;
  const Brightness& brightness_;
  const RemoteLinks remote_;
  std::vector<Element> roots_;
  std::vector<uint64_t> keys_;
  std::unique_ptr<FacingTable> facing_;
  std::vector<std::vector<Reciprocal>> found_;  // per surface, with later ones only
};

}  // namespace

bool link_pairs(State& state, const StageTools& tools, const Brightness& brightness) {
  const int64_t count = state.forest.surface_count();
  PairLinker linker(state, tools, brightness);
  const LinkSampler model(state.forest, tools.engine, tools.exposure, tools.oracle.seed,
                          tools.oracle.near_ratio);
  std::vector<LinkSampler> samplers(tools.team.size(), model);
  std::vector<int64_t> pairs(tools.team.size(), 0);
  StageMemory memory(state);
  const auto look_at = [&](PairLinker::Which which) {
    std::vector<NodeId> own;
    for (int64_t p = 0; p < count; ++p)
      if (linker.has_any(static_cast<NodeId>(p), which)) own.push_back(static_cast<NodeId>(p));
    const bool going_on = tools.team.for_each(
        static_cast<int64_t>(own.size()),
        [&](int64_t turn, int worker) {
          const NodeId p = own[static_cast<size_t>(turn)];
          const int64_t before = linker.bytes_found(p);
          linker.link(p, which, samplers[worker], &pairs[worker]);
          memory.take(linker.bytes_found(p) - before, "links");
        },
        [&](int64_t turn) {
          // Surface p has count-p partners.
          const int64_t p = turn < static_cast<int64_t>(own.size()) ? own[turn] : count;
          const double left = 1 - static_cast<double>(p) / static_cast<double>(count);
          return tools.progress(1 - left * left);
        });
    return tools.exchange.all_go_on(going_on);
  };
  // Links that others wait for come first, and travel while own ones are looked at.
  std::vector<Bytes> from_others;
  bool done = true;
  if (!tools.exchange.alone()) {
    done = look_at(PairLinker::Which::of_two_owners);
    if (done) tools.exchange.comm().start_exchange(linker.for_others());
  }
  if (done) {
    done = look_at(PairLinker::Which::of_one_owner);
    if (!tools.exchange.alone()) from_others = tools.exchange.comm().finish_exchange();
  }
  for (int worker = 0; worker < tools.team.size(); ++worker) {
    state.rays += samplers[worker].rays();
    state.pairs += pairs[worker];
  }
  if (!done) return false;
  int64_t found = 0;
  for (int64_t p = 0; p < count; ++p) found += linker.bytes_found(p);
  memory.take(2 * found, "links");  // each in both directions, in two places for a while
  state.links = linker.collect(from_others);
  memory.settle();
  tools.exchange.ask_for_sources(state);
  return true;
}

}  // namespace hrad
