// Writing the sections of a checkpoint by all processes together. Floor 8 (solver).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "machine/comm.h"
#include "machine/shared_file.h"
#include "machine/thread_team.h"
#include "solver/checkpoint_format.h"
#include "solver/packed_bytes.h"

namespace hrad {

// From first up to end.
struct ItemRange {
  int64_t first = 0, end = 0;
};

// Writes one section after the other, a few runs at a time: each process packs and compresses some
// of these and puts them in their places in the file, whose bytes are the same however many
// processes and threads there are. Collective, but for what Pack does.
class CheckpointSink {
 public:
  // team: to compress with; none: the calling thread alone. All must outlive this.
  CheckpointSink(Comm& comm, SharedFile& file, ThreadTeam* team);

  // Of items first .. end-1, the bytes of a run. Any thread.
  using Pack = std::function<void(int64_t first, int64_t end, PackedBytes& bytes)>;
  // Collective: each rank is to pack these items next and needs what others have of them.
  using Fetch = std::function<void(const std::vector<ItemRange>& of_rank)>;
  // All processes have all items, or what they lack is fetched. A section of one run is packed by
  // rank 0.
  void write(Section section, int64_t items, const Pack& pack, const Fetch& fetch = nullptr);
  // A section of runs of one item, which stands at one process each: rank 0's from 0 on, then those
  // of rank 1, and so on. Each packs its own, and keeps them compressed until all have theirs.
  void write_own(Section section, int64_t own_items, const Pack& pack);
  // After the last section.
  void finish();

 private:
  // Runs one after the other as they are stored, with their heads.
  struct Block {
    std::string stored;
    uint64_t raw = 0;
    uint32_t raw_checksum = 0;
  };
  Block block_of(Section section, ItemRange runs, int64_t items, const Pack& pack) const;
  void put(Block block);
  std::vector<ItemRange> dealt_out(int64_t runs) const;

  Comm& comm_;
  SharedFile& file_;
  ThreadTeam* team_;
  std::vector<int64_t> at_once_;  // runs of all lower ranks, for each rank; then of all
  std::vector<SectionEntry> table_;
  uint64_t offset_;
};

}  // namespace hrad
