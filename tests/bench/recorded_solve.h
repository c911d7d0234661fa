// One solve on so many ranks, recorded; or without a record on so many threads each, for its wall
// time.
#pragma once

#include <exception>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "api/guard.h"
#include "solver/solver.h"
#include "support/recorder.h"

namespace bench {

using Settings = std::vector<std::pair<std::string, std::string>>;

// Begins with the stage that the Initial Stage is recorded as, and what follows all that counts.
constexpr char kInitial[] = "initial", kAfter[] = "after";

struct Solved {
  hrad_test::Recording recording;
  hrad::Stats stats;  // all ranks together
};

inline void prepare(hrad::Solver& solver, const std::string& scene, const Settings& settings,
                    int threads) {
  solver.set_int("threads", threads);
  for (const auto& [name, value] : settings) solver.set_text(name, value);
  solver.make_scene(scene);
}

inline Solved recorded_solve(const std::string& scene, const Settings& settings, int ranks) {
  hrad_test::Recorders all(ranks);
  Solved solved;
  hrad_test::on_threads(ranks, [&](hrad_test::Hub& hub, int rank) {
    hrad_test::Recorder recorder(all, rank);
    hrad_test::RecordingComm comm(hub, rank, recorder);
    hrad::Solver solver(hrad_test::not_owned(comm));
    solver.set_observer(&recorder);
    hrad::api::agreed(comm, [&] {
      prepare(solver, scene, settings, 1);
      recorder.stage_begins(kInitial);
      solver.partition();
      recorder.stage_begins("linking");
      solver.solve();
      recorder.stage_begins(kAfter);
      const hrad::Stats stats = solver.stats();
      if (rank == 0) solved.stats = stats;
    });
  });
  solved.recording = std::move(all.recording);
  return solved;
}

// Wall seconds of the Linking and the Iterative Stage.
inline double wall_of_solve(const std::string& scene, const Settings& settings, int ranks,
                            int threads) {
  double seconds = 0;
  hrad_test::on_ranks(ranks, [&](hrad::Comm& comm) {
    hrad::Solver solver(hrad_test::not_owned(comm));
    hrad::api::agreed(comm, [&] {
      prepare(solver, scene, settings, threads);
      solver.solve();
      const hrad::Stats stats = solver.stats();
      if (comm.rank() == 0) seconds = stats.seconds_linking + stats.seconds_iterative;
    });
  });
  return seconds;
}

}  // namespace bench
