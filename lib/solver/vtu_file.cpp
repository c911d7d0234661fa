// A table of arrays, whose sizes are known beforehand, so that the XML part with their offsets
// comes first and the arrays follow as appended raw data, each led by its length as UInt64,
// little-endian. Floor 8 (solver).
#include "solver/vtu_file.h"

#include <utility>

#include "base/error.h"
#include "base/little_endian.h"
#include "machine/file_self.h"

namespace hrad {
namespace {

// Arrays are handed to the file in pieces this large.
constexpr size_t chunk_bytes = size_t{1} << 18;
constexpr uint8_t vtk_triangle = 5;  // cell type of a triangle

std::string description(const std::vector<VtuArray>& arrays, int64_t triangles) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n" +
      format("<Piece NumberOfPoints=\"%lld\" NumberOfCells=\"%lld\">\n",
             static_cast<long long>(3 * triangles), static_cast<long long>(triangles));
  std::string section;
  int64_t offset = 0;
  for (const VtuArray& array : arrays) {
    if (section != array.section) {
      if (!section.empty()) xml += "</" + section + ">\n";
      section = array.section;
      xml += "<" + section + ">\n";
    }
    xml += format(
        "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" "
        "offset=\"%lld\"/>\n",
        array.type, array.name, array.components, static_cast<long long>(offset));
    offset += static_cast<int64_t>(sizeof(uint64_t)) + array.bytes_per_triangle * triangles;
  }
  return xml + "</" + section +
         ">\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
}

}  // namespace

std::vector<VtuArray> vtu_triangles(std::function<Triangle(int64_t triangle)> corners) {
  return {
      {"Points", "Points", "Float64", 3, 9 * 8,
       [corners = std::move(corners)](int64_t i, std::string& bytes) {
         const Triangle t = corners(i);
         for (const Vec3& corner : {t.a, t.b, t.c})
           for (int axis = 0; axis < 3; ++axis) put_little_endian(bytes, corner[axis]);
       }},
      {"Cells", "connectivity", "Int64", 1, 3 * 8,
       [](int64_t i, std::string& bytes) {
         for (int64_t corner = 0; corner < 3; ++corner) put_little_endian(bytes, 3 * i + corner);
       }},
      {"Cells", "offsets", "Int64", 1, 8,
       [](int64_t i, std::string& bytes) { put_little_endian(bytes, 3 * (i + 1)); }},
      {"Cells", "types", "UInt8", 1, 1,
       [](int64_t, std::string& bytes) { put_little_endian(bytes, vtk_triangle); }},
  };
}

void write_vtu(const std::string& path, const std::vector<VtuArray>& arrays, int64_t triangles) {
  WholeFile file(path);
  std::string bytes = description(arrays, triangles);
  for (const VtuArray& array : arrays) {
    put_little_endian(bytes, static_cast<uint64_t>(array.bytes_per_triangle * triangles));
    for (int64_t i = 0; i < triangles; ++i) {
      array.put(i, bytes);
      if (bytes.size() < chunk_bytes) continue;
      file.write(bytes.data(), bytes.size());
      bytes.clear();
    }
  }
  bytes += "\n</AppendedData>\n</VTKFile>\n";
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace hrad
