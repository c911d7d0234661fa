// Reads an OBJ file with its MTL files into a scene. Floor 3 (scene).
#include <algorithm>
#include <limits>
#include <utility>

#include "base/error.h"
#include "machine/file_self.h"
#include "scene/load.h"
#include "scene/material_files.h"
#include "scene/obj_content.h"
#include "scene/obj_lexer.h"
#include "scene/triangulate.h"

namespace hrad {

namespace {

using std::to_string;

class Reader {
 public:
  Reader(const std::string& path, int bands, Sides sides) : path_(path), sides_(sides) {
    made_.bands = bands;
  }

  Scene read() {
    std::string text;
    if (!read_file(path_, text))
      fail(Status::file, "%s: cannot open: No such file or directory", path_.c_str());
    content_ = parse_obj(path_, text);
    read_material_files(path_, content_, mtl_, made_.diagnostics);
    add_materials();
    made_.vertices = std::move(content_.vertices);
    made_.z_up = content_.z_up;
    add_faces();
    describe();
    return std::move(made_);
  }

 private:
  std::string place(int64_t line) const { return path_ + ":" + to_string(line); }
  void say(std::string text) { made_.diagnostics.push_back(std::move(text)); }

  // ---- materials

  std::vector<double> in_bands(const std::array<double, 3>& rgb) const {
    if (made_.bands == 3) return {rgb.begin(), rgb.end()};
    if (rgb[0] == rgb[1] && rgb[1] == rgb[2]) return {rgb[0]};  // not rounded by a division
    return {(rgb[0] + rgb[1] + rgb[2]) / 3};
  }

  void add_materials() {
    for (const MtlMaterial& m : mtl_.materials) {
      Material material;
      material.name = m.name;
      material.reflectance = in_bands(m.reflectance);
      material.emission = in_bands(m.emission);
      material.two_sided = m.two_sided || (sides_ == Sides::two_sided && !m.blocker);
      material.blocker = m.blocker;
      made_.add_material(std::move(material));
    }
    for (size_t i = 0; i < content_.material_names.size(); ++i) {
      const auto found = mtl_.numbers.find(content_.material_names[i]);
      material_of_name_.push_back(found == mtl_.numbers.end() ? -1 : found->second);
    }
  }

  // Reflectance 0.5, no emission: for faces without a known material.
  int32_t default_material() {
    if (default_material_ < 0) {
      Material material;
      material.name = "default";
      material.two_sided = sides_ == Sides::two_sided;
      default_material_ = made_.add_material(std::move(material));
    }
    return default_material_;
  }

  // ---- faces

  void add_faces() {
    std::vector<std::array<int32_t, 3>> triangles;
    std::vector<Vec3> polygon;
    std::vector<int64_t> unknown_material(content_.material_names.size(), 0);
    for (int64_t face = 0; face < content_.face_count(); ++face) {
      const int32_t* corners = &content_.corners[content_.first_corner[face]];
      const size_t n =
          static_cast<size_t>(content_.first_corner[face + 1] - content_.first_corner[face]);
      polygon.clear();
      for (size_t i = 0; i < n; ++i) polygon.push_back(made_.vertices[corners[i]]);
      triangles.clear();
      if (!triangulate(polygon, triangles) && fans_++ == 0) first_fan_ = face;

      const int32_t name = content_.material[face];
      int32_t material = name < 0 ? -1 : material_of_name_[name];
      if (material < 0) {
        material = default_material();
        if (name >= 0) ++unknown_material[name];
        if (name < 0) ++faces_without_material_;
      }
      if (triangles.size() >
          static_cast<size_t>(std::numeric_limits<int32_t>::max() - made_.patch_count()))
        fail(Status::scene, "%s: more than 2^31-1 triangles", place(content_.line[face]).c_str());
      for (std::array<int32_t, 3> t : triangles) {
        if (sides_ == Sides::flip) std::swap(t[1], t[2]);
        made_.add_patch(corners[t[0]], corners[t[1]], corners[t[2]], material, face);
      }
    }
    describe_unknown(unknown_material);
  }

  // ---- what was doubtful

  // Per unknown material its faces; the first few by name.
  void describe_unknown(const std::vector<int64_t>& faces_of_name) {
    constexpr int64_t most_named = 8;
    int64_t unknown = 0, further_faces = 0;
    for (size_t i = 0; i < faces_of_name.size(); ++i) {
      if (faces_of_name[i] == 0) continue;
      if (++unknown <= most_named)
        say(place(content_.material_line[i]) + ": material " + quoted(content_.material_names[i]) +
            " is unknown: reflectance 0.5 for its " + to_string(faces_of_name[i]) + " faces");
      else
        further_faces += faces_of_name[i];
    }
    if (unknown > most_named)
      say(path_ + ": " + to_string(unknown - most_named) +
          " further materials are unknown: reflectance 0.5 for their " + to_string(further_faces) +
          " faces");
  }

  void describe() {
    if (faces_without_material_)
      say(path_ + ": " + to_string(faces_without_material_) +
          " faces without a material: reflectance 0.5");
    const auto first = [this](int64_t line) { return " (first: " + place(line) + ")"; };
    if (mtl_.clamped)
      say(to_string(mtl_.clamped) +
          " channels of Kd of 1 or more are clamped to 0.99 (first: " + mtl_.first_clamped + ")");
    if (mtl_.textures)
      say(to_string(mtl_.textures) + " textures are ignored (first: " + mtl_.first_texture + ")");
    if (mtl_.repeated)
      say(to_string(mtl_.repeated) +
          " repeated definitions of a material are ignored (first: " + mtl_.first_repeated + ")");
    if (mtl_.transparent)
      say(to_string(mtl_.transparent) + " materials let light through (d, Tr) and are taken as " +
          "opaque (first: " + mtl_.first_transparent + ")");
    if (mtl_.specular)
      say(to_string(mtl_.specular) +
          " materials shine (Ks) and are taken as diffuse (first: " + mtl_.first_specular + ")");
    if (mtl_.unknown)
      say(to_string(mtl_.unknown) +
          " unknown statements about materials are ignored (first: " + mtl_.first_unknown + ")");
    for (const auto& [count, first_place] : {std::pair(content_.vanished, content_.first_vanished),
                                             std::pair(mtl_.vanished, mtl_.first_vanished)})
      if (count)
        say(to_string(count) +
            " numbers are too small to be told from 0 and are 0 (first: " + first_place + ")");
    int64_t without = 0;
    std::string first_without;
    for (const MtlMaterial& m : mtl_.materials)
      if (!m.has_reflectance && without++ == 0) first_without = quoted(m.name);
    if (without)
      say(to_string(without) + " materials without Kd: reflectance 0.5 (first: " + first_without +
          ")");
    if (content_.repeated_corners)
      say(to_string(content_.repeated_corners) + " repeated corners are left out of their faces" +
          first(content_.first_repeated_corner));
    if (fans_)
      say(to_string(fans_) +
          " faces cross themselves or have no area and are cut into fans of triangles" +
          first(content_.line[first_fan_]));
    for (const auto& [keyword, count] : content_.ignored)
      say(to_string(count.count) + " statements " + quoted(keyword) + " are ignored" +
          first(count.first_line));
    if (content_.unknown.count)
      say(to_string(content_.unknown.count) + " unknown statements are ignored (first: " +
          place(content_.unknown.first_line) + ": " + content_.first_unknown + ")");
    if (content_.face_count() == 0) say(path_ + ": there are no faces");
  }

  std::string path_;
  Sides sides_;
  ObjContent content_;
  MtlLibrary mtl_;
  std::vector<int32_t> material_of_name_;  // per usemtl name; -1: unknown
  int32_t default_material_ = -1;
  int64_t fans_ = 0, first_fan_ = 0, faces_without_material_ = 0;
  Scene made_;
};

template <class T>
void append(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

template <class T>
void reserve_for(std::vector<T>& to, const std::vector<T>& from) {
  to.reserve(to.size() + from.size());
}

// Adds all of `made` to the scene, or nothing when it throws.
void append_scene(Scene& scene, Scene made) {
  constexpr size_t most = std::numeric_limits<int32_t>::max();
  if (scene.vertices.size() + made.vertices.size() > most ||
      scene.corners.size() + made.corners.size() > most)
    fail(Status::scene, "the scene has more than 2^31-1 vertices or patches");
  const int32_t first_vertex = static_cast<int32_t>(scene.vertices.size());
  const int32_t first_material = static_cast<int32_t>(scene.materials.size());
  for (auto& corners : made.corners)
    for (int32_t& corner : corners) corner += first_vertex;
  for (int32_t& material : made.material) material += first_material;
  // All memory first: what follows can't fail.
  reserve_for(scene.vertices, made.vertices);
  reserve_for(scene.materials, made.materials);
  reserve_for(scene.corners, made.corners);
  reserve_for(scene.material, made.material);
  reserve_for(scene.face, made.face);
  reserve_for(scene.flags, made.flags);
  reserve_for(scene.emission, made.emission);
  reserve_for(scene.reflectance, made.reflectance);
  reserve_for(scene.diagnostics, made.diagnostics);
  append(scene.vertices, made.vertices);
  append(scene.materials, made.materials);
  append(scene.corners, made.corners);
  append(scene.material, made.material);
  append(scene.face, made.face);
  append(scene.flags, made.flags);
  append(scene.emission, made.emission);
  append(scene.reflectance, made.reflectance);
  append(scene.diagnostics, made.diagnostics);
  scene.z_up = scene.z_up || made.z_up;
}

}  // namespace

void load_obj(Scene& scene, const std::string& path, Sides sides) {
  if (scene.bands != 1 && scene.bands != 3)
    fail(Status::argument,
         "%s: an OBJ file has red, green and blue: it needs bands = 3, or bands = 1 for their "
         "mean, not %d",
         path.c_str(), scene.bands);
  append_scene(scene, Reader(path, scene.bands, sides).read());
}

}  // namespace hrad
