// Radiosity as light of a screen: an exposure found from what is seen, and a curve that keeps
// proportions but for the brightest parts. CLI: public headers only.
#pragma once

#include <vector>

#include "render/image.h"

namespace hrad::cli {

// What a survey of a picture found, as sums over the bands, W/m2.
struct SeenValues {
  size_t black = 0;              // samples of sides that are black by the meaning of sides
  std::vector<double> lit;       // of patches that don't emit
  std::vector<double> emitting;  // of those that do
};

class ToneMap {
 public:
  // scale: the light of the screen per W/m2 in a band, 1 being its white.
  explicit ToneMap(double scale) : scale_(scale) {}
  // The automatic scale per W/m2 of the sum of the bands: what is brighter than nine tenths of the
  // lit surfaces seen is well below white.
  static double scale_for(SeenValues seen);

  // Three bands are red, green and blue; of any other number the mean is grey.
  Colour operator()(const double* bands, size_t count) const;

 private:
  double scale_;
};

// The value below which this share of the values lies; 0 without values.
double percentile(std::vector<double>* values, double share);

}  // namespace hrad::cli
