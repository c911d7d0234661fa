// The oracle: whether a link is good enough, or its receiver is split, or its source descended
// (paper, Section 2, Refinement; Hanrahan, Saltzman, Aupperle 1991, Section 4; for the error-driven
// one Lischinski, Smits, Greenberg 1994). Floor 6 (links).
#pragma once

#include <cstdint>

#include "links/element.h"
#include "links/link_sampler.h"

namespace hrad {

enum class OracleKind { energy, error };

struct OracleSettings {
  OracleKind kind = OracleKind::error;
  // Energy: the power (W, largest band) that a link may carry unrefined.
  double power = 0;
  // Error: allowed variance of a patch mean, and of a point, per unit of irradiance carried, both
  // relative to the scene's mean irradiance.
  double mean_variance = 0, point_variance = 0;
  double last_mean_variance = 0, last_point_variance = 0;  // those of the last round
  double point_area = 1;      // area at which point_variance holds; smaller elements may err more
  double point_min_area = 0;  // smaller receivers are not split for the sake of points
  double min_area = 0;        // nor for that of means
  double near_ratio = 0.4;    // LinkSampler's
  uint64_t seed = 1;
  int most_packets = 16;  // of visibility for one link, more where little of it is exposed
};

enum class Decision { keep, split_receiver, descend_source };

// The link as far as it is known without looking at its geometry.
struct LinkLoad {
  double weight = 0;
  double brightness = 0;     // of the source
  double source_spread = 0;  // of brightness within the source
  double power = 0;          // W it carries to the receiver, largest band
  double receiver_area = 0, source_area = 0, patch_area = 0;
  bool may_split = false;    // the receiver
  bool may_descend = false;  // the source
};

// True when nothing about the geometry could make the link worth refining: saves the estimate.
bool surely_good(const OracleSettings& settings, const LinkLoad& load);

// The error oracle's verdict; estimate.factor and .variation are of the unoccluded link.
Decision judge_error(const OracleSettings& settings, const LinkLoad& load,
                     const LinkEstimate& estimate, double size_ratio);

// The same for linking=clusters, whatever the ends are.
Decision judge_with_clusters(const OracleSettings& settings, const LinkLoad& load,
                             const LinkEstimate& estimate, const Element& receiver,
                             const Element& source);

// The energy oracle's verdict.
Decision judge_energy(const OracleSettings& settings, const LinkLoad& load);

// Packets of rays that bring the error of the visible fraction below the budget.
int packets_wanted(const OracleSettings& settings, const LinkLoad& load,
                   const LinkEstimate& estimate);

// Traces so many packets of the link, from a first one that begin() has drawn.
void trace_as_wanted(const OracleSettings& settings, const LinkLoad& load, LinkSampler& sampler,
                     const Element& receiver, const Element& source, uint64_t key,
                     DrawnPairs& drawn, LinkEstimate& estimate);

}  // namespace hrad
