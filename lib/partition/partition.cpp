// The table of methods, and what their parts hold. Floor 6 (partition).
#include "partition/partition.h"

#include "base/error.h"

namespace hrad {
namespace {

constexpr PartitionMethod methods[] = {{"cost", divide_by_cost}, {"grid", divide_by_grid}};

}  // namespace

std::vector<PartitionItem> partition_items(const Scene& scene, const std::vector<double>& work) {
  std::vector<PartitionItem> items;
  for (int64_t patch = 0; patch < scene.patch_count(); ++patch)
    if (scene.exchanges(patch))
      items.push_back({patch, scene.triangle(patch).centroid(), work[static_cast<size_t>(patch)]});
  return items;
}

Span<const PartitionMethod> partition_methods() { return {methods, std::size(methods)}; }

const PartitionMethod& partition_method(const std::string& name) {
  std::string names;
  for (const PartitionMethod& method : methods) {
    if (name == method.name) return method;
    names += (names.empty() ? "" : ", ") + std::string(method.name);
  }
  fail(Status::argument, "there is no partition method '%s': use one of %s", name.c_str(),
       names.c_str());
}

std::vector<int32_t> owners_of(const Scene& scene, const std::vector<PartitionItem>& items,
                               const std::vector<int32_t>& ranks) {
  std::vector<int32_t> owners(static_cast<size_t>(scene.patch_count()), 0);
  for (size_t k = 0; k < items.size(); ++k) owners[static_cast<size_t>(items[k].patch)] = ranks[k];
  return owners;
}

std::vector<RankLoad> loads_of(const Scene& scene, const std::vector<PartitionItem>& items,
                               const std::vector<int32_t>& owners, int32_t ranks) {
  std::vector<RankLoad> loads(static_cast<size_t>(ranks));
  for (const PartitionItem& item : items) {
    RankLoad& load = loads[static_cast<size_t>(owners[static_cast<size_t>(item.patch)])];
    ++load.patches;
    load.work += item.work;
    const Triangle t = scene.triangle(item.patch);
    for (const Vec3& corner : {t.a, t.b, t.c}) load.box.grow(corner);
  }
  return loads;
}

}  // namespace hrad
