// The same bits on any number of ranks, however the patches are dealt out to them.
#include <vector>

#include "solver/same_bits.h"

namespace {

using namespace hrad_test;

const std::vector<Surroundings> some_ranks = {
    {1, "auto"}, {1, "auto", 2}, {2, "auto", 3, "grid"}, {1, "auto", 5}, {1, "auto", 8, "grid"}};

void cornell_by_pairs() { check_same_bits({"cornell", "pairs", "error", 0.2}, some_ranks); }
void furnished_room_by_pairs() {
  check_same_bits({"furnished-room", "pairs", "energy", 0.5}, {{1, "auto"}, {1, "auto", 4}});
}
void cornell_by_clusters() { check_same_bits({"cornell", "clusters", "error", 0.2}, some_ranks); }
void furnished_room_by_clusters() {
  check_same_bits({"furnished-room", "clusters", "error", 0.3}, some_ranks);
}
void cornell_by_rows() { check_same_bits({"cornell", "rows", "error", 0.05}, some_ranks); }
void furnished_room_by_rows() {
  check_same_bits({"furnished-room", "rows", "error", 0.05}, some_ranks);
}
void furnished_room_by_rows_of_means() {
  check_same_bits({"furnished-room", "rows", "error", 0.05, "means"}, some_ranks);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(cornell_by_pairs),
      HRAD_TEST(furnished_room_by_pairs),
      HRAD_TEST(cornell_by_clusters),
      HRAD_TEST(furnished_room_by_clusters),
      HRAD_TEST(cornell_by_rows),
      HRAD_TEST(furnished_room_by_rows),
      HRAD_TEST(furnished_room_by_rows_of_means),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
