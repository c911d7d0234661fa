// Corners against planes, one surface against many. Floor 7 (stages).
#include "stages/facing_table.h"

namespace hrad {

FacingTable::FacingTable(const std::vector<Element>& roots, Vec3 center, double margin)
    : margin_(static_cast<float>(margin)) {
  for (const Element& e : roots) {
    const Vec3 points[3] = {e.corners.a - center, e.corners.b - center, e.corners.c - center};
    for (int k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        corner_[k][axis].push_back(static_cast<float>(points[k][axis]));
    for (int axis = 0; axis < 3; ++axis)
      normal_[axis].push_back(static_cast<float>(e.normal[axis]));
    distance_.push_back(static_cast<float>(dot(e.normal, e.centroid - center)));
  }
}

void FacingTable::find(size_t p, size_t first, size_t count, uint8_t* faces) const {
  if (count == 0) return;  // and `first` may lie behind the last
  const float nx = normal_[0][p], ny = normal_[1][p], nz = normal_[2][p];
  const float limit = distance_[p] + margin_;
  float px[3], py[3], pz[3];
  for (int k = 0; k < 3; ++k) {
    px[k] = corner_[k][0][p];
    py[k] = corner_[k][1][p];
    pz[k] = corner_[k][2][p];
  }
  const float *ax = &corner_[0][0][first], *ay = &corner_[0][1][first], *az = &corner_[0][2][first];
  const float *bx = &corner_[1][0][first], *by = &corner_[1][1][first], *bz = &corner_[1][2][first];
  const float *cx = &corner_[2][0][first], *cy = &corner_[2][1][first], *cz = &corner_[2][2][first];
  const float *mx = &normal_[0][first], *my = &normal_[1][first], *mz = &normal_[2][first];
  const float* d = &distance_[first];
  for (size_t q = 0; q < count; ++q) {
    const float a = ax[q] * nx + ay[q] * ny + az[q] * nz;
    const float b = bx[q] * nx + by[q] * ny + bz[q] * nz;
    const float c = cx[q] * nx + cy[q] * ny + cz[q] * nz;
    const float e = px[0] * mx[q] + py[0] * my[q] + pz[0] * mz[q];
    const float f = px[1] * mx[q] + py[1] * my[q] + pz[1] * mz[q];
    const float g = px[2] * mx[q] + py[2] * my[q] + pz[2] * mz[q];
    const float own = d[q] + margin_;
    faces[q] = static_cast<uint8_t>(((a > limit) | (b > limit) | (c > limit)) &
                                    ((e > own) | (f > own) | (g > own)));
  }
}

}  // namespace hrad
