// The leaves of a solution as a VTK file. Floor 8 (solver).
#include <string>
#include <utility>
#include <vector>

#include "base/little_endian.h"
#include "solver/export.h"
#include "solver/solver.h"
#include "solver/vtu_file.h"

namespace hrad {
namespace {

void put_all(std::string& bytes, const std::vector<double>& values) {
  for (const double value : values) put_little_endian(bytes, value);
}

VtuArray means(const Solver& solver, const char* name, Quantity quantity) {
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

VtuArray corner_values(const Solver& solver) {
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

// All arrays in the order of the sections of a VTK file.
std::vector<VtuArray> arrays_of(const Solver& solver) {
  std::vector<VtuArray> arrays = {
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
  };
  for (VtuArray& array : vtu_triangles([&solver](int64_t i) { return solver.leaf(i).corners; }))
    arrays.push_back(std::move(array));
  return arrays;
}

}  // namespace

void export_vtu(const Solver& solver, const std::string& path) {
  write_vtu(path, arrays_of(solver), solver.leaf_count());
}

}  // namespace hrad
