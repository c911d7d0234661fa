// Building and replacing blocks. Floor 6 (links).
#include "links/link_table.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "machine/thread_team.h"

namespace hrad {
namespace {

uint32_t offset_in_block(size_t links) {
  if (links > 0xffffffffu)
    fail(Status::memory, "more than 4,294,967,295 links to 1,024 elements: use a larger accuracy");
  return static_cast<uint32_t>(links);
}

}  // namespace

int64_t LinkTable::link_count() const {
  size_t count = 0;
  for (const Block& block : blocks_) count += block.links.size();
  return static_cast<int64_t>(count);
}

int64_t LinkTable::bytes_of_links() const {
  size_t count = 0;
  for (const Block& block : blocks_) count += block.links.capacity();
  return static_cast<int64_t>(count * sizeof(Link));
}

int64_t LinkTable::bytes() const {
  int64_t bytes = bytes_of_links() + static_cast<int64_t>(blocks_.capacity() * sizeof(Block));
  for (const Block& block : blocks_)
    bytes += block.has_links.bytes() +
             static_cast<int64_t>(block.ends.capacity() * sizeof block.ends[0]);
  return bytes;
}

void LinkTable::resize(size_t receivers) {
  blocks_.resize((receivers + receivers_of_a_block - 1) / receivers_of_a_block);
  const size_t first = std::min(size_, receivers) / receivers_of_a_block;
  for (size_t k = first; k < blocks_.size(); ++k) {
    Block& block = blocks_[k];
    block.has_links.resize(std::min(receivers_of_a_block, receivers - k * receivers_of_a_block));
    block.ends.resize(block.has_links.count());
    block.links.resize(block.ends.empty() ? 0 : block.ends.back());
  }
  size_ = receivers;
}

void LinkTable::append(Span<const Link> links) {
  if (size_ % receivers_of_a_block == 0) {
    if (!blocks_.empty()) shrink_to_fit(blocks_.back());
    blocks_.emplace_back();
  }
  append(links, blocks_.back());
  ++size_;
}

void LinkTable::append(Span<const Link> links, Block& block) {
  block.has_links.push_back(!links.empty());
  if (links.empty()) return;
  block.links.insert(block.links.end(), links.begin(), links.end());
  block.ends.push_back(offset_in_block(block.links.size()));
}

void LinkTable::shrink_to_fit(Block& block) {
  block.has_links.shrink_to_fit();
  block.ends.shrink_to_fit();
  block.links.shrink_to_fit();
}

void LinkTable::shrink_to_fit() {
  blocks_.shrink_to_fit();
  if (!blocks_.empty()) shrink_to_fit(blocks_.back());
}

// runs: those of receivers in this block, ascending.
void LinkTable::rebuild(size_t number, Span<const NewRun> runs) {
  const size_t begin = number * receivers_of_a_block;
  const size_t end = begin + blocks_[number].has_links.size();
  size_t links = blocks_[number].links.size(), with_links = blocks_[number].ends.size();
  for (const NewRun& run : runs) {
    const size_t before = (*this)[static_cast<size_t>(run.receiver)].links().size();
    links += run.links.size() - before;
    with_links += size_t{!run.links.empty()} - size_t{before > 0};
  }
  Block made;
  made.links.reserve(links);
  made.ends.reserve(with_links);
  const NewRun* next = runs.begin();
  for (size_t k = begin; k < end; ++k) {
    const bool is_new = next < runs.end() && static_cast<size_t>(next->receiver) == k;
    append(is_new ? (next++)->links : (*this)[k].links(), made);
  }
  made.has_links.shrink_to_fit();
  blocks_[number] = std::move(made);
}

void LinkTable::replace(std::vector<NewRun> runs, ThreadTeam* team) {
  const auto none_before_or_after = [&](const NewRun& run) {
    return run.links.size() == 0 && (*this)[static_cast<size_t>(run.receiver)].count() == 0;
  };
  runs.erase(std::remove_if(runs.begin(), runs.end(), none_before_or_after), runs.end());
  const auto by_receiver = [](const NewRun& a, const NewRun& b) { return a.receiver < b.receiver; };
  if (!std::is_sorted(runs.begin(), runs.end(), by_receiver))
    std::sort(runs.begin(), runs.end(), by_receiver);
  std::vector<Span<const NewRun>> of_block;
  const auto block_of = [&](size_t k) {
    return static_cast<size_t>(runs[k].receiver) / receivers_of_a_block;
  };
  for (size_t first = 0, end; first < runs.size(); first = end) {
    for (end = first + 1; end < runs.size() && block_of(end) == block_of(first);) ++end;
    of_block.push_back({runs.data() + first, end - first});
  }
  const auto rebuild_one = [&](int64_t k, int) {
    const Span<const NewRun>& some = of_block[static_cast<size_t>(k)];
    rebuild(static_cast<size_t>(some[0].receiver) / receivers_of_a_block, some);
  };
  const int64_t count = static_cast<int64_t>(of_block.size());
  if (team)
    team->for_each(count, rebuild_one);
  else
    for (int64_t k = 0; k < count; ++k) rebuild_one(k, 0);
}

}  // namespace hrad
