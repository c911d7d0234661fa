// Building and replacing blocks. Floor 6 (links).
#include "links/link_table.h"

#include <algorithm>

#include "base/error.h"

namespace hrad {
namespace {

uint32_t offset_in_block(size_t links) {
  if (links > 0xffffffffu)
    fail(Status::memory, "more than 4,294,967,295 links to 1,024 elements: use a larger accuracy");
  return static_cast<uint32_t>(links);
}

}  // namespace

LinkTable::Block LinkTable::block(size_t number) const {
  const size_t receiver = number * receivers_of_a_block;
  return {receiver, std::min(receivers_of_a_block, first_.size() - receiver),
          blocks_[number].data(), &first_[receiver], static_cast<uint32_t>(blocks_[number].size())};
}

int64_t LinkTable::link_count() const {
  size_t count = 0;
  for (const auto& block : blocks_) count += block.size();
  return static_cast<int64_t>(count);
}

int64_t LinkTable::bytes_of_links() const {
  size_t count = 0;
  for (const auto& block : blocks_) count += block.capacity();
  return static_cast<int64_t>(count * sizeof(Link));
}

int64_t LinkTable::bytes() const {
  return bytes_of_links() + static_cast<int64_t>(first_.capacity() * sizeof first_[0] +
                                                 blocks_.capacity() * sizeof blocks_[0]);
}

void LinkTable::resize(size_t receivers) {
  const size_t before = first_.size();
  blocks_.resize((receivers + receivers_of_a_block - 1) / receivers_of_a_block);
  first_.resize(receivers, 0);
  // In the block that had room, the new ones come behind its links.
  for (size_t k = before; k < receivers && k % receivers_of_a_block != 0; ++k)
    first_[k] = offset_in_block(blocks_[k / receivers_of_a_block].size());
}

void LinkTable::append(Span<const Link> links) {
  if (first_.size() % receivers_of_a_block == 0) {
    if (!blocks_.empty()) blocks_.back().shrink_to_fit();
    blocks_.emplace_back();
  }
  std::vector<Link>& block = blocks_.back();
  first_.push_back(offset_in_block(block.size()));
  block.insert(block.end(), links.begin(), links.end());
}

void LinkTable::shrink_to_fit() {
  first_.shrink_to_fit();
  blocks_.shrink_to_fit();
  if (!blocks_.empty()) blocks_.back().shrink_to_fit();
}

void LinkTable::rebuild(size_t number, const std::vector<Span<const Link>>& runs) {
  size_t total = 0;
  for (const Span<const Link>& run : runs) total += run.size();
  std::vector<Link> made;
  made.reserve(total);
  for (size_t k = 0; k < runs.size(); ++k) {
    first_[number * receivers_of_a_block + k] = offset_in_block(made.size());
    made.insert(made.end(), runs[k].begin(), runs[k].end());
  }
  blocks_[number].swap(made);
}

void LinkTable::replace(std::vector<NewRun> runs) {
  std::sort(runs.begin(), runs.end(),
            [](const NewRun& a, const NewRun& b) { return a.receiver < b.receiver; });
  std::vector<Span<const Link>> of_block;
  for (size_t next = 0; next < runs.size();) {
    const size_t block = static_cast<size_t>(runs[next].receiver) / receivers_of_a_block;
    const size_t begin = block * receivers_of_a_block;
    const size_t end = std::min(first_.size(), begin + receivers_of_a_block);
    of_block.clear();
    for (size_t k = begin; k < end; ++k) {
      const bool is_new = next < runs.size() && static_cast<size_t>(runs[next].receiver) == k;
      of_block.push_back(is_new ? runs[next++].links : (*this)[k].links());
    }
    rebuild(block, of_block);
  }
}

}  // namespace hrad
