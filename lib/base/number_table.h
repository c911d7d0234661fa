// Numbers found by 64-bit keys: one flat array, so that looking up is one miss of the cache.
// Floor 1 (base).
#pragma once

#include <cstdint>
#include <vector>

#include "base/hash.h"

namespace hrad {

class NumberTable {
 public:
  static constexpr uint64_t no_key = ~uint64_t{0};  // never given
  static constexpr int32_t none = -1;

  size_t size() const { return size_; }
  int64_t bytes() const { return static_cast<int64_t>(slots_.capacity() * sizeof(Slot)); }

  // The number of a key, none: it has none.
  int32_t find(uint64_t key) const {
    return slots_.empty() ? none : slots_[place_of(slots_, key)].number;
  }

  // The number of a key, which is `none` where the key is new. Stays in its place until one more
  // key comes than there was room for.
  int32_t& at(uint64_t key) {
    if (2 * (size_ + 1) > slots_.size()) make_room(1);
    Slot& slot = slots_[place_of(slots_, key)];
    if (slot.key == no_key) {
      slot.key = key;
      ++size_;
    }
    return slot.number;
  }

  // Room for so many more keys.
  void make_room(size_t keys) {
    size_t wanted = slots_.empty() ? 16 : slots_.size();
    while (wanted < 2 * (size_ + keys)) wanted *= 2;
    if (wanted == slots_.size()) return;
    std::vector<Slot> slots(wanted);
    for (const Slot& slot : slots_)
      if (slot.key != no_key) slots[place_of(slots, slot.key)] = slot;
    slots_.swap(slots);
  }

  // Forgets all, but keeps the room.
  void clear() {
    if (size_ > 0) slots_.assign(slots_.size(), Slot{});
    size_ = 0;
  }

 private:
  struct Slot {
    uint64_t key = no_key;
    int32_t number = none;
  };
  // Where the key is, or would be.
  static size_t place_of(const std::vector<Slot>& slots, uint64_t key) {
    const size_t mask = slots.size() - 1;
    size_t place = mix(key) & mask;
    while (slots[place].key != key && slots[place].key != no_key) place = (place + 1) & mask;
    return place;
  }

  std::vector<Slot> slots_;  // a power of two of them, at least half of them empty
  size_t size_ = 0;
};

}  // namespace hrad
