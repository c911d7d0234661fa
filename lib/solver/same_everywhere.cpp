// Hashes of everything, compared with those of rank 0. Floor 8 (solver).
#include "solver/same_everywhere.h"

#include <cstdint>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "machine/sharing.h"

namespace hrad {
namespace {

uint64_t hash_of(const std::string& text) {
  Hasher hash;
  hash.add(text.c_str());
  return hash.value();
}

uint64_t hash_of(const Scene& scene) {
  Hasher hash;
  for (const Vec3& v : scene.vertices)
    for (int axis = 0; axis < 3; ++axis) hash.add(v[axis]);
  for (const auto& corners : scene.corners)
    for (int32_t corner : corners) hash.add(static_cast<uint64_t>(corner));
  for (uint8_t flags : scene.flags) hash.add(static_cast<uint64_t>(flags));
  for (double value : scene.emission) hash.add(value);
  for (double value : scene.reflectance) hash.add(value);
  return hash.value();
}

}  // namespace

void check_same_everywhere(Comm& comm, const Params& params, const Scene& scene) {
  if (comm.alone()) return;
  std::vector<const ParamRow*> rows;
  std::vector<uint64_t> hashes;
  for (const ParamRow& row : param_table()) {
    if (!row.is_result && row.as_text != &Params::partition) continue;
    rows.push_back(&row);
    hashes.push_back(hash_of(param_text(params, row)));
  }
  hashes.push_back(hash_of(scene));
  std::vector<uint64_t> of_rank_0 = hashes;
  broadcast(comm, of_rank_0);
  for (size_t k = 0; k < hashes.size(); ++k) {
    if (hashes[k] == of_rank_0[k]) continue;
    if (k == rows.size())
      fail(Status::argument,
           "rank %d has another scene than rank 0: all ranks must make the same calls",
           comm.rank());
    fail(Status::argument,
         "parameter '%s' is %s on rank %d and something else on rank 0: set it alike on all ranks",
         rows[k]->name, param_text(params, *rows[k]).c_str(), comm.rank());
  }
  comm.all_go_on();
}

}  // namespace hrad
