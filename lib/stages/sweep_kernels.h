// The inner loops of an iteration, compiled for several instruction sets with the same bits: sums
// of weight times radiosity over runs of links, and push and pull below a root. Floor 7 (stages).
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/span.h"
#include "hierarchy/forest.h"
#include "links/link.h"
#include "stages/light_places.h"

namespace hrad {

// The values of a node are taken so many at a time.
constexpr int most_lanes = 4;

// Links `first` up to `end` of some, which arrive at a place of light.
struct GatherRun {
  uint32_t first, end, receiver;
};
// Of so many links, whose sources are places of light, too, some runs.
struct LinkRuns {
  Span<const Link> links;
  Span<const GatherRun> runs;
};
// For two to four bands. sources: bands values per place, and most_lanes more that don't count.
// Adds to the bands values of each receiver in `out` a sum in double precision, in the order of the
// run.
using GatherRuns = void (*)(const LinkRuns& runs, const float* sources, int bands, float* out);

// The trees of some surfaces.
struct PushPullRoots {
  const NodeArray* nodes;
  const Surface* surfaces;
  const NodeId* roots;
  size_t count;  // of roots
  int bands;
  const double *emission, *reflectance;  // of all patches, bands values each
  const LightPlaces* places;
  float *irradiance, *radiosity;  // likewise, by place; that of clusters is pushed, too
};
// E and rho being the same all over a patch, B = E + rho H holds for means too: irradiance alone is
// pulled. Returns in `sums`, bands values per root, the leaves' irradiance times exposed share, as
// the mean over the root's area.
using PushPull = void (*)(const PushPullRoots& all, double* sums);

struct SweepKernels {
  GatherRuns gather;
  PushPull push_pull;
};

// Those that this processor can run, the widest first.
Span<const SweepKernels* const> sweep_kernels();

extern const SweepKernels sweep_kernels_sse2, sweep_kernels_avx2;

}  // namespace hrad
