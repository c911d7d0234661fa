// Direct light at the corners of elements: which corners are asked for, their numbers, and their
// light once it has been sampled, all new ones of a step at once. Floor 7 (stages).
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "hierarchy/lattice.h"
#include "links/direct_light.h"
#include "stages/state.h"

namespace hrad {

class CornerSampler {
 public:
  // All must outlive this. Empties state.direct.
  CornerSampler(State& state, const StageTools& tools, const DirectLight& light, LightGrid& grid,
                const Brightness& brightness, uint64_t seed);

  // Asks for the light at a corner; asking twice is the same as once.
  void want(int32_t surface, LatticePoint point);
  // Samples what was asked for since the last time; false: stopped.
  bool sample();
  // Of a corner that was asked for.
  int32_t number(int32_t surface, LatticePoint point) const;
  // Of a sampled corner: its light in units of the scene's mean irradiance, negative when it is
  // sealed.
  double value(int32_t number) const { return value_[number]; }
  double value(int32_t surface, LatticePoint point) const { return value_[number(surface, point)]; }

  // A corner of an element's own: an exposed point within it. -1 when none was found.
  int32_t add_within(NodeId element);

 private:
  struct Corner {
    int32_t surface;
    LatticePoint point;
  };
  Vec3 place_of(const Corner& corner) const;

  State& state_;
  const StageTools& tools_;
  const Brightness& brightness_;
  LightGrid& grid_;
  const DirectLight& light_;
  const uint64_t seed_;
  std::unordered_map<uint64_t, int32_t> number_;  // looked up only, never walked through
  std::vector<Corner> wanted_;
  std::vector<double> value_;
  double reached_ = 0;  // share of all sampling that is done, guessed
};

// Takes out the corners that no leaf names: those that only showed that nothing need be divided.
void drop_unnamed_corners(CornerLight& direct);

}  // namespace hrad
