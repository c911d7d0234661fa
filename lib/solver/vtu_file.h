// Triangles with values as a VTK XML unstructured grid (version 1.0), which ParaView opens.
// Floor 8 (solver).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace hrad {

struct VtuArray {
  const char* section;  // PointData, CellData, Points, Cells: arrays come in this order
  const char* name;
  const char* type;  // VTK's name of it
  int components;
  int64_t bytes_per_triangle;
  std::function<void(int64_t triangle, std::string& bytes)> put;  // appends that many
};

// Points and cells, the last arrays of a file: each triangle has three points of its own.
std::vector<VtuArray> vtu_triangles(std::function<Triangle(int64_t triangle)> corners);

// The file appears whole under its name or not at all. FILE.
void write_vtu(const std::string& path, const std::vector<VtuArray>& arrays, int64_t triangles);

}  // namespace hrad
