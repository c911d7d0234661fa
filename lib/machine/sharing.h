// Results of tasks, each done by one process, made known to all of them. Floor 2 (machine).
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "machine/comm.h"

namespace hrad {

// Values one after the other in bytes, and out of them again.
template <class T>
void put(Bytes& bytes, const T* values, size_t count) {
  static_assert(std::is_trivially_copyable<T>::value, "bytes are all there is to it");
  const char* first = reinterpret_cast<const char*>(values);
  bytes.insert(bytes.end(), first, first + count * sizeof(T));
}
class Taker {
 public:
  explicit Taker(const Bytes& bytes) : next_(bytes.data()) {}
  template <class T>
  void take(T* values, size_t count) {
    if (count == 0) return;
    std::memcpy(static_cast<void*>(values), next_, count * sizeof(T));
    next_ += count * sizeof(T);
  }

 private:
  const char* next_;
};
// A list with its length.
template <class List>
void put_list(Bytes& bytes, const List& list) {
  const uint64_t size = list.size();
  put(bytes, &size, 1);
  put(bytes, list.data(), list.size());
}
template <class List>
void take_list(Taker& taker, List& list) {
  uint64_t size;
  taker.take(&size, 1);
  list.resize(size);
  taker.take(list.data(), size);
}

// `all` must outlive them.
inline std::vector<Taker> takers(const std::vector<Bytes>& all) {
  return std::vector<Taker>(all.begin(), all.end());
}

// Collective. Of `count` items each belongs to a rank, owner_of(k): `write(k, bytes)` is called for
// this rank's own, and then `read(k, taker)` for those of all others, in order.
template <class OwnerOf, class Write, class Read>
void share(Comm& comm, size_t count, const OwnerOf& owner_of, const Write& write,
           const Read& read) {
  if (comm.alone()) return;
  Bytes own;
  for (size_t k = 0; k < count; ++k)
    if (owner_of(k) == comm.rank()) write(k, own);
  const std::vector<Bytes> all = comm.gather_all(own);
  std::vector<Taker> from = takers(all);
  for (size_t k = 0; k < count; ++k)
    if (owner_of(k) != comm.rank()) read(k, from[static_cast<size_t>(owner_of(k))]);
}

// The same of lists of values.
template <class T, class OwnerOf>
void share_lists(Comm& comm, std::vector<std::vector<T>>& lists, const OwnerOf& owner_of) {
  share(
      comm, lists.size(), owner_of, [&](size_t k, Bytes& bytes) { put_list(bytes, lists[k]); },
      [&](size_t k, Taker& taker) { take_list(taker, lists[k]); });
}

// Collective. Marks that are 0 but for few: each process gives those that it has set, no two the
// same one, and all have all of them afterwards.
inline void share_marks(Comm& comm, std::vector<uint8_t>& marks) {
  if (comm.alone()) return;
  std::vector<uint32_t> places;
  Bytes own;
  for (size_t k = 0; k < marks.size(); ++k)
    if (marks[k] != 0) places.push_back(static_cast<uint32_t>(k));
  put_list(own, places);
  for (uint32_t place : places) put(own, &marks[place], 1);
  for (const Bytes& of_rank : comm.gather_all(own)) {
    Taker taker(of_rank);
    take_list(taker, places);
    for (uint32_t place : places) taker.take(&marks[place], 1);
  }
}

// Collective. Rank 0's values, on all.
template <class T>
void broadcast(Comm& comm, std::vector<T>& values) {
  if (comm.alone()) return;
  Bytes bytes;
  if (comm.rank() == 0) put(bytes, values.data(), values.size());
  comm.broadcast(bytes);
  values.resize(bytes.size() / sizeof(T));
  Taker(bytes).take(values.data(), values.size());
}

// Collective. Every process's values, one after the other.
template <class T>
void unite(Comm& comm, std::vector<T>& values) {
  if (comm.alone()) return;
  Bytes own;
  put(own, values.data(), values.size());
  values.clear();
  for (const Bytes& bytes : comm.gather_all(own)) {
    const size_t before = values.size();
    values.resize(before + bytes.size() / sizeof(T));
    Taker(bytes).take(values.data() + before, values.size() - before);
  }
}

// Collective. Every process's values that are to go to this one, owner_of(value).
template <class T, class OwnerOf>
void send_to_owners(Comm& comm, std::vector<T>& values, const OwnerOf& owner_of) {
  if (comm.alone()) return;
  std::vector<Bytes> to(static_cast<size_t>(comm.size()));
  for (const T& value : values) put(to[static_cast<size_t>(owner_of(value))], &value, 1);
  values.clear();
  for (const Bytes& bytes : comm.exchange(std::move(to))) {
    const size_t before = values.size();
    values.resize(before + bytes.size() / sizeof(T));
    Taker(bytes).take(values.data() + before, values.size() - before);
  }
}

// Of tasks that belong to nobody each process takes its turn.
inline bool is_my_turn(const Comm& comm, size_t task) {
  return task % static_cast<size_t>(comm.size()) == static_cast<size_t>(comm.rank());
}

}  // namespace hrad
