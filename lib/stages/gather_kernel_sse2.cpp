// The gathering loop for SSE2, on other processors the generic form of the same. Floor 7 (stages).
#include <cstring>

#include "stages/gather_kernel.h"

namespace hrad {

namespace {
#include "stages/gather_kernel.inl"
}  // namespace

void gather_runs_sse2(const Link* links, const uint32_t* ends, const uint16_t* receivers,
                      size_t runs, const float* sources, int bands, float* out) {
  gather_runs(links, ends, receivers, runs, sources, bands, out);
}

}  // namespace hrad
