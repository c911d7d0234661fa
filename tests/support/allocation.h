// Every allocation of the program goes through the test that includes this, once in a program: by
// operator new, and by realloc() in what is linked with --wrap (CMakeLists.txt).
#pragma once

#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <new>

extern "C" void* __real_realloc(void* block, size_t size);
extern "C" void __real_free(void* block);

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
  __real_free(block);
}

// Blocks that came from realloc(), which free() and realloc() take back.
class Reallocated {
 public:
  void add(void* block) { exchange(nullptr, block); }
  // Whether it was one of them.
  bool drop(void* block) { return block && exchange(block, nullptr); }

 private:
  bool exchange(void* before, void* after) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (void*& slot : slots_)
      if (slot == before) {
        slot = after;
        return true;
      }
    if (!before) std::abort();  // more than there are slots
    return false;
  }

  std::mutex mutex_;
  void* slots_[1024] = {};
};
inline Reallocated& reallocated() {
  static Reallocated all;
  return all;
}

inline void* allocate_or_throw(size_t size, size_t alignment) {
  void* block = may_allocate() ? allocate(size, alignment) : nullptr;
  if (!block) throw std::bad_alloc();
  return block;
}

constexpr size_t usual_alignment = alignof(std::max_align_t);

}  // namespace hrad_test

extern "C" void* __wrap_realloc(void* block, size_t size) {
  using namespace hrad_test;
  if (!may_allocate()) return nullptr;
  if (reallocated().drop(block)) note_given_back(block);
  void* moved = __real_realloc(block, size);
  if (!moved) std::abort();  // no test asks for so much
  reallocated().add(moved);
  note_allocated(moved);
  return moved;
}
extern "C" void __wrap_free(void* block) {
  if (hrad_test::reallocated().drop(block)) hrad_test::note_given_back(block);
  __real_free(block);
}

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
