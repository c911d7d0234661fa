// The points at which an end of a link, element or cluster, is sampled where a rough estimate will
// do: sixteen on its exposed part, always the same, so that they are found once for many links.
// Floor 6 (links).
#pragma once

#include <cstdint>
#include <vector>

#include "links/element.h"
#include "links/pair_samples.h"
#include "machine/thread_team.h"
#include "visibility/exposure.h"

namespace hrad {

// Point k lies in sixteenth k of the end's exposed area. Relative to the center, moved off the
// surfaces.
struct EndPoints {
  float x[16], y[16], z[16], nx[16], ny[16], nz[16];
};

struct PointPlacer {
  const Forest& forest;
  const Exposure& exposure;
  Vec3 center;  // VisibilityEngine's
  double offset;
  void place(const Element& end, uint64_t key, EndPoints& points) const;
  // At given points of an element, exposed or not.
  void place_at(const Element& element, const float u[16], const float v[16],
                EndPoints& points) const;
};

// Sixteen pairs of points, that of the source given for each of the receiver's, and the kernel
// between them.
void pair_up(const EndPoints& receiver, const EndPoints& source, const int8_t of_source[16],
             PairSamples& samples);

// The points of those ends for which they are costly to find: clusters, and partly sealed elements.
class EndPointsTable {
 public:
  EndPointsTable(const PointPlacer& placer, ThreadTeam& team);
  // nullptr: not in the table.
  const EndPoints* of(NodeId id) const {
    const size_t at = static_cast<size_t>(id);
    return at < number_.size() && number_[at] >= 0 ? &points_[static_cast<size_t>(number_[at])]
                                                   : nullptr;
  }
  int64_t bytes() const {
    return static_cast<int64_t>(number_.size() * sizeof(int32_t) +
                                points_.size() * sizeof(EndPoints));
  }

 private:
  std::vector<int32_t> number_;  // per node
  std::vector<EndPoints> points_;
};

}  // namespace hrad
