// Building and replacing blocks. Floor 6 (links).
#include "links/link_table.h"

#include <algorithm>

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
                                                 blocks_.capacity() * sizeof(std::vector<Link>));
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

// runs: those of receivers in this block, ascending.
void LinkTable::rebuild(size_t number, Span<const NewRun> runs) {
  const size_t begin = number * receivers_of_a_block;
  const size_t end = std::min(first_.size(), begin + receivers_of_a_block);
  size_t total = blocks_[number].size();
  for (const NewRun& run : runs)
    total += run.links.size() - (*this)[static_cast<size_t>(run.receiver)].links().size();
  std::vector<Link> made;
  made.reserve(total);
  const NewRun* next = runs.begin();
  // The old run of k ends where that of k + 1 begins, which is overwritten later.
  for (size_t k = begin; k < end; ++k) {
    const bool is_new = next < runs.end() && static_cast<size_t>(next->receiver) == k;
    const Span<const Link> links = is_new ? (next++)->links : (*this)[k].links();
    first_[k] = offset_in_block(made.size());
    made.insert(made.end(), links.begin(), links.end());
  }
  blocks_[number].swap(made);
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
