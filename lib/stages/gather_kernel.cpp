// Run-time choice by what the processor has. Floor 7 (stages).
#include "stages/gather_kernel.h"

namespace hrad {
namespace {

constexpr GatherRuns kernels[] = {
#ifdef HRAD_X86_KERNELS
    gather_runs_avx2,
#endif
    gather_runs_sse2,
};
constexpr size_t count = sizeof kernels / sizeof kernels[0];

}  // namespace

Span<const GatherRuns> gather_kernels() {
#ifdef HRAD_X86_KERNELS
  if (!__builtin_cpu_supports("avx2")) return {kernels + 1, count - 1};
#endif
  return {kernels, count};
}

}  // namespace hrad
