// Sources as differences; weights of rows of rays as counts of rays, other weights by what the same
// source sent to the receiver before. Floor 8 (solver).
#include "solver/checkpoint_runs.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace hrad {
namespace {

// The weakest link of a row stands for so many rays at the most, or weights are kept as they are.
constexpr int most_rays_of_the_weakest = 4;
constexpr int64_t most_rays = int64_t{1} << 30;

float weight_of_rays(int64_t rays, int64_t all) {
  return static_cast<float>(static_cast<double>(rays) / static_cast<double>(all));
}

// The number of rays that the weights are shares of, 0: they are no such shares, or the sources
// don't ascend.
int64_t rays_of(Span<const Link> run) {
  float least = largest_weight;
  for (size_t k = 0; k < run.size(); ++k) {
    if (k > 0 && run[k].source <= run[k - 1].source) return 0;
    least = std::min(least, run[k].weight);
  }
  if (!(least > 0)) return 0;
  for (int rays = 1; rays <= most_rays_of_the_weakest; ++rays) {
    const double all = std::nearbyint(rays / static_cast<double>(least));
    if (!(all >= 1 && all <= static_cast<double>(most_rays))) continue;
    const auto number = static_cast<int64_t>(all);
    const bool exact = std::all_of(run.begin(), run.end(), [&](const Link& link) {
      const auto share = static_cast<int64_t>(std::nearbyint(link.weight * all));
      return share >= 1 && share <= number &&
             bits_of(weight_of_rays(share, number)) == bits_of(link.weight);
    });
    if (exact) return number;
  }
  return 0;
}

}  // namespace

void pack_runs(int64_t first, int64_t end, const RunOf& run_of, PackedBytes& bytes) {
  PackedBytes sources, rays;
  std::vector<uint32_t> weights;
  std::unordered_map<NodeId, uint32_t> last_weight;  // looked up only
  NodeId first_before = 0;
  for (int64_t receiver = first; receiver < end; ++receiver) {
    const Span<const Link> run = run_of(receiver);
    bytes.varint(run.size());
    if (run.empty()) continue;
    const int64_t all = rays_of(run);
    rays.varint(static_cast<uint64_t>(all));
    NodeId before = first_before;
    for (size_t k = 0; k < run.size(); ++k) {
      const Link& link = run[k];
      if (all > 0 && k > 0)
        sources.varint(static_cast<uint64_t>(link.source - before - 1));
      else
        sources.signed_varint(link.source - before);
      before = link.source;
      if (all > 0) {
        const double share = std::nearbyint(link.weight * static_cast<double>(all));
        rays.varint(static_cast<uint64_t>(share) - 1);
      } else {
        uint32_t& last = last_weight[link.source];
        weights.push_back(zigzag32(bits_of(link.weight) - last));
        last = bits_of(link.weight);
      }
    }
    first_before = run[0].source;
  }
  bytes.raw(sources.bytes());
  bytes.raw(rays.bytes());
  bytes.planes(weights);
}

void unpack_runs(int64_t first, int64_t end, NodeId sources, int64_t& left, PackedReader& bytes,
                 const std::function<void(Span<const Link>)>& take) {
  // Every link takes a byte of the run at least.
  std::vector<size_t> counts;
  int64_t total = 0;
  for (int64_t receiver = first; receiver < end; ++receiver) {
    const int64_t most = std::min(left - total, static_cast<int64_t>(bytes.left()) - total);
    counts.push_back(static_cast<size_t>(
        bytes.count("the number of an element's links", 0, std::max<int64_t>(0, most))));
    total += static_cast<int64_t>(counts.back());
  }
  left -= total;
  // Whether a run is by rays is known after its sources; these are read once more as they stand.
  PackedReader of_sources = bytes;
  for (int64_t k = 0; k < total; ++k) bytes.varint();
  std::vector<Link> links(static_cast<size_t>(total));
  std::vector<size_t> by_weights;
  NodeId first_before = 0;
  size_t at = 0;
  for (size_t count : counts) {
    if (count == 0) continue;
    const int64_t all = bytes.count("the number of a row's rays", 0, most_rays);
    int64_t before = first_before;
    for (size_t k = 0; k < count; ++k) {
      Link& link = links[at + k];
      if (all > 0 && k > 0)
        before += 1 + of_sources.count("the step to a link's source", 0, sources - 1);
      else
        before = of_sources.moved(before, "the source of a link", 0, sources - 1);
      if (before >= sources)
        fail_format(bytes.place(), "the source of a link is %lld: it must be below %lld",
                    static_cast<long long>(before), static_cast<long long>(sources));
      link.source = static_cast<NodeId>(before);
      if (all > 0)
        link.weight = weight_of_rays(1 + bytes.count("a link's rays", 0, all - 1), all);
      else
        by_weights.push_back(at + k);
    }
    first_before = links[at].source;
    at += count;
  }
  std::vector<uint32_t> weights;
  bytes.planes(by_weights.size(), weights);
  std::unordered_map<NodeId, uint32_t> last_weight;
  for (size_t k = 0; k < weights.size(); ++k) {
    Link& link = links[by_weights[k]];
    uint32_t& last = last_weight[link.source];
    last += from_zigzag32(weights[k]);
    link.weight = float_of(last);
    if (!(link.weight >= 0 && link.weight <= largest_weight))
      fail_format(bytes.place(), "the weight of a link is %g: it must be from 0 to %g",
                  static_cast<double>(link.weight), static_cast<double>(largest_weight));
  }
  at = 0;
  for (size_t count : counts) {
    take({links.data() + at, count});
    at += count;
  }
}

}  // namespace hrad
