// Which bright emitters there are to be sampled, looked up together for all points of a cube of
// space that face the same way, and which of them pilot rays find hidden from there: few rays do
// for those, or none where what may come after all is little enough to be left to rays from the
// receiver, so that rooms that don't see each other cost each other nothing. Floor 6 (links).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/growing_array.h"
#include "links/emitters.h"
#include "machine/comm.h"
#include "machine/key_numbers.h"
#include "machine/thread_team.h"
#include "visibility/visibility.h"

namespace hrad {

struct OrientedPoint {
  Vec3 place, normal;
};

class LightGrid {
 public:
  // size: of the cubes. most_of_a_group: the light, in units of the mean irradiance, of which
  // sixteen rays tell well enough how much is visible: where a group may bring more it is looked at
  // part by part. All must outlive this.
  LightGrid(const Emitters& emitters, const VisibilityEngine& engine, double size,
            double most_of_a_group);

  const Emitters& emitters() const { return emitters_; }

  struct Candidate {
    int32_t emitter;
    bool hidden;  // no pilot ray met it
  };
  // A cube that is being opened, by a name that tells it from all others of its size.
  struct Opened {
    uint64_t name;
    std::vector<Candidate> candidates;
    int64_t rays = 0;
  };
  // Runs find(k) for so many cubes, or gives them what it has found before; false: stopped.
  using Opener =
      std::function<bool(std::vector<Opened>& cubes, const std::function<void(size_t k)>& find)>;
  // Opens the cubes that these points lie in, if they aren't yet; their pilot rays start at the
  // points, which should be of all surfaces there. Collective: all give the same points, and each
  // traces rays of some cubes. Adds the number of this process's rays. False: stopped, and the
  // grid is of no use any more.
  bool open(const std::vector<OrientedPoint>& points, ThreadTeam& team, Comm& comm,
            const Opener& opener, int64_t& rays);
  // Whether the cube that a point lies in has yet to be opened.
  bool is_closed(const OrientedPoint& point) const {
    return fine_.number.find(key_of(fine_, point)) == NumberTable::none;
  }

  // The emitters that can be worth sampling in an open cube, ascending.
  const std::vector<Candidate>& at(const OrientedPoint& point) const;
  // Whether all that comes from an emitter to an element comes by links of their own, so that rays
  // and links count it once: a matter of the element's middle, which must lie in an open cube.
  // Of a group, the same for all of it. there: at(middle).
  bool by_links(int32_t emitter, const OrientedPoint& middle,
                const std::vector<Candidate>& there) const;

 private:
  struct Cube {
    std::vector<Candidate> candidates;
    // Of those that opened it, where a process traces rays for it or for the cube around it.
    std::vector<int32_t> points;
    int32_t around = -1;  // the cube of the coarser grid that it lies in
  };
  struct Grid {
    double size;
    int pilot_packets;
    KeyNumbers number;
    std::vector<Cube> cubes;
  };
  enum class Seen { none, hidden, some };
  Vec3 corner_of(const Grid& grid, Vec3 place) const;  // in whole cubes from the scene's middle
  uint64_t key_of(const Grid& grid, const OrientedPoint& point) const;
  GrowingArray<uint64_t> keys_of(const Grid& grid, const std::vector<OrientedPoint>& points,
                                 ThreadTeam& team) const;
  std::vector<int32_t> spread_over(const std::vector<int32_t>& fine) const;
  Seen seen_from(const Cube& cube, int32_t emitter) const;
  bool open_from(Grid& grid, size_t first, const std::vector<OrientedPoint>& points, Comm& comm,
                 const Opener& opener, int64_t& rays);
  int64_t find_emitters(const std::vector<OrientedPoint>& points, const Grid& grid,
                        const Cube& cube, std::vector<Candidate>& candidates) const;
  bool hidden(const Emitter& emitter, const std::vector<OrientedPoint>& points, const Cube& cube,
              int packets, int64_t& rays) const;

  const Emitters& emitters_;
  const VisibilityEngine& engine_;
  const double most_of_a_group_;
  // Coarse cubes first say what can be seen from anywhere near: what is hidden from all of one
  // needs no pilot rays from each of the fine ones in it.
  Grid coarse_, fine_;
};

}  // namespace hrad
