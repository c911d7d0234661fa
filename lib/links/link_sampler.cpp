// Estimating one link. Floor 6 (links).
#include "links/link_sampler.h"

#include <algorithm>

#include "base/angle.h"
#include "links/close_pairs.h"
#include "links/mean_factor.h"

namespace hrad {
namespace {

constexpr int lanes_per_packet = 16;

double mean_of(const double v[4]) { return ((v[0] + v[1]) + (v[2] + v[3])) * 0.25; }

double half_range(const double v[4]) {
  const double low = std::min(std::min(v[0], v[1]), std::min(v[2], v[3]));
  const double high = std::max(std::max(v[0], v[1]), std::max(v[2], v[3]));
  return (high - low) * 0.5;
}

}  // namespace

Exposure::Part& LinkSampler::part_of(const Element& element) {
  const Triangle& t = element.corners;
  const auto is_known = [&](const KnownPart& known) {
    const Triangle& of = known.corners;
    return known.surface == element.surface && of.a == t.a && of.b == t.b && of.c == t.c;
  };
  if (!is_known(known_[latest_])) latest_ = 1 - latest_;
  KnownPart& known = known_[latest_];
  if (!is_known(known)) {
    const Surface& surface = forest_.surfaces[element.surface];
    known.part.emplace(exposure_, surface.patch, surface.side, t);
    known.surface = element.surface;
    known.corners = t;
  }
  return *known.part;
}

// Bit k set: point k is exposed.
uint32_t LinkSampler::exposed_mask(const Element& element, const float u[16], const float v[16]) {
  if (element.exposed >= 1) return all_pairs;
  Exposure::Part& part = part_of(element);
  uint32_t mask = 0;
  for (int k = 0; k < lanes_per_packet; ++k)
    if (!part.sealed(element.corners.at(u[k], v[k]))) mask |= 1u << k;
  return mask;
}

// Points on the sealed part are drawn again until they lie on the exposed one. As often as it takes
// where a hundredth is exposed; a point that stays sealed counts as blocked. The mask of the
// others.
uint32_t LinkSampler::move_to_exposed(const Element& element, uint64_t key, float u[16],
                                      float v[16]) {
  constexpr uint64_t most_draws = 400;
  uint32_t mask = exposed_mask(element, u, v);
  if (mask == all_pairs) return mask;
  Exposure::Part& part = part_of(element);
  for (int k = 0; k < lanes_per_packet; ++k) {
    for (uint64_t draw = 0; draw < most_draws && !(mask >> k & 1); ++draw) {
      // Of any sixteenth: to go on to the next one would favour those that follow sealed ones.
      const uint64_t h = mix(key, draw, static_cast<uint64_t>(k));
      double uv[2];
      spread_point(h, static_cast<int>(mix(h) % lanes_per_packet), uv);
      u[k] = static_cast<float>(uv[0]);
      v[k] = static_cast<float>(uv[1]);
      if (!part.sealed(element.corners.at(u[k], v[k]))) mask |= 1u << k;
    }
  }
  return mask;
}

// The pairs that are traced, with all that the first look at a link does without.
void LinkSampler::draw(const Element& receiver, const Element& source, uint64_t key,
                       LinkEstimate& estimate, DrawnPairs& drawn) {
  if (estimate.by_points) {
    EndPoints unused;
    draw_points(receiver, source, key, false, estimate, drawn, unused);
    if (estimate.near) scale_to(estimate, drawn);
    return;
  }
  PairPoints points = pattern_of(key);
  const EndsBySize ends(receiver, source);
  // Of close pairs the points on the larger end are drawn sealed or not.
  const bool move_small = ends.small.exposed < 1;
  const bool move_large = ends.large.exposed < 1 && !estimate.close_pairs;
  const bool move_receiver = ends.receiver_smaller ? move_small : move_large;
  const bool move_source = ends.receiver_smaller ? move_large : move_small;
  uint32_t receiver_exposed = all_pairs, source_exposed = all_pairs;
  if (move_receiver)
    receiver_exposed = move_to_exposed(receiver, mix(key, 1), points.receiver_u, points.receiver_v);
  if (move_source)
    source_exposed = move_to_exposed(source, mix(key, 2), points.source_u, points.source_v);
  estimate.exposed_only = move_receiver || move_source;
  estimate.exposed = move_receiver ? 1 : receiver.exposed;
  estimate.source_exposed = move_source ? 1 : source.exposed;
  estimate.source_area = move_source ? source.area * source.exposed : source.area;
  if (estimate.close_pairs) {
    draw_close_pairs(receiver, source, key, engine_.center(), engine_.offset(), points,
                     drawn.samples);
    scale_kernel(move_small ? mean_kernel(ends, points) : estimate.factor / source.area,
                 drawn.samples);
  } else {
    place_pairs(receiver, source, points, engine_.center(), engine_.offset(), drawn.samples);
  }
  if (!move_receiver)
    receiver_exposed = exposed_mask(receiver, points.receiver_u, points.receiver_v);
  if (!move_source) source_exposed = exposed_mask(source, points.source_u, points.source_v);
  drawn.exposed = receiver_exposed & source_exposed;
}

void LinkSampler::begin(const Element& receiver, const Element& source, uint64_t key,
                        DrawnPairs& drawn, LinkEstimate& estimate, double allowed) {
  if (allowed > 0 && begin_by_points(receiver, source, key, drawn, estimate, allowed)) return;
  draw_pairs(receiver, source, key, engine_.center(), engine_.offset(), drawn.samples);
  drawn.exposed = all_pairs;
  estimate = LinkEstimate{};
  estimate.source_area = source.area;
  estimate.exposed = receiver.exposed;
  estimate.source_exposed = source.exposed;
  const float* kernel = drawn.samples.kernel;
  double quarter[4];
  for (int q = 0; q < 4; ++q)
    quarter[q] = std::min(1.0, 0.25 * source.area *
                                   (static_cast<double>(kernel[4 * q]) + kernel[4 * q + 1] +
                                    kernel[4 * q + 2] + kernel[4 * q + 3]));
  const double distance = length(source.centroid - receiver.centroid);
  estimate.near = receiver.radius + source.radius > near_ratio_ * distance;
  if (!estimate.near) {
    estimate.factor = mean_of(quarter);
    estimate.variation = half_range(quarter);
    return;
  }
  const EndsBySize ends(receiver, source);
  estimate.close_pairs = is_close(ends);
  if (ends.receiver_smaller) {
    const MeanFactor mean = mean_factor(receiver.corners, receiver.normal, source.corners);
    estimate.factor = mean.mean;
    estimate.mean_error = mean.error;
    estimate.variation = mean.half_range;
  } else {
    // Reciprocity: integrate over the smaller of the two, where few points do.
    const MeanFactor mean = mean_factor(source.corners, source.normal, receiver.corners);
    const double ratio = source.area / receiver.area;
    // A small source near a large receiver lights a spot that the quarters may miss: about its own
    // size, and wider the higher it stands.
    const double height = dot(source.centroid - receiver.centroid, receiver.normal);
    const double spot = mean.mean * source.area / (source.area + pi * height * height);
    estimate.factor = mean.mean * ratio;
    estimate.mean_error = mean.error * ratio;
    estimate.variation = std::max(half_range(quarter), 0.5 * (spot - estimate.factor));
  }
}

void LinkSampler::add(const DrawnPairs& drawn, uint32_t lanes, uint32_t blocked,
                      LinkEstimate& estimate) {
  rays_ += __builtin_popcount(lanes);
  const uint32_t seen = lanes & drawn.exposed & ~blocked;
  for (int k = 0; k < lanes_per_packet; ++k) {
    if (!(lanes >> k & 1)) continue;
    // Near each other a pair of points may all but touch: it stands for a sixteenth of the source,
    // whose form factor is at most 1.
    double kernel = drawn.samples.kernel[k];
    if (estimate.near && !estimate.close_pairs && !estimate.by_points)
      kernel = std::min(kernel, lanes_per_packet / estimate.source_area);
    estimate.kernel_sum += kernel;
    if (seen >> k & 1) {
      estimate.visible_sum += kernel;
      estimate.quarter_sum[k / 4] += kernel;
    }
    ++estimate.pairs;
  }
}

void LinkSampler::trace_drawn(const DrawnPairs& drawn, LinkEstimate& estimate) {
  add(drawn, all_pairs, engine_.blocked(drawn.samples.packet), estimate);
}

void LinkSampler::trace(const Element& receiver, const Element& source, uint64_t key,
                        DrawnPairs& drawn, LinkEstimate& estimate) {
  if (!estimate.by_points && (receiver.exposed < 1 || source.exposed < 1 || estimate.close_pairs))
    draw(receiver, source, key, estimate, drawn);
  trace_drawn(drawn, estimate);
}

void LinkSampler::trace_more(const Element& receiver, const Element& source, uint64_t key,
                             int packets, LinkEstimate& estimate) {
  DrawnPairs drawn;
  for (int k = 1; k < packets; ++k) {
    draw(receiver, source, mix(key, static_cast<uint64_t>(k)), estimate, drawn);
    trace_drawn(drawn, estimate);
  }
  // The more pairs, the better the sampled kernel: use all of them.
  if (!estimate.near && estimate.pairs > 0)
    estimate.factor = std::min(1.0, estimate.kernel_sum / estimate.pairs * estimate.source_area);
}

float LinkSampler::exposed_share(const Node& place) const {
  const Surface& surface = forest_.surfaces[place.surface];
  if (!exposure_.can_be_sealed(surface.patch, surface.side)) return 1;
  const Triangle corners = forest_.triangle(place);
  Exposure::Part part(exposure_, surface.patch, surface.side, corners);
  if (!part.can_be_sealed()) return 1;
  const uint64_t key = key_of(forest_, place);
  // Few sets tell most elements that are sealed not at all or all over; the borders take more, and
  // larger elements too.
  constexpr int most_sets = 16;
  const int least_sets = std::max(2, most_sets >> ((place.level + 1) / 2));
  int exposed = 0, sets = 0;
  while (sets < most_sets) {
    const uint64_t set = static_cast<uint64_t>(sets++);
    for (int k = 0; k < lanes_per_packet; ++k) {
      double uv[2];
      spread_point(mix(key, set), k, uv);
      exposed += !part.sealed(corners.at(uv[0], uv[1]));
    }
    if (sets >= least_sets && (exposed == 0 || exposed == sets * lanes_per_packet)) break;
  }
  const int points = sets * lanes_per_packet;
  // What is pressed against small things may lie between all points.
  if (exposed == points)
    return static_cast<float>(1 - std::min(part.pressed_share(), 1.0 / points));
  return static_cast<float>(exposed) / static_cast<float>(points);
}

}  // namespace hrad
