// Compressing and checking the runs of a checkpoint: zlib is known here alone. Floor 8 (solver).
#pragma once

#include <cstdint>
#include <string>

#include "solver/packed_bytes.h"

namespace hrad {

// No run is compressed to less than this share of its length: it is filled up with zeros, so that
// what a file can claim to hold is bounded by its own size.
constexpr uint64_t most_compressed = 64;

// CRC-32 (ISO 3309) of bytes that follow those of `before`; 0 at the beginning.
uint32_t checksum(uint32_t before, const char* data, size_t size);
// The same of bytes of which the checksum and the number are known.
uint32_t checksum_joined(uint32_t before, uint32_t checksum, uint64_t size);

// The bytes as a zlib stream, and zeros behind it as said above.
std::string compressed(const std::string& bytes);

// Fills `bytes`, which has the size that the result must have. FORMAT when the stream is damaged,
// holds more or less, or is followed by anything but the zeros that compressed() adds.
void decompress(const char* data, size_t size, const FilePlace& place, std::string& bytes);

}  // namespace hrad
