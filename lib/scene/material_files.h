// The MTL files that an OBJ file names: found in its folder, or below it, and nowhere else.
// Floor 3 (scene).
#pragma once

#include <string>
#include <vector>

#include "scene/mtl_reader.h"
#include "scene/obj_content.h"

namespace hrad {

// Reads every file that the mtllib statements of the OBJ file at `path` name, each once. A missing
// one is a diagnostic. SCENE with the statement's file:line for a name that leads out of the
// scene's folder (by .., from the root, or over a symbolic link) and for what can't be read or is
// no regular file.
void read_material_files(const std::string& path, const ObjContent& content, MtlLibrary& library,
                         std::vector<std::string>& diagnostics);

}  // namespace hrad
