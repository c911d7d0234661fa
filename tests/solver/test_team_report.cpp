// Who is told of which threads: rank 0 of every process and of every crowded node, the others of a
// crowd on their own node.
#include <string>
#include <vector>

#include "solver/team_report.h"
#include "support/check.h"
#include "support/node_ranks.h"

namespace {

using namespace hrad;
using namespace hrad_test;

struct Place {
  int node, processors, threads, sharers;
};

struct Said {
  std::vector<std::string> warnings, others;
};

void keep(int32_t level, const char* message, void* user) {
  Said& said = *static_cast<Said*>(user);
  (level == Log::warning ? said.warnings : said.others).push_back(message);
}

std::vector<Said> said_on(const std::vector<Place>& places, Log::Level level = Log::info) {
  std::vector<Said> said(places.size());
  on_nodes(nodes_of(places), [&](Comm& comm, size_t rank) {
    Topology topology;
    topology.usable_contexts = places[rank].processors;
    PoolPlan plan;
    plan.threads = places[rank].threads;
    plan.sharers = places[rank].sharers;
    plan.reason = "reason " + std::to_string(rank);
    report_teams(comm, topology, plan, {keep, &said[rank], level});
  });
  return said;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void rank_0_is_told_of_all() {
  const std::vector<Said> said = said_on({{0, 8, 8, 1}, {1, 4, 1, 1}, {1, 4, 3, 1}});
  CHECK_EQUAL(said[0].others.size(), size_t{3});
  CHECK(has(said[0].others[0], "process 0 on node ") && has(said[0].others[0], ": 8 threads"));
  CHECK(has(said[0].others[1], "process 1") && has(said[0].others[1], ": 1 thread (reason 1)"));
  CHECK(has(said[0].others[2], "process 2") && has(said[0].others[2], ": 3 threads (reason 2)"));
  for (const Said& of_rank : said) CHECK(of_rank.warnings.empty());
  CHECK(said[1].others.empty() && said[2].others.empty());
}

// Nodes 1 and 2 are crowded, node 0 is not, and of node 3 each process has processors of its own.
void crowded_nodes_are_named_once() {
  const std::vector<Said> said = said_on({{0, 8, 4, 2},
                                          {0, 8, 4, 2},
                                          {1, 4, 3, 2},
                                          {1, 4, 3, 2},
                                          {2, 2, 2, 2},
                                          {2, 2, 2, 2},
                                          {3, 1, 5, 1}},
                                         Log::warning);
  CHECK_EQUAL(said[0].warnings.size(), size_t{2});
  CHECK(has(said[0].warnings[0], "2 processes on node "));
  CHECK(has(said[0].warnings[0], "would run 6 threads on the same 4 processors"));
  CHECK(has(said[0].warnings[0], "mpirun --map-by slot:PE=3"));
  CHECK(has(said[0].warnings[1], "would run 4 threads on the same 2 processors"));
  for (size_t rank : {1, 6}) CHECK(said[rank].warnings.empty());
  for (size_t rank : {2, 3, 4, 5}) {
    CHECK_EQUAL(said[rank].warnings.size(), size_t{1});
    CHECK(said[rank].warnings[0] == said[0].warnings[rank < 4 ? 0 : 1]);
  }
  for (const Said& of_rank : said) CHECK(of_rank.others.empty());
}

void one_process_alone() {
  const std::vector<Said> said = said_on({{0, 2, 16, 1}});
  CHECK(said[0].warnings.empty());
  CHECK_EQUAL(said[0].others.size(), size_t{1});
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(rank_0_is_told_of_all),
      HRAD_TEST(crowded_nodes_are_named_once),
      HRAD_TEST(one_process_alone),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
