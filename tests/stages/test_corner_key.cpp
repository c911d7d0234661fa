// What a key of a corner tells.
#include "stages/corner_key.h"
#include "support/check.h"

namespace {

using namespace hrad;

void a_key_tells_surface_and_point() {
  const uint64_t key = key_of_corner(2147483647, {lattice_size, 5});
  CHECK_EQUAL(surface_of_corner(key), 2147483647);
  CHECK_EQUAL(point_of_corner(key).i, lattice_size);
  CHECK_EQUAL(point_of_corner(key).j, 5);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(a_key_tells_surface_and_point)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
