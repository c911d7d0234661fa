// The seam between the method and the ray engines: who sees whom, in batches. Two engines stand
// behind it: our own (builtin) and Embree. Results are part of the solution, so an engine must give
// the same hits whatever the processor or the number of threads. Floor 4 (visibility).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/span.h"
#include "base/vec3.h"
#include "machine/thread_team.h"
#include "scene/scene.h"

namespace hrad {

// Sixteen segments that are tested together, ordinarily those of one link. Coordinates are relative
// to VisibilityEngine::center(). Segment i runs from (ox,oy,oz) to (ox,oy,oz)+(dx,dy,dz); only
// those of `active` (bit i) are looked at.
struct alignas(64) SegmentPacket {
  float ox[16], oy[16], oz[16];
  float dx[16], dy[16], dz[16];
  uint32_t active = 0;

  // Segment k, without making it active.
  void set(int k, Vec3 from, Vec3 to) {
    ox[k] = static_cast<float>(from.x);
    oy[k] = static_cast<float>(from.y);
    oz[k] = static_cast<float>(from.z);
    dx[k] = static_cast<float>(to.x - from.x);
    dy[k] = static_cast<float>(to.y - from.y);
    dz[k] = static_cast<float>(to.z - from.z);
  }
  // Likewise one of another packet.
  void take(int k, const SegmentPacket& other, int lane) {
    ox[k] = other.ox[lane];
    oy[k] = other.oy[lane];
    oz[k] = other.oz[lane];
    dx[k] = other.dx[lane];
    dy[k] = other.dy[lane];
    dz[k] = other.dz[lane];
  }
};

struct Hit {
  int64_t patch = -1;   // -1: nothing was hit
  double t = 0;         // hit point = origin + t * direction
  bool back = false;    // the ray met the back of the patch
  double u = 0, v = 0;  // hit point = Triangle::at(u, v) of the patch
};

class VisibilityEngine {
 public:
  virtual ~VisibilityEngine() = default;

  // Bit i set: something lies strictly between the ends of segment i (0 < t < 1). Any thread.
  virtual uint32_t blocked(const SegmentPacket& packet) const = 0;

  // The nearest hit of a ray with t > t_min; of equally near ones that of a patch met from its
  // front, of the lowest such patch. Origin and direction are in scene coordinates (not relative to
  // the center); the direction need not have length 1. Any thread.
  virtual Hit nearest(Vec3 origin, Vec3 direction, double t_min) const = 0;

  virtual const char* name() const = 0;     // "builtin" or "embree"
  virtual std::string version() const = 0;  // of the engine
  virtual int64_t bytes() const = 0;        // memory of the structure

  // Origin of the packets' coordinates, the middle of the scene: keeps single precision useful.
  Vec3 center() const { return center_; }
  // Half the diagonal of the scene's box.
  double radius() const { return radius_; }
  // Ray ends are moved off their surfaces by this length towards the front: 4e-6 scene radii, above
  // the rounding of single precision (about 1e-7 radii), below every gap that a scene means.
  double offset() const { return 4e-6 * radius_; }

 protected:
  Vec3 center_;
  double radius_ = 1;
};

// Builds an engine over all patches of the scene but the dropped ones. name: "builtin" or "embree"
// (UNSUPPORTED where it was not found at configure time). instruction_set: "auto", or one of
// "sse2", "avx2", "avx512" to force the builtin engine's kernels (ARGUMENT for one that this
// processor lacks). The scene must outlive the engine.
std::unique_ptr<VisibilityEngine> make_visibility_engine(const Scene& scene,
                                                         const std::string& name,
                                                         const std::string& instruction_set,
                                                         ThreadTeam& team);

}  // namespace hrad
