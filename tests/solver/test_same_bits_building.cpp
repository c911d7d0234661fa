// The same bits everywhere, in the paper's Building: thousands of patches, so that threads meet in
// all stages.
#include "solver/same_bits.h"

namespace {

using namespace hrad_test;

void building() { check_same_bits({"building", "error", 0.5}, {{1, "auto"}, {7, "avx2"}}); }
void building_by_energy() {
  check_same_bits({"building", "energy", 0.5}, {{4, "sse2"}, {3, "avx512"}});
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(building),
      HRAD_TEST(building_by_energy),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
