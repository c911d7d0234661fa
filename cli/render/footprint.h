// A triangle as the picture sees it: edge functions and depth over directions, after Olano and
// Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates" (1997): no clipping, and a
// sample lies in the triangle exactly when its ray meets it. CLI: public headers only.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "render/camera.h"
#include "render/samples.h"

namespace hrad::cli {

struct Footprint {
  std::array<Vector3, 3> edge;  // a direction d meets the triangle when all dot(d, edge[k]) >= 0
  Vector3 inverse_depth;        // dot(d, inverse_depth) is 1/depth where it meets the plane
  double nearest, farthest;     // 1/depth of the corners, what rounding must not leave
  bool front;                   // it shows its front
};

// Corners in the pixels' space of a View. False for a triangle seen edge on, or all of it nearer
// than `near`.
bool make_footprint(const std::array<Vector3, 3>& corners, double near, Footprint* footprint);

// The columns and rows of pixels that may hold parts of the triangle ahead of `near`: first and
// past the last. False when there are none.
struct PixelBox {
  int first_column, past_column, first_row, past_row;
};
bool make_pixel_box(const std::array<Vector3, 3>& corners, double near, const View& view,
                    const PictureSize& size, PixelBox* box);

// Calls visit(sample, direction, edges) for every sample of the window inside the footprint, where
// sample is its number in the window and edges the three values dot(direction, edge[k]).
template <typename Visit>
void for_each_sample(const Footprint& footprint, const PixelBox& box, const View& view,
                     const SampleWindow& window, const Visit& visit) {
  const auto& edge = footprint.edge;
  const int first_row = std::max(box.first_row, window.first_row);
  const int past_row = std::min(box.past_row, window.first_row + window.rows);
  double slack[3];
  for (int k = 0; k < 3; ++k) slack[k] = 0.5 * (std::fabs(edge[k].x) + std::fabs(edge[k].y));
  for (int row = first_row; row < past_row; ++row) {
    for (int column = box.first_column; column < box.past_column; ++column) {
      const Vector3 middle = view.direction(column + 0.5, row + 0.5);
      const double at[3] = {dot(middle, edge[0]), dot(middle, edge[1]), dot(middle, edge[2])};
      if (at[0] < -slack[0] || at[1] < -slack[1] || at[2] < -slack[2]) {
        // Leave the row behind the triangle, jump to where it begins.
        bool past = false;
        for (int k = 0; k < 3; ++k) past = past || (at[k] < -slack[k] && edge[k].x <= 0);
        if (past) break;
        double jump = 1;
        for (int k = 0; k < 3; ++k)
          if (at[k] < -slack[k]) jump = std::max(jump, std::floor((-slack[k] - at[k]) / edge[k].x));
        column += static_cast<int>(std::min(jump, static_cast<double>(box.past_column))) - 1;
        continue;
      }
      size_t sample = window.first_sample(column, row);
      for (const SamplePlace& place : *window.places) {
        const Vector3 d = view.direction(column + place.x, row + place.y);
        const double edges[3] = {dot(d, edge[0]), dot(d, edge[1]), dot(d, edge[2])};
        if (edges[0] >= 0 && edges[1] >= 0 && edges[2] >= 0) visit(sample, d, edges);
        ++sample;
      }
    }
  }
}

}  // namespace hrad::cli
