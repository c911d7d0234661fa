// Loops over many small things: the tasks of a team of threads are pieces of them. What they find
// is put together in the order of the things, whoever found it. Floor 2 (machine).
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "machine/thread_team.h"

namespace hrad {

// Few enough for many threads, and many enough to be worth waking them.
constexpr size_t things_of_a_piece = 512;

inline size_t pieces_of(size_t count, size_t of_a_piece = things_of_a_piece) {
  return (count + of_a_piece - 1) / of_a_piece;
}

// body(piece, begin, end) for the things from begin up to end.
template <class Body>
void for_each_piece(ThreadTeam& team, size_t count, const Body& body,
                    size_t of_a_piece = things_of_a_piece) {
  team.for_each(static_cast<int64_t>(pieces_of(count, of_a_piece)), [&](int64_t task, int) {
    const size_t piece = static_cast<size_t>(task), begin = piece * of_a_piece;
    body(piece, begin, std::min(count, begin + of_a_piece));
  });
}

// body(k) for each thing.
template <class Body>
void for_each_thing(ThreadTeam& team, size_t count, const Body& body) {
  for_each_piece(team, count, [&](size_t, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) body(k);
  });
}

// Lists one after the other.
template <class T>
std::vector<T> joined(ThreadTeam& team, std::vector<std::vector<T>>& lists) {
  if (lists.size() == 1) return std::move(lists.front());
  std::vector<size_t> first(lists.size() + 1, 0);
  for (size_t k = 0; k < lists.size(); ++k) first[k + 1] = first[k] + lists[k].size();
  std::vector<T> all;
  if (team.alone() || first.back() < 64 * things_of_a_piece) {
    all.reserve(first.back());
    for (const std::vector<T>& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
  }
  all.resize(first.back());
  for_each_piece(
      team, lists.size(),
      [&](size_t k, size_t, size_t) {
        std::copy(lists[k].begin(), lists[k].end(), all.data() + first[k]);
      },
      1);
  return all;
}

// What body(k, list) appends to the list, for each thing in turn.
template <class T, class Body>
std::vector<T> gathered(ThreadTeam& team, size_t count, const Body& body,
                        size_t of_a_piece = things_of_a_piece) {
  std::vector<std::vector<T>> lists(pieces_of(count, of_a_piece));
  for_each_piece(
      team, count,
      [&](size_t piece, size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) body(k, lists[piece]);
      },
      of_a_piece);
  return joined(team, lists);
}

}  // namespace hrad
