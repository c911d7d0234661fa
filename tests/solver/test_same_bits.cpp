// The same bits everywhere: one result for every number of threads and every instruction set that
// this processor has, and another where a result parameter says so.
#include <vector>

#include "solver/same_bits.h"

namespace {

using namespace hrad_test;

// Every number of threads and every instruction set, in as few solves as that takes; the slower
// cases make do with some of them.
const std::vector<Surroundings> all_surroundings = {
    {1, "auto"}, {2, "sse2"}, {3, "avx2"}, {4, "avx512"}, {7, "auto"}};

void cornell() { check_same_bits({"cornell", "pairs", "error", 0.2}, all_surroundings); }
void cornell_by_energy() {
  check_same_bits({"cornell", "pairs", "energy", 0.5}, {{2, "auto"}, {1, "sse2"}, {3, "avx512"}});
}
void furnished_room() {
  check_same_bits({"furnished-room", "pairs", "error", 0.3}, {{4, "auto"}, {1, "sse2"}});
}
void furnished_room_by_energy() {
  check_same_bits({"furnished-room", "pairs", "energy", 0.5}, {{1, "auto"}, {7, "sse2"}});
}
void furnace_boxes() {
  check_same_bits({"furnace-boxes", "pairs", "error", 0.2}, all_surroundings);
}
void furnace_boxes_by_energy() {
  check_same_bits({"furnace-boxes", "pairs", "energy", 0.5}, {{3, "auto"}, {1, "avx2"}});
}

void cornell_by_rows() { check_same_bits({"cornell", "rows", "error", 0.02}, all_surroundings); }
void furnished_room_by_rows() {
  check_same_bits({"furnished-room", "rows", "error", 0.02}, all_surroundings);
}
void furnished_room_by_rows_of_means() {
  check_same_bits({"furnished-room", "rows", "error", 0.02, "means"}, all_surroundings);
}
void furnace_boxes_by_rows() {
  check_same_bits({"furnace-boxes", "rows", "error", 0.02}, all_surroundings);
}
// Where the first settings don't keep the promise, the second ones are the same too.
void a_missed_accuracy_by_rows() {
  check_same_bits({"parallel-plates", "rows", "error", 0.001}, {{1, "sse2"}, {4, "auto"}});
}

void cornell_by_clusters() {
  check_same_bits({"cornell", "clusters", "error", 0.2}, all_surroundings);
}
void furnished_room_by_clusters() {
  check_same_bits({"furnished-room", "clusters", "error", 0.3}, all_surroundings);
}
void furnished_room_by_clusters_by_energy() {
  check_same_bits({"furnished-room", "clusters", "energy", 0.5}, {{1, "auto"}, {7, "sse2"}});
}
void furnace_boxes_by_clusters() {
  check_same_bits({"furnace-boxes", "clusters", "error", 0.2}, {{3, "auto"}, {1, "avx2"}});
}

void twice_is_the_same() {
  check_same_bits({"cornell", "pairs", "error", 0.3}, {{2, "auto"}, {2, "auto"}, {2, "auto"}});
}

// The hash sees what it is to see.
void result_parameters_change_the_hash() {
  Results coarse, finer, energy, rows, clusters;
  CHECK(solve_in({"cornell", "pairs", "error", 0.3}, {2, "auto"}, coarse));
  CHECK(solve_in({"cornell", "pairs", "error", 0.25}, {2, "auto"}, finer));
  CHECK(solve_in({"cornell", "pairs", "energy", 0.5}, {2, "auto"}, energy));
  CHECK(solve_in({"cornell", "rows", "error", 0.3}, {2, "auto"}, rows));
  CHECK(solve_in({"cornell", "clusters", "error", 0.3}, {2, "auto"}, clusters));
  CHECK(coarse.hash != finer.hash);
  CHECK(coarse.hash != clusters.hash);
  CHECK(coarse.hash != rows.hash);
  CHECK(coarse.hash != energy.hash);
  CHECK(coarse.numbers != finer.numbers);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(cornell),
      HRAD_TEST(cornell_by_energy),
      HRAD_TEST(furnished_room),
      HRAD_TEST(furnished_room_by_energy),
      HRAD_TEST(furnace_boxes),
      HRAD_TEST(furnace_boxes_by_energy),
      HRAD_TEST(cornell_by_rows),
      HRAD_TEST(furnished_room_by_rows),
      HRAD_TEST(furnished_room_by_rows_of_means),
      HRAD_TEST(furnace_boxes_by_rows),
      HRAD_TEST(a_missed_accuracy_by_rows),
      HRAD_TEST(cornell_by_clusters),
      HRAD_TEST(furnished_room_by_clusters),
      HRAD_TEST(furnished_room_by_clusters_by_energy),
      HRAD_TEST(furnace_boxes_by_clusters),
      HRAD_TEST(twice_is_the_same),
      HRAD_TEST(result_parameters_change_the_hash),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
