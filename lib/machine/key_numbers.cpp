// Keys are dealt out to tables, and what is new in these is counted in the order of the keys.
// Floor 2 (machine).
#include "machine/key_numbers.h"

#include <algorithm>

#include "base/growing_array.h"
#include "machine/pieces.h"

namespace hrad {
namespace {

constexpr size_t table_count = 64;
constexpr size_t keys_of_a_piece = 1024;

}  // namespace

KeyNumbers::KeyNumbers() : tables_(table_count) {}

int64_t KeyNumbers::bytes() const {
  int64_t sum = 0;
  for (const NumberTable& table : tables_) sum += table.bytes();
  return sum;
}

std::vector<uint32_t> KeyNumbers::add_in_turn(Span<const uint64_t> keys, int32_t next) {
  std::vector<uint32_t> added;
  for (size_t k = 0; k < keys.size(); ++k) {
    int32_t& number = tables_[table_of(keys[k])].at(keys[k]);
    if (number != NumberTable::none) continue;
    number = next++;
    added.push_back(static_cast<uint32_t>(k));
  }
  return added;
}

std::vector<uint32_t> KeyNumbers::add(Span<const uint64_t> keys, int32_t next, ThreadTeam& team) {
  if (team.alone() || keys.size() <= keys_of_a_piece) return add_in_turn(keys, next);
  // Of each table its keys, in order: piece by piece, first counted, then put side by side.
  const size_t pieces = pieces_of(keys.size(), keys_of_a_piece);
  std::vector<uint32_t> next_of(pieces * table_count, 0);
  // Written to by the team first.
  GrowingArray<uint32_t> sorted;
  GrowingArray<int32_t> number_of;
  sorted.resize_for_overwrite(keys.size());
  number_of.resize_for_overwrite(keys.size());
  for_each_piece(
      team, keys.size(),
      [&](size_t piece, size_t begin, size_t end) {
        std::fill(number_of.data() + begin, number_of.data() + end, NumberTable::none);
        for (size_t k = begin; k < end; ++k) ++next_of[piece * table_count + table_of(keys[k])];
      },
      keys_of_a_piece);
  std::vector<uint32_t> first(table_count + 1, 0);
  uint32_t sum = 0;
  for (size_t table = 0; table < table_count; ++table) {
    for (size_t piece = 0; piece < pieces; ++piece) {
      uint32_t& here = next_of[piece * table_count + table];
      const uint32_t count = here;
      here = sum;
      sum += count;
    }
    first[table + 1] = sum;
  }
  for_each_piece(
      team, keys.size(),
      [&](size_t piece, size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k)
          sorted[next_of[piece * table_count + table_of(keys[k])]++] = static_cast<uint32_t>(k);
      },
      keys_of_a_piece);
  // New ones stand in the tables without a number until all are known. Tables grow with them alone,
  // as they do where keys come in turn.
  std::vector<std::vector<uint32_t>> new_of(table_count);
  team.for_each(static_cast<int64_t>(table_count), [&](int64_t t, int) {
    const size_t table = static_cast<size_t>(t);
    for (uint32_t at = first[table]; at < first[table + 1]; ++at) {
      const uint32_t k = sorted[at];
      const size_t before = tables_[table].size();
      tables_[table].at(keys[k]);
      if (tables_[table].size() == before) continue;
      number_of[k] = 0;
      new_of[table].push_back(k);
    }
  });
  const std::vector<uint32_t> added =
      gathered<uint32_t>(team, keys.size(), [&](size_t k, std::vector<uint32_t>& some) {
        if (number_of[k] != NumberTable::none) some.push_back(static_cast<uint32_t>(k));
      });
  for_each_thing(team, added.size(),
                 [&](size_t k) { number_of[added[k]] = next + static_cast<int32_t>(k); });
  team.for_each(static_cast<int64_t>(table_count), [&](int64_t t, int) {
    const size_t table = static_cast<size_t>(t);
    for (uint32_t k : new_of[table]) tables_[table].at(keys[k]) = number_of[k];
  });
  return added;
}

}  // namespace hrad
