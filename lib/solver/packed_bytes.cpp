// Packing and strict unpacking. Floor 8 (solver).
#include "solver/packed_bytes.h"

#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "base/error.h"

namespace hrad {
namespace {

template <class Value>
void put_planes(std::string& bytes, const std::vector<Value>& values) {
  for (int shift = 8 * static_cast<int>(sizeof(Value)) - 8; shift >= 0; shift -= 8)
    for (Value value : values) bytes.push_back(static_cast<char>(value >> shift & 255));
}

}  // namespace

uint32_t bits_of(float value) {
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

uint64_t bits_of(double value) {
  uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

float float_of(uint32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

double double_of(uint64_t bits) {
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

void PackedBytes::u32(uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) byte(static_cast<uint8_t>(value >> shift));
}

void PackedBytes::u64(uint64_t value) {
  for (int shift = 0; shift < 64; shift += 8) byte(static_cast<uint8_t>(value >> shift));
}

void PackedBytes::varint(uint64_t value) {
  for (; value >= 128; value >>= 7) byte(static_cast<uint8_t>(128 | (value & 127)));
  byte(static_cast<uint8_t>(value));
}

void PackedBytes::text(const std::string& text) {
  varint(text.size());
  bytes_ += text;
}

void PackedBytes::planes(const std::vector<uint32_t>& values) { put_planes(bytes_, values); }
void PackedBytes::planes(const std::vector<uint64_t>& values) { put_planes(bytes_, values); }

void fail_format(const FilePlace& place, const char* text, ...) {
  char what[512];
  va_list arguments;
  va_start(arguments, text);
  std::vsnprintf(what, sizeof what, text, arguments);
  va_end(arguments);
  fail(Status::format, "section '%s', byte %llu: %s", place.section,
       static_cast<unsigned long long>(place.offset), what);
}

void PackedReader::need(size_t bytes) const {
  if (left() < bytes)
    fail_format(place_, "it ends %zu bytes too early: the file is damaged", bytes - left());
}

uint8_t PackedReader::byte() {
  need(1);
  return static_cast<uint8_t>(*next_++);
}

uint32_t PackedReader::u32() {
  need(4);
  uint32_t value = 0;
  for (int shift = 0; shift < 32; shift += 8) value |= static_cast<uint32_t>(byte()) << shift;
  return value;
}

uint64_t PackedReader::u64() {
  need(8);
  uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 8) value |= static_cast<uint64_t>(byte()) << shift;
  return value;
}

uint64_t PackedReader::varint() {
  uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const uint8_t next = byte();
    const uint64_t bits = next & 127u;
    if ((shift == 63 && bits > 1) || (shift > 0 && next == 0)) break;
    value |= bits << shift;
    if (next < 128) return value;
  }
  fail_format(place_, "a number is written in more bytes than it may take: the file is damaged");
}

int64_t PackedReader::count(const char* what, int64_t lowest, int64_t highest) {
  const uint64_t value = varint();
  if (value > static_cast<uint64_t>(INT64_MAX) || static_cast<int64_t>(value) < lowest ||
      static_cast<int64_t>(value) > highest)
    fail_format(place_, "%s is %llu: it must be from %lld to %lld", what,
                static_cast<unsigned long long>(value), static_cast<long long>(lowest),
                static_cast<long long>(highest));
  return static_cast<int64_t>(value);
}

int64_t PackedReader::moved(int64_t before, const char* what, int64_t lowest, int64_t highest) {
  const int64_t value = hrad::moved(before, signed_varint());
  if (value < lowest || value > highest)
    fail_format(place_, "%s is %lld: it must be from %lld to %lld", what,
                static_cast<long long>(value), static_cast<long long>(lowest),
                static_cast<long long>(highest));
  return value;
}

bool PackedReader::flag(const char* what) {
  const uint8_t value = byte();
  if (value > 1) fail_format(place_, "%s is %d: it must be 0 or 1", what, value);
  return value == 1;
}

double PackedReader::finite(const char* what, double lowest, double highest) {
  const double value = number();
  if (!(value >= lowest && value <= highest))
    fail_format(place_, "%s is %g: it must be from %g to %g", what, value, lowest, highest);
  return value;
}

std::string PackedReader::text(size_t longest) {
  return raw(static_cast<size_t>(count("the length of a text", 0, static_cast<int64_t>(longest))));
}

std::string PackedReader::raw(size_t count) {
  need(count);
  std::string result(next_, count);
  next_ += count;
  return result;
}

template <class Value>
void PackedReader::read_planes(size_t count, std::vector<Value>& values) {
  if (left() / sizeof(Value) < count) need(count * sizeof(Value));
  values.assign(count, 0);
  for (size_t plane = 0; plane < sizeof(Value); ++plane)
    for (Value& value : values)
      value = static_cast<Value>(value << 8 | static_cast<unsigned char>(*next_++));
}

void PackedReader::planes(size_t count, std::vector<uint32_t>& values) {
  read_planes(count, values);
}
void PackedReader::planes(size_t count, std::vector<uint64_t>& values) {
  read_planes(count, values);
}

void PackedReader::finish() const {
  if (left() > 0)
    fail_format(place_, "%zu bytes are left over at its end: the file is damaged", left());
}

}  // namespace hrad
