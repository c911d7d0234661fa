// The sums of weight times radiosity over runs of links, the inner loop of gathering, compiled for
// several instruction sets with the same bits. Floor 7 (stages).
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/span.h"
#include "links/link.h"

namespace hrad {

// A source is read four values at a time, the last one beyond its own.
constexpr int lanes_of_a_source = 4;

// Run k ends at ends[k], where the next one begins. sources: bands values per node (2 to 4 bands),
// and lanes_of_a_source more that don't count. Adds to the bands values of `out` of receivers[k] a
// sum in double precision, in the order of the run.
using GatherRuns = void (*)(const Link* links, const uint32_t* ends, const uint16_t* receivers,
                            size_t runs, const float* sources, int bands, float* out);

// Those that this processor can run, the widest first.
Span<const GatherRuns> gather_kernels();

void gather_runs_sse2(const Link* links, const uint32_t* ends, const uint16_t* receivers,
                      size_t runs, const float* sources, int bands, float* out);
void gather_runs_avx2(const Link* links, const uint32_t* ends, const uint16_t* receivers,
                      size_t runs, const float* sources, int bands, float* out);

}  // namespace hrad
