// Where the samples of a pixel lie, and a window of the picture whose samples are held at a time.
// CLI: public headers only.
#pragma once

#include <cstddef>
#include <vector>

namespace hrad::cli {

// In pixels, from the upper left corner of one.
struct SamplePlace {
  double x, y;
};

// One in the middle.
inline std::vector<SamplePlace> one_sample() { return {{0.5, 0.5}}; }

// Sixteen after Hammersley: one in each cell of a 4 x 4 grid and one in each of 16 columns and of
// 16 rows, so that edges of any slope get many steps of coverage.
inline std::vector<SamplePlace> sixteen_samples() {
  std::vector<SamplePlace> places;
  for (int k = 0; k < 16; ++k) {
    const int reversed = (k & 1) << 3 | (k & 2) << 1 | (k & 4) >> 1 | (k & 8) >> 3;
    places.push_back({(k + 0.5) / 16, (reversed + 0.5) / 16});
  }
  return places;
}

// Whole rows of the picture.
struct SampleWindow {
  int width, first_row, rows;
  const std::vector<SamplePlace>* places;

  size_t samples() const {
    return static_cast<size_t>(width) * static_cast<size_t>(rows) * places->size();
  }
  // The number in the window of a pixel's first sample.
  size_t first_sample(int column, int row) const {
    return (static_cast<size_t>(row - first_row) * static_cast<size_t>(width) +
            static_cast<size_t>(column)) *
           places->size();
  }
};

}  // namespace hrad::cli
