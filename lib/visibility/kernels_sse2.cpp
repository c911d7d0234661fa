// The builtin engine's kernels for SSE2, or of any other processor in its generic form. Floor 4
// (visibility).
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "visibility/kernels.h"

namespace hrad {

namespace {
#include "visibility/packet_kernel.inl"
#include "visibility/ray_kernel.inl"
constexpr Kernels kernels{"sse2", blocked, nearest};
}  // namespace

const Kernels& kernels_sse2() { return kernels; }

}  // namespace hrad
