// How much a test tries where there is more than anybody waits for: with HRAD_TEST_THOROUGH in the
// environment, as in the long run (tests/run.sh --full), everything, otherwise a fair sample of it.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace hrad_test {

inline bool thorough() { return std::getenv("HRAD_TEST_THOROUGH") != nullptr; }

// One of so many that come one after the other.
inline int64_t every(int64_t one_of) { return thorough() ? 1 : one_of; }

}  // namespace hrad_test
