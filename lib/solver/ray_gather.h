// Irradiance at a point by rays to the solved leaves: what sensors read, and what the solution is
// measured with. Emitted light by shadow rays to the emitters, reflected light by cosine rays, so
// that small lamps make no noise. Floor 8 (solver).
#pragma once

#include <cstdint>
#include <vector>

#include "base/draw.h"
#include "links/element.h"
#include "stages/light_of_all.h"
#include "stages/state.h"

namespace hrad {

class RayGather {
 public:
  // What a cosine ray brings from the leaf it meets: the solved radiosity, or (doubted) where much
  // is reflected ordinarily what one more sample taken there finds, and so on. In a gap between
  // bright walls light is lost little by little over many bounces, and a single one hardly shows
  // it.
  enum class Solution { trusted, doubted };
  // radiosity: of all nodes. All must outlive this.
  RayGather(const State& state, const LightOfAll& radiosity, const VisibilityEngine& engine,
            Solution solution = Solution::trusted);

  // Emitters by the light that would arrive from them without occlusion anywhere on an element; of
  // those that give power, none is never picked. space: of one thread, used again and again.
  struct NearEmitters {
    std::vector<double> light;
    Draw draw;
  };
  const Draw& emitters_near(const Element& receiver, NearEmitters& space) const;

  static constexpr int shadow_rays = 16;  // of a sample: one packet

  // Irradiance at x (on or off a surface; the caller has moved it off) with normal n, bands values:
  // sample number k of a sequence that fills hemisphere and emitters evenly, of one packet of
  // shadow rays and so many cosine rays. Any thread. Returns the number of rays traced.
  int64_t sample(Vec3 x, Vec3 n, uint64_t key, uint32_t k, int cosine_rays, const Draw& emitters,
                 double* value) const;

 private:
  int64_t sample(Vec3 x, Vec3 n, uint64_t key, uint32_t k, int cosine_rays, const Draw& emitters,
                 int bounces, double* value) const;
  int64_t add_by_cosine_ray(Vec3 x, Vec3 n, const double p[4], uint64_t key, int cosine_rays,
                            const Draw& emitters, int bounces, double* value) const;
  bool goes_on(const Hit& hit, double random) const;
  int64_t add_by_shadow_rays(Vec3 x, Vec3 n, uint64_t key, uint32_t first, int cosine_rays,
                             const Draw& emitters, double* value) const;
  double share(size_t emitter, double chance, double distance2, double at_x, double at_y,
               int cosine_rays) const;

  const State& state_;
  const LightOfAll& radiosity_;
  const VisibilityEngine& engine_;
  const Solution solution_;
  std::vector<NodeId> emitters_;     // roots with emission
  std::vector<double> power_;        // of each
  std::vector<int32_t> emitter_of_;  // per root its place among them, -1: none
  Draw by_power_;
};

}  // namespace hrad
