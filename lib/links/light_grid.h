// Which bright emitters there are to be sampled, looked up together for all points of a cube of
// space that face the same way, and which of them pilot rays find hidden from there: few rays do
// for those, so that rooms that don't see each other cost each other little. Floor 6 (links).
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
  LightGrid(const Emitters& emitters, const VisibilityEngine& engine, double size)
      : emitters_(emitters), engine_(engine), size_(size) {}

  // Opens the cubes that these points lie in; their pilot rays start at the points. Returns the
  // number of rays.
  int64_t open(const std::vector<OrientedPoint>& points, ThreadTeam& team);

  struct Candidate {
    int32_t emitter;
    bool hidden;  // no pilot ray met it
  };
  // The emitters that can be worth sampling in an open cube.
  const std::vector<Candidate>& at(const OrientedPoint& point) const {
    return cubes_[number_.at(key_of(point))].candidates;
  }

 private:
  struct Cube {
    std::vector<Candidate> candidates;
    std::vector<int32_t> points;  // of those that opened it
  };
  Vec3 corner_of(Vec3 place) const;  // of its cube, in whole cubes from the middle of the scene
  uint64_t key_of(const OrientedPoint& point) const;
  int64_t find_emitters(const std::vector<OrientedPoint>& points, Cube& cube) const;
  bool hidden(const Emitter& emitter, const std::vector<OrientedPoint>& points, const Cube& cube,
              int64_t& rays) const;

  const Emitters& emitters_;
  const VisibilityEngine& engine_;
  const double size_;
  std::unordered_map<uint64_t, int32_t> number_;  // looked up only
  std::vector<Cube> cubes_;
};

}  // namespace hrad
