// What every entry of the C API checks or copies alike: pointers, ranges, sized structs, text
// buffers. Floor 9 (api).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "base/error.h"

namespace hrad {
namespace api {

// ARGUMENT when pointer is NULL; what: its name and what it should be.
void require(const void* pointer, const char* what);

// ARGUMENT when an array of `count` items is NULL although it has any, or when count is negative or
// so large that its values can't be counted.
void require_array(const void* pointer, int64_t count, const char* what);

// ARGUMENT unless first .. first+count-1 lie in 0 .. total-1; noun: "patches".
void require_range(int64_t first, int64_t count, int64_t total, const char* noun);

// ARGUMENT for a negative size, or NULL with a positive one.
void require_text_buffer(const char* text, int64_t size);

// Puts a text into a caller's buffer, cut if need be, by the rules in the head of hrad.h.
void copy_text(const std::string& from, char* text, int64_t size, int64_t* needed);

// ARGUMENT for a struct_size that can't be meant: it counts itself.
void require_struct_size(size_t struct_size, const char* name);

// Gives a caller as much of a struct as its struct_size says it knows, and leaves the size as it
// was.
template <class Struct>
void copy_struct_out(const Struct& from, Struct* to) {
  const size_t size = std::min(to->struct_size, sizeof(Struct));
  const size_t head = offsetof(Struct, struct_size) + sizeof from.struct_size;
  std::memcpy(reinterpret_cast<char*>(to) + head, reinterpret_cast<const char*>(&from) + head,
              size - head);
}

// Takes as much of a caller's struct as its struct_size says is there; the rest is 0. A size that
// no struct has would cut a pointer in two: it counts up to the alignment before it.
template <class Struct>
Struct copy_struct_in(const Struct* from) {
  Struct to = {};
  const size_t whole = from->struct_size / alignof(Struct) * alignof(Struct);
  std::memcpy(&to, from, std::min(whole, sizeof(Struct)));
  return to;
}

}  // namespace api
}  // namespace hrad
