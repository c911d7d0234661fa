// Light straight from bright emitters to a point: exact form factors (Lambert) times the visible
// fraction by sixteen shadow rays spread over the emitter, or over what is seen of its parts where
// it is near; by up to four times as many in the penumbra of a strong one. Floor 6 (links).
#pragma once

#include <cstdint>
#include <vector>

#include "links/element.h"
#include "links/light_grid.h"
#include "links/link.h"
#include "visibility/visibility.h"

namespace hrad {

class DirectLight {
 public:
  // noise: what the visible fraction of an emitter may be off by, times the light that it would
  // bring, in units of the mean irradiance: weak ones take fewer than sixteen rays. All must
  // outlive this.
  DirectLight(const Forest& forest, const VisibilityEngine& engine, const Emitters& emitters,
              const LightGrid& grid, double noise);

  // Appends one link per visible surface of every emitter that is worth sampling there, or one for
  // a group, weight = form factor times visible fraction. The point lies on a surface, not lifted.
  // Any thread. Returns the number of rays.
  int64_t sample(const OrientedPoint& point, uint64_t key, std::vector<Link>& links) const;

  // What links of sample() bring to its point, by the brightness of their sources: what was looked
  // at by chance as if it always were, so that a mesh follows the light and not the chance.
  double light_of(const OrientedPoint& point, Span<const Link> links,
                  const std::vector<float>& brightness) const;

  // About the rays that sample() would take there.
  double rays_at(const OrientedPoint& point) const;

 private:
  struct Batch;
  struct Weights {  // of rays
    double all = 0, visible = 0;
  };
  double rays_for(double light, double variance) const;
  size_t rays_of_penumbra(double light) const;
  // 1, 4 or 16, none where the emitter isn't worth sampling; traced by this chance, and then for
  // all those that are not.
  struct Wanted {
    int rays;
    double chance;
  };
  Wanted wanted_of(const Emitter& emitter, bool hidden, Vec3 x, Vec3 normal) const;
  static bool is_near(const Emitter& emitter, const OrientedPoint& point);
  void add(const Emitter& emitter, const Wanted& wanted, uint64_t key, const OrientedPoint& point,
           Batch& batch) const;
  void add_group(const Emitter& group, const Wanted& wanted, uint64_t key,
                 const OrientedPoint& point, Batch& batch) const;
  void finish(const OrientedPoint& point, Batch& batch, std::vector<Link>& links) const;
  int64_t look_closer(const Emitter& emitter, const OrientedPoint& point, Weights& sum) const;
  int64_t sample_near(NodeId root, const OrientedPoint& point, uint64_t key,
                      std::vector<Link>& links) const;

  const Forest& forest_;
  const VisibilityEngine& engine_;
  const Emitters& emitters_;
  const LightGrid& grid_;
  const double noise_;
};

}  // namespace hrad
