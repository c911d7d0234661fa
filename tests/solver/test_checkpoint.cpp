// Checkpoints: what is read is what was written, for every method and state; a solve goes on from
// one to the same bits; the bytes don't depend on threads.
#include <vector>

#include "solver/checkpoint_files.h"

using hrad::Solver;
using hrad::Status;
using namespace hrad_test;

namespace {

const SolveCase cases[] = {
    {"cornell", "rows", "error", 0.1},
    {"cornell", "rows", "error", 0.1, "means"},
    {"furnished-room", "rows", "error", 0.1},
    {"cornell", "pairs", "error", 0.1},
    {"cornell", "pairs", "energy", 0.1},
    {"furnished-room", "clusters", "error", 0.2},
    {"furnace", "auto", "error", 0.05, "points", 1},
    {"cornell", "rows", "error", 0.2, "points", 5},
};

// All that queries and exports are made of.
std::vector<double> answers_of(const Solver& solver) {
  const int bands = solver.scene().bands;
  const int64_t leaves = solver.leaf_count();
  std::vector<double> all, corners(3 * static_cast<size_t>(bands));
  for (int64_t k = 0; k < leaves; ++k) {
    const hrad::LeafView leaf = solver.leaf(k);
    all.insert(all.end(), {static_cast<double>(leaf.patch), static_cast<double>(leaf.face),
                           leaf.area, leaf.exposed, leaf.corners.b.y});
    solver.leaf_corner_radiosity(k, corners.data());
    all.insert(all.end(), corners.begin(), corners.end());
    solver.leaf_values(k, hrad::Quantity::irradiance, corners.data());
    all.insert(all.end(), corners.begin(), corners.begin() + bands);
  }
  std::vector<double> four(4 * static_cast<size_t>(bands));
  solver.power_balance(&four[0], &four[bands], &four[2 * bands], &four[3 * bands]);
  all.insert(all.end(), four.begin(), four.end());
  const double xyz[] = {0.4, 0.5, 0.25}, normal[] = {0, 0.5, 1};
  solver.query_sensors(1, xyz, normal, &four[0], &four[bands]);
  all.insert(all.end(), four.begin(), four.end());
  const hrad::Stats stats = solver.stats();
  for (double value : {stats.error_estimate, stats.error_standard_error, stats.area,
                       stats.sealed_area, stats.back_share})
    all.push_back(value);
  for (int64_t value : {stats.rounds, stats.iterations, stats.elements, stats.links, stats.rays,
                        stats.pairs, stats.leaves})
    all.push_back(static_cast<double>(value));
  return all;
}

void same_solvers(const Solver& one, const Solver& other) {
  CHECK(one.state_hash() == other.state_hash());
  CHECK(one.diagnostics() == other.diagnostics());
  CHECK(answers_of(one) == answers_of(other));
  for (const hrad::ParamRow& row : hrad::param_table())
    if (row.is_result) CHECK(same_value(one.params(), other.params(), row));
}

void what_is_read_is_what_was_written() {
  const Folder folder("round-trip");
  for (const SolveCase& c : cases) {
    const auto solver = solver_of(c);
    solver->solve();
    solver->write_checkpoint(folder.file("a.hrad"));
    Solver other;
    other.read_checkpoint(folder.file("a.hrad"));
    CHECK(solver->state_hash() == other.state_hash());
    other.write_checkpoint(folder.file("b.hrad"));
    CHECK(bytes_of_file(folder.file("a.hrad")) == bytes_of_file(folder.file("b.hrad")));
    same_solvers(*solver, other);
    // There is nothing left to do.
    const Status status = other.solve();
    CHECK(status == Status::ok || status == Status::not_converged);
    CHECK(solver->state_hash() == other.state_hash());
    CHECK_EQUAL(other.stats().iterations, solver->stats().iterations);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(what_is_read_is_what_was_written)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
