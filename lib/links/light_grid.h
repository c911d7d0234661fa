// Which bright emitters there are to be sampled, looked up together for all points of a cube of
// space that face the same way, and which of them pilot rays find hidden from there: few rays do
// for those, or none where what may come after all is little enough to be left to rays from the
// receiver, so that rooms that don't see each other cost each other nothing. Floor 6 (links).
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "links/emitters.h"
#include "machine/thread_team.h"
#include "visibility/visibility.h"

namespace hrad {

struct OrientedPoint {
  Vec3 place, normal;
};

class LightGrid {
 public:
  // size: of the cubes. All must outlive this.
  LightGrid(const Emitters& emitters, const VisibilityEngine& engine, double size);

  const Emitters& emitters() const { return emitters_; }

  // Opens the cubes that these points lie in; their pilot rays start at the points. Returns the
  // number of rays.
  int64_t open(const std::vector<OrientedPoint>& points, ThreadTeam& team);

  struct Candidate {
    int32_t emitter;
    bool hidden;  // no pilot ray met it
  };
  // The emitters that can be worth sampling in an open cube, ascending.
  const std::vector<Candidate>& at(const OrientedPoint& point) const;
  // Whether all that comes from an emitter to an element comes by links of their own, so that rays
  // and links count it once: a matter of the element's middle, which must lie in an open cube.
  bool by_links(int32_t emitter, const OrientedPoint& middle) const;

 private:
  struct Cube {
    std::vector<Candidate> candidates;
    std::vector<int32_t> points;  // of those that opened it
    int32_t around = -1;          // the cube of the coarser grid that it lies in
  };
  struct Grid {
    double size;
    int pilot_packets;
    std::unordered_map<uint64_t, int32_t> number;  // looked up only
    std::vector<Cube> cubes;
  };
  Vec3 corner_of(const Grid& grid, Vec3 place) const;  // in whole cubes from the scene's middle
  uint64_t key_of(const Grid& grid, const OrientedPoint& point) const;
  size_t add_cubes(Grid& grid, const std::vector<OrientedPoint>& points) const;
  int64_t find_emitters(const std::vector<OrientedPoint>& points, const Grid& grid,
                        Cube& cube) const;
  bool hidden(const Emitter& emitter, const std::vector<OrientedPoint>& points, const Cube& cube,
              int packets, int64_t& rays) const;

  const Emitters& emitters_;
  const VisibilityEngine& engine_;
  // Coarse cubes first say what can be seen from anywhere near: what is hidden from all of one
  // needs no pilot rays from each of the fine ones in it.
  Grid coarse_, fine_;
};

}  // namespace hrad
