// The bright emitters, those whose light comes through links of its own rather than by chance:
// joined where they lie in one plane, side by side, with the same emission. Floor 6 (links).
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy/forest.h"

namespace hrad {

// Emitting surfaces of one plane that shine alike.
struct Emitter {
  Vec3 center, normal;
  double radius = 0, area = 0;
  double brightness = 0;  // radiosity over the scene's mean, in units of the mean irradiance
  std::vector<NodeId> surfaces;
  // Sixteen points spread over it by area.
  Vec3 point[16];
};

class Emitters {
 public:
  // brightness: per root, its radiosity in units of the scene's mean irradiance, reflected light
  // included. least_bright: what brightness squared times form factor must reach for an emitter to
  // be bright where it is seen so large.
  Emitters(const Forest& forest, const std::vector<float>& brightness, double least_bright);

  const std::vector<Emitter>& all() const { return emitters_; }
  // Number of the emitter that a root belongs to, -1: it is none.
  int32_t of_root(NodeId root) const { return of_root_[root]; }
  // About the emitter's form factor at x on a surface of this normal, 0 behind a horizon: a matter
  // of geometry alone, whether it is seen or not.
  static double rough_factor(const Emitter& emitter, Vec3 x, Vec3 normal);
  bool is_bright(const Emitter& emitter, double factor) const {
    return emitter.brightness * emitter.brightness * factor > least_bright_;
  }
  bool bright(const Emitter& emitter, Vec3 x, Vec3 normal) const {
    return is_bright(emitter, rough_factor(emitter, x, normal));
  }
  // Whether the emitter is to be sampled at a point: also where it is not quite bright, but may be
  // so in the middle of a leaf that the point belongs to.
  bool is_sampled(const Emitter& emitter, double factor) const {
    return is_bright(emitter, factor * sampling_margin);
  }
  // False: at no point of this ball is the emitter sampled, if but `share` of it is visible.
  bool can_be_sampled(const Emitter& emitter, Vec3 center, double radius, double share = 1) const;

 private:
  static constexpr double sampling_margin = 2;

  std::vector<Emitter> emitters_;
  std::vector<int32_t> of_root_;
  double least_bright_;
};

}  // namespace hrad
