// Sixteen pairs of points for a link one end of which reaches close to the other: points spread
// evenly over it would miss the near part, which most of the light comes from (design, Section 4:
// descend a near source by the kernel). Floor 6 (links).
#pragma once

#include <cstdint>

#include "links/pair_samples.h"

namespace hrad {

// True where the larger of the two comes closer to the smaller than its own size.
bool is_close(const Element& receiver, const Element& source);

// For the given points of the smaller end, a point each of the larger end drawn about in proportion to
// what is seen of it, which replaces the given one. samples.kernel is divided by how much more often
// the point is drawn than evenly, so that means over the pairs are estimates as those of draw_pairs
// are, but steadier ones.
void draw_close_pairs(const Element& receiver, const Element& source, uint64_t key, Vec3 center,
                      double offset, PairPoints& points, PairSamples& samples);

}  // namespace hrad
