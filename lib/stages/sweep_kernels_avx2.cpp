// The loops for AVX2. Floor 7 (stages).
#include <immintrin.h>

#include <cstring>

#include "stages/sweep_kernels.h"

namespace hrad {

namespace {
#include "stages/four_lanes.inl"

#include "stages/gather_kernel.inl"
#include "stages/push_pull_kernel.inl"
}  // namespace

const SweepKernels sweep_kernels_avx2{gather_runs, push_pull};

}  // namespace hrad
