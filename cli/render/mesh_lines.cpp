// Edges of leaves (mesh_lines.h). CLI: public headers only.
#include "render/mesh_lines.h"

#include "signals.h"

namespace hrad::cli {
namespace {

constexpr int64_t most_at_once = 65536;

// In pixels to either side of an edge; less in leaves so small that lines would fill them.
constexpr double half_width = 0.45, most_of_height = 0.12;

double half_width_in(const std::array<Vector3, 3>& corners, double near) {
  double x[3], y[3];
  for (size_t k = 0; k < 3; ++k) {
    if (corners[k].z < near) return half_width;
    x[k] = corners[k].x / corners[k].z;
    y[k] = corners[k].y / corners[k].z;
  }
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    longest = std::max(longest, std::hypot(x[(k + 1) % 3] - x[k], y[(k + 1) % 3] - y[k]));
  const double twice_area =
      std::fabs((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]));
  return std::min(half_width, longest > 0 ? most_of_height * twice_area / longest : 0);
}

}  // namespace

MeshLines::MeshLines(Session* session, const Raster& raster, int rows)
    : bins_(raster.size(), rows) {
  int64_t leaves = 0;
  check(hrad_leaf_count(session->solver(), &leaves));
  std::vector<int64_t> patch;
  std::vector<int32_t> side;
  std::vector<double> xyz;
  for (int64_t first = 0; first < leaves; first += most_at_once) {
    const int64_t count = std::min(most_at_once, leaves - first);
    const auto size = static_cast<size_t>(count);
    patch.resize(size);
    side.resize(size);
    xyz.resize(9 * size);
    check(hrad_query_leaves(session->solver(), first, count, patch.data(), nullptr, side.data(),
                            xyz.data(), nullptr, nullptr));
    for (size_t i = 0; i < size; ++i) {
      Leaf leaf;
      for (size_t k = 0; k < 3; ++k) {
        const double* corner = &xyz[9 * i + 3 * k];
        leaf.corners[k] = raster.view().to_pixels({corner[0], corner[1], corner[2]});
      }
      PixelBox box;
      if (!make_pixel_box(leaf.corners, raster.near(), raster.view(), raster.size(), &box))
        continue;
      leaf.patch = patch[i];
      leaf.front = side[i] == HRAD_FRONT;
      bins_.add(static_cast<int64_t>(leaves_.size()), box);
      leaves_.push_back(leaf);
    }
    signals::check();
  }
  bins_.close();
}

void MeshLines::draw(int number, const Raster& raster, const Visible& visible,
                     std::vector<uint8_t>* on_line) const {
  const SampleWindow window = raster.window(number);
  on_line->assign(window.samples(), 0);
  for (const int64_t* item = bins_.begin(number); item != bins_.end(number); ++item) {
    const Leaf& leaf = leaves_[static_cast<size_t>(*item)];
    Footprint footprint;
    PixelBox box;
    // The corners of a leaf run anticlockwise seen from its own side.
    if (!make_footprint(leaf.corners, raster.near(), &footprint) || !footprint.front ||
        !make_pixel_box(leaf.corners, raster.near(), raster.view(), raster.size(), &box))
      continue;
    double reach[3];  // of the line, as a value of each edge function
    const double width = half_width_in(leaf.corners, raster.near());
    for (size_t k = 0; k < 3; ++k)
      reach[k] = width * std::hypot(footprint.edge[k].x, footprint.edge[k].y);
    for_each_sample(footprint, box, raster.view(), window,
                    [&](size_t sample, const Vector3&, const double* edges) {
                      if (visible.patch[sample] == leaf.patch &&
                          (visible.front[sample] != 0) == leaf.front &&
                          (edges[0] < reach[0] || edges[1] < reach[1] || edges[2] < reach[2]))
                        (*on_line)[sample] = 1;
                    });
  }
}

}  // namespace hrad::cli
