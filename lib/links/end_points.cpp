// Finding exposed points, and pairing them. Floor 6 (links).
#include "links/end_points.h"

#include <algorithm>

#include "base/angle.h"
#include "base/hash.h"

namespace hrad {
namespace {

// As often as it takes where a hundredth is exposed.
constexpr uint64_t most_draws = 400;

}  // namespace

void PointPlacer::place(const Element& end, uint64_t key, EndPoints& points) const {
  const PairPoints& pattern = pattern_of(key);
  const ClusterTree& tree = forest.clusters;
  Triangle corners = end.corners;
  Vec3 normal = end.normal;
  int32_t surface = end.surface;
  bool may_be_sealed = end.exposed < 1;
  if (!end.cluster && !may_be_sealed) {
    place_at(end, pattern.receiver_u, pattern.receiver_v, points);
    return;
  }
  for (int k = 0; k < 16; ++k) {
    double u = pattern.receiver_u[k], v = pattern.receiver_v[k];
    const uint64_t h = mix(key, static_cast<uint64_t>(k));
    if (end.cluster) {
      const double* before = &tree.area_before[static_cast<size_t>(end.cluster->first)];
      const double wanted = before[0] + (k + unit_interval(h)) / 16 * end.area;
      const double* found = std::upper_bound(before + 1, before + end.cluster->count, wanted);
      surface = tree.order[static_cast<size_t>(found - tree.area_before.data()) - 1];
      corners = forest.root_triangle(surface);
      normal = forest.surfaces[static_cast<size_t>(surface)].normal;
      may_be_sealed = forest.nodes[static_cast<size_t>(surface)].exposed < 1;
      // Anywhere on it: no sixteenth of the cluster has a sixteenth of its surfaces for its own.
      u = unit_interval(mix(h, 1));
      v = unit_interval(mix(h, 2));
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
    }
    if (may_be_sealed) {
      const Surface& s = forest.surfaces[static_cast<size_t>(surface)];
      for (uint64_t draw = 0; draw < most_draws; ++draw) {
        if (!exposure.sealed(s.patch, s.side, corners.at(u, v))) break;
        const uint64_t again = mix(h, draw);
        double uv[2];
        spread_point(again, static_cast<int>(mix(again) % 16), uv);
        u = uv[0];
        v = uv[1];
      }
    }
    const Vec3 p = corners.at(u, v) - center + normal * offset;
    points.x[k] = static_cast<float>(p.x);
    points.y[k] = static_cast<float>(p.y);
    points.z[k] = static_cast<float>(p.z);
    points.nx[k] = static_cast<float>(normal.x);
    points.ny[k] = static_cast<float>(normal.y);
    points.nz[k] = static_cast<float>(normal.z);
  }
}

void PointPlacer::place_at(const Element& element, const float u[16], const float v[16],
                           EndPoints& points) const {
  const Triangle& t = element.corners;
  const Vec3 a = t.a - center + element.normal * offset, ab = t.b - t.a, ac = t.c - t.a;
  const auto f = [](double x) { return static_cast<float>(x); };
  const float base[3] = {f(a.x), f(a.y), f(a.z)}, du[3] = {f(ab.x), f(ab.y), f(ab.z)},
              dv[3] = {f(ac.x), f(ac.y), f(ac.z)};
  const float n[3] = {f(element.normal.x), f(element.normal.y), f(element.normal.z)};
  for (int k = 0; k < 16; ++k) {
    points.x[k] = base[0] + u[k] * du[0] + v[k] * dv[0];
    points.y[k] = base[1] + u[k] * du[1] + v[k] * dv[1];
    points.z[k] = base[2] + u[k] * du[2] + v[k] * dv[2];
    points.nx[k] = n[0];
    points.ny[k] = n[1];
    points.nz[k] = n[2];
  }
}

void pair_up(const EndPoints& r, const EndPoints& s, const int8_t of_source[16],
             PairSamples& samples) {
  SegmentPacket& packet = samples.packet;
  packet.active = all_pairs;
  for (int k = 0; k < 16; ++k) {
    const int other = static_cast<uint8_t>(of_source[k]);
    const float dx = s.x[other] - r.x[k], dy = s.y[other] - r.y[k], dz = s.z[other] - r.z[k];
    packet.ox[k] = r.x[k];
    packet.oy[k] = r.y[k];
    packet.oz[k] = r.z[k];
    packet.dx[k] = dx;
    packet.dy[k] = dy;
    packet.dz[k] = dz;
    float at_receiver = dx * r.nx[k] + dy * r.ny[k] + dz * r.nz[k];
    float at_source = -(dx * s.nx[other] + dy * s.ny[other] + dz * s.nz[other]);
    at_receiver = at_receiver > 0 ? at_receiver : 0;
    at_source = at_source > 0 ? at_source : 0;
    const float d2 = dx * dx + dy * dy + dz * dz;
    samples.kernel[k] = kernel_of(at_receiver, at_source, d2);
  }
}

EndPointsTable::EndPointsTable(const PointPlacer& placer, ThreadTeam& team) {
  const Forest& forest = placer.forest;
  const size_t count = forest.nodes.size();
  number_.assign(count, -1);
  std::vector<NodeId> wanted;
  for (size_t k = 0; k < count; ++k) {
    const Node& node = forest.nodes[k];
    if (!(node.exposed > 0) || (node.exposed >= 1 && !Forest::is_cluster(node))) continue;
    number_[k] = static_cast<int32_t>(wanted.size());
    wanted.push_back(static_cast<NodeId>(k));
  }
  points_.resize(wanted.size());
  team.for_each(static_cast<int64_t>(wanted.size()), [&](int64_t k, int) {
    const Node& node = forest.nodes[static_cast<size_t>(wanted[static_cast<size_t>(k)])];
    placer.place(element_of(forest, node), key_of(forest, node), points_[static_cast<size_t>(k)]);
  });
}

}  // namespace hrad
