// Scene sections. Numbers are checked as those that users hand in. Floor 8 (solver).
#include "solver/checkpoint_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/error.h"

namespace hrad {
namespace {

constexpr double largest_coordinate = 1e30;
constexpr double largest_emission = 1e300;
constexpr size_t longest_text = size_t{1} << 20;
constexpr int64_t largest_face = std::numeric_limits<int64_t>::max();
const double largest_reflectance = std::nextafter(1.0, 0.0);

enum MaterialBits : uint8_t { two_sided_bit = 1, blocker_bit = 2 };
enum OwnValues : uint8_t { own_emission = 1, own_reflectance = 2 };

bool same_bits(const double* a, const double* b, int count) {
  return std::equal(a, a + count, b, [](double x, double y) { return bits_of(x) == bits_of(y); });
}

const double* values_of(const std::vector<double>& values, int64_t patch, int bands) {
  return &values[static_cast<size_t>(patch) * static_cast<size_t>(bands)];
}

void unpack_values(PackedReader& bytes, const char* what, double highest, int bands,
                   std::vector<double>& values) {
  for (int b = 0; b < bands; ++b) values.push_back(bytes.finite(what, 0, highest));
}

}  // namespace

void pack_materials(const Scene& scene, PackedBytes& bytes) {
  bytes.byte(scene.z_up);
  for (const Material& material : scene.materials) {
    bytes.text(material.name);
    bytes.byte(static_cast<uint8_t>((material.two_sided ? two_sided_bit : 0) |
                                    (material.blocker ? blocker_bit : 0)));
    for (double value : material.reflectance) bytes.number(value);
    for (double value : material.emission) bytes.number(value);
  }
  bytes.varint(scene.diagnostics.size());
  for (const std::string& text : scene.diagnostics) bytes.text(text);
}

void unpack_materials(PackedReader& bytes, int64_t materials, Scene& scene) {
  scene.z_up = bytes.flag("whether z is up");
  for (int64_t k = 0; k < materials; ++k) {
    Material material;
    material.name = bytes.text(longest_text);
    const uint8_t flags = bytes.byte();
    if (flags > (two_sided_bit | blocker_bit))
      fail_format(bytes.place(), "material %lld has the flags %d", static_cast<long long>(k),
                  flags);
    material.two_sided = (flags & two_sided_bit) != 0;
    material.blocker = (flags & blocker_bit) != 0;
    unpack_values(bytes, "a reflectance", largest_reflectance, scene.bands, material.reflectance);
    unpack_values(bytes, "an emission", largest_emission, scene.bands, material.emission);
    scene.materials.push_back(std::move(material));
  }
  const int64_t diagnostics =
      bytes.count("the number of diagnostics", 0, static_cast<int64_t>(bytes.left()));
  for (int64_t k = 0; k < diagnostics; ++k) scene.diagnostics.push_back(bytes.text(longest_text));
}

void pack_vertices(const Scene& scene, int64_t first, int64_t end, PackedBytes& bytes) {
  std::vector<uint64_t> changes;
  for (int axis = 0; axis < 3; ++axis) {
    changes.clear();
    uint64_t before = 0;
    for (int64_t k = first; k < end; ++k) {
      const uint64_t bits = bits_of(scene.vertices[k][axis]);
      changes.push_back(bits ^ before);
      before = bits;
    }
    bytes.planes(changes);
  }
}

void unpack_vertices(PackedReader& bytes, int64_t first, int64_t end, Scene& scene) {
  std::vector<uint64_t> changes[3];
  for (auto& of_axis : changes) {
    bytes.planes(static_cast<size_t>(end - first), of_axis);
    uint64_t bits = 0;
    for (uint64_t& change : of_axis) {
      change = bits ^= change;
      if (!(std::fabs(double_of(bits)) <= largest_coordinate))
        fail_format(bytes.place(), "a vertex has the coordinate %g", double_of(bits));
    }
  }
  for (size_t k = 0; k < changes[0].size(); ++k)
    scene.vertices.push_back(
        {double_of(changes[0][k]), double_of(changes[1][k]), double_of(changes[2][k])});
}

void pack_patches(const Scene& scene, int64_t first, int64_t end, PackedBytes& bytes) {
  int64_t corner = 0, material = 0, face = first - 1;
  for (int64_t patch = first; patch < end; ++patch) {
    for (int32_t c : scene.corners[patch]) {
      bytes.signed_varint(c - corner);
      corner = c;
    }
    bytes.signed_varint(scene.material[patch] - material);
    material = scene.material[patch];
    bytes.signed_varint(scene.face[patch] - face - 1);
    face = scene.face[patch];
    bytes.byte(scene.flags[patch]);
    const Material& made_of = scene.materials[static_cast<size_t>(material)];
    const double* emission = values_of(scene.emission, patch, scene.bands);
    const double* reflectance = values_of(scene.reflectance, patch, scene.bands);
    const int own =
        (same_bits(emission, made_of.emission.data(), scene.bands) ? 0 : own_emission) |
        (same_bits(reflectance, made_of.reflectance.data(), scene.bands) ? 0 : own_reflectance);
    bytes.byte(static_cast<uint8_t>(own));
    for (int b = 0; b < scene.bands && (own & own_emission); ++b) bytes.number(emission[b]);
    for (int b = 0; b < scene.bands && (own & own_reflectance); ++b) bytes.number(reflectance[b]);
  }
}

void unpack_patches(PackedReader& bytes, int64_t first, int64_t end, Scene& scene) {
  const auto vertices = static_cast<int64_t>(scene.vertices.size());
  const auto materials = static_cast<int64_t>(scene.materials.size());
  int64_t corner = 0, material = 0, face = first - 1;
  for (int64_t patch = first; patch < end; ++patch) {
    std::array<int32_t, 3> corners;
    for (int32_t& c : corners) {
      corner = bytes.moved(corner, "a patch's vertex", 0, vertices - 1);
      c = static_cast<int32_t>(corner);
    }
    scene.corners.push_back(corners);
    material = bytes.moved(material, "a patch's material", 0, materials - 1);
    scene.material.push_back(static_cast<int32_t>(material));
    // Behind the largest number there is none.
    if (face == largest_face) fail_format(bytes.place(), "the number of a face is too large");
    face = bytes.moved(face + 1, "the number of a face", 0, largest_face);
    scene.face.push_back(face);
    const uint8_t flags = bytes.byte(), own = bytes.byte();
    if (flags > (patch_dropped | patch_two_sided | patch_blocker) ||
        own > (own_emission | own_reflectance))
      fail_format(bytes.place(), "patch %lld has the flags %d and %d",
                  static_cast<long long>(patch), flags, own);
    scene.flags.push_back(flags);
    const Material& made_of = scene.materials[static_cast<size_t>(material)];
    if (own & own_emission)
      unpack_values(bytes, "an emission", largest_emission, scene.bands, scene.emission);
    else
      scene.emission.insert(scene.emission.end(), made_of.emission.begin(), made_of.emission.end());
    if (own & own_reflectance)
      unpack_values(bytes, "a reflectance", largest_reflectance, scene.bands, scene.reflectance);
    else
      scene.reflectance.insert(scene.reflectance.end(), made_of.reflectance.begin(),
                               made_of.reflectance.end());
    if (!scene.exchanges(patch)) continue;
    const double area = length(scene.triangle(patch).area_vector()) / 2;
    if (!(area > 0 && area < std::numeric_limits<double>::infinity()))
      fail_format(bytes.place(), "patch %lld has the area %g and is not marked as dropped",
                  static_cast<long long>(patch), area);
  }
}

std::string difference_of(const Scene& of_file, const Scene& here) {
  if (of_file.bands != here.bands)
    return format("the file has %d bands and the scene %d", of_file.bands, here.bands);
  if (of_file.patch_count() != here.patch_count())
    return format("the file has %zu patches and the scene %zu", of_file.corners.size(),
                  here.corners.size());
  for (int64_t patch = 0; patch < here.patch_count(); ++patch) {
    const Triangle a = of_file.triangle(patch), b = here.triangle(patch);
    const Vec3 from[3] = {a.a, a.b, a.c}, to[3] = {b.a, b.b, b.c};
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        if (from[corner][axis] != to[corner][axis])
          return format("corner %d of patch %lld has %c = %.17g in the file and %.17g in the scene",
                        corner, static_cast<long long>(patch), "xyz"[axis], from[corner][axis],
                        to[corner][axis]);
    const auto k = static_cast<size_t>(patch);
    if (of_file.flags[k] != here.flags[k])
      return format(
          "patch %lld has the flags %d (1 dropped, 2 two-sided, 4 blocker) in the file "
          "and %d in the scene",
          static_cast<long long>(patch), of_file.flags[k], here.flags[k]);
    for (int b = 0; b < here.bands; ++b) {
      const size_t at = k * static_cast<size_t>(here.bands) + static_cast<size_t>(b);
      for (const auto& [name, one, other] :
           {std::make_tuple("emission", of_file.emission[at], here.emission[at]),
            std::make_tuple("reflectance", of_file.reflectance[at], here.reflectance[at])})
        if (one != other)
          return format(
              "the %s of patch %lld in band %d is %.17g in the file and %.17g in the "
              "scene",
              name, static_cast<long long>(patch), b, one, other);
    }
  }
  return "";
}

}  // namespace hrad
