// The checks of arguments and the copies from and to a caller's memory. Floor 9 (api).
#include "api/arguments.h"

#include <limits>

namespace hrad {
namespace api {
namespace {

// Up to 16 bands, nine coordinates, eight bytes: an array of more items has no size in bytes.
constexpr int64_t kMostItems = std::numeric_limits<int64_t>::max() / (16 * 8);

}  // namespace

void require(const void* pointer, const char* what) {
  if (!pointer) fail(Status::argument, "%s is NULL", what);
}

void require_array(const void* pointer, int64_t count, const char* what) {
  if (count < 0 || count > kMostItems)
    fail(Status::argument, "the count is %lld: it must be from 0 to %lld",
         static_cast<long long>(count), static_cast<long long>(kMostItems));
  if (!pointer && count > 0)
    fail(Status::argument, "%s is NULL: give an array for %lld items", what,
         static_cast<long long>(count));
}

void require_range(int64_t first, int64_t count, int64_t total, const char* noun) {
  if (first < 0 || count < 0 || first > total || count > total - first)
    fail(Status::argument, "%lld %s from %lld on: there are %lld, from 0 on",
         static_cast<long long>(count), noun, static_cast<long long>(first),
         static_cast<long long>(total));
}

void require_text_buffer(const char* text, int64_t size) {
  if (size < 0)
    fail(Status::argument, "the size of the text buffer is %lld: it can't be negative",
         static_cast<long long>(size));
  if (!text && size > 0)
    fail(Status::argument, "the text buffer is NULL but its size is %lld: give a buffer or size 0",
         static_cast<long long>(size));
}

void copy_text(const std::string& from, char* text, int64_t size, int64_t* needed) {
  require_text_buffer(text, size);
  const auto whole = static_cast<int64_t>(from.size()) + 1;
  if (size > 0) {
    const auto length = static_cast<size_t>(std::min(whole, size) - 1);
    std::memcpy(text, from.data(), length);
    text[length] = '\0';
  }
  if (needed) *needed = whole;
}

void require_struct_size(size_t struct_size, const char* name) {
  if (struct_size < sizeof(size_t))
    fail(Status::argument, "struct_size of %s is %zu: set it to sizeof(%s) before the call", name,
         struct_size, name);
}

}  // namespace api
}  // namespace hrad
