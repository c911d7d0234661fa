// Numbers of many keys at once, by a team, in the order of the keys. Floor 2 (machine).
#pragma once

#include <cstdint>
#include <vector>

#include "base/number_table.h"
#include "base/span.h"
#include "machine/thread_team.h"

namespace hrad {

class KeyNumbers {
 public:
  KeyNumbers();

  // NumberTable::none: it has none.
  int32_t find(uint64_t key) const { return tables_[table_of(key)].find(key); }
  // Gives numbers from `next` on to those of the keys that have none yet, in the order in which
  // they come first, whatever the threads. Returns where in `keys` these are.
  std::vector<uint32_t> add(Span<const uint64_t> keys, int32_t next, ThreadTeam& team);
  int64_t bytes() const;

 private:
  static size_t table_of(uint64_t key) { return mix(key) >> 58; }
  std::vector<uint32_t> add_in_turn(Span<const uint64_t> keys, int32_t next);

  std::vector<NumberTable> tables_;  // by the hash of the key, each filled by one thread at a time
};

}  // namespace hrad
