// The two oracles. The error-driven one gives every link a share of the error that is proportional
// to the light it carries: with v the relative error of a link and s = weight * brightness its share
// of the irradiance, links of independent errors add up to a variance of sum (v s)^2, so v^2 s below
// a constant keeps that sum below the constant times the irradiance, however finely a source is
// split. Floor 6 (links).
#include "links/oracle.h"

#include <algorithm>

namespace hrad {
namespace {

// With sixteen rays a visible fraction that is not zero is at least a sixteenth.
constexpr double least_visible = 1.0 / 16;

// Packets of rays before a link that matters is taken for clear or dark.
constexpr int packets_before_verdict = 4;

// Partial visibility over a receiver weighs more at points than its own variance: all light that an
// edge cuts off is cut off along the same line.
constexpr double edge_weight = 4;

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
  const double carried = load.weight * load.brightness;
  // Partial visibility, bright and dark alike: were links that look almost clear kept more readily
  // than those that look almost dark, the chance of sampling would brighten the scene.
  const double visible = e.factor > 0 ? std::min(1.0, load.weight / e.factor) : 0;
  const double partial = e.factor * load.brightness * visible * (1 - visible);
  const double relative = e.factor > 0 ? e.variation / e.factor : 0;
  const double quadrature = e.factor > 0 ? e.mean_error / e.factor : 0;
  // Variation over the receiver: of the kernel, and of what is seen of the source.
  const double at_points = (carried * relative * relative + edge_weight * partial) * point_share(s, load);
  const double in_mean =
      (carried * quadrature * quadrature + partial / 64) * mean_share(load);
  if (load.may_split && (at_points > s.point_variance || in_mean > s.mean_variance))
    return Decision::split_receiver;
  if (load.may_descend && load.brightness > 0) {
    // An uneven source matters as far as the kernel or the view of it is uneven across it.
    const double uneven = load.source_spread / load.brightness;
    const double skew = std::min(1.0, size_ratio * size_ratio) +
                        (carried > 0 ? std::min(1.0, partial / carried) : 1.0);
    if (carried * uneven * uneven * std::min(1.0, skew) * mean_share(load) > s.mean_variance)
      return Decision::descend_source;
  }
  return Decision::keep;
}

int packets_wanted(const OracleSettings& s, const LinkLoad& load, const LinkEstimate& e) {
  // No pair that counts was met: everything behind a horizon or sealed.
  if (!(e.kernel_sum > 0)) return s.most_packets;
  const double visible = e.visible();
  const double variance = std::max(visible * (1 - visible), 1.0 / 18);
  const double error = e.factor * load.brightness * variance * mean_share(load);
  const double wanted = error / (16 * s.mean_variance);
  // Nothing seen, or nothing blocked, by n rays means a share below about 1/n, not none. Links that
  // look dark or clear are refined no further, others are: where that is to be decided by chance, in
  // this round or in a later one, few rays would lose light for good. The loss falls with 1/n^2.
  const bool even = visible <= 0 || visible >= 1;
  const bool in_question =
      e.factor * load.brightness * point_share(s, load) > s.last_point_variance;
  const int least = even && in_question ? packets_before_verdict : 1;
  return std::max(least, std::min(s.most_packets, static_cast<int>(wanted) + 1));
}

}  // namespace hrad
