// The builtin engine's kernels for AVX-512. Floor 4 (visibility).
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "visibility/kernels.h"

namespace hrad {

namespace {
#include "visibility/packet_kernel.inl"
#include "visibility/ray_kernel.inl"
constexpr Kernels kernels{"avx512", blocked, nearest};
}  // namespace

const Kernels& kernels_avx512() { return kernels; }

}  // namespace hrad
