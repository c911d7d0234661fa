// Names for the corners of elements that neighbouring surfaces agree on: exact, by lattice
// coordinates and shared edges, never by comparing rounded positions. Floor 5 (hierarchy).
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/hash.h"
#include "hierarchy/lattice.h"

namespace hrad {

class CornerIndex {
 public:
  explicit CornerIndex(const Forest& forest);

  // The corner's number, a new one when it was not met before.
  int32_t number(int32_t surface, LatticePoint point);
  // The corner's number, -1 when it was not met.
  int32_t find(int32_t surface, LatticePoint point) const;
  int32_t count() const { return static_cast<int32_t>(numbers_.size()); }

 private:
  struct Key {
    int64_t place, along;
    bool operator==(const Key& o) const { return place == o.place && along == o.along; }
  };
  struct KeyHash {
    size_t operator()(const Key& k) const {
      return mix(static_cast<uint64_t>(k.place), static_cast<uint64_t>(k.along));
    }
  };
  Key key_of_point(int32_t surface, LatticePoint point) const;

  std::vector<int32_t> plane_;                         // per surface: surfaces joined in one plane
  std::vector<int32_t> vertex_;                        // per surface and corner: welded vertex
  std::unordered_map<Key, int32_t, KeyHash> numbers_;  // looked up only, never walked through
};

}  // namespace hrad
