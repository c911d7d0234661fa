// A solve that is stopped at any one call of its progress function, or at a sample of them: from
// the checkpoint of that moment, and without one, it goes on to the same bits as one that was not
// stopped.
#include "solver/checkpoint_files.h"
#include "support/thorough.h"

using hrad::Solver;
using hrad::Status;
using namespace hrad_test;

namespace {

enum class End { stopped, not_stopped, no_such_call };

// There is no call after the one that stops it.
End solve_until_call(Solver& solver, int64_t number) {
  int64_t calls = 0;
  solver.set_progress([&](const hrad::Progress&) { return ++calls != number; });
  const bool stopped = solver.solve() == Status::stopped;
  solver.set_progress(nullptr);
  CHECK(calls <= number);
  CHECK(!stopped || calls == number);
  return stopped ? End::stopped : calls == number ? End::not_stopped : End::no_such_call;
}

void same_end(const Solver& one, const Solver& whole) {
  CHECK(one.state_hash() == whole.state_hash());
  CHECK_EQUAL(one.stats().rays, whole.stats().rays);
  CHECK_EQUAL(one.stats().iterations, whole.stats().iterations);
  CHECK(one.stats().error_estimate == whole.stats().error_estimate);
}

// Every so many of them.
void goes_on_from_calls(const SolveCase& c, int64_t step) {
  const Folder folder("any-call");
  const auto whole = solver_of(c);
  CHECK(whole->solve() == Status::ok);
  int64_t stops = 0;
  for (int64_t number = 1;; number += step, ++stops) {
    const auto solver = solver_of(c);
    solver->set_int("resumable", 1);
    const End end = solve_until_call(*solver, number);
    // The last call of all tells that it is over.
    if (end != End::stopped) {
      CHECK(solve_until_call(*solver_of(c), number + 1) == End::no_such_call);
      break;
    }
    solver->write_checkpoint(folder.file("a.hrad"));
    Solver other;
    other.read_checkpoint(folder.file("a.hrad"));
    CHECK(other.solve() == Status::ok);
    same_end(other, *whole);
    // Now and then without the file.
    if (number % 10 != 0) continue;
    CHECK(solver->solve() == Status::ok);
    same_end(*solver, *whole);
  }
  CHECK(stops > 10);
}

void any_call_by_pairs() {
  goes_on_from_calls({"furnace", "pairs", "error", 0.5, "points", 1}, every(3));
}
void any_call_by_clusters() {
  goes_on_from_calls({"furnace", "clusters", "error", 0.5, "points", 1}, every(3));
}
// There are more than a thousand.
void some_calls_by_rows() {
  goes_on_from_calls({"cornell", "rows", "error", 0.5, "points", 1}, 79);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(any_call_by_pairs), HRAD_TEST(any_call_by_clusters),
                              HRAD_TEST(some_calls_by_rows)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
