// Values as bytes of a checkpoint and back: every number byte by byte, the lowest first, so that no
// processor's memory layout gets into a file. The layout is described in hrad-checkpoint(5).
// Floor 8 (solver).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hrad {

// Small differences of either sign as small numbers: 0, -1, 1, -2, ... are 0, 1, 2, 3, ...
inline uint64_t zigzag(int64_t value) {
  return (static_cast<uint64_t>(value) << 1) ^ static_cast<uint64_t>(value >> 63);
}
inline int64_t from_zigzag(uint64_t code) {
  return static_cast<int64_t>(code >> 1) ^ -static_cast<int64_t>(code & 1);
}
inline uint32_t zigzag32(uint32_t difference) {
  return (difference << 1) ^ (difference & 0x80000000u ? 0xffffffffu : 0u);
}
inline uint32_t from_zigzag32(uint32_t code) { return (code >> 1) ^ (code & 1 ? 0xffffffffu : 0u); }
// A sum of whatever a file says: as unsigned numbers, which may overflow.
inline int64_t moved(int64_t before, int64_t difference) {
  return static_cast<int64_t>(static_cast<uint64_t>(before) + static_cast<uint64_t>(difference));
}

uint32_t bits_of(float value);
uint64_t bits_of(double value);
float float_of(uint32_t bits);
double double_of(uint64_t bits);

class PackedBytes {
 public:
  const std::string& bytes() const { return bytes_; }
  void byte(uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
  void u32(uint32_t value);
  void u64(uint64_t value);
  void number(double value) { u64(bits_of(value)); }
  // Seven bits a byte, the lowest first; the upper bit says that more follow.
  void varint(uint64_t value);
  void signed_varint(int64_t value) { varint(zigzag(value)); }
  void text(const std::string& text);
  void raw(const std::string& bytes) { bytes_ += bytes; }
  // The upper bytes of all, then the bytes below, down to the lowest: neighbours are alike there.
  void planes(const std::vector<uint32_t>& values);
  void planes(const std::vector<uint64_t>& values);

 private:
  std::string bytes_;
};

// Where bytes of a file stand, for messages.
struct FilePlace {
  const char* section;
  uint64_t offset;
};

// FORMAT: what stands there is not what should.
[[noreturn]] void fail_format(const FilePlace& place, const char* format, ...)
    __attribute__((format(printf, 2, 3)));

// Reads what PackedBytes wrote. FORMAT where it ends early or is not as it would have been written.
class PackedReader {
 public:
  PackedReader(const char* data, size_t size, FilePlace place)
      : next_(data), end_(data + size), place_(place) {}

  const FilePlace& place() const { return place_; }
  size_t left() const { return static_cast<size_t>(end_ - next_); }
  uint8_t byte();
  uint32_t u32();
  uint64_t u64();
  double number() { return double_of(u64()); }
  uint64_t varint();
  // A varint that must be within these bounds, both included; what: "the number of links".
  int64_t count(const char* what, int64_t lowest, int64_t highest);
  int64_t signed_varint() { return from_zigzag(varint()); }
  // `before` and a signed difference, within these bounds.
  int64_t moved(int64_t before, const char* what, int64_t lowest, int64_t highest);
  bool flag(const char* what);
  double finite(const char* what, double lowest, double highest);
  std::string text(size_t longest);
  std::string raw(size_t count);
  void planes(size_t count, std::vector<uint32_t>& values);
  void planes(size_t count, std::vector<uint64_t>& values);
  void finish() const;  // FORMAT when bytes are left

 private:
  void need(size_t bytes) const;
  template <class Value>
  void read_planes(size_t count, std::vector<Value>& values);

  const char *next_, *end_;
  FilePlace place_;
};

}  // namespace hrad
