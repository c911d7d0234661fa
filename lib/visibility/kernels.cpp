// Run-time choice of the kernels by what the processor has. Floor 4 (visibility).
#include "visibility/kernels.h"

#include <cstring>

#include "base/error.h"

namespace hrad {

namespace {

struct Choice {
  const char* name;
  bool (*usable)();
  const Kernels& (*kernels)();
};

// The widest first.
const Choice choices[] = {
#ifdef HRAD_X86_KERNELS
    {"avx512",
     [] {
       return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
              __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
              __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
     },
     kernels_avx512},
    {"avx2",
     [] {
       return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
              __builtin_cpu_supports("bmi2");
     },
     kernels_avx2},
#endif
    {"sse2", [] { return true; }, kernels_sse2},
};

}  // namespace

const Kernels& choose_kernels(const char* instruction_set) {
  const bool automatic = std::strcmp(instruction_set, "auto") == 0;
  std::string usable_names = "auto";
  for (const Choice& choice : choices) {
    if (!choice.usable()) continue;
    if (automatic || std::strcmp(instruction_set, choice.name) == 0) return choice.kernels();
    usable_names += std::string(", ") + choice.name;
  }
  fail(Status::argument, "instruction set '%s' can't be used here; this processor has: %s",
       instruction_set, usable_names.c_str());
}

}  // namespace hrad
