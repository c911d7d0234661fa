// hrad.h, section "load". Floor 9 (api).
#include "scene/load.h"

#include <algorithm>

#include "api/arguments.h"
#include "api/guard.h"

namespace {

int32_t material_flags(const hrad::Material& material) {
  return (material.two_sided ? HRAD_TWO_SIDED : 0) | (material.blocker ? HRAD_BLOCKER : 0);
}

hrad::Material material_of(const hrad_material* material, int bands) {
  hrad::api::require(material, "the material");
  hrad::api::require_struct_size(material->struct_size, "hrad_material");
  const hrad_material given = hrad::api::copy_struct_in(material);
  if (given.flags & ~(HRAD_TWO_SIDED | HRAD_BLOCKER))
    hrad::fail(hrad::Status::argument,
               "the flags of the material are %d: only HRAD_TWO_SIDED and HRAD_BLOCKER are known",
               static_cast<int>(given.flags));
  hrad::Material made;
  if (given.name) made.name = given.name;
  if (given.reflectance) made.reflectance.assign(given.reflectance, given.reflectance + bands);
  if (given.emission) made.emission.assign(given.emission, given.emission + bands);
  made.two_sided = (given.flags & HRAD_TWO_SIDED) != 0;
  made.blocker = (given.flags & HRAD_BLOCKER) != 0;
  return made;
}

}  // namespace

hrad_status hrad_add_material(hrad_solver* solver, const hrad_material* material, int32_t* number) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    hrad::Material made;
    if (inside.describes_scene()) made = material_of(material, inside.scene().bands);
    const int32_t added = inside.add_material(std::move(made));
    if (number) *number = added;
  });
}

hrad_status hrad_add_patches(hrad_solver* solver, int64_t n_vertices, const double* xyz,
                             int64_t n_triangles, const int64_t* vertex, const int32_t* material) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    if (inside.describes_scene()) {
      hrad::api::require_array(xyz, n_vertices, "xyz");
      hrad::api::require_array(vertex, n_triangles, "vertex");
    }
    inside.add_patches(n_vertices, xyz, n_triangles, vertex, material);
  });
}

hrad_status hrad_load_scene(hrad_solver* solver, const char* path) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    if (inside.describes_scene()) hrad::api::require(path, "the path of the scene");
    inside.load_scene(path ? path : "");
  });
}

hrad_status hrad_make_scene(hrad_solver* solver, const char* name) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    hrad::api::require(name, "the name of the scene");
    inside.make_scene(name);
  });
}

const char* hrad_scene_name(int64_t index) {
  return index < 0 ? nullptr : hrad::builtin_scene_name(index);
}

hrad_status hrad_scene_size(const hrad_solver* solver, int64_t* patches, int64_t* materials) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    if (patches) *patches = inside.scene().patch_count();
    if (materials) *materials = static_cast<int64_t>(inside.scene().materials.size());
  });
}

hrad_status hrad_get_patch(const hrad_solver* solver, int64_t patch, hrad_patch* out) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    hrad::api::require(out, "the place for the patch");
    hrad::api::require_struct_size(out->struct_size, "hrad_patch");
    const hrad::Scene& scene = inside.scene();
    hrad::api::require_range(patch, 1, scene.patch_count(), "patches");
    const hrad::Triangle triangle = scene.triangle(patch);
    hrad_patch full = {};
    double* xyz = full.corners_xyz;
    for (const hrad::Vec3& corner : {triangle.a, triangle.b, triangle.c})
      for (int axis = 0; axis < 3; ++axis) *xyz++ = corner[axis];
    const bool dropped = scene.has(patch, hrad::patch_dropped);
    full.area = dropped ? 0 : 0.5 * hrad::length(triangle.area_vector());
    const auto index = static_cast<size_t>(patch);
    full.face = scene.face[index];
    full.material = scene.material[index];
    full.flags = scene.flags[index];
    hrad::api::copy_struct_out(full, out);
  });
}

hrad_status hrad_get_material(const hrad_solver* solver, int32_t material, char* name, int64_t size,
                              int64_t* needed, double* reflectance, double* emission,
                              int32_t* flags) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    const std::vector<hrad::Material>& materials = inside.scene().materials;
    hrad::api::require_range(material, 1, static_cast<int64_t>(materials.size()), "materials");
    const hrad::Material& found = materials[static_cast<size_t>(material)];
    hrad::api::copy_text(found.name, name, size, needed);
    if (reflectance) std::copy(found.reflectance.begin(), found.reflectance.end(), reflectance);
    if (emission) std::copy(found.emission.begin(), found.emission.end(), emission);
    if (flags) *flags = material_flags(found);
  });
}

hrad_status hrad_get_diagnostic(const hrad_solver* solver, int64_t index, char* text, int64_t size,
                                int64_t* needed) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    const std::vector<std::string> all = inside.diagnostics();
    hrad::api::require_range(index, 1, static_cast<int64_t>(all.size()), "diagnostics");
    hrad::api::copy_text(all[static_cast<size_t>(index)], text, size, needed);
  });
}

hrad_status hrad_set_emission(hrad_solver* solver, int64_t first_patch, int64_t count,
                              const double* emission) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    if (inside.describes_scene()) hrad::api::require_array(emission, count, "emission");
    inside.set_emission(first_patch, count, emission);
  });
}

hrad_status hrad_set_reflectance(hrad_solver* solver, int64_t first_patch, int64_t count,
                                 const double* reflectance) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    if (inside.describes_scene()) hrad::api::require_array(reflectance, count, "reflectance");
    inside.set_reflectance(first_patch, count, reflectance);
  });
}
