// The solution as comma-separated values, one row per leaf and side. Numbers are written by
// std::to_chars: the shortest form that reads back as the same double, whatever the locale.
// Floor 8 (solver).
#include <charconv>
#include <string>
#include <vector>

#include "base/error.h"
#include "machine/file_self.h"
#include "solver/export.h"
#include "solver/solver.h"

namespace hrad {
namespace {

constexpr size_t chunk_bytes = size_t{1} << 18;  // rows are handed to the file in pieces this large

template <class Number>
void put(std::string& row, Number value) {
  char text[32];  // the longest double takes 24 characters, the longest int64_t 20
  row.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

template <class Number>
void put_next(std::string& row, Number value) {
  row += ',';
  put(row, value);
}

std::string heading(int bands) {
  std::string row = "patch,face,side,x0,y0,z0,x1,y1,z1,x2,y2,z2,area";
  for (int band = 0; band < bands; ++band) row += ",b" + std::to_string(band);
  return row + '\n';
}

}  // namespace

void export_csv(const Solver& solver, const std::string& path) {
  const int64_t leaves = solver.leaf_count();
  std::vector<double> radiosity(static_cast<size_t>(solver.scene().bands));

  WholeFile file(path);
  std::string rows = heading(solver.scene().bands);
  for (int64_t i = 0; i < leaves; ++i) {
    const LeafView leaf = solver.leaf(i);
    solver.leaf_values(i, Quantity::radiosity, radiosity.data());
    put(rows, leaf.patch);
    put_next(rows, leaf.face);
    put_next(rows, leaf.side);
    for (const Vec3& corner : {leaf.corners.a, leaf.corners.b, leaf.corners.c})
      for (int axis = 0; axis < 3; ++axis) put_next(rows, corner[axis]);
    put_next(rows, leaf.area);
    for (const double value : radiosity) put_next(rows, value);
    rows += '\n';
    if (rows.size() >= chunk_bytes) {
      file.write(rows.data(), rows.size());
      rows.clear();
    }
  }
  file.write(rows.data(), rows.size());
  file.commit();
}

}  // namespace hrad
