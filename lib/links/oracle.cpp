// The two oracles. The error-driven one gives every link a share of the error that is proportional
// to the light it carries: with v the relative error of a link and s = weight * brightness its
// share of the irradiance, links of independent errors add up to a variance of sum (v s)^2, so v^2
// s below a constant keeps that sum below the constant times the irradiance, however finely a
// source is split. Floor 6 (links).
#include "links/oracle.h"

#include <algorithm>

namespace hrad {
namespace {

// Packets of rays before a link that matters is taken for clear, and for dark: what is taken for
// dark is lost for good.
constexpr int packets_before_verdict = 4;
constexpr int packets_before_dark = 8;
// The most where few of the rays tell anything.
constexpr int most_packets_before_verdict = 64;
constexpr int rays_before_verdict = 16 * packets_before_verdict;
constexpr double least_visible = 1.0 / rays_before_verdict;
// Visible fractions nearer to 1 than this are 1.
constexpr double almost_clear = 0.5 / rays_before_verdict;

// Mean of V (1-V) over the fractions V that a shadow's edge brings.
constexpr double partial_variance = 1.0 / 6;

// Partial visibility over a receiver weighs more at points than its own variance: all light that an
// edge cuts off is cut off along the same line.
constexpr double edge_weight = 4;

// What is hidden of an uneven source is hidden from many receivers, and is as a rule its dark part:
// such errors all go one way, and add up where others of the same size average out.
constexpr double one_way_weight = 10;
// Links that are estimated roughly are refined for what many of them add up to.
constexpr double rough_in_question = 0.3;

// An error over a whole element counts less for its patch the smaller the element is, and for the
// root mean square over points likewise.
double mean_share(const LinkLoad& load) { return load.receiver_area / load.patch_area; }
double point_share(const OracleSettings& s, const LinkLoad& load) {
  return std::min(1.0, load.receiver_area / s.point_area);
}

}  // namespace

bool surely_good(const OracleSettings& s, const LinkLoad& load) {
  if (s.kind == OracleKind::energy) return load.power <= s.power;
  const double carried = load.weight * load.brightness / least_visible;
  return carried * mean_share(load) <= s.mean_variance &&
         carried * point_share(s, load) <= s.point_variance;
}

Decision judge_energy(const OracleSettings& s, const LinkLoad& load) {
  if (load.power <= s.power) return Decision::keep;
  // The larger of the two is refined; a source without elements of its own can't be.
  if (load.source_area > load.receiver_area && load.may_descend) return Decision::descend_source;
  if (load.may_split) return Decision::split_receiver;
  return load.may_descend ? Decision::descend_source : Decision::keep;
}

Decision judge_error(const OracleSettings& s, const LinkLoad& load, const LinkEstimate& e,
                     double size_ratio) {
  // What the link could carry: its weight is a sample, and links that chance has made too heavy
  // must not be refined more readily than those it has made too light, or light is lost.
  const double carried = e.potential() * load.brightness;
  const double relative = e.potential() > 0 ? e.variation / e.potential() : 0;
  const double quadrature = e.factor > 0 ? e.mean_error / e.factor : 0;
  const double visible = e.factor > 0 ? load.weight / e.factor : 1;
  const bool partly_seen = visible < 1 - almost_clear;
  const double partial = partly_seen ? carried * partial_variance : 0;
  // Variation over the receiver: of the kernel, and of what is seen of the source.
  const double at_points =
      load.receiver_area > s.point_min_area
          ? (carried * relative * relative + edge_weight * partial) * point_share(s, load)
          : 0;
  const double in_mean =
      (carried * quadrature * quadrature + partial / rays_before_verdict) * mean_share(load);
  if (load.may_split && (at_points > s.point_variance || in_mean > s.mean_variance))
    return Decision::split_receiver;
  if (load.may_descend && load.brightness > 0) {
    // An uneven source matters as far as the kernel is uneven across it, or the view of it. What is
    // hidden from one receiver is often hidden from all, and dark for that: such errors don't
    // average out over a patch, however small the receivers are.
    const double uneven = load.source_spread / load.brightness;
    const double by_kernel = std::min(1.0, size_ratio * size_ratio) * mean_share(load);
    const double by_view = partly_seen ? partial_variance : 0;
    if (carried * uneven * uneven * (by_kernel + by_view) > s.mean_variance)
      return Decision::descend_source;
  }
  return Decision::keep;
}

Decision judge_with_clusters(const OracleSettings& s, const LinkLoad& load, const LinkEstimate& e,
                             const Element& receiver, const Element& source) {
  const double carried = e.potential() * load.brightness;
  const double relative = e.potential() > 0 ? e.variation / e.potential() : 0;
  const double visible = e.factor > 0 ? std::min(1.0, load.weight / e.factor) : 1;
  const double distance = length(source.centroid - receiver.centroid);
  const double size = receiver.radius + source.radius;
  const double by_kernel = size < distance ? size * size / (distance * distance) : 1;
  const double by_view = one_way_weight * visible * (1 - visible);
  const double uneven = load.brightness > 0 ? load.source_spread / load.brightness : 0;
  const double of_source = carried * uneven * uneven;
  // Small receivers side by side all have the same error by an uneven source.
  if (load.may_descend && (of_source * (by_view + by_kernel * mean_share(load)) > s.mean_variance ||
                           of_source * by_kernel > s.point_variance))
    return Decision::descend_source;
  const double partial = visible < 1 - almost_clear ? carried * partial_variance : 0;
  const double at_points = (carried * relative * relative + edge_weight * partial) *
                           (load.receiver_area > s.point_min_area ? point_share(s, load) : 0);
  // What varies over a cluster is wrong on its patches. Rough estimates are good enough for means
  // by the way they are chosen.
  const double quadrature = e.by_points || !(e.factor > 0) ? 0 : e.mean_error / e.factor;
  const double in_mean =
      receiver.cluster
          ? carried * relative * relative + partial
          : (carried * quadrature * quadrature + partial / rays_before_verdict) * mean_share(load);
  if (at_points <= s.point_variance && in_mean <= s.mean_variance) return Decision::keep;
  const bool split =
      load.may_split && (!source.cluster || receiver.radius >= source.radius || !load.may_descend);
  if (split) return Decision::split_receiver;
  return load.may_descend ? Decision::descend_source : Decision::keep;
}

int packets_wanted(const OracleSettings& s, const LinkLoad& load, const LinkEstimate& e) {
  // No pair that counts was met: everything behind a horizon or sealed.
  if (!(e.kernel_sum > 0)) return s.most_packets;
  const double visible = e.visible();
  const double variance = std::max(visible * (1 - visible), 1.0 / 18);
  // All light that is seen arrives on the exposed part of what the pairs are drawn from.
  const double error = e.potential() * load.brightness * variance * mean_share(load) /
                       std::max(1e-9, e.exposed * e.exposed);
  const double wanted = error / (16 * s.mean_variance);
  // Nothing seen, or nothing blocked, by n rays means a share below about 1/n, not none. Links that
  // look dark or clear are refined no further, others are: where that is to be decided by chance,
  // in this round or in a later one, few rays would lose light for good. The loss falls with 1/n^2.
  const bool even = visible <= 0 || visible >= 1;
  const bool in_question = e.potential() * load.brightness * point_share(s, load) >
                           s.last_point_variance * (e.by_points ? rough_in_question : 1);
  const double most_to_meet = e.by_points ? s.most_packets : most_packets_before_verdict;
  const double most = e.exposed < 1 ? most_to_meet : s.most_packets;
  const int packets = static_cast<int>(std::min(most, wanted + 1));
  if (!even) return packets;
  // Pairs on sealed points say nothing: where little is exposed it takes more to meet that little.
  const int verdict = visible <= 0 ? packets_before_dark : packets_before_verdict;
  const double least = (in_question ? verdict : 1) / std::max(1e-9, e.telling());
  return std::max(packets, static_cast<int>(std::min<double>(most_to_meet, least)));
}

void trace_as_wanted(const OracleSettings& settings, const LinkLoad& load, LinkSampler& sampler,
                     const Element& receiver, const Element& source, uint64_t key,
                     DrawnPairs& drawn, LinkEstimate& estimate) {
  sampler.trace(receiver, source, key, drawn, estimate);
  const int packets = packets_wanted(settings, load, estimate);
  if (packets > 1) sampler.trace_more(receiver, source, key, packets, estimate);
}

}  // namespace hrad
