// Solves one scene in several surroundings, numbers of threads and instruction sets, and holds the
// results against each other bit by bit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/solver.h"
#include "support/check.h"

namespace hrad_test {

struct Surroundings {
  int threads;
  const char* instruction_set;
};

struct Case {
  const char* scene;
  const char* linking;
  const char* oracle;
  double accuracy;
  const char* detail = "points";
};

// All that a user gets to see of a solution.
struct Results {
  uint64_t hash = 0;
  int64_t rays = 0, links = 0, elements = 0, iterations = 0;
  std::vector<double> numbers;
};

// False where this processor lacks the instruction set.
inline bool solve_in(const Case& c, const Surroundings& in, Results& results) {
  hrad::Solver solver;
  solver.make_scene(c.scene);
  solver.set_text("linking", c.linking);
  solver.set_text("oracle", c.oracle);
  solver.set_double("accuracy", c.accuracy);
  solver.set_text("detail", c.detail);
  solver.set_int("threads", in.threads);
  solver.set_text("instruction_set", in.instruction_set);
  try {
    solver.partition();
  } catch (const hrad::Error& e) {
    if (e.status() != hrad::Status::argument) throw;
    return false;
  }
  CHECK(solver.solve() == hrad::Status::ok);
  const hrad::Stats stats = solver.stats();
  CHECK_EQUAL(stats.threads, in.threads);
  results.hash = solver.state_hash();
  results.rays = stats.rays;
  results.links = stats.links;
  results.elements = stats.elements;
  results.iterations = stats.iterations;

  const int bands = solver.scene().bands;
  const int64_t patches = solver.scene().patch_count();
  std::vector<double>& out = results.numbers;
  out.assign(static_cast<size_t>(patches) * bands, 0.0);
  solver.query_patches(hrad::Quantity::radiosity, 0, 0, patches, out.data());
  const auto room_for = [&](int count) {
    out.resize(out.size() + static_cast<size_t>(count) * bands);
    return &out[out.size() - static_cast<size_t>(count) * bands];
  };
  const double xyz[] = {0.5, 0.5, 0.25, 0.3, 0.4, 0.6}, normal[] = {0, 0, 1, 1, 2, -1};
  double* sensors = room_for(4);
  solver.query_sensors(2, xyz, normal, sensors, sensors + 2 * bands);
  const int64_t patch[] = {0, patches - 1};
  const double uv[] = {0.3, 0.2, 0.1, 0.75};
  solver.query_points(hrad::Quantity::irradiance, 0, 2, patch, uv, room_for(2));
  double* balance = room_for(4);
  solver.power_balance(balance, balance + bands, balance + 2 * bands, balance + 3 * bands);
  out.push_back(stats.error_estimate);
  out.push_back(stats.error_standard_error);
  return true;
}

inline void check_same_bits(const Case& c, const std::vector<Surroundings>& all) {
  Results first;
  bool any = false;
  for (const Surroundings& in : all) {
    Results other;
    if (!solve_in(c, in, other)) continue;
    if (!any) first = other;
    any = true;
    const bool same = other.hash == first.hash && other.rays == first.rays &&
                      other.links == first.links && other.elements == first.elements &&
                      other.iterations == first.iterations && other.numbers == first.numbers;
    if (!same)
      failed(__FILE__, __LINE__,
             hrad::format("%s by %s, oracle=%s: %d threads with %s give other bits than %d with %s",
                          c.scene, c.linking, c.oracle, in.threads, in.instruction_set,
                          all[0].threads, all[0].instruction_set));
  }
  CHECK(any);
}

}  // namespace hrad_test
