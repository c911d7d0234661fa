// Corners by plane and name. Floor 5 (hierarchy).
#include "hierarchy/corner_index.h"

namespace hrad {

int32_t CornerIndex::number(int32_t surface, LatticePoint point) {
  const int32_t next = count();
  return numbers_.emplace(Key{names_.plane(surface), names_.name(surface, point)}, next)
      .first->second;
}

int32_t CornerIndex::find(int32_t surface, LatticePoint point) const {
  const auto found = numbers_.find(Key{names_.plane(surface), names_.name(surface, point)});
  return found == numbers_.end() ? -1 : found->second;
}

}  // namespace hrad
