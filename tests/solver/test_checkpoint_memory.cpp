// What writing a checkpoint takes, counted byte by byte: on several ranks none of them ever holds
// the links of all, nor half of them.
#include <malloc.h>

#include <algorithm>
#include <vector>

#include "api/guard.h"
#include "solver/checkpoint_files.h"
#include "support/allocation.h"
#include "support/thread_ranks.h"

namespace {

// A rank is a thread that gives back itself what it took.
thread_local int64_t bytes_held = 0, most_held = 0;

}  // namespace

bool hrad_test::may_allocate() { return true; }
void hrad_test::note_allocated(void* block) {
  bytes_held += static_cast<int64_t>(malloc_usable_size(block));
  most_held = std::max(most_held, bytes_held);
}
void hrad_test::note_given_back(void* block) {
  bytes_held -= static_cast<int64_t>(malloc_usable_size(block));
}

namespace {

using namespace hrad_test;
using hrad::Comm;
using hrad::Solver;

struct Cost {
  int64_t links = 0;             // bytes of the links of all ranks
  std::vector<int64_t> writing;  // bytes that writing held at most, of each rank
};

Cost cost_of(int ranks, double accuracy) {
  const Folder folder("memory");
  Cost cost;
  cost.writing.resize(static_cast<size_t>(ranks));
  on_ranks(ranks, [&](Comm& comm) {
    hrad::api::agreed(comm, [&] {
      Solver solver(not_owned(comm));
      solver.set_text("linking", "rows");
      solver.set_double("accuracy", accuracy);
      solver.set_int("threads", 1);
      solver.make_scene("building");
      solver.solve();
      const int64_t links = solver.stats().links * 8;
      most_held = bytes_held;
      const int64_t before = bytes_held;
      solver.write_checkpoint(folder.file("a.hrad"));
      cost.writing[static_cast<size_t>(comm.rank())] = most_held - before;
      if (comm.rank() == 0) cost.links = links;
    });
  });
  return cost;
}

// Two and a half times as many links.
void no_rank_holds_all_links() {
  for (int ranks : {1, 4}) {
    const Cost few = cost_of(ranks, 0.05), many = cost_of(ranks, 0.02);
    CHECK(many.links > 2 * few.links);
    for (size_t rank = 0; rank < many.writing.size(); ++rank) {
      CHECK(many.writing[rank] > 0);
      CHECK(2 * many.writing[rank] < many.links);
      CHECK(2 * (many.writing[rank] - few.writing[rank]) < many.links - few.links);
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(no_rank_holds_all_links)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
