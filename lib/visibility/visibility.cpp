// The table of ray engines. Floor 4 (visibility).
#include "visibility/visibility.h"

#include <cmath>

#include "base/error.h"
#include "visibility/engines.h"

namespace hrad {

namespace {

struct EngineEntry {
  const char* name;
  // nullptr: known, but not part of this build.
  std::unique_ptr<VisibilityEngine> (*make)(const Scene&, const std::string&, ThreadTeam&);
};

const EngineEntry engines[] = {
    {"builtin", make_builtin_engine},
#ifdef HRAD_WITH_EMBREE
    {"embree", make_embree_engine},
#else
    {"embree", nullptr},
#endif
};

}  // namespace

void measure_scene(const Scene& scene, Vec3& center, double& radius) {
  Box box;
  for (int64_t patch = 0; patch < scene.patch_count(); ++patch) {
    if (scene.has(patch, patch_dropped)) continue;
    const Triangle triangle = scene.triangle(patch);
    for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) {
      if (!std::isfinite(corner.x + corner.y + corner.z))
        fail(Status::scene, "patch %lld has a corner that is not finite",
             static_cast<long long>(patch));
      box.grow(corner);
    }
  }
  center = box.empty() ? Vec3{} : box.center();
  radius = box.empty() ? 0 : 0.5 * length(box.extent());
  if (radius == 0) radius = 1;
  // Products of three lengths must stay within single precision.
  if (!(radius > 1e-8 && radius < 1e11))
    fail(Status::scene, "the scene's size of %g lies outside 1e-8 to 1e11: choose another unit",
         radius);
  // Below that, patches and points on them are no longer where they should be.
  constexpr double most_radii_from_origin = 1e10;
  const double distance = length(center);
  if (distance > most_radii_from_origin * radius)
    fail(Status::scene,
         "the scene has a size of %g and lies %g from the origin: too few digits are left for its "
         "coordinates; move it to the origin",
         radius, distance);
}

std::unique_ptr<VisibilityEngine> make_visibility_engine(const Scene& scene,
                                                         const std::string& name,
                                                         const std::string& instruction_set,
                                                         ThreadTeam& team) {
  std::string names;
  for (const EngineEntry& entry : engines) {
    if (name == entry.name) {
      if (!entry.make)
        fail(Status::unsupported,
             "this build has no visibility engine '%s': build it where CMake finds that, or leave "
             "the parameter 'visibility' out",
             name.c_str());
      return entry.make(scene, instruction_set, team);
    }
    names += names.empty() ? entry.name : std::string(", ") + entry.name;
  }
  fail(Status::argument, "unknown visibility engine '%s'; known: %s", name.c_str(), names.c_str());
}

}  // namespace hrad
