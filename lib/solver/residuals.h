// What measured patches tell of the error of a solution. Floor 8 (solver).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace hrad {

// A patch as it was measured once, in two independent halves: solved less measured radiosity.
struct Residual {
  int64_t rays = 0;
  double difference[most_bands] = {};  // per band, of both halves together
  double squares = 0;                  // of the halves' differences, over all bands
  double solved = 0;                   // radiosity squared, over all bands
  double solved_sum = 0;               // radiosity
};

struct DrawnPatch {
  size_t number;  // that tells it from others
  double worth;   // one over the chance that it was drawn with
};

// RMS over the area, relative.
struct MeasuredError {
  double error = -1;  // negative: there is no light to measure
  double standard_error = 0;
};

// The error of which so many patches have shown so much; some may have been drawn many times, by
// even steps through all. returned: the share of the light leaving surfaces that is reflected.
MeasuredError error_of(const std::vector<DrawnPatch>& drawn, const std::vector<Residual>& residuals,
                       double returned);

}  // namespace hrad
