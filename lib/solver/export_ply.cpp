// The solution as a polygon file (PLY, binary little-endian): vertices with their linear radiosity
// and a colour for display, faces with the patch, the face and the side that they belong to.
// Floor 8 (solver).
#include <string>

#include "base/error.h"
#include "base/little_endian.h"
#include "base/number_text.h"
#include "base/version.h"
#include "machine/file_self.h"
#include "solver/display_color.h"
#include "solver/export.h"
#include "solver/leaf_mesh.h"
#include "solver/solver.h"

namespace hrad {
namespace {

std::string header(const LeafMesh& mesh, const DisplayColors& colors, int bands) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  text += format("comment hrad %s\n", version_text());
  text += "comment radiosity: W/m2 leaving the surface, per band\n";
  text +=
      "comment red, green, blue: sRGB of radiosity times " + number_text(colors.exposure()) + "\n";
  text += format("element vertex %lld\n", static_cast<long long>(mesh.vertex_count()));
  for (const char* axis : {"x", "y", "z"}) text += format("property double %s\n", axis);
  for (int band = 0; band < bands; ++band) text += format("property float radiosity_%d\n", band);
  for (const char* color : {"red", "green", "blue"}) text += format("property uchar %s\n", color);
  text += format("element face %lld\n", static_cast<long long>(mesh.triangle_count()));
  return text +
         "property list uchar uint vertex_indices\nproperty int patch\nproperty int face\n"
         "property uchar side\nend_header\n";
}

void put_vertex(const MeshVertex& vertex, int bands, const DisplayColors& colors,
                std::string& bytes) {
  for (int axis = 0; axis < 3; ++axis) put_little_endian(bytes, vertex.position[axis]);
  for (int band = 0; band < bands; ++band)
    put_little_endian(bytes, finite_float(vertex.radiosity[band]));
  for (const double value : colors.linear(vertex.radiosity.data()))
    put_little_endian(bytes, srgb_byte(value));
}

void put_face(const LeafView& leaf, const std::array<uint32_t, 3>& triangle, std::string& bytes) {
  put_little_endian(bytes, uint8_t{3});
  for (const uint32_t vertex : triangle) put_little_endian(bytes, vertex);
  // Patches and faces are fewer than 2^31.
  put_little_endian(bytes, static_cast<int32_t>(leaf.patch));
  put_little_endian(bytes, static_cast<int32_t>(leaf.face));
  put_little_endian(bytes, static_cast<uint8_t>(leaf.side));
}

}  // namespace

void export_ply(const Solver& solver, const std::string& path) {
  const LeafMesh mesh(solver, path);
  const DisplayColors colors(solver);
  const int bands = solver.scene().bands;

  WholeFile file(path);
  file.text(header(mesh, colors, bands));
  std::string bytes;
  for (int64_t i = 0; i < mesh.vertex_count(); ++i) {
    bytes.clear();
    put_vertex(mesh.vertex(i), bands, colors, bytes);
    file.text(bytes);
  }
  for (int64_t i = 0; i < mesh.triangle_count(); ++i) {
    bytes.clear();
    put_face(solver.leaf(i), mesh.triangle(i), bytes);
    file.text(bytes);
  }
  file.commit();
}

}  // namespace hrad
