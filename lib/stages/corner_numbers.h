// Numbers of the corners of elements, by their names. Floor 7 (stages).
#pragma once

#include <cstdint>
#include <vector>

#include "base/number_table.h"
#include "hierarchy/lattice.h"
#include "machine/thread_team.h"

namespace hrad {

// A surface and a point of its lattice: no point is shared by two surfaces.
inline uint64_t key_of_corner(int32_t surface, LatticePoint p) {
  return static_cast<uint64_t>(surface) << 32 | static_cast<uint64_t>(p.i) << 16 |
         static_cast<uint64_t>(p.j);
}
inline int32_t surface_of_corner(uint64_t key) { return static_cast<int32_t>(key >> 32); }
inline LatticePoint point_of_corner(uint64_t key) {
  return {static_cast<int32_t>(key >> 16 & 0xffff), static_cast<int32_t>(key & 0xffff)};
}

class CornerNumbers {
 public:
  CornerNumbers();

  // NumberTable::none: it has none.
  int32_t find(uint64_t key) const { return tables_[table_of(key)].find(key); }
  // Gives numbers from `next` on to those of the keys that have none yet, in the order in which
  // they come first, whatever the threads. Returns where in `keys` these are.
  std::vector<uint32_t> add(const std::vector<uint64_t>& keys, int32_t next, ThreadTeam& team);
  int64_t bytes() const;

 private:
  static size_t table_of(uint64_t key) { return mix(key) >> 58; }
  std::vector<uint32_t> add_in_turn(const std::vector<uint64_t>& keys, int32_t next);

  std::vector<NumberTable> tables_;  // by the hash of the key, each filled by one thread at a time
};

}  // namespace hrad
