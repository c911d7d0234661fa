// Checkpoints of several ranks: the bytes are those of one rank, and any number of ranks reads them
// and goes on to the same end.
#include <algorithm>
#include <map>
#include <vector>

#include "api/guard.h"
#include "solver/checkpoint.h"
#include "solver/checkpoint_files.h"
#include "support/failing_ranks.h"

using hrad::Comm;
using hrad::Solver;
using namespace hrad_test;

namespace {

const SolveCase cases[] = {{"furnished-room", "rows", "error", 0.1},
                           {"cornell", "rows", "error", 0.1, "means"},
                           {"cornell", "pairs", "error", 0.4},
                           {"furnished-room", "clusters", "error", 0.5},
                           {"cornell", "rows", "error", 0.2, "points", 5}};

std::unique_ptr<Solver> solver_on(Comm& comm, const SolveCase& c) {
  auto solver = std::make_unique<Solver>(not_owned(comm));
  solver->set_int("bands", c.bands);
  solver->set_text("linking", c.linking);
  solver->set_text("oracle", c.oracle);
  solver->set_double("accuracy", c.accuracy);
  solver->set_text("detail", c.detail);
  solver->set_int("threads", 1);
  return solver;
}

template <class Body>
void on_solvers(int ranks, const SolveCase& c, const Body& body) {
  on_ranks(ranks, [&](Comm& comm) {
    hrad::api::agreed(comm, [&] {
      const auto solver = solver_on(comm, c);
      body(*solver);
    });
  });
}

void the_bytes_are_those_of_one() {
  const Folder folder("ranks");
  for (const SolveCase& c : cases) {
    std::string bytes;
    for (int ranks : {1, 2, 3, 5}) {
      on_solvers(ranks, c, [&](Solver& solver) {
        solver.make_scene(c.scene);
        solver.solve();
        solver.stats();
        const uint64_t hash = solver.state_hash();
        solver.write_checkpoint(folder.file("a.hrad"));
        CHECK(solver.state_hash() == hash);
      });
      const std::string written = bytes_of_file(folder.file("a.hrad"));
      CHECK(written.size() > 1000);
      if (ranks == 1) bytes = written;
      CHECK(written == bytes);
    }
  }
}

// Written by so many, read by others, who write it again.
void any_number_reads() {
  const Folder folder("ranks");
  for (const SolveCase& c : cases) {
    uint64_t hash = 0;
    const double xyz[] = {0.4, 0.5, 0.25}, normal[] = {0, 0.5, 1};
    std::vector<double> sensors;
    for (int ranks : {3, 1, 4}) {
      on_solvers(ranks, c, [&](Solver& solver) {
        if (ranks == 3) {
          solver.make_scene(c.scene);
          solver.solve();
        } else {
          solver.read_checkpoint(folder.file("a.hrad"));
        }
        std::vector<double> light(5 * static_cast<size_t>(c.bands));
        solver.query_sensors(1, xyz, normal, light.data(), light.data() + c.bands);
        solver.leaf_corner_radiosity(0, light.data() + 2 * c.bands);
        const hrad::Stats stats = solver.stats();
        light.push_back(static_cast<double>(stats.rays));
        light.push_back(static_cast<double>(stats.links));
        const uint64_t own = solver.state_hash();
        if (solver.comm().rank() == 0) {
          if (ranks == 3) {
            hash = own;
            sensors = light;
          }
          CHECK(own == hash);
          CHECK(light == sensors);
        }
        solver.write_checkpoint(folder.file("b.hrad"));
      });
      if (ranks == 3) write_bytes(folder.file("a.hrad"), bytes_of_file(folder.file("b.hrad")));
      CHECK(bytes_of_file(folder.file("a.hrad")) == bytes_of_file(folder.file("b.hrad")));
    }
  }
}

// A re-solve after a change of light on other ranks, and a finer one, are what they would be.
void solving_goes_on() {
  const Folder folder("ranks");
  for (const SolveCase& c : cases) {
    on_solvers(2, c, [&](Solver& solver) {
      solver.make_scene(c.scene);
      solver.solve();
      solver.write_checkpoint(folder.file("a.hrad"));
    });
    for (int refine : {0, 1}) {
      uint64_t hash = 0;
      for (int ranks : {1, 3}) {
        on_solvers(ranks, c, [&](Solver& solver) {
          solver.read_checkpoint(folder.file("a.hrad"));
          std::vector<double> half(static_cast<size_t>(c.bands), 0.25);
          solver.set_reflectance(0, 1, half.data());
          solver.set_int("refine", refine);
          solver.solve();
          const uint64_t own = solver.state_hash();
          if (solver.comm().rank() > 0) return;
          if (ranks == 1) hash = own;
          CHECK(own == hash);
        });
      }
    }
  }
}

// Rank 0 can't write: all fail alike, and the solvers are as before.
void a_folder_that_is_not_there() {
  const SolveCase& c = cases[1];
  on_ranks(3, [&](Comm& comm) {
    const auto solver = solver_on(comm, c);
    solver->make_scene(c.scene);
    solver->solve();
    const uint64_t hash = solver->state_hash();
    bool failed_so = false;
    try {
      hrad::api::agreed(comm, [&] { solver->write_checkpoint("/no/such/folder/a.hrad"); });
    } catch (const hrad::Error& error) {
      failed_so = error.status() == hrad::Status::file &&
                  std::string(error.what()).find("/no/such/folder") != std::string::npos;
    }
    const bool same = solver->state_hash() == hash;
    comm.all_go_on();
    CHECK(failed_so && same);
  });
}

// Each step of each rank on the file fails once: all say the same, the file that was there is
// whole, nothing else is left, and the solvers write as before.
void every_step_fails_once() {
  const SolveCase& c = cases[1];
  constexpr int ranks = 3;
  const Folder folder("ranks");
  const std::string path = folder.file("a.hrad");
  struct Attempt {
    std::string message;
    uint64_t hash = 0;
  };
  std::vector<std::vector<Attempt>> attempts(ranks);
  std::vector<std::string> files;  // after each of them
  std::vector<int64_t> counts;
  on_failing_ranks(ranks, [&](FailingComm& comm) {
    hrad::api::agreed(comm, [&] {
      const auto solver = solver_on(comm, c);
      solver->set_int("checkpoint_keep", 0);
      solver->make_scene(c.scene);
      solver->solve();
      const auto attempt = [&](int step) {
        Attempt made;
        comm.failing_step = step;
        if (comm.rank() == 0) write_bytes(path, "old");
        try {
          hrad::api::agreed(comm, [&] { solver->write_checkpoint(path); });
        } catch (const hrad::Error& error) {
          made.message = std::to_string(static_cast<int>(error.status())) + error.what();
        }
        made.hash = solver->state_hash();
        if (comm.rank() == 0) {
          files.push_back(bytes_of_file(path));
          counts.push_back(folder.count());
        }
        attempts[static_cast<size_t>(comm.rank())].push_back(made);
        return !made.message.empty();
      };
      attempt(-1);
      for (int failing = 0; failing < ranks; ++failing)
        for (int step = 0; attempt(comm.rank() == failing ? step : -1); ++step) continue;
    });
  });
  size_t failures = 0;
  for (size_t k = 0; k < files.size(); ++k) {
    const Attempt& first = attempts[0][k];
    for (const auto& of_rank : attempts) {
      CHECK(of_rank[k].message == first.message);
      CHECK(of_rank[k].hash == attempts[0][0].hash);
    }
    CHECK_EQUAL(counts[k], 1);
    CHECK(files[k] == (first.message.empty() ? files[0] : "old"));
    if (first.message.empty()) continue;
    CHECK(first.message.find("-4" + path + ": rank ") == 0);
    ++failures;
  }
  CHECK(files[0].size() > 1000);
  CHECK(failures > 40);
}

// A stage that is under way: the file has what every rank has done of it, once, however often it
// is read and written again.
void finished_tasks_of_all_ranks() {
  const Folder folder("ranks");
  constexpr int ranks = 3;
  for (const SolveCase& c : {SolveCase{"furnished-room", "rows", "error", 0.1},
                             SolveCase{"furnished-room", "clusters", "error", 0.5}}) {
    on_solvers(ranks, c, [&](Solver& solver) {
      solver.set_int("resumable", 1);
      if (solver.comm().rank() == 0)
        solver.set_progress([](const hrad::Progress& progress) {
          return progress.stage != std::string("linking") || progress.stage_share < 0.05;
        });
      solver.make_scene(c.scene);
      CHECK(solver.solve() == hrad::Status::stopped);
      solver.write_checkpoint(folder.file("a.hrad"));
    });
    const std::string bytes = bytes_of_file(folder.file("a.hrad"));
    const auto content = hrad::read_checkpoint(bytes, 0);
    CHECK(!content->state && content->key_of_steps != 0);
    std::map<uint32_t, int> steps_of_pass;
    int most = 0;
    for (const hrad::LinkStep& step : content->steps)
      most = std::max(most, ++steps_of_pass[step.pass]);
    CHECK(most >= ranks);
    uint64_t hash = 0;
    for (int readers : {1, 2, 4})
      on_solvers(readers, c, [&](Solver& solver) {
        solver.read_checkpoint(folder.file("a.hrad"));
        solver.write_checkpoint(folder.file("b.hrad"));
        // Others don't wait until it has its name.
        if (solver.comm().rank() == 0) CHECK(bytes_of_file(folder.file("b.hrad")) == bytes);
        solver.solve();
        const uint64_t own = solver.state_hash();
        if (solver.comm().rank() > 0) return;
        if (readers == 1) hash = own;
        CHECK(own == hash);
      });
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(the_bytes_are_those_of_one),
      HRAD_TEST(any_number_reads),
      HRAD_TEST(solving_goes_on),
      HRAD_TEST(a_folder_that_is_not_there),
      HRAD_TEST(every_step_fails_once),
      HRAD_TEST(finished_tasks_of_all_ranks),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
