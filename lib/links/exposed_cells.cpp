// The cells, and draws from them. Floor 6 (links).
#include "links/exposed_cells.h"

#include "base/hash.h"
#include "hierarchy/lattice.h"
#include "links/pair_samples.h"

namespace hrad {
namespace {

constexpr int level_of_cells = 3;
constexpr uint64_t most_draws = 400;

Vec3 at(const Triangle& t, LatticePoint p) {
  return t.at(static_cast<double>(p.i) / lattice_size, static_cast<double>(p.j) / lattice_size);
}

}  // namespace

// Those of a place of the element.
void ExposedCells::find_cells(const Node& place) {
  LatticePoint corner[3];
  lattice_corners(place, corner);
  if (part_.covered({at(corners_, corner[0]), at(corners_, corner[1]), at(corners_, corner[2])}))
    return;
  if (place.level == level_of_cells) {
    cells_.push_back(place);
    return;
  }
  for (int child = 0; child < 4; ++child) find_cells(child_place(place, child));
}

bool ExposedCells::draw(uint64_t key, float* u, float* v) {
  if (!found_) find_cells(Node{});
  found_ = true;
  for (uint64_t draw = 0; draw < most_draws && !cells_.empty(); ++draw) {
    const uint64_t h = mix(key, draw);
    const Node& cell = cells_[h % cells_.size()];
    point_in_place(cell, unit_interval(mix(h, 1)), unit_interval(mix(h, 2)), u, v);
    if (exposed(*u, *v)) return true;
  }
  return false;
}

}  // namespace hrad
