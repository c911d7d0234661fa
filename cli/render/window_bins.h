// Which things may be seen in which window of rows of a picture. CLI: public headers only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/footprint.h"

namespace hrad::cli {

class WindowBins {
 public:
  WindowBins(const PictureSize& size, int rows)
      : size_(size),
        rows_(rows),
        first_(static_cast<size_t>((size.height + rows - 1) / rows) + 1) {}

  int windows() const { return static_cast<int>(first_.size()) - 1; }
  SampleWindow window(int number, const std::vector<SamplePlace>& places) const {
    const int first_row = number * rows_;
    return {size_.width, first_row, std::min(rows_, size_.height - first_row), &places};
  }

  void add(int64_t item, const PixelBox& box) {
    spans_.push_back({item, box.first_row / rows_, (box.past_row - 1) / rows_});
  }
  // After the last item: the lists can be asked for, each in the order of adding.
  void close() {
    for (const Span& span : spans_)
      for (int w = span.first; w <= span.last; ++w) ++first_[static_cast<size_t>(w) + 1];
    for (size_t w = 1; w < first_.size(); ++w) first_[w] += first_[w - 1];
    items_.resize(first_.back());
    std::vector<size_t> next(first_.begin(), first_.end() - 1);
    for (const Span& span : spans_)
      for (int w = span.first; w <= span.last; ++w)
        items_[next[static_cast<size_t>(w)]++] = span.item;
    spans_ = {};
  }
  const int64_t* begin(int window) const {
    return items_.data() + first_[static_cast<size_t>(window)];
  }
  const int64_t* end(int window) const {
    return items_.data() + first_[static_cast<size_t>(window) + 1];
  }

 private:
  struct Span {
    int64_t item;
    int first, last;  // windows
  };
  PictureSize size_;
  int rows_;
  std::vector<Span> spans_;
  std::vector<size_t> first_;
  std::vector<int64_t> items_;
};

}  // namespace hrad::cli
