// Estimating one link. Floor 6 (links).
#include "links/link_sampler.h"

#include <algorithm>

#include "links/form_factor.h"

namespace hrad {
namespace {

constexpr int lanes_per_packet = 16;

// Lambert's form factors of a source from the centroids of the receiver's quarters. The one in the
// middle lies at the receiver's own centroid: the one-point rule, against which the mean of the four
// is held.
void quarter_factors(const Triangle& t, Vec3 normal, const Triangle& source, double factor[4]) {
  const Vec3 center = t.centroid();
  // The centroid of the quarter at a corner lies halfway between the corner and the centroid.
  factor[0] = point_to_triangle((t.a + center) * 0.5, normal, source);
  factor[1] = point_to_triangle((t.b + center) * 0.5, normal, source);
  factor[2] = point_to_triangle((t.c + center) * 0.5, normal, source);
  factor[3] = point_to_triangle(center, normal, source);
}

double mean_of(const double v[4]) { return ((v[0] + v[1]) + (v[2] + v[3])) * 0.25; }

double half_range(const double v[4]) {
  const double low = std::min(std::min(v[0], v[1]), std::min(v[2], v[3]));
  const double high = std::max(std::max(v[0], v[1]), std::max(v[2], v[3]));
  return (high - low) * 0.5;
}

}  // namespace

uint32_t LinkSampler::exposed_mask(const Element& element, uint64_t key, bool as_receiver) const {
  if (element.exposed >= 1) return all_pairs;
  const Surface& surface = forest_.surfaces[element.surface];
  uint32_t mask = 0;
  for (int k = 0; k < lanes_per_packet; ++k) {
    double receiver_uv[2], source_uv[2];
    pair_points(key, k, receiver_uv, source_uv);
    const double* uv = as_receiver ? receiver_uv : source_uv;
    if (!exposure_.sealed(surface.patch, surface.side, element.corners.at(uv[0], uv[1])))
      mask |= 1u << k;
  }
  return mask;
}

void LinkSampler::draw(const Element& receiver, const Element& source, uint64_t key,
                       DrawnPairs& drawn) const {
  draw_pairs(receiver, source, key, engine_.center(), engine_.offset(), drawn.samples);
  drawn.receiver_exposed = exposed_mask(receiver, key, true);
  drawn.source_exposed = exposed_mask(source, key, false);
}

void LinkSampler::begin(const Element& receiver, const Element& source, uint64_t key,
                        DrawnPairs& drawn, LinkEstimate& estimate) const {
  draw(receiver, source, key, drawn);
  estimate = LinkEstimate{};
  estimate.source_area = source.area;
  const float* kernel = drawn.samples.kernel;
  double quarter[4] = {0, 0, 0, 0};
  double sum = 0;
  int count = 0;
  for (int q = 0; q < 4; ++q) {
    double quarter_sum = 0;
    int quarter_count = 0;
    for (int k = 4 * q; k < 4 * q + 4; ++k) {
      if (!(drawn.receiver_exposed >> k & 1)) continue;
      quarter_sum += kernel[k];
      ++quarter_count;
    }
    quarter[q] = quarter_count ? std::min(1.0, quarter_sum / quarter_count * source.area) : 0;
    sum += quarter_sum;
    count += quarter_count;
  }
  const double sampled = count ? std::min(1.0, sum / count * source.area) : 0;
  const double distance = length(source.centroid - receiver.centroid);
  estimate.near = receiver.radius + source.radius > near_ratio_ * distance;
  if (!estimate.near) {
    estimate.factor = sampled;
    estimate.variation = half_range(quarter);
    return;
  }
  double lambert[4];
  if (receiver.area <= source.area || receiver.exposed < 1) {
    quarter_factors(receiver.corners, receiver.normal, source.corners, lambert);
    estimate.factor = mean_of(lambert);
    estimate.variation = half_range(lambert);
    estimate.mean_error = std::fabs(lambert[3] - estimate.factor) / 3;
  } else {
    // Reciprocity: integrate over the smaller of the two, where few points do.
    quarter_factors(source.corners, source.normal, receiver.corners, lambert);
    const double ratio = source.area / receiver.area;
    estimate.factor = mean_of(lambert) * ratio;
    estimate.mean_error = std::fabs(lambert[3] * ratio - estimate.factor) / 3;
    estimate.variation = half_range(quarter);
  }
}

void LinkSampler::add(const DrawnPairs& drawn, uint32_t lanes, uint32_t blocked,
                      LinkEstimate& estimate) {
  rays_ += __builtin_popcount(lanes);
  const uint32_t counted = lanes & drawn.receiver_exposed;
  const uint32_t seen = counted & drawn.source_exposed & ~blocked;
  for (int k = 0; k < lanes_per_packet; ++k) {
    if (!(counted >> k & 1)) continue;
    estimate.kernel_sum += drawn.samples.kernel[k];
    if (seen >> k & 1) estimate.visible_sum += drawn.samples.kernel[k];
    ++estimate.pairs;
  }
}

void LinkSampler::trace(const DrawnPairs& drawn, LinkEstimate& estimate) {
  add(drawn, all_pairs, engine_.blocked(drawn.samples.packet), estimate);
}

void LinkSampler::trace_more(const Element& receiver, const Element& source, uint64_t key,
                             int packets, LinkEstimate& estimate) {
  DrawnPairs drawn;
  for (int k = 1; k < packets; ++k) {
    draw(receiver, source, mix(key, static_cast<uint64_t>(k)), drawn);
    trace(drawn, estimate);
  }
  // The more pairs, the better the sampled kernel: use all of them.
  if (!estimate.near && estimate.pairs > 0)
    estimate.factor =
        std::min(1.0, estimate.kernel_sum / estimate.pairs * estimate.source_area);
}

float LinkSampler::exposed_share(const Node& place) const {
  const Surface& surface = forest_.surfaces[place.surface];
  if (!exposure_.can_be_sealed(surface.patch, surface.side)) return 1;
  const Triangle corners = forest_.triangle(place);
  const uint64_t key = key_of(forest_, place);
  int exposed = 0;
  for (int k = 0; k < lanes_per_packet; ++k) {
    double uv[2];
    spread_point(key, k, uv);
    exposed += !exposure_.sealed(surface.patch, surface.side, corners.at(uv[0], uv[1]));
  }
  return static_cast<float>(exposed) / lanes_per_packet;
}

}  // namespace hrad
