// A depth buffer over the samples of a window (raster.h). CLI: public headers only.
#include "render/raster.h"

namespace hrad::cli {
namespace {

// Of surfaces at the same place the first wins, and one that shows something wins over black.
constexpr double same_place = 1e-9, behind_others = 1e-6;

constexpr double near_share = 1e-6;  // of the scene's diagonal

}  // namespace

Raster::Raster(const Geometry& geometry, const Camera& camera, const PictureSize& size, Backs backs,
               std::vector<SamplePlace> places, int rows)
    : geometry_(geometry),
      view_(camera, size),
      size_(size),
      backs_(backs),
      places_(std::move(places)),
      near_(near_share * geometry.diagonal()),
      bins_(size, rows) {
  for (int64_t patch = 0; patch < geometry.patches(); ++patch) {
    PixelBox box;
    if (!geometry.has(patch, Geometry::dropped) &&
        make_pixel_box(pixel_corners(patch), near_, view_, size_, &box))
      bins_.add(patch, box);
  }
  bins_.close();
}

std::array<Vector3, 3> Raster::pixel_corners(int64_t patch) const {
  const auto& corners = geometry_.corners[static_cast<size_t>(patch)];
  return {view_.to_pixels(corners[0]), view_.to_pixels(corners[1]), view_.to_pixels(corners[2])};
}

void Raster::draw(int number, Visible* visible) const {
  const SampleWindow samples = window(number);
  visible->patch.assign(samples.samples(), Visible::nothing);
  visible->front.assign(samples.samples(), 0);
  visible->inverse_depth.assign(samples.samples(), 0);
  for (const int64_t* item = bins_.begin(number); item != bins_.end(number); ++item) {
    const int64_t patch = *item;
    const auto corners = pixel_corners(patch);
    Footprint footprint;
    PixelBox box;
    if (!make_footprint(corners, near_, &footprint) ||
        !make_pixel_box(corners, near_, view_, size_, &box))
      continue;
    const bool black = geometry_.is_black(patch, footprint.front);
    if (black && backs_ == Backs::hidden && !geometry_.has(patch, Geometry::blocker)) continue;
    const double nearness = black ? 1 - behind_others : 1;
    for_each_sample(footprint, box, view_, samples,
                    [&](size_t sample, const Vector3& direction, const double*) {
                      const double exact = dot(direction, footprint.inverse_depth);
                      const double inverse_depth =
                          nearness *
                          std::max(footprint.farthest, std::min(footprint.nearest, exact));
                      if (exact * near_ > 1 ||
                          inverse_depth <= visible->inverse_depth[sample] * (1 + same_place))
                        return;
                      visible->inverse_depth[sample] = inverse_depth;
                      visible->patch[sample] = static_cast<int32_t>(patch);
                      visible->front[sample] = footprint.front;
                    });
  }
}

Vector3 Raster::direction(const SampleWindow& window, size_t sample) const {
  const size_t pixel = sample / places_.size();
  const SamplePlace& place = places_[sample % places_.size()];
  const auto width = static_cast<size_t>(window.width);
  const size_t row = pixel / width;
  return view_.direction(static_cast<double>(pixel % width) + place.x,
                         static_cast<double>(row) + window.first_row + place.y);
}

void PatchPoints::locate(int64_t patch, const Vector3& direction, double uv[2]) {
  if (patch != patch_) {
    patch_ = patch;
    std::array<Vector3, 3> corner;
    for (size_t k = 0; k < 3; ++k)
      corner[k] = view_.to_pixels(geometry_.corners[static_cast<size_t>(patch)][k]);
    for (size_t k = 0; k < 3; ++k) edge_[k] = cross(corner[(k + 1) % 3], corner[(k + 2) % 3]);
  }
  // Shares of the corners: all of one sign, but for rounding.
  double share[3];
  for (size_t k = 0; k < 3; ++k) share[k] = std::fabs(dot(direction, edge_[k]));
  const double sum = share[0] + share[1] + share[2];
  uv[0] = sum > 0 ? share[1] / sum : 0;
  uv[1] = sum > 0 ? share[2] / sum : 0;
}

}  // namespace hrad::cli
