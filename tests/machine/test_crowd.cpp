// Who shares processors with whom: processes of one node whose sets of processors overlap.
#include <vector>

#include "machine/crowd.h"
#include "support/check.h"
#include "support/node_ranks.h"

namespace {

using hrad::Topology;

struct Place {
  int node;
  std::vector<std::vector<int>> cores;
};

std::vector<int> sharers(const std::vector<Place>& places) {
  std::vector<int> result(places.size(), 0);
  hrad_test::on_nodes(hrad_test::nodes_of(places), [&](hrad::Comm& comm, size_t rank) {
    Topology topology;
    topology.core_contexts = places[rank].cores;
    result[rank] = hrad::sharers_of_processors(comm, topology);
  });
  return result;
}

using Counts = std::vector<int>;

void alone() { CHECK(sharers({{0, {{0, 1}}}}) == Counts{1}); }

void all_on_the_same() {
  const std::vector<std::vector<int>> cores = {{0, 1}, {2, 3}};
  CHECK(sharers({{0, cores}, {0, cores}, {0, cores}}) == (Counts{3, 3, 3}));
}

void each_on_its_own() {
  CHECK(sharers({{0, {{0}}}, {0, {{1}}}, {0, {{2}, {3}}}}) == (Counts{1, 1, 1}));
}

// Equal numbers on other nodes are other processors.
void nodes_share_nothing() {
  const std::vector<std::vector<int>> cores = {{0}, {1}};
  CHECK(sharers({{0, cores}, {7, cores}, {0, cores}, {7, {{1}}}, {9, cores}}) ==
        (Counts{2, 2, 2, 2, 1}));
}

// Two contexts of one core are two processors, and overlapping is not handed on.
void some_overlap() {
  CHECK(sharers({{0, {{0, 1}}}, {0, {{1}, {2}}}, {0, {{2, 3}}}, {0, {}}}) == (Counts{2, 3, 2, 1}));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(alone),           HRAD_TEST(all_on_the_same),
      HRAD_TEST(each_on_its_own), HRAD_TEST(nodes_share_nothing),
      HRAD_TEST(some_overlap),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
