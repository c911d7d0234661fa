// Sampling corners. Floor 7 (stages).
#include "stages/corner_light.h"

#include <algorithm>

#include "base/error.h"
#include "links/element.h"
#include "links/pair_samples.h"

namespace hrad {
namespace {

constexpr int64_t corners_of_a_task = 64;
// Corners are moved into their patch by this share of the way to its middle, so that none lies in
// the plane of a wall, and by so many ray offsets at the most.
constexpr double inwards = 1e-3;
constexpr double most_offsets = 50;
constexpr int tries_for_an_exposed_point = 64;
constexpr double sealed = -1;

uint64_t key_of_corner(int32_t surface, LatticePoint p) {
  return static_cast<uint64_t>(surface) << 32 | static_cast<uint64_t>(p.i) << 16 |
         static_cast<uint64_t>(p.j);
}

uint32_t run_border(size_t links) {
  if (links > 0xffffffffu)
    fail(Status::memory,
         "more than 4,294,967,295 links from bright emitters: use a larger accuracy");
  return static_cast<uint32_t>(links);
}

}  // namespace

CornerSampler::CornerSampler(State& state, const StageTools& tools, const DirectLight& light,
                             LightGrid& grid, const Brightness& brightness, uint64_t seed)
    : state_(state),
      tools_(tools),
      brightness_(brightness),
      grid_(grid),
      light_(light),
      seed_(seed) {
  state_.direct = CornerLight{};
  state_.direct.first.push_back(0);
}

void CornerSampler::want(int32_t surface, LatticePoint point) {
  const int32_t next = static_cast<int32_t>(value_.size() + wanted_.size());
  if (number_.emplace(key_of_corner(surface, point), next).second)
    wanted_.push_back({surface, point});
}

int32_t CornerSampler::number(int32_t surface, LatticePoint point) const {
  return number_.at(key_of_corner(surface, point));
}

Vec3 CornerSampler::place_of(const Corner& corner) const {
  const Triangle t = state_.forest.root_triangle(corner.surface);
  const Vec3 on = t.at(static_cast<double>(corner.point.i) / lattice_size,
                       static_cast<double>(corner.point.j) / lattice_size);
  const Vec3 way = t.centroid() - on;
  const double distance = length(way);
  if (!(distance > 0)) return on;
  return on + way * std::min(inwards, most_offsets * tools_.engine.offset() / distance);
}

bool CornerSampler::sample() {
  struct Result {
    std::vector<Link> links;
    std::vector<size_t> end;  // of each corner's links
    std::vector<double> value;
    int64_t rays = 0;
  };
  std::vector<OrientedPoint> points;
  for (const Corner& corner : wanted_)
    points.push_back({place_of(corner), state_.forest.surfaces[corner.surface].normal});
  state_.rays += grid_.open(points, tools_.team);
  const int64_t count = static_cast<int64_t>(wanted_.size());
  const int64_t tasks = (count + corners_of_a_task - 1) / corners_of_a_task;
  std::vector<Result> results(static_cast<size_t>(tasks));
  const bool going_on = tools_.team.for_each(
      tasks,
      [&](int64_t task, int) {
        Result& r = results[task];
        const int64_t last = std::min(count, (task + 1) * corners_of_a_task);
        for (int64_t k = task * corners_of_a_task; k < last; ++k) {
          const Corner& corner = wanted_[k];
          const Surface& surface = state_.forest.surfaces[corner.surface];
          double value = sealed;
          if (!tools_.exposure.can_be_sealed(surface.patch, surface.side) ||
              !tools_.exposure.sealed(surface.patch, surface.side, points[k].place)) {
            const size_t before = r.links.size();
            r.rays += light_.sample(
                points[k],
                mix(key_of_corner(surface.patch * 2 + surface.side, corner.point), seed_), r.links);
            value = 0;
            for (size_t l = before; l < r.links.size(); ++l)
              value +=
                  static_cast<double>(r.links[l].weight) * brightness_.of_node[r.links[l].source];
          }
          r.value.push_back(value);
          r.end.push_back(r.links.size());
        }
      },
      [&](int64_t done) {
        // How many steps there will be isn't known: each is taken for half of what is left.
        return tools_.progress(reached_ + (1 - reached_) / 2 * static_cast<double>(done) /
                                              static_cast<double>(tasks));
      });
  if (!going_on) return false;
  reached_ += (1 - reached_) / 2;
  CornerLight& direct = state_.direct;
  for (const Result& r : results) {
    const size_t before = direct.links.size();
    direct.links.insert(direct.links.end(), r.links.begin(), r.links.end());
    for (size_t end : r.end) direct.first.push_back(run_border(before + end));
    value_.insert(value_.end(), r.value.begin(), r.value.end());
    state_.rays += r.rays;
  }
  for (const OrientedPoint& point : points) direct.place.push_back(point.place);
  wanted_.clear();
  return true;
}

int32_t CornerSampler::add_within(NodeId id) {
  const Node& node = state_.forest.nodes[id];
  const Surface& surface = state_.forest.surfaces[node.surface];
  const Triangle corners = state_.forest.triangle(node);
  const uint64_t key = mix(key_of(state_.forest, node), seed_, 0x77697468u);
  CornerLight& direct = state_.direct;
  for (int k = 0; k < tries_for_an_exposed_point; ++k) {
    double uv[2];
    spread_point(mix(key, static_cast<uint64_t>(k / 16)), k % 16, uv);
    const Vec3 place = corners.at(uv[0], uv[1]);
    if (tools_.exposure.sealed(surface.patch, surface.side, place)) continue;
    const OrientedPoint point{place, surface.normal};
    state_.rays += grid_.open({point}, tools_.team) + light_.sample(point, key, direct.links);
    direct.first.push_back(run_border(direct.links.size()));
    direct.place.push_back(place);
    value_.push_back(0);
    return static_cast<int32_t>(value_.size()) - 1;
  }
  return -1;
}

void drop_unnamed_corners(CornerLight& direct) {
  constexpr int32_t unnamed = -1, named = -2;
  std::vector<int32_t> number(direct.corner_count(), unnamed);
  for (const auto& corners : direct.of_leaf)
    for (int32_t corner : corners)
      if (corner >= 0) number[corner] = named;
  size_t kept = 0, links = 0;
  for (size_t k = 0; k < number.size(); ++k) {
    if (number[k] == unnamed) continue;
    const uint32_t begin = direct.first[k], end = direct.first[k + 1];
    std::copy(direct.links.begin() + begin, direct.links.begin() + end,
              direct.links.begin() + static_cast<std::ptrdiff_t>(links));
    direct.first[kept] = static_cast<uint32_t>(links);
    links += end - begin;
    number[k] = static_cast<int32_t>(kept++);
  }
  direct.first[kept] = static_cast<uint32_t>(links);
  direct.first.resize(kept + 1);
  direct.links.resize(links);
  direct.first.shrink_to_fit();
  direct.links.shrink_to_fit();
  for (auto& corners : direct.of_leaf)
    for (int32_t& corner : corners)
      if (corner >= 0) corner = number[corner];
}

}  // namespace hrad
