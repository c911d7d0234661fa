// The solution as a VTK XML unstructured grid (version 1.0): a table of arrays, whose sizes are
// known beforehand, so that the XML part with their offsets comes first and the arrays follow as
// appended raw data, each led by its length as UInt64, little-endian. Floor 8 (solver).
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/little_endian.h"
#include "machine/file_self.h"
#include "solver/export.h"
#include "solver/solver.h"

namespace hrad {
namespace {

constexpr size_t chunk_bytes = size_t{1}
                               << 18;  // arrays are handed to the file in pieces this large
constexpr uint8_t vtk_triangle = 5;    // cell type of a triangle

void put_all(std::string& bytes, const std::vector<double>& values) {
  for (const double value : values) put_little_endian(bytes, value);
}

struct Array {
  const char* section;
  const char* name;
  const char* type;
  int components;
  int64_t bytes_per_leaf;
  std::function<void(int64_t leaf, std::string& bytes)> put_leaf;
};

Array means(const Solver& solver, const char* name, Quantity quantity) {
  const int bands = solver.scene().bands;
  return {"CellData",
          name,
          "Float64",
          bands,
          8 * bands,
          [&solver, quantity, values = std::vector<double>(static_cast<size_t>(bands))](
              int64_t leaf, std::string& bytes) mutable {
            solver.leaf_values(leaf, quantity, values.data());
            put_all(bytes, values);
          }};
}

Array corner_values(const Solver& solver) {
  const int bands = solver.scene().bands;
  return {"PointData",
          "radiosity_linear",
          "Float64",
          bands,
          3 * 8 * bands,
          [&solver, values = std::vector<double>(3 * static_cast<size_t>(bands))](
              int64_t leaf, std::string& bytes) mutable {
            solver.leaf_corner_radiosity(leaf, values.data());
            put_all(bytes, values);
          }};
}

Array points(const Solver& solver) {
  return {"Points", "Points", "Float64", 3, 9 * 8, [&solver](int64_t i, std::string& bytes) {
            const Triangle corners = solver.leaf(i).corners;
            for (const Vec3& corner : {corners.a, corners.b, corners.c})
              for (int axis = 0; axis < 3; ++axis) put_little_endian(bytes, corner[axis]);
          }};
}

// All arrays in the order of the sections of a VTK file.
std::vector<Array> arrays_of(const Solver& solver) {
  return {
      corner_values(solver),
      means(solver, "radiosity", Quantity::radiosity),
      means(solver, "irradiance", Quantity::irradiance),
      means(solver, "emission", Quantity::emission),
      {"CellData", "patch", "Int64", 1, 8,
       [&solver](int64_t i, std::string& bytes) {
         put_little_endian(bytes, solver.leaf(i).patch);
       }},
      {"CellData", "face", "Int64", 1, 8,
       [&solver](int64_t i, std::string& bytes) { put_little_endian(bytes, solver.leaf(i).face); }},
      {"CellData", "side", "Int32", 1, 4,
       [&solver](int64_t i, std::string& bytes) { put_little_endian(bytes, solver.leaf(i).side); }},
      points(solver),
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

std::string description(const std::vector<Array>& arrays, int64_t leaves) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n" +
      format("<Piece NumberOfPoints=\"%lld\" NumberOfCells=\"%lld\">\n",
             static_cast<long long>(3 * leaves), static_cast<long long>(leaves));
  std::string section;
  int64_t offset = 0;
  for (const Array& array : arrays) {
    if (section != array.section) {
      if (!section.empty()) xml += "</" + section + ">\n";
      section = array.section;
      xml += "<" + section + ">\n";
    }
    xml += format(
        "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" "
        "offset=\"%lld\"/>\n",
        array.type, array.name, array.components, static_cast<long long>(offset));
    offset += static_cast<int64_t>(sizeof(uint64_t)) + array.bytes_per_leaf * leaves;
  }
  return xml + "</" + section +
         ">\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
}

}  // namespace

void export_vtu(const Solver& solver, const std::string& path) {
  const int64_t leaves = solver.leaf_count();
  const std::vector<Array> arrays = arrays_of(solver);

  WholeFile file(path);
  std::string bytes = description(arrays, leaves);
  for (const Array& array : arrays) {
    put_little_endian(bytes, static_cast<uint64_t>(array.bytes_per_leaf * leaves));
    for (int64_t leaf = 0; leaf < leaves; ++leaf) {
      array.put_leaf(leaf, bytes);
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
