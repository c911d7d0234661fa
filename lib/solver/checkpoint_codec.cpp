// The one file that calls zlib. Floor 8 (solver).
#include "solver/checkpoint_codec.h"

#include <zlib.h>

#include <algorithm>
#include <new>

#include "base/error.h"

namespace hrad {
namespace {

// Bytes that are left to compress are mostly mantissas, which no effort makes smaller.
constexpr int level = 3;

struct Inflater {
  z_stream stream{};
  Inflater() {
    if (::inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { ::inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

size_t least_size(size_t raw) {
  return static_cast<size_t>((raw + most_compressed - 1) / most_compressed);
}

}  // namespace

uint32_t checksum(uint32_t before, const char* data, size_t size) {
  return static_cast<uint32_t>(::crc32_z(before, reinterpret_cast<const Bytef*>(data), size));
}

uint32_t checksum_joined(uint32_t before, uint32_t checksum, uint64_t size) {
  return static_cast<uint32_t>(::crc32_combine(before, checksum, static_cast<z_off_t>(size)));
}

std::string compressed(const std::string& bytes) {
  uLongf size = ::compressBound(static_cast<uLong>(bytes.size()));
  std::string result(static_cast<size_t>(size), '\0');
  const int status = ::compress2(reinterpret_cast<Bytef*>(&result[0]), &size,
                                 reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), level);
  if (status == Z_MEM_ERROR) throw std::bad_alloc();
  if (status != Z_OK) fail(Status::internal, "zlib can't compress: status %d", status);
  result.resize(static_cast<size_t>(size));
  result.resize(std::max(result.size(), least_size(bytes.size())), '\0');
  return result;
}

void decompress(const char* data, size_t size, const FilePlace& place, std::string& bytes) {
  Inflater inflater;
  z_stream& stream = inflater.stream;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data));
  stream.avail_in = static_cast<uInt>(size);
  stream.next_out = reinterpret_cast<Bytef*>(&bytes[0]);
  stream.avail_out = static_cast<uInt>(bytes.size());
  const int status = ::inflate(&stream, Z_FINISH);
  if (status == Z_MEM_ERROR) throw std::bad_alloc();
  if (status != Z_STREAM_END || stream.avail_out != 0)
    fail_format(place, "its compressed data doesn't give the %zu bytes that are stated (zlib %d)",
                bytes.size(), status);
  const size_t used = size - stream.avail_in;
  const bool filled_up = std::all_of(data + used, data + size, [](char c) { return c == 0; }) &&
                         size == std::max(used, least_size(bytes.size()));
  if (!filled_up) fail_format(place, "its compressed data ends with what doesn't belong to it");
}

}  // namespace hrad
