// Numbers as colours: the map "viridis", in which equal steps look equally large, to colour-blind
// eyes and in grey print too. CLI: public headers only.
#pragma once

#include <string>
#include <vector>

#include "render/image.h"

namespace hrad::cli {

struct ColourRange {
  double low = 0, high = 1;
};

class FalseColour {
 public:
  explicit FalseColour(const ColourRange& range) : range_(range) {}
  const ColourRange& range() const { return range_; }
  // What lies outside the range gets the colour of its end.
  Colour operator()(double value) const;

 private:
  ColourRange range_;
};

// Round ends around the values, but for a hundredth of them at either end; 0 is one end unless
// there are values on both sides of it.
ColourRange range_for(std::vector<double> values);

// Round numbers from low to high, about as many as `wanted`.
std::vector<double> tick_values(const ColourRange& range, int wanted);

}  // namespace hrad::cli
