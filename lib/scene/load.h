// Getting a scene: from an OBJ file, or one of the built-in ones. Floor 3 (scene).
#pragma once

#include <string>

#include "scene/scene.h"

namespace hrad {

enum class Sides { front, two_sided, flip };

// Adds the patches of an OBJ file and the materials of its MTL files (Kd, Ke, and the marks that
// write_obj makes: two-sided, blocker, z-up) to the scene; nothing when it throws (FILE, or SCENE with file:line). Doubtful input goes to scene.diagnostics.
void load_obj(Scene& scene, const std::string& path, Sides sides);

// Fills an empty scene. ARGUMENT, listing all names, for an unknown one.
void make_builtin_scene(Scene& scene, const std::string& name);
const char* builtin_scene_name(int64_t index);  // nullptr past the last

// Marks what can't take part as dropped (zero area; same corners and winding as an earlier patch)
// and says so in scene.diagnostics. first: the patches before it are already checked, but count as
// "earlier".
void check_patches(Scene& scene, int64_t first);

// Writes the scene as OBJ to `path`, its materials beside it (same name, .mtl), each file whole or
// not at all.
void write_obj(const Scene& scene, const std::string& path);

}  // namespace hrad
