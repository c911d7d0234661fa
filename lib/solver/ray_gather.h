// Irradiance at a point by rays to the solved leaves: what sensors read, and what the solution is
// measured with. Emitted light by shadow rays to the emitters, reflected light by cosine rays, so
// that small lamps make no noise. Floor 8 (solver).
#pragma once

#include <cstdint>
#include <vector>

#include "stages/state.h"

namespace hrad {

class RayGather {
 public:
  RayGather(const State& state, const VisibilityEngine& engine);

  // Adds `rays` samples of each kind at x (on or off a surface; the caller has moved it off) with
  // normal n to sums per band: their sum and the sum of their squares, one sample being what one
  // shadow ray and one cosine ray bring together. stratum of strata: this call's part of a larger
  // set of samples spread evenly. Any thread. Returns the number of rays traced.
  int64_t sample(Vec3 x, Vec3 n, uint64_t key, int rays, double* sum, double* squares) const;

 private:
  double share(NodeId emitter, double distance2, double at_x, double at_y) const;

  const State& state_;
  const VisibilityEngine& engine_;
  std::vector<NodeId> emitters_;      // roots with emission
  std::vector<double> cumulative_;    // their power, running sum, last 1
  std::vector<double> chance_;        // per surface: of being picked by a shadow ray
};

}  // namespace hrad
