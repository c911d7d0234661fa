// The scene cut into as many parts as there are ranks, one rank each (paper, Section 3.1), by one
// of several methods. What comes out depends on the patches, the predicted work and the number of
// ranks alone, and never decides a bit of the solution. Floor 6 (partition).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/span.h"
#include "base/vec3.h"
#include "scene/scene.h"

namespace hrad {

// A patch, as methods see it.
struct PartitionItem {
  int64_t patch = 0;
  Vec3 place;       // its centroid: a patch belongs to one part whole, wherever it reaches
  double work = 0;  // predicted, in any unit, not negative
};

// All patches that exchange light, in input order; work: per patch of the scene.
std::vector<PartitionItem> partition_items(const Scene& scene, const std::vector<double>& work);

struct PartitionMethod {
  const char* name;
  // The rank of each item, 0 to ranks-1; a rank may be left without any.
  std::vector<int32_t> (*divide)(const std::vector<PartitionItem>& items, int32_t ranks);
};

// The paper's: cells of a uniform grid over the box around the scene, as cubic as the number of
// ranks allows.
std::vector<int32_t> divide_by_grid(const std::vector<PartitionItem>& items, int32_t ranks);
// Halves of equal work, again and again, each across its longest side: fine where there is much to
// do (Berger and Bokhari, IEEE Trans. Computers 36(5), 1987; the paper leaves a non-uniform
// partition for later).
std::vector<int32_t> divide_by_cost(const std::vector<PartitionItem>& items, int32_t ranks);

Span<const PartitionMethod> partition_methods();
// ARGUMENT for an unknown name.
const PartitionMethod& partition_method(const std::string& name);

// The owner of every patch of the scene; of those that exchange no light rank 0.
std::vector<int32_t> owners_of(const Scene& scene, const std::vector<PartitionItem>& items,
                               const std::vector<int32_t>& ranks);

// What a rank gets.
struct RankLoad {
  int64_t patches = 0;
  double work = 0;
  Box box;  // around its patches: the cell made tight
};
std::vector<RankLoad> loads_of(const Scene& scene, const std::vector<PartitionItem>& items,
                               const std::vector<int32_t>& owners, int32_t ranks);

}  // namespace hrad
