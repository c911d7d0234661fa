// Cubes by hashing, pilot rays by packets. Floor 6 (links).
#include "links/light_grid.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"

namespace hrad {
namespace {

constexpr int pilot_packets = 2;

}  // namespace

Vec3 LightGrid::corner_of(Vec3 place) const {
  const Vec3 at = (place - engine_.center()) * (1 / size_);
  return {std::floor(at.x), std::floor(at.y), std::floor(at.z)};
}

uint64_t LightGrid::key_of(const OrientedPoint& p) const {
  const double x = std::fabs(p.normal.x), y = std::fabs(p.normal.y), z = std::fabs(p.normal.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  uint64_t key = static_cast<uint64_t>(2 * axis + (p.normal[axis] < 0));
  const Vec3 corner = corner_of(p.place);
  for (double c : {corner.x, corner.y, corner.z})
    key = key << 20 | (static_cast<uint64_t>(static_cast<int64_t>(c)) & 0xfffff);
  return key;
}

int64_t LightGrid::open(const std::vector<OrientedPoint>& points, ThreadTeam& team) {
  const size_t before = cubes_.size();
  for (size_t k = 0; k < points.size(); ++k) {
    const auto found =
        number_.emplace(key_of(points[k]), static_cast<int32_t>(cubes_.size())).first;
    if (static_cast<size_t>(found->second) == cubes_.size()) cubes_.emplace_back();
    if (static_cast<size_t>(found->second) >= before)
      cubes_[found->second].points.push_back(static_cast<int32_t>(k));
  }
  std::vector<int64_t> rays(cubes_.size() - before, 0);
  team.for_each(static_cast<int64_t>(rays.size()), [&](int64_t k, int) {
    rays[k] = find_emitters(points, cubes_[before + static_cast<size_t>(k)]);
  });
  int64_t all = 0;
  for (int64_t r : rays) all += r;
  return all;
}

int64_t LightGrid::find_emitters(const std::vector<OrientedPoint>& points, Cube& cube) const {
  int64_t rays = 0;
  const Vec3 corner = corner_of(points[cube.points.front()].place);
  const Vec3 center = engine_.center() + (corner + Vec3{0.5, 0.5, 0.5}) * size_;
  const double radius = 0.87 * size_;  // half the diagonal
  for (size_t e = 0; e < emitters_.all().size(); ++e) {
    const Emitter& emitter = emitters_.all()[e];
    if (emitters_.can_be_sampled(emitter, center, radius))
      cube.candidates.push_back({static_cast<int32_t>(e), hidden(emitter, points, cube, rays)});
  }
  cube.points = std::vector<int32_t>();
  return rays;
}

// There were pilot rays, from points spread over those of the cube, and all were blocked.
bool LightGrid::hidden(const Emitter& emitter, const std::vector<OrientedPoint>& points,
                       const Cube& cube, int64_t& rays) const {
  bool any = false;
  for (int pass = 0; pass < pilot_packets; ++pass) {
    SegmentPacket packet;
    const size_t count = cube.points.size();
    for (size_t k = 0; k < 16; ++k) {
      const size_t turn = 16 * static_cast<size_t>(pass) + k;
      const OrientedPoint& p =
          points[cube.points[count > 16 ? turn * count / (16 * pilot_packets) : turn % count]];
      const Vec3 from = p.place + p.normal * engine_.offset();
      // Another point of the emitter each time round.
      const Vec3 y = emitter.point[(k + 5 * static_cast<size_t>(pass)) % 16];
      packet.set(static_cast<int>(k), from - engine_.center(),
                 y + emitter.normal * engine_.offset() - engine_.center());
      const Vec3 d = y - p.place;
      if (dot(d, p.normal) > 0 && dot(d, emitter.normal) < 0) packet.active |= 1u << k;
    }
    rays += __builtin_popcount(packet.active);
    any = any || packet.active;
    if (packet.active & ~engine_.blocked(packet)) return false;
  }
  return any;
}

}  // namespace hrad
