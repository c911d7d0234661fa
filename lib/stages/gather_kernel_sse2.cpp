// The gathering loop for SSE2, on other processors the generic form of the same. Floor 7 (stages).
#include <cstring>

#include "stages/gather_kernel.h"

namespace hrad {

namespace {
#include "stages/gather_kernel.inl"
}  // namespace

void gather_runs_sse2(const Link* links, const uint32_t* first, size_t runs, uint32_t end,
                      const float* sources, int bands, float* out) {
  gather_runs(links, first, runs, end, sources, bands, out);
}

}  // namespace hrad
