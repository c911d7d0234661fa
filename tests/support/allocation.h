// Every allocation of the program goes through the test that includes this, once in a program.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace hrad_test {

// Of the test. Any thread.
bool may_allocate();  // false: this one fails
void note_allocated(void* block);
void note_given_back(void* block);

inline void* allocate(size_t size, size_t alignment) {
  // aligned_alloc wants a multiple of the alignment.
  void* block = std::aligned_alloc(alignment, (size + alignment) / alignment * alignment);
  if (block) note_allocated(block);
  return block;
}

inline void give_back(void* block) {
  if (!block) return;
  note_given_back(block);
  std::free(block);
}

inline void* allocate_or_throw(size_t size, size_t alignment) {
  void* block = may_allocate() ? allocate(size, alignment) : nullptr;
  if (!block) throw std::bad_alloc();
  return block;
}

constexpr size_t usual_alignment = alignof(std::max_align_t);

}  // namespace hrad_test

void* operator new(size_t size) {
  return hrad_test::allocate_or_throw(size, hrad_test::usual_alignment);
}
void* operator new[](size_t size) {
  return hrad_test::allocate_or_throw(size, hrad_test::usual_alignment);
}
void* operator new(size_t size, std::align_val_t a) {
  return hrad_test::allocate_or_throw(size, static_cast<size_t>(a));
}
void* operator new[](size_t size, std::align_val_t a) {
  return hrad_test::allocate_or_throw(size, static_cast<size_t>(a));
}
// Who asks like this can do without: sorting, for one.
void* operator new(size_t size, const std::nothrow_t&) noexcept {
  return hrad_test::allocate(size, hrad_test::usual_alignment);
}
void* operator new[](size_t size, const std::nothrow_t&) noexcept {
  return hrad_test::allocate(size, hrad_test::usual_alignment);
}
void operator delete(void* block) noexcept { hrad_test::give_back(block); }
void operator delete[](void* block) noexcept { hrad_test::give_back(block); }
void operator delete(void* block, size_t) noexcept { hrad_test::give_back(block); }
void operator delete[](void* block, size_t) noexcept { hrad_test::give_back(block); }
void operator delete(void* block, std::align_val_t) noexcept { hrad_test::give_back(block); }
void operator delete[](void* block, std::align_val_t) noexcept { hrad_test::give_back(block); }
void operator delete(void* block, size_t, std::align_val_t) noexcept {
  hrad_test::give_back(block);
}
void operator delete[](void* block, size_t, std::align_val_t) noexcept {
  hrad_test::give_back(block);
}
