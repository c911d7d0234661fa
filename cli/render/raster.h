// Which patch, which side of it, and which point every sample of a picture sees. CLI: public
// headers only.
#pragma once

#include <cstdint>
#include <vector>

#include "render/camera.h"
#include "render/footprint.h"
#include "render/geometry.h"
#include "render/samples.h"
#include "render/window_bins.h"

namespace hrad::cli {

// What becomes of sides that are black by the meaning of sides.
enum class Backs {
  black,  // drawn so: they block the view as they block light
  hidden  // those of one-sided patches are left out, so that one sees into a closed room
};

// What the samples of a window see.
struct Visible {
  static constexpr int32_t nothing = -1;
  std::vector<int32_t> patch;         // per sample, or nothing
  std::vector<uint8_t> front;         // per sample: it is the patch's front
  std::vector<double> inverse_depth;  // per sample, 0 for nothing
};

class Raster {
 public:
  // Samples lie at `places`, in windows of `rows` rows.
  Raster(const Geometry& geometry, const Camera& camera, const PictureSize& size, Backs backs,
         std::vector<SamplePlace> places, int rows);

  int windows() const { return bins_.windows(); }
  SampleWindow window(int number) const { return bins_.window(number, places_); }
  void draw(int number, Visible* visible) const;

  const View& view() const { return view_; }
  const PictureSize& size() const { return size_; }
  double near() const { return near_; }
  // The direction of a sample of a window.
  Vector3 direction(const SampleWindow& window, size_t sample) const;

 private:
  std::array<Vector3, 3> pixel_corners(int64_t patch) const;

  const Geometry& geometry_;
  View view_;
  PictureSize size_;
  Backs backs_;
  std::vector<SamplePlace> places_;
  double near_;
  WindowBins bins_;  // of patches
};

// Coordinates (u, v) of hrad_query_points for samples of one patch after another.
class PatchPoints {
 public:
  PatchPoints(const Geometry& geometry, const View& view) : geometry_(geometry), view_(view) {}
  void locate(int64_t patch, const Vector3& direction, double uv[2]);

 private:
  const Geometry& geometry_;
  const View& view_;
  int64_t patch_ = -1;
  std::array<Vector3, 3> edge_;
};

}  // namespace hrad::cli
