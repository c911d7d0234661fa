// An array that grows and shrinks in place where the system can move its pages, instead of being
// copied from one place to the other: for the largest ones. Floor 1 (base).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace hrad {

// As far as it goes a std::vector of plain values. Throws std::bad_alloc.
template <class T>
class GrowingArray {
  static_assert(std::is_trivially_copyable<T>::value, "bytes are all there is to move");

 public:
  GrowingArray() = default;
  GrowingArray(const GrowingArray& other) { *this = other; }
  GrowingArray(GrowingArray&& other) noexcept { swap(other); }
  GrowingArray& operator=(const GrowingArray& other) {
    if (this == &other) return *this;
    resize_for_overwrite(other.size_);
    std::copy(other.begin(), other.end(), begin());
    return *this;
  }
  GrowingArray& operator=(GrowingArray&& other) noexcept {
    GrowingArray(std::move(other)).swap(*this);
    return *this;
  }
  void swap(GrowingArray& other) noexcept {
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    values_.swap(other.values_);
  }

  size_t size() const { return size_; }
  size_t capacity() const { return capacity_; }
  bool empty() const { return size_ == 0; }
  T* data() { return values_.get(); }
  const T* data() const { return values_.get(); }
  T& operator[](size_t k) { return values_.get()[k]; }
  const T& operator[](size_t k) const { return values_.get()[k]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T& back() { return (*this)[size_ - 1]; }
  const T& back() const { return (*this)[size_ - 1]; }

  void push_back(const T& value) {
    const T copy = value;
    resize_for_overwrite(size_ + 1);
    back() = copy;
  }
  void resize(size_t size) {
    const size_t before = size_;
    resize_for_overwrite(size);
    for (size_t k = before; k < size; ++k) new (data() + k) T();
  }
  // New ones have any value until they are written to.
  void resize_for_overwrite(size_t size) {
    // An eighth more than there was: growing is cheap.
    if (size > capacity_) reserve(std::max(size, capacity_ + capacity_ / 8 + least));
    size_ = size;
  }
  void reserve(size_t capacity) {
    if (capacity > capacity_ && !move_to(capacity)) throw std::bad_alloc();
  }
  // Stays as it is where there is no memory to make it smaller.
  void shrink_to_fit() {
    if (size_ < capacity_) static_cast<void>(move_to(size_));
  }
  bool operator==(const GrowingArray& other) const {
    return std::equal(begin(), end(), other.begin(), other.end());
  }

 private:
  static constexpr size_t least = 16;
  static constexpr size_t most =
      static_cast<size_t>(std::numeric_limits<std::ptrdiff_t>::max()) / sizeof(T);
  struct Free {
    void operator()(T* values) const { std::free(values); }
  };

  // False: there is no memory, and nothing has changed.
  bool move_to(size_t capacity) {
    if (capacity == 0) {
      values_.reset();
    } else {
      if (capacity > most) return false;
      void* moved = std::realloc(static_cast<void*>(values_.get()), capacity * sizeof(T));
      if (!moved) return false;
      static_cast<void>(values_.release());
      values_.reset(static_cast<T*>(moved));
    }
    capacity_ = capacity;
    return true;
  }

  size_t size_ = 0, capacity_ = 0;
  std::unique_ptr<T, Free> values_;
};

// What it takes.
template <class T>
int64_t bytes_in(const GrowingArray<T>& array) {
  return static_cast<int64_t>(array.capacity() * sizeof(T));
}

}  // namespace hrad
