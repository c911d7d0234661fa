// Sixteen pairs of points for a link one end of which reaches close to the other: points spread
// evenly over it would miss the near part, which most of the light comes from (design, Section 4:
// descend a near source by the kernel). Floor 6 (links).
#pragma once

#include <cstdint>

#include "links/pair_samples.h"

namespace hrad {

// The larger end comes closer to the smaller than its own size.
bool is_close(const EndsBySize& ends);

// For the given points of the smaller end, a point each of the larger one drawn about in proportion
// to what is seen of it, which replaces the given one. samples.kernel is divided by how much more
// often the point is drawn than evenly, so that means over the pairs are estimates as those of
// draw_pairs are, but steadier ones.
void draw_close_pairs(const Element& receiver, const Element& source, uint64_t key, Vec3 center,
                      double offset, PairPoints& points, PairSamples& samples);

// The kernel's mean over the larger end, mean over the given points of the smaller one: exact, by
// Lambert's formula.
double mean_kernel(const EndsBySize& ends, const PairPoints& points);

// Scales the kernel to have this mean: what is left to chance is the share that is seen.
void scale_kernel(double mean, PairSamples& samples);

}  // namespace hrad
