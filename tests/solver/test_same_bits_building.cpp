// The same bits everywhere, in the paper's Building: thousands of patches, so that threads meet in
// all stages.
#include "solver/same_bits.h"

namespace {

using namespace hrad_test;

void building() {
  check_same_bits({"building", "pairs", "error", 0.5}, {{1, "auto"}, {7, "avx2"}});
}
void building_by_rows() {
  check_same_bits({"building", "rows", "error", 0.05},
                  {{1, "auto"}, {2, "sse2"}, {3, "avx2"}, {4, "avx512"}, {7, "auto"}});
}
void classroom_by_rows() {
  check_same_bits({"classroom", "rows", "error", 0.05}, {{1, "auto"}, {7, "sse2"}});
}
void building_by_energy() {
  check_same_bits({"building", "pairs", "energy", 0.5}, {{4, "sse2"}, {3, "avx512"}});
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(building),
      HRAD_TEST(building_by_energy),
      HRAD_TEST(building_by_rows),
      HRAD_TEST(classroom_by_rows),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
