// Numbers for the corners of elements that neighbouring surfaces agree on. Floor 5 (hierarchy).
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/hash.h"
#include "hierarchy/corner_names.h"

namespace hrad {

class CornerIndex {
 public:
  explicit CornerIndex(const Forest& forest, double facet_area = 0) : names_(forest, facet_area) {}

  // The corner's number, a new one when it was not met before.
  int32_t number(int32_t surface, LatticePoint point);
  // The corner's number, -1 when it was not met.
  int32_t find(int32_t surface, LatticePoint point) const;
  int32_t count() const { return static_cast<int32_t>(numbers_.size()); }

 private:
  struct Key {
    int32_t plane;
    uint64_t name;
    bool operator==(const Key& o) const { return plane == o.plane && name == o.name; }
  };
  struct KeyHash {
    size_t operator()(const Key& k) const { return mix(static_cast<uint64_t>(k.plane), k.name); }
  };

  CornerNames names_;
  std::unordered_map<Key, int32_t, KeyHash> numbers_;  // looked up only, never walked through
};

}  // namespace hrad
