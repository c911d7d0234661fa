// The loops for SSE2, on other processors the generic form of the same. Floor 7 (stages).

#ifdef __SSE2__
#include <immintrin.h>
#endif

#include <cstring>

#include "stages/sweep_kernels.h"

namespace hrad {

namespace {
#include "stages/four_lanes.inl"

#include "stages/gather_kernel.inl"
#include "stages/push_pull_kernel.inl"
}  // namespace

const SweepKernels sweep_kernels_sse2{gather_runs, push_pull};

}  // namespace hrad
