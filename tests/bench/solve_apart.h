// One solve in a process of its own, so that its CPU time and its peak memory are its own.
#pragma once

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/calibration.h"
#include "bench/reference_file.h"
#include "bench/solution_error.h"
#include "bench/user_time.h"
#include "physics/api_solver.h"

namespace bench {

using Settings = std::vector<std::pair<std::string, std::string>>;

// What a child process leaves behind: plain values, because they cross between processes.
struct Measurement {
  bool done = false;
  char failure[256] = {};
  double user_seconds = 0;  // of hrad_solve
  double calibration = 0;   // of the fixed loop run before and after it, the mean
  hrad_stats stats = {};
  double mismatch = 0;  // of the power balance, in the worst band, relative to the emitted power
  bool compared = false;
  SolutionError sides, points;
};

// A solver with the settings in force and the scene in it: a built-in name or a path that ends
// in .obj.
inline std::unique_ptr<physics::ApiSolver> loaded(const std::string& scene,
                                                  const Settings& settings) {
  int bands = 3;
  for (const auto& [name, value] : settings)
    if (name == "bands") bands = std::stoi(value);
  if (bands > physics::max_bands)
    throw std::runtime_error("the reference knows at most " + std::to_string(physics::max_bands) +
                             " bands");
  auto solver = std::make_unique<physics::ApiSolver>(bands);
  solver->set("threads", 1);
  for (const auto& [name, value] : settings) solver->set(name.c_str(), value.c_str());
  const std::string ending = ".obj";
  const bool is_file = scene.size() > ending.size() &&
                       scene.compare(scene.size() - ending.size(), ending.size(), ending) == 0;
  if (is_file)
    physics::ApiSolver::check(hrad_load_scene(solver->get(), scene.c_str()));
  else
    solver->make(scene.c_str());
  return solver;
}

inline double worst_mismatch(const physics::ApiSolver& solver) {
  const size_t bands = static_cast<size_t>(solver.bands());
  std::vector<double> in(bands), front(bands), back(bands), out(bands);
  physics::ApiSolver::check(
      hrad_power_balance(solver.get(), in.data(), front.data(), back.data(), out.data()));
  double worst = 0;
  for (size_t k = 0; k < bands; ++k)
    if (in[k] > 0) worst = std::max(worst, std::fabs(in[k] - front[k] - back[k] - out[k]) / in[k]);
  return worst;
}

// Runs work(result) in a child process and returns what it left in the result: plain values, with
// `done` and `failure` as in Measurement.
template <class Result = Measurement>
Result in_child(const std::function<void(Result&)>& work) {
  void* shared =
      mmap(nullptr, sizeof(Result), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) throw std::runtime_error("no shared memory");
  Result& result = *new (shared) Result;
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    try {
      work(result);
      result.done = true;
    } catch (const std::exception& error) {
      std::snprintf(result.failure, sizeof result.failure, "%s", error.what());
    }
    _exit(0);
  }
  int status = 0;
  const bool ended = child > 0 && waitpid(child, &status, 0) == child;
  const Result copy = result;
  munmap(shared, sizeof(Result));
  if (!ended || !WIFEXITED(status)) throw std::runtime_error("the solving process died");
  if (!copy.done) throw std::runtime_error(copy.failure);
  return copy;
}

// The fixed loop in a process of its own, so that its table is nobody's peak memory.
inline double calibration_apart() {
  struct Result {
    bool done = false;
    char failure[256] = {};
    double seconds = 0;
  };
  return in_child<Result>([](Result& result) { result.seconds = calibration_seconds(); }).seconds;
}

// Solves; then compares with the reference when there is one. It is read after the solve, so that
// the peak of memory is the solve's.
inline Measurement solve_apart(const std::string& scene, const Settings& settings,
                               const ReferencePlace* place) {
  const double before = calibration_apart();
  Measurement measured = in_child<Measurement>([&](Measurement& result) {
    const auto solver = loaded(scene, settings);
    const double start = user_seconds();
    solver->solve();
    result.user_seconds = user_seconds() - start;
    result.stats = solver->stats();
    result.mismatch = worst_mismatch(*solver);
    if (place == nullptr) return;
    const PathTracer tracer(solver->surfaces());
    const uint64_t key = place->key(tracer.surfaces());
    Reference reference;
    if (!read_reference(place->path(key), key, reference) || !reference.usable()) return;
    result.sides = error_of(radiosity_of(*solver, reference.sides), reference.sides, tracer);
    result.points = error_of(radiosity_of(*solver, reference.points), reference.points, tracer);
    result.compared = true;
  });
  measured.calibration = (before + calibration_apart()) / 2;
  return measured;
}

}  // namespace bench
