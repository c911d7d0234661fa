// The frame of a checkpoint: head, table of sections, sections made of compressed runs, end mark,
// and reading it; checkpoint_sink.h writes it.
// The layout is described in hrad-checkpoint(5). Floor 8 (solver).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/memory_budget.h"
#include "solver/packed_bytes.h"

namespace hrad {

// Files of version 1 differ in their steps, which are left out in reading.
constexpr uint32_t checkpoint_version = 2;

// In the order in which they stand in a file. Each is cut into runs of so many items, whoever
// writes it.
enum class Section {
  origin,  // what wrote the file
  parameters,
  sizes,
  materials,  // and what was found doubtful in the scene
  vertices,
  patches,
  progress,
  tree,
  nodes,
  clusters,
  links,
  cells,
  mean_light,
  points,
  point_links,
  own_points,
  light,
  steps,
  count_of_sections
};
constexpr size_t section_count = static_cast<size_t>(Section::count_of_sections);
const char* section_name(Section section);
int64_t items_of_run(Section section);

struct SectionEntry {
  uint64_t offset = 0, stored = 0, raw = 0;  // bytes
  uint32_t stored_checksum = 0, raw_checksum = 0;
};

// What stands before the sections, of a file of so many bytes, and behind them.
constexpr uint64_t head_bytes = 32, entry_bytes = 40, table_bytes = section_count * entry_bytes;
std::string head_and_table(uint64_t file_bytes, const std::vector<SectionEntry>& table);
constexpr char end_mark[] = "hradend\n";
constexpr size_t mark_bytes = 8;

// Of a run: bytes in the file, bytes when expanded, then what is stored.
constexpr uint64_t run_head_bytes = 8;
// zlib counts in 32 bits.
constexpr size_t longest_run = size_t{1} << 31;

// The content of a file whose frame is right: its head, its table, its end, and the checksum of
// every stored byte. FORMAT otherwise.
class CheckpointSource {
 public:
  // Both must outlive this; runs are counted in the budget while they are expanded.
  CheckpointSource(const std::string& content, MemoryBudget& budget);

  uint32_t version() const { return version_; }
  const SectionEntry& entry(Section section) const { return table_[static_cast<size_t>(section)]; }
  // Where a section begins, for messages.
  FilePlace place(Section section) const { return {section_name(section), entry(section).offset}; }

  // Reads a section run by run; each is checked to be read to its end.
  using Unpack = std::function<void(int64_t first, int64_t end, PackedReader& bytes)>;
  void read(Section section, int64_t items, const Unpack& unpack) const;

 private:
  void read_table();
  void check_sums() const;

  const std::string& content_;
  MemoryBudget& budget_;
  uint32_t version_ = 0;
  std::vector<SectionEntry> table_;
};

}  // namespace hrad
