// Form factor and visible fraction of one link, from the same sixteen pairs of points: Lambert's
// formula where receiver and source are near each other, the sampled kernel elsewhere.
// Floor 6 (links).
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "links/element.h"
#include "links/end_points.h"
#include "links/pair_samples.h"
#include "visibility/exposure.h"
#include "visibility/visibility.h"

namespace hrad {

// What is known of a link; grows as packets are traced.
struct LinkEstimate {
  double factor = 0;         // form factor without occlusion, mean over the whole receiver
  double variation = 0;      // half the range of it among the receiver's quarters
  double mean_error = 0;     // error of its mean over the receiver, estimated
  bool near = false;         // factor is Lambert's
  double source_area = 0;    // that the pairs are drawn from
  bool close_pairs = false;  // pairs that are traced whole are draw_close_pairs'
  bool by_points = false;    // pairs are those of EndPoints, and factor is but a sample
  double guess = 0;          // then: LinkGuess::factor
  // What the link could carry, whatever chance has made of its sample: links that it made too heavy
  // must not be refined more readily than those it made too light, or light is lost.
  double potential() const { return by_points ? guess : factor; }
  double kernel_sum = 0, visible_sum = 0;  // over the traced pairs
  double quarter_sum[4] = {};              // visible_sum by the receiver's quarters
  int pairs = 0;                           // traced pairs; those on sealed points count as blocked
  double visible() const { return kernel_sum > 0 ? visible_sum / kernel_sum : 0; }
  // Shares of what the pairs are drawn from that are exposed. All light arrives on the receiver's.
  double exposed = 1, source_exposed = 1;
  bool exposed_only = false;  // the pairs are drawn from an exposed part alone, of one end or both
  // Share of the pairs that say anything about visibility: both ends exposed.
  double telling() const { return exposed * source_exposed; }
  // Form factor times visible fraction, mean over the receiver's exposed part, at most 1.
  double weight() const { return std::min(1.0, seen() / exposed); }
  // The same over all that the pairs start from. Not their product, which a handful of pairs makes
  // too large or too small on the average where kernel and visibility go together, but without
  // bias: the form factor less the blocked part, or the visible part alone, whichever was sampled
  // to be smaller. The form factor is of whole elements, so that exposed parts have but the latter.
  double seen() const {
    if (pairs == 0) return 0;
    const double visible_part = source_area * visible_sum / pairs;
    const double blocked_part = source_area * (kernel_sum - visible_sum) / pairs;
    if (exposed_only) return visible_part;
    if (blocked_part <= visible_part) return blocked_part < factor ? factor - blocked_part : 0;
    return visible_part < factor ? visible_part : factor;
  }
};

// A packet under way: the drawn pairs and which of them have exposed points at both ends.
struct DrawnPairs {
  PairSamples samples;
  uint32_t exposed = all_pairs;
};

// One for each worker.
class LinkSampler {
 public:
  // near_ratio: below this (receiver radius + source radius) / distance the kernel is sampled.
  LinkSampler(const Forest& forest, const VisibilityEngine& engine, const Exposure& exposure,
              uint64_t seed, double near_ratio)
      : forest_(forest),
        engine_(engine),
        exposure_(exposure),
        seed_(seed),
        near_ratio_(near_ratio) {}

  // The unoccluded form factor; draws the first packet's pairs on the way. allowed: variance of the
  // weight, per weight, that doesn't matter; where that is much, or an end is a cluster, a rough
  // estimate from EndPoints will do.
  void begin(const Element& receiver, const Element& source, uint64_t key, DrawnPairs& drawn,
             LinkEstimate& estimate, double allowed = 0);

  // Adds the outcome of tracing the pairs of `lanes`: bit k of blocked: pair k is blocked.
  void add(const DrawnPairs& drawn, uint32_t lanes, uint32_t blocked, LinkEstimate& estimate);

  // Traces a whole packet of the drawn pairs and adds it. Where the ends come close to each other
  // pairs are drawn anew in proportion to the form factor, where an end is partly sealed, from its
  // exposed part.
  void trace(const Element& receiver, const Element& source, uint64_t key, DrawnPairs& drawn,
             LinkEstimate& estimate);

  // Draws and traces further packets until `packets` are in the estimate, the first included.
  void trace_more(const Element& receiver, const Element& source, uint64_t key, int packets,
                  LinkEstimate& estimate);

  // Share of the element that is exposed, from points spread over it: more on a whole patch.
  float exposed_share(const Node& place) const;

  // A few rays of a first packet serve as a probe of a clear view only where all points count.
  static bool may_probe(const Element& receiver, const Element& source) {
    return receiver.exposed >= 1 && source.exposed >= 1;
  }

  // Rays traced so far (those that add() was given included).
  int64_t rays() const { return rays_; }

  uint64_t link_key(uint64_t receiver_key, uint64_t source_key) const {
    return mix(receiver_key, source_key, seed_);
  }

  PointPlacer placer() const { return {forest_, exposure_, engine_.center(), engine_.offset()}; }

 private:
  bool begin_by_points(const Element& receiver, const Element& source, uint64_t key,
                       DrawnPairs& drawn, LinkEstimate& estimate, double allowed);
  void draw_points(const Element& receiver, const Element& source, uint64_t key, bool keep,
                   const LinkEstimate& estimate, DrawnPairs& drawn, EndPoints& of_small);
  uint32_t place_near(const EndsBySize& ends, const EndPoints& small, uint64_t key,
                      EndPoints& points, float scale[16]);
  static void scale_to(const LinkEstimate& estimate, DrawnPairs& drawn);
  void draw(const Element& receiver, const Element& source, uint64_t key, LinkEstimate& estimate,
            DrawnPairs& drawn);
  void draw_clusters(const Element& receiver, const Element& source, uint64_t key,
                     LinkEstimate& estimate, DrawnPairs& drawn) const;
  Exposure::Part& part_of(const Element& element);
  uint32_t move_to_exposed(const Element& element, uint64_t key, float u[16], float v[16]);
  uint32_t exposed_mask(const Element& element, const float u[16], const float v[16]);
  void trace_drawn(const DrawnPairs& drawn, LinkEstimate& estimate);

  const Forest& forest_;
  const VisibilityEngine& engine_;
  const Exposure& exposure_;
  uint64_t seed_;
  double near_ratio_;
  int64_t rays_ = 0;
  // Of partly sealed ends: of the receiver of many links, and of the source.
  struct KnownPart {
    int32_t surface = -1;
    Triangle corners;
    std::optional<Exposure::Part> part;
  };
  KnownPart known_[2];
  int latest_ = 0;
};

}  // namespace hrad
