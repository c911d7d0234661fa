// An OBJ file as large as asked for: a level grid of squares, two triangles each, in stripes of
// materials, all corners shared.
#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>

namespace hrad_test {

constexpr int stripes = 16;

// Square k of a row has the material "stripe" k modulo stripes; the first of them emits.
inline void write_grid(const std::string& folder, int64_t columns, int64_t rows) {
  std::ofstream materials(folder + "/grid.mtl"), grid(folder + "/grid.obj");
  for (int k = 0; k < stripes; ++k)
    materials << "newmtl stripe" << k << "\nKd 0." << 10 + k << (k == 0 ? "\nKe 1\n" : "\n");
  grid << "mtllib grid.mtl\n";
  for (int64_t j = 0; j <= rows; ++j)
    for (int64_t i = 0; i <= columns; ++i) grid << "v " << i << " " << j << " 0.5\n";
  const int64_t next_row = columns + 1;
  for (int64_t i = 0; i < columns; ++i) {
    grid << "usemtl stripe" << i % stripes << "\n";
    for (int64_t j = 0; j < rows; ++j) {
      const int64_t corner = 1 + j * next_row + i;
      grid << "f " << corner << " " << corner + 1 << " " << corner + 1 + next_row << "\nf "
           << corner << " " << corner + 1 + next_row << " " << corner + next_row << "\n";
    }
  }
  materials.close();
  grid.close();
  if (!materials || !grid) throw std::runtime_error(folder + ": can't write grid.obj");
}

}  // namespace hrad_test
