// Irradiance at a point by rays to the solved leaves: what sensors read, and what the solution is
// measured with. Emitted light by shadow rays to the emitters, reflected light by cosine rays, so
// that small lamps make no noise. Floor 8 (solver).
#pragma once

#include <cstdint>
#include <vector>

#include "base/draw.h"
#include "links/element.h"
#include "stages/state.h"

namespace hrad {

class RayGather {
 public:
  RayGather(const State& state, const VisibilityEngine& engine);

  // Emitters by the light that would arrive from them without occlusion anywhere on an element; of
  // those that give power, none is never picked.
  Draw emitters_near(const Element& receiver) const;

  // Adds `rays` samples of each kind at x (on or off a surface; the caller has moved it off) with
  // normal n to sums per band: their sum and the sum of their squares, one sample being what one
  // shadow ray and one cosine ray bring together. stratum of strata: this call's part of a larger
  // set of samples spread evenly. Any thread. Returns the number of rays traced.
  int64_t sample(Vec3 x, Vec3 n, uint64_t key, int rays, double* sum, double* squares) const;

  // One sample of each kind: what it brings, bands values. hemisphere: the cosine ray's two
  // coordinates in the unit square; light: the shadow ray's three, the first of which picks the
  // emitter. Returns the number of rays traced.
  int64_t sample_once(Vec3 x, Vec3 n, const double hemisphere[2], const double light[3],
                      const Draw& emitters, double* value) const;

 private:
  void add_by_cosine_ray(Vec3 x, Vec3 n, const double hemisphere[2], const Draw& emitters,
                         double* value) const;
  int add_by_shadow_ray(Vec3 x, Vec3 n, const double light[3], const Draw& emitters,
                        double* value) const;
  double share(size_t emitter, double chance, double distance2, double at_x, double at_y) const;

  const State& state_;
  const VisibilityEngine& engine_;
  std::vector<NodeId> emitters_;     // roots with emission
  std::vector<double> power_;        // of each
  std::vector<int32_t> emitter_of_;  // per root its place among them, -1: none
  Draw by_power_;
};

}  // namespace hrad
