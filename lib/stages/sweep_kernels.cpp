// Run-time choice by what the processor has. Floor 7 (stages).
#include "stages/sweep_kernels.h"

namespace hrad {
namespace {

constexpr const SweepKernels* kernels[] = {
#ifdef HRAD_X86_KERNELS
    &sweep_kernels_avx2,
#endif
    &sweep_kernels_sse2,
};
constexpr size_t count = sizeof kernels / sizeof kernels[0];

}  // namespace

Span<const SweepKernels* const> sweep_kernels() {
#ifdef HRAD_X86_KERNELS
  if (!__builtin_cpu_supports("avx2")) return {kernels + 1, count - 1};
#endif
  return {kernels, count};
}

}  // namespace hrad
