// Values from the solver (sample_values.h). CLI: public headers only.
#include "render/sample_values.h"

#include <algorithm>

namespace hrad::cli {
namespace {

// Neighbouring samples of a pixel that see the same patch: one point stands for them, the middle of
// theirs. Values are linear in all but the leaves that end between them.
constexpr size_t most_together = 4;

}  // namespace

SampleValues::SampleValues(Session* session, const Geometry& geometry, int32_t quantity)
    : session_(session),
      geometry_(geometry),
      quantity_(quantity),
      bands_(static_cast<size_t>(session->bands())) {}

void SampleValues::fetch(const Raster& raster, const SampleWindow& window, const Visible& visible) {
  place_.assign(visible.patch.size(), -1);
  values_.clear();
  PatchPoints points(geometry_, raster.view());
  const size_t run = std::min<size_t>(most_together, window.places->size());
  for (int32_t side : {HRAD_FRONT, HRAD_BACK}) {
    patch_.clear();
    uv_.clear();
    weight_.clear();
    for (size_t sample = 0; sample < visible.patch.size(); ++sample) {
      const int32_t patch = visible.patch[sample];
      const bool front = visible.front[sample] != 0;
      if (patch == Visible::nothing || front != (side == HRAD_FRONT) ||
          geometry_.is_black(patch, front))
        continue;
      // A point of the same patch asked for in the same part of the pixel moves to the middle.
      size_t point = patch_.size();
      for (size_t k = sample - sample % run; k < sample && point == patch_.size(); ++k)
        if (visible.patch[k] == patch && (visible.front[k] != 0) == front)
          point = (static_cast<size_t>(place_[k]) - values_.size()) / bands_;
      if (point == patch_.size()) {
        patch_.push_back(patch);
        uv_.insert(uv_.end(), 2, 0.0);
        weight_.push_back(0);
      }
      place_[sample] = static_cast<int64_t>(values_.size() + point * bands_);
      double uv[2];
      points.locate(patch, raster.direction(window, sample), uv);
      weight_[point] += 1;
      for (size_t k = 0; k < 2; ++k)
        uv_[2 * point + k] += (uv[k] - uv_[2 * point + k]) / weight_[point];
    }
    if (patch_.empty()) continue;
    answer_.resize(patch_.size() * bands_);
    check(hrad_query_points(session_->solver(), quantity_, side,
                            static_cast<int64_t>(patch_.size()), patch_.data(), uv_.data(),
                            answer_.data()));
    values_.insert(values_.end(), answer_.begin(), answer_.end());
  }
}

}  // namespace hrad::cli
