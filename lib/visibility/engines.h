// The engines behind the seam, one function each. Floor 4 (visibility).
#pragma once

#include <memory>
#include <string>

#include "visibility/visibility.h"

namespace hrad {

// The middle of the scene and half the diagonal of its box (1 for a scene without extent). SCENE
// for one that single precision can't hold.
void measure_scene(const Scene& scene, Vec3& center, double& radius);

std::unique_ptr<VisibilityEngine> make_builtin_engine(const Scene& scene,
                                                      const std::string& instruction_set,
                                                      ThreadTeam& team);
#ifdef HRAD_WITH_EMBREE
std::unique_ptr<VisibilityEngine> make_embree_engine(const Scene& scene,
                                                     const std::string& instruction_set,
                                                     ThreadTeam& team);
#endif

}  // namespace hrad
