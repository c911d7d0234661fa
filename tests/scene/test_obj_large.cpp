// A million triangles in an OBJ file: each with its corners, its material and its face, in memory
// in proportion to what the scene holds.
#include <sys/resource.h>

#include <filesystem>
#include <vector>

#include "scene/large_scene.h"
#include "scene/scene_folder.h"
#include "support/sanitized.h"

using hrad::Scene;
using namespace hrad_test;

namespace {

constexpr int64_t columns = 1000, rows = 500, triangles = 2 * columns * rows;

int64_t most_memory() {
  struct rusage usage {};
  CHECK(::getrusage(RUSAGE_SELF, &usage) == 0);
  return static_cast<int64_t>(usage.ru_maxrss) * 1024;
}

template <class Item>
int64_t bytes_of(const std::vector<Item>& items) {
  return static_cast<int64_t>(items.size() * sizeof(Item));
}
int64_t bytes_of(const Scene& s) {
  return bytes_of(s.vertices) + bytes_of(s.corners) + bytes_of(s.material) + bytes_of(s.face) +
         bytes_of(s.flags) + bytes_of(s.emission) + bytes_of(s.reflectance);
}

void a_million_triangles() {
  const SceneFolder folder;
  write_grid(folder.path, columns, rows);
  const int64_t before = most_memory();
  Scene s;
  hrad::load_obj(s, folder.file("grid.obj"), hrad::Sides::front);
  hrad::check_patches(s, 0);
  const int64_t grown = most_memory() - before;

  CHECK_EQUAL(s.patch_count(), triangles);
  CHECK_EQUAL(static_cast<int64_t>(s.vertices.size()), (columns + 1) * (rows + 1));
  CHECK_EQUAL(static_cast<int>(s.materials.size()), stripes);
  CHECK(s.diagnostics.empty());
  double area = 0;
  for (int64_t k = 0; k < triangles; ++k) {
    const auto at = static_cast<size_t>(k);
    const int64_t column = k / (2 * rows);
    CHECK_EQUAL(s.face[at], k);
    CHECK_EQUAL(s.flags[at], 0);
    CHECK(s.materials[static_cast<size_t>(s.material[at])].name ==
          "stripe" + std::to_string(column % stripes));
    CHECK_EQUAL(s.emission[3 * at], column % stripes == 0 ? 1.0 : 0.0);
    CHECK_EQUAL(s.triangle(k).a.x, static_cast<double>(column));
    area += length(s.triangle(k).area_vector()) / 2;
  }
  CHECK_EQUAL(area, static_cast<double>(columns * rows));

  // The text, the scene, and what it is while its arrays grow.
  const auto text = static_cast<int64_t>(std::filesystem::file_size(folder.file("grid.obj")));
  if (!HRAD_TEST_ADDRESSES && !HRAD_TEST_THREADS) CHECK(grown < text + 3 * bytes_of(s));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(a_million_triangles)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
