// Cubes by hashing, pilot rays by packets. Floor 6 (links).
#include "links/light_grid.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/hash.h"
#include "machine/pieces.h"
#include "machine/sharing.h"

namespace hrad {
namespace {

constexpr double coarse_cubes = 4;  // times as large as fine ones
constexpr int coarse_packets = 8, fine_packets = 2;
// A group farther than so many of its radii is one emitter.
constexpr double group_radii = 2.5;
constexpr int32_t none = -1;

const LightGrid::Candidate* find(const std::vector<LightGrid::Candidate>& candidates,
                                 int32_t emitter) {
  const auto found = std::lower_bound(candidates.begin(), candidates.end(), emitter,
                                      [](const LightGrid::Candidate& candidate, int32_t number) {
                                        return candidate.emitter < number;
                                      });
  return found != candidates.end() && found->emitter == emitter ? &*found : nullptr;
}

}  // namespace

LightGrid::LightGrid(const Emitters& emitters, const VisibilityEngine& engine, double size,
                     double most_of_a_group)
    : emitters_(emitters),
      engine_(engine),
      most_of_a_group_(most_of_a_group),
      coarse_{coarse_cubes * size, coarse_packets, {}, {}},
      fine_{size, fine_packets, {}, {}} {}

const std::vector<LightGrid::Candidate>& LightGrid::at(const OrientedPoint& point) const {
  const int32_t number = fine_.number.find(key_of(fine_, point));
  if (number == NumberTable::none)
    fail(Status::internal, "light was asked for in a cube that isn't open");
  return fine_.cubes[static_cast<size_t>(number)].candidates;
}

bool LightGrid::by_links(int32_t emitter, const OrientedPoint& middle,
                         const std::vector<Candidate>& there) const {
  const std::vector<Emitter>& all = emitters_.all();
  for (int32_t k = emitter; k >= 0; k = all[k].group)
    if (find(there, k)) return emitters_.bright(all[k], middle.place, middle.normal);
  // A group of which a neighbouring cube sees the parts: one of them speaks for all.
  return !all[emitter].members.empty() && by_links(all[emitter].members.front(), middle, there);
}

Vec3 LightGrid::corner_of(const Grid& grid, Vec3 place) const {
  const Vec3 at = (place - engine_.center()) * (1 / grid.size);
  return {std::floor(at.x), std::floor(at.y), std::floor(at.z)};
}

uint64_t LightGrid::key_of(const Grid& grid, const OrientedPoint& p) const {
  const double x = std::fabs(p.normal.x), y = std::fabs(p.normal.y), z = std::fabs(p.normal.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  uint64_t key = static_cast<uint64_t>(2 * axis + (p.normal[axis] < 0));
  const Vec3 corner = corner_of(grid, p.place);
  for (double c : {corner.x, corner.y, corner.z})
    key = key << 20 | (static_cast<uint64_t>(static_cast<int64_t>(c)) & 0xfffff);
  return key;
}

GrowingArray<uint64_t> LightGrid::keys_of(const Grid& grid,
                                          const std::vector<OrientedPoint>& points,
                                          ThreadTeam& team) const {
  GrowingArray<uint64_t> keys;
  keys.resize_for_overwrite(points.size());
  for_each_thing(team, keys.size(), [&](size_t k) { keys[k] = key_of(grid, points[k]); });
  return keys;
}

// Points for the pilot rays of a coarse cube, as many from each of its fine ones, so that none is
// judged by what lies about it alone.
std::vector<int32_t> LightGrid::spread_over(const std::vector<int32_t>& fine) const {
  constexpr size_t wanted = 16 * coarse_packets;
  std::vector<int32_t> result;
  for (size_t c = 0; c < fine.size(); ++c) {
    const std::vector<int32_t>& points = fine_.cubes[fine[c]].points;
    const size_t share = (c + 1) * wanted / fine.size() - c * wanted / fine.size();
    for (size_t k = 0; k < share; ++k) result.push_back(points[k * points.size() / share]);
  }
  return result;
}

bool LightGrid::open(const std::vector<OrientedPoint>& points, ThreadTeam& team, Comm& comm,
                     const Opener& opener, int64_t& rays) {
  const size_t first_coarse = coarse_.cubes.size(), first_fine = fine_.cubes.size();
  // Each new cube's first point.
  const auto add_cubes = [&](Grid& grid, const GrowingArray<uint64_t>& keys) {
    const std::vector<uint32_t> first =
        grid.number.add({keys.data(), keys.size()}, static_cast<int32_t>(grid.cubes.size()), team);
    grid.cubes.resize(grid.cubes.size() + first.size());
    return first;
  };
  add_cubes(coarse_, keys_of(coarse_, points, team));
  const GrowingArray<uint64_t> keys = keys_of(fine_, points, team);
  const std::vector<uint32_t> first_point = add_cubes(fine_, keys);
  for_each_thing(team, first_point.size(), [&](size_t k) {
    fine_.cubes[first_fine + k].around =
        coarse_.number.find(key_of(coarse_, points[first_point[k]]));
  });
  // Their points matter where rays leave from them: from the cube itself or from that around it.
  const auto own_around = [&](size_t fine) {
    const size_t coarse = static_cast<size_t>(fine_.cubes[fine].around);
    return coarse >= first_coarse && is_my_turn(comm, coarse - first_coarse);
  };
  struct Inside {
    int32_t cube, point;
  };
  const std::vector<Inside> inside =
      gathered<Inside>(team, points.size(), [&](size_t k, std::vector<Inside>& some) {
        const size_t cube = static_cast<size_t>(fine_.number.find(keys[k]));
        if (cube >= first_fine && (is_my_turn(comm, cube - first_fine) || own_around(cube)))
          some.push_back({static_cast<int32_t>(cube), static_cast<int32_t>(k)});
      });
  for (const Inside& its : inside) fine_.cubes[its.cube].points.push_back(its.point);
  std::vector<std::vector<int32_t>> within(coarse_.cubes.size() - first_coarse);
  for (size_t k = first_fine; k < fine_.cubes.size(); ++k)
    if (own_around(k))
      within[static_cast<size_t>(fine_.cubes[k].around) - first_coarse].push_back(
          static_cast<int32_t>(k));
  for_each_thing(team, within.size(), [&](size_t k) {
    coarse_.cubes[first_coarse + k].points = spread_over(within[k]);
  });
  return open_from(coarse_, first_coarse, points, comm, opener, rays) &&
         open_from(fine_, first_fine, points, comm, opener, rays);
}

// The cubes from the first on. Processes take turns.
bool LightGrid::open_from(Grid& grid, size_t first, const std::vector<OrientedPoint>& points,
                          Comm& comm, const Opener& opener, int64_t& rays) {
  const size_t count = grid.cubes.size() - first;
  std::vector<Opened> own;
  std::vector<size_t> cube_of;
  for (size_t k = 0; k < count; ++k) {
    if (!is_my_turn(comm, k)) continue;
    cube_of.push_back(first + k);
    own.push_back({key_of(grid, points[grid.cubes[first + k].points.front()]), {}, 0});
  }
  const bool going_on = opener(own, [&](size_t k) {
    own[k].rays = find_emitters(points, grid, grid.cubes[cube_of[k]], own[k].candidates);
  });
  if (!comm.all_go_on(going_on)) return false;
  for (size_t k = 0; k < own.size(); ++k) {
    rays += own[k].rays;
    grid.cubes[cube_of[k]].candidates = std::move(own[k].candidates);
  }
  share(
      comm, count, [&](size_t k) { return static_cast<int>(k % static_cast<size_t>(comm.size())); },
      [&](size_t k, Bytes& bytes) { put_list(bytes, grid.cubes[first + k].candidates); },
      [&](size_t k, Taker& taker) { take_list(taker, grid.cubes[first + k].candidates); });
  for (size_t k = 0; k < count; ++k) grid.cubes[first + k].points = std::vector<int32_t>();
  return true;
}

// What a coarse cube knows of an emitter, or of the groups around it or the parts within.
LightGrid::Seen LightGrid::seen_from(const Cube& cube, int32_t emitter) const {
  for (int32_t k = emitter; k >= 0; k = emitters_.all()[k].group)
    if (const Candidate* candidate = find(cube.candidates, k))
      return candidate->hidden ? Seen::hidden : Seen::some;
  Seen most = Seen::none;
  for (int32_t part : emitters_.all()[emitter].parts) {
    const Seen seen = seen_from(cube, part);
    if (seen == Seen::some) return seen;
    if (seen == Seen::hidden) most = seen;
  }
  return most;
}

int64_t LightGrid::find_emitters(const std::vector<OrientedPoint>& points, const Grid& grid,
                                 const Cube& cube, std::vector<Candidate>& candidates) const {
  int64_t rays = 0;
  const Vec3 corner = corner_of(grid, points[cube.points.front()].place);
  const Vec3 center = engine_.center() + (corner + Vec3{0.5, 0.5, 0.5}) * grid.size;
  const double radius = 0.87 * grid.size;  // half the diagonal
  std::vector<int32_t> stack = emitters_.tops();
  while (!stack.empty()) {
    const int32_t number = stack.back();
    stack.pop_back();
    const Emitter& emitter = emitters_.all()[number];
    const double factor = Emitters::largest_factor(emitter, center, radius);
    if (!emitters_.is_sampled(emitter, factor)) continue;
    const std::vector<int32_t>& parts = emitter.parts;
    if (!parts.empty() &&
        (emitter.brightness * factor > most_of_a_group_ ||
         length(emitter.center - center) < group_radii * emitter.radius + radius)) {
      stack.insert(stack.end(), parts.begin(), parts.end());
      continue;
    }
    const Seen around =
        cube.around == none ? Seen::some : seen_from(coarse_.cubes[cube.around], number);
    if (around == Seen::none) continue;
    const int packets = around == Seen::hidden ? coarse_packets : grid.pilot_packets;
    const bool is_hidden = around == Seen::hidden || hidden(emitter, points, cube, packets, rays);
    // So much of it may be visible all the same.
    const double share = 1.0 / (16 * packets);
    if (is_hidden && !emitters_.is_sampled(emitter, factor * share)) continue;
    candidates.push_back({number, is_hidden});
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.emitter < b.emitter; });
  return rays;
}

// There were pilot rays, from points spread over those of the cube, and all were blocked.
bool LightGrid::hidden(const Emitter& emitter, const std::vector<OrientedPoint>& points,
                       const Cube& cube, int packets, int64_t& rays) const {
  bool any = false;
  for (int pass = 0; pass < packets; ++pass) {
    SegmentPacket packet;
    const size_t count = cube.points.size();
    for (size_t k = 0; k < 16; ++k) {
      const size_t turn = 16 * static_cast<size_t>(pass) + k;
      const OrientedPoint& p =
          points[cube.points[count > 16 ? turn * count / (16 * static_cast<size_t>(packets))
                                        : turn % count]];
      const Vec3 from = p.place + p.normal * engine_.offset();
      // Another point of the emitter each time round.
      const Vec3 y = emitter.point((k + 5 * static_cast<size_t>(pass)) % 16);
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
