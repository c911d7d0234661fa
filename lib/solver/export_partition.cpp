// Who would own which patch, as a VTK file. Floor 8 (solver).
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/little_endian.h"
#include "solver/export.h"
#include "solver/partition_plan.h"
#include "solver/vtu_file.h"

namespace hrad {

void check_partition_file(const std::string& path) {
  if (path.size() < 4 || path.compare(path.size() - 4, 4, ".vtu") != 0)
    fail(Status::argument, "%s: a partition is written as .vtu alone", path.c_str());
}

void export_partition(const Scene& scene, const PartitionPlan& plan, const std::string& path) {
  std::vector<int64_t> patches;
  for (int64_t patch = 0; patch < scene.patch_count(); ++patch)
    if (scene.exchanges(patch)) patches.push_back(patch);
  const auto of = [&patches](int64_t i) { return static_cast<size_t>(patches[i]); };
  std::vector<VtuArray> arrays = {
      {"CellData", "owner", "Int32", 1, 4,
       [&](int64_t i, std::string& bytes) { put_little_endian(bytes, plan.owners[of(i)]); }},
      {"CellData", "work", "Float64", 1, 8,
       [&](int64_t i, std::string& bytes) { put_little_endian(bytes, plan.work[of(i)]); }},
      {"CellData", "patch", "Int64", 1, 8,
       [&](int64_t i, std::string& bytes) { put_little_endian(bytes, patches[i]); }},
  };
  for (VtuArray& array : vtu_triangles([&](int64_t i) { return scene.triangle(patches[i]); }))
    arrays.push_back(std::move(array));
  write_vtu(path, arrays, static_cast<int64_t>(patches.size()));
}

}  // namespace hrad
