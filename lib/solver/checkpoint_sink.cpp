// What a process has compressed stands in the file behind what lower ranks have. Floor 8 (solver).
#include "solver/checkpoint_sink.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "machine/sharing.h"
#include "solver/checkpoint_codec.h"

namespace hrad {
namespace {

// A few for each thread, so that little stands in memory. Others wait for the slowest process, and
// may have to hand over all that it packs.
constexpr int64_t runs_of_a_thread_alone = 4, runs_of_a_thread = 2;

int64_t own_runs_at_once(const Comm& comm, const ThreadTeam* team) {
  if (comm.alone()) return team ? runs_of_a_thread_alone * team->size() : 1;
  return runs_of_a_thread * (team ? team->size() : 1);
}

}  // namespace

CheckpointSink::CheckpointSink(Comm& comm, SharedFile& file, ThreadTeam* team)
    : comm_(comm), file_(file), team_(team), offset_(head_bytes + table_bytes) {
  std::vector<int64_t> own(1, own_runs_at_once(comm, team));
  unite(comm, own);
  at_once_.push_back(0);
  for (int64_t runs : own) at_once_.push_back(at_once_.back() + runs);
}

// Contiguous ones to each rank, the first to rank 0.
std::vector<ItemRange> CheckpointSink::dealt_out(int64_t runs) const {
  const auto first_of = [&](size_t rank) {
    return (runs * at_once_[rank] + at_once_.back() - 1) / at_once_.back();
  };
  std::vector<ItemRange> of_rank;
  for (size_t rank = 0; rank + 1 < at_once_.size(); ++rank)
    of_rank.push_back({first_of(rank), first_of(rank + 1)});
  return of_rank;
}

CheckpointSink::Block CheckpointSink::block_of(Section section, ItemRange runs, int64_t items,
                                               const Pack& pack) const {
  struct Run {
    std::string stored;
    uint64_t raw;
    uint32_t raw_checksum;
  };
  const int64_t of_run = items_of_run(section);
  std::vector<Run> made(static_cast<size_t>(runs.end - runs.first));
  const auto make = [&](int64_t k, int) {
    const int64_t first = (runs.first + k) * of_run;
    PackedBytes packed;
    pack(first, std::min(items, first + of_run), packed);
    const std::string& raw = packed.bytes();
    if (raw.size() >= longest_run)
      fail(Status::unsupported, "a run of section '%s' has %zu bytes: more than a file can hold",
           section_name(section), raw.size());
    made[static_cast<size_t>(k)] = {compressed(raw), raw.size(),
                                    checksum(0, raw.data(), raw.size())};
  };
  if (team_)
    team_->for_each(static_cast<int64_t>(made.size()), make);
  else
    for (int64_t k = 0; k < static_cast<int64_t>(made.size()); ++k) make(k, 0);
  Block block;
  for (Run& run : made) {
    PackedBytes head;
    head.u32(static_cast<uint32_t>(run.stored.size()));
    head.u32(static_cast<uint32_t>(run.raw));
    block.stored += head.bytes();
    block.stored += std::exchange(run.stored, {});
    block.raw += run.raw;
    block.raw_checksum = checksum_joined(block.raw_checksum, run.raw_checksum, run.raw);
  }
  return block;
}

// Of every process one block, in the order of ranks.
void CheckpointSink::put(Block block) {
  struct Size {
    uint64_t stored, raw;
    uint32_t stored_checksum, raw_checksum;
  };
  std::vector<Size> sizes(1);
  sizes[0] = {block.stored.size(), block.raw, checksum(0, block.stored.data(), block.stored.size()),
              block.raw_checksum};
  unite(comm_, sizes);
  SectionEntry& entry = table_.back();
  for (size_t rank = 0; rank < sizes.size(); ++rank) {
    const Size& size = sizes[rank];
    if (static_cast<int>(rank) == comm_.rank())
      file_.write_at(offset_, block.stored.data(), block.stored.size());
    offset_ += size.stored;
    entry.stored += size.stored;
    entry.raw += size.raw;
    entry.stored_checksum =
        checksum_joined(entry.stored_checksum, size.stored_checksum, size.stored);
    entry.raw_checksum = checksum_joined(entry.raw_checksum, size.raw_checksum, size.raw);
  }
}

void CheckpointSink::write(Section section, int64_t items, const Pack& pack, const Fetch& fetch) {
  table_.emplace_back();
  table_.back().offset = offset_;
  const int64_t of_run = items_of_run(section), runs = (items + of_run - 1) / of_run;
  for (int64_t first = 0; first < runs; first += at_once_.back()) {
    std::vector<ItemRange> of_rank = dealt_out(std::min(at_once_.back(), runs - first));
    for (ItemRange& dealt : of_rank) dealt = {first + dealt.first, first + dealt.end};
    const ItemRange own = of_rank[static_cast<size_t>(comm_.rank())];
    if (fetch && !comm_.alone()) {
      for (ItemRange& dealt : of_rank)
        dealt = {std::min(items, dealt.first * of_run), std::min(items, dealt.end * of_run)};
      fetch(of_rank);
    }
    put(block_of(section, own, items, pack));
  }
}

void CheckpointSink::write_own(Section section, int64_t own_items, const Pack& pack) {
  if (comm_.alone()) return write(section, own_items, pack);
  table_.emplace_back();
  table_.back().offset = offset_;
  put(block_of(section, {0, own_items}, own_items, pack));
}

void CheckpointSink::finish() {
  if (comm_.rank() != 0) return;
  file_.write_at(offset_, end_mark, mark_bytes);
  const std::string start = head_and_table(offset_ + mark_bytes, table_);
  file_.write_at(0, start.data(), start.size());
}

}  // namespace hrad
