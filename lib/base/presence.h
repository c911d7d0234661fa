// Which of many things have something, a bit for each, so that what they have can lie side by side
// without gaps. Floor 1 (base).
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace hrad {

class Presence {
 public:
  static constexpr size_t of_a_word = 64;

  Presence() = default;
  // words: of so many things, a bit for each, the lowest first; those beyond are 0.
  Presence(size_t size, std::vector<uint64_t> words) : size_(size), bits_(std::move(words)) {
    before_.reserve(bits_.size());
    uint32_t sum = 0;
    for (uint64_t word : bits_) {
      before_.push_back(sum);
      sum += static_cast<uint32_t>(ones(word));
    }
  }

  size_t size() const { return size_; }
  // How many have something.
  size_t count() const { return bits_.empty() ? 0 : before_.back() + ones(bits_.back()); }
  bool operator[](size_t k) const { return bits_[k / of_a_word] >> k % of_a_word & 1; }
  // How many before k have something: the place of what k has.
  size_t place(size_t k) const {
    return before_[k / of_a_word] + ones(bits_[k / of_a_word] & (bit(k) - 1));
  }
  // body(k) for each that has something, in order.
  template <class Body>
  void for_each(const Body& body) const {
    for (size_t word = 0; word < bits_.size(); ++word)
      for (uint64_t left = bits_[word]; left != 0; left &= left - 1)
        body(word * of_a_word + static_cast<size_t>(__builtin_ctzll(left)));
  }
  int64_t bytes() const {
    return static_cast<int64_t>(bits_.capacity() * sizeof bits_[0] +
                                before_.capacity() * sizeof before_[0]);
  }

  void push_back(bool has) {
    resize(size_ + 1);
    if (has) bits_.back() |= bit(size_ - 1);
  }
  // Those behind the present ones have nothing.
  void resize(size_t size) {
    const size_t words = (size + of_a_word - 1) / of_a_word;
    before_.resize(words, static_cast<uint32_t>(count()));
    bits_.resize(words, 0);
    if (size < size_ && size % of_a_word != 0) bits_.back() &= bit(size) - 1;
    size_ = size;
  }
  void shrink_to_fit() {
    bits_.shrink_to_fit();
    before_.shrink_to_fit();
  }

 private:
  static uint64_t bit(size_t k) { return uint64_t{1} << k % of_a_word; }
  static size_t ones(uint64_t word) { return static_cast<size_t>(__builtin_popcountll(word)); }

  size_t size_ = 0;
  std::vector<uint64_t> bits_;
  std::vector<uint32_t> before_;  // per word
};

}  // namespace hrad
