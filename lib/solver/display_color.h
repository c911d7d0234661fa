// Colours for looking at a solution: radiosity times one exposure, found from the solution itself,
// cut off at white. Own arithmetic alone, so that the bytes are the same on every processor.
// Floor 8 (solver).
#pragma once

#include <array>
#include <cstdint>

namespace hrad {

class Solver;

class DisplayColors {
 public:
  // The exposure makes white of the radiosity that 95 % of the lit area stays below; emitters count
  // only where nothing else is lit.
  explicit DisplayColors(const Solver& solver);

  double exposure() const { return exposure_; }

  // Linear red, green and blue in 0..1 of a radiosity of `bands` values. Three bands are taken as
  // red, green and blue; any other number of bands gives the grey of their mean.
  std::array<double, 3> linear(const double* radiosity) const;

 private:
  int bands_;
  double exposure_ = 1;
};

// The nearest of the 256 sRGB values (IEC 61966-2-1) of a linear value in 0..1.
uint8_t srgb_byte(double linear);

}  // namespace hrad
