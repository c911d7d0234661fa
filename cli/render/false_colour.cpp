// Numbers as colours (false_colour.h). CLI: public headers only.
#include "render/false_colour.h"

#include <iterator>

#include "render/tone_map.h"

namespace hrad::cli {
namespace {

// Ten evenly spaced colours of viridis, sRGB (Smith and van der Walt; in the public domain).
constexpr double table[][3] = {{68, 1, 84},    {72, 40, 120},  {62, 74, 137},  {49, 104, 142},
                               {38, 130, 142}, {31, 158, 137}, {53, 183, 121}, {109, 205, 89},
                               {180, 222, 44}, {253, 231, 37}};

constexpr double left_out = 0.01;  // of the values, at either end

// The smallest round number that is not below the value, which is positive.
double rounded_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (double step : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (value <= step * power * (1 + 1e-9)) return step * power;
  return 10 * power;
}

}  // namespace

Colour FalseColour::operator()(double value) const {
  const double width = range_.high - range_.low;
  const double share = width > 0 ? std::max(0.0, std::min(1.0, (value - range_.low) / width)) : 0;
  constexpr int steps = static_cast<int>(std::size(table)) - 1;
  const double place = share * steps;
  const int below = std::min(static_cast<int>(place), steps - 1);
  double code[3];
  for (int k = 0; k < 3; ++k)
    code[k] = table[below][k] + (place - below) * (table[below + 1][k] - table[below][k]);
  return {srgb_decoded(code[0]), srgb_decoded(code[1]), srgb_decoded(code[2])};
}

ColourRange range_for(std::vector<double> values) {
  const double low = percentile(&values, left_out), high = percentile(&values, 1 - left_out);
  ColourRange range{low < 0 ? -rounded_up(-low) : 0, high > 0 ? rounded_up(high) : 0};
  if (!(range.low < range.high)) range.high = range.low + 1;
  return range;
}

std::vector<double> tick_values(const ColourRange& range, int wanted) {
  const double least = (range.high - range.low) / std::max(1, wanted);
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10 * power;
  for (double candidate : {1.0, 2.0, 2.5, 5.0})
    if (least <= candidate * power * (1 + 1e-9)) {
      step = candidate * power;
      break;
    }
  std::vector<double> ticks;
  const double first = std::ceil(range.low / step - 1e-9), last = range.high / step + 1e-9;
  for (double k = first; k <= last; ++k) ticks.push_back(k * step + 0.0);  // no -0
  return ticks;
}

}  // namespace hrad::cli
