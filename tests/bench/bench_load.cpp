// Loading an OBJ file of many triangles, a million unless the argument says another number:
// reading, and checking every patch against all others. Median of user CPU, also in calibration
// loops.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "bench/calibration.h"
#include "scene/large_scene.h"
#include "scene/load.h"
#include "support/folder.h"

namespace {

constexpr int64_t columns = 1000;
constexpr int runs = 5;

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + runs / 2, values.end());
  return values[runs / 2];
}

void measure(int64_t triangles) {
  const hrad_test::Folder folder("bench-load");
  const int64_t rows = std::max<int64_t>(1, triangles / (2 * columns));
  hrad_test::write_grid(folder.file(""), columns, rows);
  std::vector<double> reading, checking, loops;
  for (int run = 0; run < runs; ++run) {
    loops.push_back(bench::calibration_seconds());
    hrad::Scene scene;
    const double start = bench::user_seconds();
    hrad::load_obj(scene, folder.file("grid.obj"), hrad::Sides::front);
    const double read = bench::user_seconds();
    hrad::check_patches(scene, 0);
    reading.push_back(read - start);
    checking.push_back(bench::user_seconds() - read);
  }
  const double loop = median(loops), read = median(reading), check = median(checking);
  std::printf("| triangles | reading, s | loops | checking, s | loops |\n|---|---|---|---|---|\n");
  std::printf("| %lld | %.3f | %.2f | %.3f | %.2f |\n", static_cast<long long>(2 * columns * rows),
              read, read / loop, check, check / loop);
}

}  // namespace

int main(int argc, char** argv) {
  const long long triangles = argc == 2 ? std::atoll(argv[1]) : 1000000;
  if (argc > 2 || triangles < 1) {
    std::fprintf(stderr, "usage: %s [TRIANGLES]\n", argv[0]);
    return 2;
  }
  try {
    measure(triangles);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
}
