// A surface, what is meant on it, and where. Floor 7 (stages).
#include "stages/task_names.h"

#include "base/hash.h"

namespace hrad {
namespace {

// Bits of the place and of what is meant; a surface whose number doesn't fit before them makes
// hashes of its names, which are as good but for their length.
constexpr int bits_of_place = 34;
constexpr int32_t surfaces_that_fit = int32_t{1} << (64 - bits_of_place - 1);
constexpr uint64_t is_element = 1;

uint64_t name_of(int32_t surface, uint64_t kind, uint64_t place) {
  const auto number = static_cast<uint64_t>(surface);
  if (surface >= surfaces_that_fit) return mix(number, kind, place);
  return (number << 1 | kind) << bits_of_place | place;
}

}  // namespace

// The way from the root: two bits for each child, below a leading one.
uint64_t name_of_element(const Forest& forest, NodeId element, int which) {
  uint64_t way = 0;
  int bits = 0;
  NodeId id = element;
  for (; forest.nodes[id].level > 0; id = forest.nodes[id].parent, bits += 2) {
    const NodeId first = forest.nodes[forest.nodes[id].parent].first_child;
    way |= static_cast<uint64_t>(id - first) << bits;
  }
  way |= uint64_t{1} << bits;
  static_assert(2 * max_level + 1 + 2 <= bits_of_place, "the longest way has a name");
  return name_of(forest.nodes[element].surface, is_element,
                 way << 2 | static_cast<uint64_t>(which));
}

uint64_t name_of_corner(int32_t surface, LatticePoint point) {
  return name_of(surface, 0, static_cast<uint64_t>(point.i) << 16 | static_cast<uint64_t>(point.j));
}

}  // namespace hrad
