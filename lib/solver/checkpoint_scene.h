// The scene as sections of a checkpoint and back: materials, vertices, patches. Floor 8 (solver).
#pragma once

#include "scene/scene.h"
#include "solver/packed_bytes.h"

namespace hrad {

void pack_materials(const Scene& scene, PackedBytes& bytes);
void unpack_materials(PackedReader& bytes, int64_t materials, Scene& scene);

// Vertices or patches first .. end-1; unpacking appends them. Materials and all vertices come
// before the patches.
void pack_vertices(const Scene& scene, int64_t first, int64_t end, PackedBytes& bytes);
void unpack_vertices(PackedReader& bytes, int64_t first, int64_t end, Scene& scene);
void pack_patches(const Scene& scene, int64_t first, int64_t end, PackedBytes& bytes);
void unpack_patches(PackedReader& bytes, int64_t first, int64_t end, Scene& scene);

// "" when two scenes are the same in all that decides a solution; or the first difference, as "the
// file has 36 patches and the scene 12".
std::string difference_of(const Scene& of_file, const Scene& here);

}  // namespace hrad
