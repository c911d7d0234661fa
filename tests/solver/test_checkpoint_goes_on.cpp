// A solve that was stopped, or whose process ended, goes on from its last checkpoint to the same
// bits as one that was not: from after every sweep, and from within every stage.
#include <cstring>
#include <map>
#include <vector>

#include "solver/checkpoint_files.h"
#include "solver/checkpoint_sizes.h"
#include "support/checkpoint_frame.h"
#include "support/thorough.h"

using hrad::Solver;
using hrad::Status;
using namespace hrad_test;

namespace {

// Places where a solve may be stopped: after a sweep, or where so much of another stage is done.
struct Stop {
  const char* stage;
  int64_t iteration;
  double share;
};

// Sweeps that are done when the last round of refinement begins.
int64_t sweeps_before_the_last_round(const SolveCase& c) {
  const auto solver = solver_of(c);
  int64_t sweeps = 0;
  solver->set_progress([&](const hrad::Progress& progress) {
    if (progress.stage == std::string("refine")) sweeps = progress.iteration;
    return true;
  });
  solver->solve();
  return sweeps;
}

// False: the solve came to its end before.
bool solve_until(Solver& solver, const Stop& stop) {
  solver.set_progress([&](const hrad::Progress& progress) {
    return progress.stage != std::string(stop.stage) || progress.iteration < stop.iteration ||
           progress.stage_share < stop.share;
  });
  const bool stopped = solver.solve() == Status::stopped;
  solver.set_progress(nullptr);
  return stopped;
}

// Solves on from the checkpoint of a stopped solve. False: there was nothing to be stopped.
bool goes_on_to(const Solver& whole, const SolveCase& c, const Stop& stop,
                const std::string& path) {
  const auto solver = solver_of(c);
  solver->set_int("resumable", 1);
  if (!solve_until(*solver, stop)) return false;
  solver->write_checkpoint(path);
  Solver other;
  other.read_checkpoint(path);
  CHECK(other.solved() == solver->solved());
  if (solver->solved()) CHECK(other.state_hash() == solver->state_hash());
  CHECK(other.solve() != Status::stopped);
  CHECK(other.state_hash() == whole.state_hash());
  CHECK_EQUAL(other.stats().iterations, whole.stats().iterations);
  CHECK_EQUAL(other.stats().rays, whole.stats().rays);
  CHECK(other.stats().error_estimate == whole.stats().error_estimate);
  if (stop.stage == std::string("sweep")) return true;
  // Here as well, where nothing was read.
  CHECK(solver->solve() != Status::stopped);
  CHECK(solver->state_hash() == whole.state_hash());
  CHECK_EQUAL(solver->stats().rays, whole.stats().rays);
  return true;
}

void a_stopped_solve_goes_on_from_its_checkpoint() {
  const Folder folder("stops");
  for (const SolveCase& c :
       {SolveCase{"cornell", "rows", "error", 0.3}, SolveCase{"furnace", "pairs", "error", 0.3},
        SolveCase{"cornell", "clusters", "error", 0.5}}) {
    const auto whole = solver_of(c);
    whole->solve();
    const int64_t sweeps = whole->stats().iterations;
    int64_t stops = 0;
    const int64_t step = c.linking == std::string("clusters") ? 5 : every(3);
    for (int64_t sweep = 1; sweep <= sweeps; sweep += step)
      stops += goes_on_to(*whole, c, {"sweep", sweep, 0}, folder.file("a.hrad"));
    CHECK(stops >= (sweeps - 1) / step);
    for (double share : {0.0, 0.2, 0.5, 0.8})
      for (const char* stage : {"linking", "refine", "measure"})
        stops += goes_on_to(*whole, c, {stage, 0, share}, folder.file("a.hrad"));
    CHECK(stops > sweeps / step + 2);
  }
}

// Of a solve that goes on all the time, from its progress function.
void checkpoints_are_written_on_the_way() {
  const Folder folder("on-the-way");
  for (const SolveCase& c : {SolveCase{"cornell", "rows", "error", 0.3},
                             SolveCase{"cornell", "rows", "error", 0.3, "means"},
                             SolveCase{"cornell", "pairs", "error", 0.4},
                             SolveCase{"cornell", "clusters", "error", 0.5}}) {
    const auto whole = solver_of(c);
    whole->solve();
    const auto solver = solver_of(c, 2);
    solver->set_int("resumable", 1);
    std::vector<std::string> files;
    std::string stage;
    double due = 0;
    int64_t sweep = 0, refused = 0;
    solver->set_progress([&](const hrad::Progress& progress) {
      if (progress.stage != stage) due = 0;
      if (progress.stage_share < due && progress.iteration < sweep + 4) return true;
      due = progress.stage_share + 0.3;
      sweep = progress.iteration;
      stage = progress.stage;
      try {
        solver->write_checkpoint(folder.file("a.hrad"));
        files.push_back(bytes_of_file(folder.file("a.hrad")));
      } catch (const hrad::Error& error) {
        CHECK(error.status() == Status::state);
        ++refused;
      }
      return true;
    });
    solver->solve();
    CHECK(solver->state_hash() == whole->state_hash());
    CHECK(files.size() > 3 && refused < 5);
    for (const std::string& bytes : files) {
      write_bytes(folder.file("b.hrad"), bytes);
      Solver other;
      other.read_checkpoint(folder.file("b.hrad"));
      CHECK(other.solve() != Status::stopped);
      CHECK(other.state_hash() == whole->state_hash());
      CHECK_EQUAL(other.stats().rays, whole->stats().rays);
      CHECK_EQUAL(other.stats().iterations, whole->stats().iterations);
    }
  }
}

// Within a round that has made elements already, which are not in the file: what large tasks of the
// first pass hand on is most of it.
void checkpoints_within_later_passes() {
  const Folder folder("passes");
  for (const SolveCase& c : {SolveCase{"cornell", "pairs", "error", 0.2},
                             SolveCase{"cornell", "clusters", "error", 0.3}}) {
    const auto whole = solver_of(c), solver = solver_of(c);
    whole->solve();
    solver->set_int("resumable", 1);
    std::map<int64_t, std::string> files;  // the last one of each round
    solver->set_progress([&](const hrad::Progress& progress) {
      if (progress.stage != std::string("refine") || progress.stage_share < 0.7) return true;
      solver->write_checkpoint(folder.file("a.hrad"));
      files[progress.iteration] = bytes_of_file(folder.file("a.hrad"));
      return true;
    });
    solver->solve();
    CHECK(files.size() >= 2);
    for (const auto& [iteration, bytes] : files) {
      write_bytes(folder.file("b.hrad"), bytes);
      Solver other;
      other.read_checkpoint(folder.file("b.hrad"));
      CHECK(other.solve() != Status::stopped);
      CHECK(other.state_hash() == whole->state_hash());
    }
  }
}

// Every result in the file says of its rays one more than there were: a solve that goes on counts
// as many more as there are results, as it does none of these tasks again. Exposed shares are
// shorter, and tell of no rays.
int64_t add_a_ray_to_every_result(const std::string& path) {
  hrad_test::Frame frame = frame_of(bytes_of_file(path));
  int64_t results = 0;
  for (auto& run : frame[static_cast<size_t>(hrad::Section::steps)]) {
    hrad::PackedReader reader(run.raw.data(), run.raw.size(), {"steps", 0});
    hrad::LinkStep step = hrad::unpack_step(reader);
    uint64_t at = 0;
    for (uint64_t end : step.ends) {
      int64_t rays;
      if (end - at >= sizeof rays) {
        std::memcpy(&rays, &step.results[at], sizeof rays);
        ++rays;
        std::memcpy(&step.results[at], &rays, sizeof rays);
        ++results;
      }
      at = end;
    }
    hrad::PackedBytes packed;
    hrad::pack_step(step, packed);
    run.raw = packed.bytes();
  }
  write_bytes(path, file_of(frame));
  return results;
}

void finished_tasks_are_not_done_again() {
  const Folder folder("tasks");
  const struct {
    SolveCase c;
    Stop stop;
    int64_t least;
  } stops[] = {{{"cornell", "rows", "error", 0.3}, {"linking", 0, 0.3}, 500},
               {{"cornell", "rows", "error", 0.3, "means"}, {"linking", 0, 0.5}, 500},
               {{"cornell", "pairs", "error", 0.3}, {"linking", 0, 0.5}, 10},
               {{"cornell", "pairs", "error", 0.3}, {"refine", 1, 0.9}, 10},
               {{"cornell", "clusters", "error", 0.5}, {"linking", 0, 0.7}, 20},
               {{"cornell", "clusters", "error", 0.5}, {"refine", 1, 0.9}, 20},
               {{"cornell", "rows", "error", 0.3}, {"measure", 0, 0.5}, 100}};
  for (auto [c, stop, least] : stops) {
    if (stop.iteration > 0) stop.iteration = sweeps_before_the_last_round(c);
    const auto whole = solver_of(c), solver = solver_of(c, 2);
    whole->solve();
    solver->set_int("resumable", 1);
    CHECK(solve_until(*solver, stop));
    solver->write_checkpoint(folder.file("a.hrad"));
    const int64_t results = add_a_ray_to_every_result(folder.file("a.hrad"));
    CHECK(results >= least);
    Solver other;
    other.read_checkpoint(folder.file("a.hrad"));
    CHECK(other.solve() != Status::stopped);
    CHECK_EQUAL(other.stats().rays, whole->stats().rays + results);
    CHECK(other.state_hash() == whole->state_hash());
  }
}

// Steps of another light or accuracy are no use.
void steps_of_other_links_are_forgotten() {
  const Folder folder("other-steps");
  const SolveCase c{"cornell", "rows", "error", 0.3};
  const double emission[3] = {1, 2, 3};
  const auto whole = solver_of(c), solver = solver_of(c);
  whole->set_emission(5, 1, emission);
  whole->solve();
  solver->set_int("resumable", 1);
  CHECK(solve_until(*solver, {"linking", 0, 0.6}));
  solver->write_checkpoint(folder.file("a.hrad"));
  Solver other;
  other.read_checkpoint(folder.file("a.hrad"));
  for (Solver* each : {solver.get(), &other}) {
    each->set_emission(5, 1, emission);
    CHECK(each->solve() != Status::stopped);
    CHECK(each->state_hash() == whole->state_hash());
    CHECK_EQUAL(each->stats().rays, whole->stats().rays);
  }
}

// Another method serves the smaller accuracy.
void a_method_that_changes_begins_anew() {
  const SolveCase c{"furnace", "auto", "error", 0.2, "points", 1};
  const auto solver = solver_of(c),
             fresh = solver_of({"furnace", "auto", "error", 0.0039, "points", 1});
  solver->solve();
  solver->set_double("accuracy", 0.0039);
  CHECK(solver->solve() == Status::ok);
  CHECK(fresh->solve() == Status::ok);
  CHECK(solver->state_hash() == fresh->state_hash());
}

// Through a file after every sweep, with other threads each time.
void a_solve_goes_on_through_many_checkpoints() {
  const Folder folder("chain");
  for (const SolveCase& c :
       {SolveCase{"cornell", "rows", "error", 0.3}, SolveCase{"cornell", "pairs", "energy", 0.4}}) {
    const auto whole = solver_of(c);
    whole->solve();
    auto solver = solver_of(c);
    int links_of_the_chain = 0;
    for (;;) {
      int64_t before = solver->stats().iterations;
      solver->set_progress([&](const hrad::Progress& progress) {
        return std::string(progress.stage) != "sweep" || progress.iteration == before;
      });
      if (solver->solve() != Status::stopped) break;
      solver->write_checkpoint(folder.file("chain.hrad"));
      solver = std::make_unique<Solver>();
      solver->set_int("threads", 1 + links_of_the_chain % 3);
      solver->read_checkpoint(folder.file("chain.hrad"));
      ++links_of_the_chain;
    }
    CHECK(links_of_the_chain >= 10);
    CHECK(solver->state_hash() == whole->state_hash());
    CHECK_EQUAL(solver->stats().iterations, whole->stats().iterations);
  }
}

void light_and_sweeps_alone_are_kept_as_well() {
  const Folder folder("resolve");
  const auto solver = solver_of({"cornell", "rows", "error", 0.3});
  solver->solve();
  const int64_t patches = solver->scene().patch_count();
  std::vector<double> emission(3 * static_cast<size_t>(patches), 0.25);
  solver->set_emission(0, patches, emission.data());
  solver->set_int("refine", 0);
  const int64_t sweeps = solver->stats().iterations;
  // Before these sweeps, between them and after them.
  for (int64_t stop : {int64_t{0}, int64_t{3}, int64_t{1000}}) {
    if (stop > 0) static_cast<void>(solve_until(*solver, {"sweep", sweeps + stop, 0}));
    solver->write_checkpoint(folder.file("a.hrad"));
    Solver other;
    other.read_checkpoint(folder.file("a.hrad"));
    CHECK(other.state_hash() == solver->state_hash());
    Solver third;
    third.read_checkpoint(folder.file("a.hrad"));
    CHECK(third.solve() == Status::ok);
    CHECK(other.solve() == Status::ok);
    CHECK(third.state_hash() == other.state_hash());
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(a_stopped_solve_goes_on_from_its_checkpoint),
                              HRAD_TEST(checkpoints_are_written_on_the_way),
                              HRAD_TEST(checkpoints_within_later_passes),
                              HRAD_TEST(finished_tasks_are_not_done_again),
                              HRAD_TEST(steps_of_other_links_are_forgotten),
                              HRAD_TEST(a_method_that_changes_begins_anew),
                              HRAD_TEST(a_solve_goes_on_through_many_checkpoints),
                              HRAD_TEST(light_and_sweeps_alone_are_kept_as_well)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
