// The solution as comma-separated values, one row per leaf and side. Floor 8 (solver).
#include <string>
#include <vector>

#include "base/number_text.h"
#include "machine/file_self.h"
#include "solver/export.h"
#include "solver/solver.h"

namespace hrad {
namespace {

constexpr size_t chunk_bytes = size_t{1} << 18;  // rows are handed to the file in pieces this large

template <class Number>
void put_next(std::string& row, Number value) {
  row += ',';
  append_number(row, value);
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
    append_number(rows, leaf.patch);
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
