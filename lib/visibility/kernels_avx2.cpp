// The builtin engine's kernels for AVX2. Floor 4 (visibility).
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "visibility/kernels.h"

namespace hrad {

namespace {
#include "visibility/packet_kernel.inl"
#include "visibility/ray_kernel.inl"
constexpr Kernels kernels{"avx2", blocked, nearest};
}  // namespace

const Kernels& kernels_avx2() { return kernels; }

}  // namespace hrad
