// A .hrad file taken apart into the plain bytes of its sections and put together again with right
// lengths and checksums: for tests that change what checksums would otherwise protect.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/checkpoint_codec.h"
#include "solver/checkpoint_format.h"
#include "solver/packed_bytes.h"

namespace hrad_test {

constexpr size_t head_bytes = 32, entry_bytes = 40;

struct FrameRun {
  std::string raw;
  // What the file states and holds instead, where that is to be wrong.
  std::string stored;
  uint32_t stated_raw = 0;
};
// Runs of each section.
using Frame = std::vector<std::vector<FrameRun>>;

inline uint64_t little_endian(const std::string& bytes, size_t at, size_t size) {
  uint64_t value = 0;
  for (size_t k = 0; k < size; ++k)
    value |= static_cast<uint64_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
  return value;
}

inline Frame frame_of(const std::string& file) {
  Frame frame(hrad::section_count);
  for (size_t k = 0; k < hrad::section_count; ++k) {
    const size_t entry = head_bytes + k * entry_bytes;
    size_t at = little_endian(file, entry + 8, 8);
    const size_t end = at + little_endian(file, entry + 16, 8);
    while (at < end) {
      const size_t stored = little_endian(file, at, 4), raw = little_endian(file, at + 4, 4);
      FrameRun run;
      run.raw.resize(raw);
      hrad::decompress(file.data() + at + 8, stored, {"test", at}, run.raw);
      frame[k].push_back(run);
      at += 8 + stored;
    }
  }
  return frame;
}

inline std::string file_of(const Frame& frame, uint32_t version = hrad::checkpoint_version) {
  hrad::PackedBytes table, head;
  std::string sections;
  const size_t first = head_bytes + hrad::section_count * entry_bytes;
  for (size_t k = 0; k < hrad::section_count; ++k) {
    const size_t offset = sections.size();
    uint64_t raw_bytes = 0;
    uint32_t raw_sum = 0;
    for (const FrameRun& run : frame[k]) {
      const std::string stored = run.stored.empty() ? hrad::compressed(run.raw) : run.stored;
      const uint64_t raw = run.stored.empty() ? run.raw.size() : run.stated_raw;
      hrad::PackedBytes run_head;
      run_head.u32(static_cast<uint32_t>(stored.size()));
      run_head.u32(static_cast<uint32_t>(raw));
      sections += run_head.bytes() + stored;
      raw_bytes += raw;
      raw_sum = hrad::checksum(raw_sum, run.raw.data(), run.raw.size());
    }
    std::string name = hrad::section_name(static_cast<hrad::Section>(k));
    name.resize(8, '\0');
    table.raw(name);
    table.u64(first + offset);
    table.u64(sections.size() - offset);
    table.u64(raw_bytes);
    table.u32(hrad::checksum(0, sections.data() + offset, sections.size() - offset));
    table.u32(raw_sum);
  }
  head.raw("\x89HRD\r\n\x1a\n");
  head.u32(version);
  head.u32(static_cast<uint32_t>(hrad::section_count));
  head.u64(first + sections.size() + 8);
  head.u32(hrad::checksum(0, table.bytes().data(), table.bytes().size()));
  head.u32(hrad::checksum(0, head.bytes().data(), 28));
  return head.bytes() + table.bytes() + sections + "hradend\n";
}

}  // namespace hrad_test
