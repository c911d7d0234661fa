// The frame of a file, made and checked. Floor 8 (solver).
#include "solver/checkpoint_format.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "solver/checkpoint_codec.h"

namespace hrad {
namespace {

// A byte beyond ASCII, and both kinds of line ends: whatever takes the file for text damages it
// here.
constexpr char magic[] = "\x89HRD\r\n\x1a\n";
constexpr size_t name_bytes = 8, checked_head_bytes = 28;

struct Kind {
  const char* name;
  int64_t items;
};
constexpr Kind kinds[section_count] = {
    {"origin", 1},     {"params", 1},    {"sizes", 1},   {"material", 1},  {"vertices", 4096},
    {"patches", 4096}, {"progress", 1},  {"tree", 4096}, {"nodes", 4096},  {"clusters", 1},
    {"links", 1024},   {"cells", 16384}, {"mean", 4096}, {"points", 4096}, {"ptlinks", 4096},
    {"own", 16384},    {"light", 4096},  {"steps", 1}};

constexpr FilePlace head_place{"head", 0};

std::string head_of(uint64_t file_bytes, const std::string& table) {
  PackedBytes head;
  head.raw(std::string(magic, mark_bytes));
  head.u32(checkpoint_version);
  head.u32(static_cast<uint32_t>(section_count));
  head.u64(file_bytes);
  head.u32(checksum(0, table.data(), table.size()));
  head.u32(checksum(0, head.bytes().data(), checked_head_bytes));
  return head.bytes();
}

std::string table_of(const std::vector<SectionEntry>& entries) {
  PackedBytes table;
  for (size_t k = 0; k < entries.size(); ++k) {
    std::string name = kinds[k].name;
    name.resize(name_bytes, '\0');
    table.raw(name);
    table.u64(entries[k].offset);
    table.u64(entries[k].stored);
    table.u64(entries[k].raw);
    table.u32(entries[k].stored_checksum);
    table.u32(entries[k].raw_checksum);
  }
  return table.bytes();
}

}  // namespace

std::string head_and_table(uint64_t file_bytes, const std::vector<SectionEntry>& entries) {
  const std::string table = table_of(entries);
  return head_of(file_bytes, table) + table;
}

const char* section_name(Section section) { return kinds[static_cast<size_t>(section)].name; }
int64_t items_of_run(Section section) { return kinds[static_cast<size_t>(section)].items; }

CheckpointSource::CheckpointSource(const std::string& content, MemoryBudget& budget)
    : content_(content), budget_(budget) {
  read_table();
  check_sums();
}

void CheckpointSource::read_table() {
  const uint64_t size = content_.size();
  if (size < mark_bytes || std::memcmp(content_.data(), magic, mark_bytes) != 0)
    fail_format(head_place,
                "it doesn't begin as a .hrad file does: it is another kind of file, or "
                "was changed as if it were text");
  if (size < head_bytes + table_bytes + mark_bytes)
    fail_format(head_place, "the file has %llu bytes and is cut short",
                static_cast<unsigned long long>(size));
  PackedReader head(content_.data() + mark_bytes, head_bytes - mark_bytes, head_place);
  version_ = head.u32();
  const uint32_t sections = head.u32();
  const uint64_t stated = head.u64();
  const uint32_t sum_of_table = head.u32();
  if (head.u32() != checksum(0, content_.data(), checked_head_bytes))
    fail_format(head_place, "its checksum is wrong: the file is damaged");
  if (version_ < 1 || version_ > checkpoint_version)
    fail_format(head_place, "its format has version %u, and this library reads versions 1 to %u",
                version_, checkpoint_version);
  if (stated != size)
    fail_format(head_place, "the file has %llu bytes and should have %llu: it was %s",
                static_cast<unsigned long long>(size), static_cast<unsigned long long>(stated),
                size < stated ? "cut short" : "added to");
  const char* table = content_.data() + head_bytes;
  const FilePlace place{"table", head_bytes};
  if (sections != section_count || sum_of_table != checksum(0, table, table_bytes))
    fail_format(place, "its checksum or its length is wrong: the file is damaged");
  PackedReader entries(table, table_bytes, place);
  uint64_t offset = head_bytes + table_bytes;
  const uint64_t end = size - mark_bytes;
  for (size_t k = 0; k < section_count; ++k) {
    std::string name = kinds[k].name;
    name.resize(name_bytes, '\0');
    for (char c : name)
      if (entries.byte() != static_cast<unsigned char>(c))
        fail_format(place, "section %zu should be '%s' and has another name", k, kinds[k].name);
    SectionEntry entry;
    entry.offset = entries.u64();
    entry.stored = entries.u64();
    entry.raw = entries.u64();
    entry.stored_checksum = entries.u32();
    entry.raw_checksum = entries.u32();
    if (entry.offset != offset || entry.stored > end - offset ||
        entry.raw / most_compressed > entry.stored)
      fail_format(place, "section '%s' of %llu bytes, %llu when expanded, can't be at byte %llu",
                  kinds[k].name, static_cast<unsigned long long>(entry.stored),
                  static_cast<unsigned long long>(entry.raw),
                  static_cast<unsigned long long>(entry.offset));
    offset += entry.stored;
    table_.push_back(entry);
  }
  if (offset != end || std::memcmp(content_.data() + end, end_mark, mark_bytes) != 0)
    fail_format({"end", end}, "the mark that ends the file is not where the sections end");
}

// All of them, so that a message tells everything that is damaged.
void CheckpointSource::check_sums() const {
  std::string damaged;
  const SectionEntry* first = nullptr;
  for (size_t k = 0; k < section_count; ++k) {
    const SectionEntry& entry = table_[k];
    const uint32_t sum = checksum(0, content_.data() + entry.offset, entry.stored);
    if (sum == entry.stored_checksum) continue;
    if (!first) first = &entry;
    damaged += std::string(damaged.empty() ? "'" : ", '") + kinds[k].name + "'";
  }
  if (first)
    fail(Status::format,
         "section %s, from byte %llu on: the checksum is wrong: the file is damaged",
         damaged.c_str(), static_cast<unsigned long long>(first->offset));
}

void CheckpointSource::read(Section section, int64_t items, const Unpack& unpack) const {
  const SectionEntry& whole = entry(section);
  const int64_t of_run = items_of_run(section);
  uint64_t at = whole.offset, raw_bytes = 0;
  const uint64_t end = at + whole.stored;
  uint32_t sum = 0;
  std::string raw;
  for (int64_t first = 0; first < items; first += of_run) {
    const FilePlace place{section_name(section), at};
    PackedReader head(content_.data() + at, std::min(run_head_bytes, end - at), place);
    const uint32_t stored = head.u32(), length = head.u32();
    at += run_head_bytes;
    if (stored > end - at || length / most_compressed > stored || length >= longest_run)
      fail_format(place, "a run of %u bytes, %u when expanded, can't stand there", stored, length);
    // A reading that fails doesn't go on: what it had counted is of no interest.
    budget_.take(length, "a run of the checkpoint");
    raw.resize(length);
    decompress(content_.data() + at, stored, place, raw);
    at += stored;
    raw_bytes += length;
    sum = checksum(sum, raw.data(), raw.size());
    PackedReader bytes(raw.data(), raw.size(), place);
    unpack(first, std::min(items, first + of_run), bytes);
    bytes.finish();
    budget_.take(-static_cast<int64_t>(length), "a run of the checkpoint");
  }
  if (at != end || raw_bytes != whole.raw || sum != whole.raw_checksum)
    fail_format({section_name(section), at}, "its runs don't add up to what the table states");
}

}  // namespace hrad
