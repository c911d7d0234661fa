// Light as sections of a checkpoint and back: radiosity and irradiance of all nodes, and the points
// at which leaves know their direct light. Floor 8 (solver).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "solver/packed_bytes.h"
#include "stages/light_of_all.h"
#include "stages/state.h"

namespace hrad {

void pack_light(const State& state, const LightOfAll& radiosity, const LightOfAll& irradiance,
                int64_t first, int64_t end, PackedBytes& bytes);

// Light is kept as differences from what is expected by that of other nodes: all differences are
// read, then added up.
class LightReader {
 public:
  explicit LightReader(State& state) : state_(state) {}
  void unpack(PackedReader& bytes, int64_t first, int64_t end);
  void finish(const FilePlace& place);

 private:
  State& state_;
  std::vector<uint32_t> irradiance_, radiosity_;
};

// CornerLight::of_leaf of nodes first .. end-1.
using PointsOf = std::function<LeafPoints::Numbers(int64_t node)>;
void pack_points(const Forest& forest, int64_t first, int64_t end, const PointsOf& points_of,
                 PackedBytes& bytes);
void unpack_points(PackedReader& bytes, int64_t first, int64_t end, State& state);

// The points that belong to one leaf alone, ascending, three of each leaf that has some.
struct OwnPoint {
  int32_t number;
  LeafPoints::Place place;
};
using OwnPointAt = std::function<OwnPoint(int64_t k)>;
void pack_own_points(int64_t first, int64_t end, const OwnPointAt& point_at, PackedBytes& bytes);
void unpack_own_points(PackedReader& bytes, int64_t first, int64_t end, CornerLight& direct);
// FORMAT unless points belong to one surface each, and those of one leaf to no other.
void check_points(const State& state, const FilePlace& place);

}  // namespace hrad
