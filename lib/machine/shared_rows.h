// Rows of as many bytes each, every one a process's own, made known to all by a team of threads.
// Floor 2 (machine).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

#include "machine/pieces.h"
#include "machine/sharing.h"

namespace hrad {

// For counting whose rows they are, which is cheap.
constexpr size_t rows_of_a_piece = 2048;

// Where the rows of each process stand in what it gives: piece by piece, one after the other.
class RowsOfOwners {
 public:
  template <class OwnerOf>
  RowsOfOwners(ThreadTeam& team, size_t rows, int owners, const OwnerOf& owner_of)
      : owners_(static_cast<size_t>(owners)), first_(pieces_of(rows, rows_of_a_piece) * owners_) {
    for_each_piece(
        team, rows,
        [&](size_t piece, size_t begin, size_t end) {
          std::vector<size_t> count(owners_, 0);
          for (size_t k = begin; k < end; ++k) ++count[static_cast<size_t>(owner_of(k))];
          std::copy(count.begin(), count.end(), &first_[piece * owners_]);
        },
        rows_of_a_piece);
    total_.assign(owners_, 0);
    for (size_t piece = 0; piece * owners_ < first_.size(); ++piece)
      for (size_t owner = 0; owner < owners_; ++owner) {
        size_t& first = first_[piece * owners_ + owner];
        const size_t count = first;
        first = total_[owner];
        total_[owner] += count;
      }
  }

  size_t of(int owner) const { return total_[static_cast<size_t>(owner)]; }
  // Of the first row in a piece that is an owner's; of each owner.
  size_t first(size_t piece, int owner) const {
    return first_[piece * owners_ + static_cast<size_t>(owner)];
  }
  std::vector<size_t> first(size_t piece) const {
    const size_t* own = first_.data() + piece * owners_;
    return std::vector<size_t>(own, own + owners_);
  }

 private:
  const size_t owners_;
  std::vector<size_t> first_;  // per piece and owner
  std::vector<size_t> total_;  // per owner
};

// Collective. Of so many rows of `bytes` each belongs to a rank, owner_of(k): write(k, to) is
// called for this rank's own, and then read(k, from) for those of all others, by any thread in any
// order. Returns how many bytes this rank has given.
template <class OwnerOf, class Write, class Read>
size_t share_rows(Comm& comm, ThreadTeam& team, size_t rows, size_t bytes, const OwnerOf& owner_of,
                  const Write& write, const Read& read) {
  if (comm.alone()) return 0;
  const RowsOfOwners places(team, rows, comm.size(), owner_of);
  Bytes own(places.of(comm.rank()) * bytes);
  for_each_piece(
      team, rows,
      [&](size_t piece, size_t begin, size_t end) {
        char* to = own.data() + places.first(piece, comm.rank()) * bytes;
        for (size_t k = begin; k < end; ++k) {
          if (owner_of(k) != comm.rank()) continue;
          write(k, to);
          to += bytes;
        }
      },
      rows_of_a_piece);
  const std::vector<Bytes> all = comm.gather_all(own);
  for_each_piece(
      team, rows,
      [&](size_t piece, size_t begin, size_t end) {
        std::vector<size_t> next = places.first(piece);
        for (size_t k = begin; k < end; ++k) {
          if (owner_of(k) == comm.rank()) continue;
          const size_t owner = static_cast<size_t>(owner_of(k));
          read(k, all[owner].data() + next[owner]++ * bytes);
        }
      },
      rows_of_a_piece);
  return own.size();
}

// The same of values that stand side by side, so many in a row.
template <class T, class OwnerOf>
size_t share_rows_of(Comm& comm, ThreadTeam& team, std::vector<T>& values, size_t of_a_row,
                     const OwnerOf& owner_of) {
  static_assert(std::is_trivially_copyable<T>::value, "bytes are all there is to it");
  const size_t bytes = of_a_row * sizeof(T);
  return share_rows(
      comm, team, values.size() / of_a_row, bytes, owner_of,
      [&](size_t k, char* to) { std::memcpy(to, &values[k * of_a_row], bytes); },
      [&](size_t k, const char* from) {
        std::memcpy(static_cast<void*>(&values[k * of_a_row]), from, bytes);
      });
}

}  // namespace hrad
