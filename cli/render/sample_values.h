// The values of what the samples of a picture see, from the solver. CLI: public headers only.
#pragma once

#include <cstdint>
#include <vector>

#include "render/raster.h"
#include "session.h"

namespace hrad::cli {

class SampleValues {
 public:
  SampleValues(Session* session, const Geometry& geometry, int32_t quantity);
  size_t bands() const { return bands_; }

  // Asks for a whole window. Black sides and the background have no values.
  void fetch(const Raster& raster, const SampleWindow& window, const Visible& visible);
  // The bands of a sample, NULL where it has none.
  const double* at(size_t sample) const {
    return place_[sample] < 0 ? nullptr : &values_[static_cast<size_t>(place_[sample])];
  }

 private:
  Session* session_;
  const Geometry& geometry_;
  int32_t quantity_;
  size_t bands_;
  std::vector<int64_t> place_;  // per sample: where its values begin, -1 without
  std::vector<double> values_, uv_, weight_, answer_;
  std::vector<int64_t> patch_;
};

}  // namespace hrad::cli
