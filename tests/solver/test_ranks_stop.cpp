// A stop on several ranks, asked for by the progress function of rank 0 or on any other rank: all
// return HRAD_STOPPED from the same place, and going on gives the bits of a solve without a stop.
#include <string>
#include <vector>

#include "solver/checkpoint_files.h"
#include "support/solver_ranks.h"

namespace {

using namespace hrad_test;

constexpr int ranks = 3;

// Where to stop: in the stage, when so many sweeps are done, at the next report after so many.
struct Point {
  const char* stage;
  int64_t iteration;
  int reports;
};

// Stops at one point after the other.
struct Stops {
  std::vector<Point> points;
  hrad_solver* other = nullptr;  // is asked to stop instead of rank 0
  size_t next = 0, met = 0;
  int reports = 0;  // of the stage since the last stop
  bool asks_other = false;

  static int32_t asked(const hrad_progress* progress, void* user) {
    auto* stops = static_cast<Stops*>(user);
    if (stops->next >= stops->points.size()) return 0;
    const Point& point = stops->points[stops->next];
    if (std::string(point.stage) != progress->stage || progress->iteration < point.iteration ||
        stops->reports++ < point.reports)
      return 0;
    stops->reports = 0;
    ++stops->next;
    ++stops->met;
    stops->asks_other = stops->next % 2 == 0;
    if (!stops->asks_other) return 1;
    hrad_request_stop(stops->other);
    return 0;
  }
};

struct Case {
  const char *scene, *linking;
  double accuracy;
  std::vector<Point> points;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"cornell",
       "pairs",
       0.4,
       {{"linking", 0, 0},
        {"linking", 0, 3},
        {"sweep", 1, 0},
        {"sweep", 2, 0},
        {"sweep", 4, 0},
        {"refine", 0, 0},
        {"refine", 0, 20},
        {"sweep", 9, 0},
        {"refine", 0, 6},
        {"sweep", 14, 0},
        {"sweep", 15, 0}}},
      {"furnished-room",
       "clusters",
       0.5,
       {{"linking", 0, 0}, {"sweep", 1, 0}, {"refine", 0, 0}, {"sweep", 8, 0}, {"sweep", 9, 0}}},
      {"cornell",
       "rows",
       0.1,
       {{"linking", 0, 0},
        {"linking", 0, 3},
        {"linking", 0, 20},
        {"linking", 0, 40},
        {"linking", 0, 60},
        {"sweep", 1, 0},
        {"sweep", 2, 0},
        {"sweep", 5, 0},
        {"sweep", 6, 0}}}};
  return all;
}

// Solves on until it isn't stopped any more.
void solve_to_the_end(SolverRank& one) {
  for (int calls = 0; one.note(hrad_solve(one.solver)) == HRAD_STOPPED && calls < 100; ++calls) {
  }
}

void going_on_is_as_good() {
  for (const Case& c : cases()) {
    const std::string wanted = hash_of_one(c.scene, c.linking, c.accuracy);
    for (int resumable : {0, 1}) {
      Stops stops;
      stops.points = c.points;
      const auto answers = solve_together(ranks, [&](SolverRank& one) {
        one.prepare(c.scene, c.linking, c.accuracy);
        one.note(hrad_set_int(one.solver, "resumable", resumable));
        if (one.rank == ranks - 1) stops.other = one.solver;
        // After a collective call the pointer is known to rank 0.
        one.note(hrad_partition(one.solver));
        if (one.rank == 0) hrad_set_progress(one.solver, Stops::asked, &stops);
        solve_to_the_end(one);
        one.note_hash();
      });
      CHECK(errors_of(answers).empty());
      CHECK(last_of(answers) == wanted);
      size_t stopped = 0;
      for (const Answer& answer : answers) stopped += answer.status == HRAD_STOPPED;
      CHECK(stopped >= 4);
      CHECK(stopped <= stops.met);  // asked for at the very end, it comes too late
    }
  }
}

// Stops at one report of linking, in whichever of its phases that comes.
struct StopAt {
  int report, reports = 0;
  static int32_t asked(const hrad_progress* progress, void* user) {
    auto* stop = static_cast<StopAt*>(user);
    return std::string(progress->stage) == "linking" && ++stop->reports == stop->report;
  }
};

void pairs_are_counted_once() {
  std::string wanted;
  size_t stopped = 0;
  for (int report : {0, 20, 36, 38, 42, 45, 50})
    for (int resumable : {0, 1}) {
      StopAt stop{report};
      const auto answers = solve_together(2, [&](SolverRank& one) {
        one.prepare("cornell", "pairs", 0.5);
        one.note(hrad_set_int(one.solver, "resumable", resumable));
        if (one.rank == 0) hrad_set_progress(one.solver, StopAt::asked, &stop);
        solve_to_the_end(one);
        one.note_number(static_cast<uint64_t>(one.stats().pairs));
      });
      if (report == 0) wanted = last_of(answers);
      CHECK(last_of(answers) == wanted);
      for (const Answer& answer : answers) stopped += answer.status == HRAD_STOPPED;
    }
  CHECK(wanted != "0");
  CHECK(stopped >= 6);
}

// Each stop alone, then a checkpoint that other ranks go on from.
void other_ranks_go_on() {
  const Folder folder("ranks-stop");
  for (const Case& c : cases()) {
    const std::string wanted = hash_of_one(c.scene, c.linking, c.accuracy);
    int files = 0;
    for (size_t k = 0; k < c.points.size(); k += 3) {
      Stops stops;
      stops.points = {c.points[k]};
      const std::string path = folder.file("stopped.hrad");
      const auto answers = solve_together(ranks, [&](SolverRank& one) {
        one.prepare(c.scene, c.linking, c.accuracy);
        if (one.rank == 0) hrad_set_progress(one.solver, Stops::asked, &stops);
        one.note(hrad_solve(one.solver));
        one.note(hrad_write_checkpoint(one.solver, path.c_str()));
      });
      CHECK(errors_of(answers).empty());
      files += stops.met > 0;
      const auto again = solve_together(k % 2 == 0 ? 1 : 2, [&](SolverRank& one) {
        one.note(hrad_set_int(one.solver, "threads", 1));
        one.note(hrad_read_checkpoint(one.solver, path.c_str()));
        one.note(hrad_solve(one.solver));
        one.note_hash();
      });
      CHECK(errors_of(again).empty());
      CHECK(last_of(again) == wanted);
    }
    CHECK(files >= 2);
  }
}

// Asked for before the solve begins, on any rank.
void asked_for_beforehand() {
  const std::string wanted = hash_of_one("furnace", "pairs", 0.1);
  for (int other = 0; other < ranks; ++other) {
    const auto answers = solve_together(ranks, [&](SolverRank& one) {
      one.prepare("furnace", "pairs", 0.1);
      if (one.rank == other) hrad_request_stop(one.solver);
      one.note(hrad_solve(one.solver));
      one.note(hrad_solve(one.solver));
      one.note_hash();
    });
    int stopped = 0;
    for (const Answer& answer : answers) stopped += answer.status == HRAD_STOPPED;
    CHECK_EQUAL(stopped, 1);
    CHECK(last_of(answers) == wanted);
  }
}

// The progress function may not write where others must take part, and says so.
struct Writing {
  hrad_solver* solver;
  std::string path;
  hrad_status status = HRAD_OK;
  static int32_t asked(const hrad_progress*, void* user) {
    auto* writing = static_cast<Writing*>(user);
    writing->status = hrad_write_checkpoint(writing->solver, writing->path.c_str());
    return 0;
  }
};

void no_rank_writes_alone() {
  const Folder folder("ranks-stop");
  Writing writing{nullptr, folder.file("a.hrad")};
  const auto answers = solve_together(2, [&](SolverRank& one) {
    one.prepare("furnace", "rows", 0.2);
    if (one.rank == 0) {
      writing.solver = one.solver;
      hrad_set_progress(one.solver, Writing::asked, &writing);
    }
    one.note(hrad_solve(one.solver));
  });
  CHECK(errors_of(answers).empty());
  CHECK_EQUAL(writing.status, HRAD_ERROR_STATE);
  CHECK_EQUAL(folder.count(), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(going_on_is_as_good),  HRAD_TEST(pairs_are_counted_once),
      HRAD_TEST(other_ranks_go_on),    HRAD_TEST(asked_for_beforehand),
      HRAD_TEST(no_rank_writes_alone),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
