// Lists that their owners alone know, brought to who packs them, a few at a time.
// Floor 8 (solver).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/span.h"
#include "machine/comm.h"
#include "machine/sharing.h"
#include "solver/checkpoint_sink.h"

namespace hrad {

template <class Part>
class ItemsOfOthers {
 public:
  using OwnerOf = std::function<int32_t(int64_t item)>;
  // Appends the list of an item that is this process's own.
  using Give = std::function<void(int64_t item, std::vector<Part>& list)>;
  ItemsOfOthers(Comm& comm, OwnerOf owner_of, Give give)
      : comm_(comm), owner_of_(std::move(owner_of)), give_(std::move(give)) {}

  bool mine(int64_t item) const { return owner_of_(item) == comm_.rank(); }
  // Collective: a CheckpointSink::Fetch. What was fetched before is forgotten.
  void fetch(const std::vector<ItemRange>& of_rank);
  // Of an item of another that was fetched. Any thread.
  Span<const Part> operator[](int64_t item) const {
    const size_t at = static_cast<size_t>(item - first_);
    return {parts_.data() + before_[at], before_[at + 1] - before_[at]};
  }

 private:
  Comm& comm_;
  const OwnerOf owner_of_;
  const Give give_;
  int64_t first_ = 0;           // of those fetched
  std::vector<size_t> before_;  // where the parts of each begin; own ones have none
  std::vector<Part> parts_;
};

template <class Part>
void ItemsOfOthers<Part>::fetch(const std::vector<ItemRange>& of_rank) {
  std::vector<Bytes> to(of_rank.size());
  std::vector<Part> list;
  for (size_t rank = 0; rank < of_rank.size(); ++rank) {
    if (static_cast<int>(rank) == comm_.rank()) continue;
    for (int64_t k = of_rank[rank].first; k < of_rank[rank].end; ++k) {
      if (!mine(k)) continue;
      list.clear();
      give_(k, list);
      put_list(to[rank], list);
    }
  }
  const std::vector<Bytes> from = comm_.exchange(std::move(to));
  std::vector<Taker> takers_of = takers(from);
  const ItemRange wanted = of_rank[static_cast<size_t>(comm_.rank())];
  first_ = wanted.first;
  before_.assign(1, 0);
  parts_.clear();
  for (int64_t k = wanted.first; k < wanted.end; ++k) {
    if (!mine(k)) {
      take_list(takers_of[static_cast<size_t>(owner_of_(k))], list);
      parts_.insert(parts_.end(), list.begin(), list.end());
    }
    before_.push_back(parts_.size());
  }
}

}  // namespace hrad
