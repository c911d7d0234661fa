// Solves one scene in several surroundings, numbers of threads and instruction sets, and holds the
// results against each other bit by bit.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "api/guard.h"
#include "solver/solver.h"
#include "support/check.h"
#include "support/thread_ranks.h"

namespace hrad_test {

struct Surroundings {
  int threads;
  const char* instruction_set;
  int ranks = 1;
  const char* partition = "cost";
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
  bool operator==(const Results& other) const {
    return hash == other.hash && rays == other.rays && links == other.links &&
           elements == other.elements && iterations == other.iterations && numbers == other.numbers;
  }
};

// False where this processor lacks the instruction set.
inline bool solve_in(hrad::Solver& solver, const Case& c, const Surroundings& in,
                     Results& results) {
  solver.make_scene(c.scene);
  solver.set_text("partition", in.partition);
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
  CHECK_EQUAL(stats.ranks, in.ranks);
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

// On so many ranks, all of which must see the same; results: rank 0's.
inline bool solve_in(const Case& c, const Surroundings& in, Results& results) {
  std::vector<Results> of_rank(static_cast<size_t>(in.ranks));
  std::vector<uint8_t> possible(of_rank.size(), 0);
  on_ranks(in.ranks, [&](hrad::Comm& comm) {
    hrad::Solver solver(not_owned(comm));
    const size_t rank = static_cast<size_t>(comm.rank());
    hrad::api::agreed(comm, [&] { possible[rank] = solve_in(solver, c, in, of_rank[rank]); });
  });
  results = of_rank[0];
  for (const Results& other : of_rank)
    if (!(other == results)) failed(__FILE__, __LINE__, "ranks see different solutions");
  return possible[0] != 0;
}

inline void check_same_bits(const Case& c, const std::vector<Surroundings>& all) {
  Results first;
  bool any = false;
  for (const Surroundings& in : all) {
    Results other;
    if (!solve_in(c, in, other)) continue;
    if (!any) first = other;
    any = true;
    if (!(other == first))
      failed(
          __FILE__, __LINE__,
          hrad::format("%s by %s, oracle=%s: %d ranks by %s of %d threads with %s give other bits "
                       "than %d of %d with %s",
                       c.scene, c.linking, c.oracle, in.ranks, in.partition, in.threads,
                       in.instruction_set, all[0].ranks, all[0].threads, all[0].instruction_set));
  }
  CHECK(any);
}

}  // namespace hrad_test
