// A picture of 8-bit sRGB pixels, and colours in linear light. CLI: public headers only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hrad::cli {

// Linear light, 0 black to 1 white of the screen.
struct Colour {
  double red = 0, green = 0, blue = 0;
};

inline Colour mix(const Colour& a, const Colour& b, double share_of_b) {
  const double share_of_a = 1 - share_of_b;
  return {share_of_a * a.red + share_of_b * b.red, share_of_a * a.green + share_of_b * b.green,
          share_of_a * a.blue + share_of_b * b.blue};
}

inline double luminance(const Colour& c) {
  return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
}

inline double srgb_decoded(double code) {  // 0 to 255
  const double s = code / 255;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

inline uint8_t srgb_encoded(double linear) {
  const double c = std::max(0.0, std::min(1.0, linear));
  const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<uint8_t>(std::lround(255 * s));
}

inline Colour grey(double code) {
  const double value = srgb_decoded(code);
  return {value, value, value};
}

struct Image {
  int width, height;
  std::vector<uint8_t> rgb;  // three bytes a pixel, rows from the top

  Image(int w, int h)
      : width(w), height(h), rgb(3 * static_cast<size_t>(w) * static_cast<size_t>(h)) {}

  // What lies outside is left out.
  void set(int column, int row, const Colour& colour) {
    if (column < 0 || row < 0 || column >= width || row >= height) return;
    uint8_t* pixel = &rgb[3 * (static_cast<size_t>(row) * static_cast<size_t>(width) +
                               static_cast<size_t>(column))];
    pixel[0] = srgb_encoded(colour.red);
    pixel[1] = srgb_encoded(colour.green);
    pixel[2] = srgb_encoded(colour.blue);
  }
  void fill(int left, int top, int past_right, int past_bottom, const Colour& colour) {
    for (int row = top; row < past_bottom; ++row)
      for (int column = left; column < past_right; ++column) set(column, row, colour);
  }
};

}  // namespace hrad::cli
