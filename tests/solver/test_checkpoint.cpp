// Checkpoints: what is read is what was written, for every method; the bytes don't depend on
// threads; what doesn't fit is refused.
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
    {"cornell", "pairs", "error", 0.4},
    {"cornell", "pairs", "energy", 0.4},
    {"cornell", "clusters", "error", 0.5},
    {"furnace", "auto", "error", 0.2, "points", 1},
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

// A sliver part of which is within a solid has points of its own, whose places are finite.
void slivers_in_solids_are_read_back() {
  const Folder folder("checkpoint");
  for (double width : {1e-2, 1e-7, 1e-8, 1e-11}) {
    Solver solver, other;
    solver.add_material({"wall", {0.5, 0.5, 0.5}, {0, 0, 0}});
    solver.add_material({"lamp", {0.5, 0.5, 0.5}, {100, 100, 100}});
    const double box[] = {1, -1, 0, 3, -1, 0, 1, 1, 0, 3, 1, 0,
                          1, -1, 1, 3, -1, 1, 1, 1, 1, 3, 1, 1};
    const int64_t faces[] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                             2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    solver.add_patches(8, box, 12, faces, nullptr);
    const double rest[] = {0,  0,    0.5, 4,  0,    0.5, 2, width, 0.5, 0, -2,
                           3,  0,    2,   3,  4,    2,   3, 4,     -2,  3, -2,
                           -3, -0.5, 6,   -3, -0.5, 6,   3, -0.5,  -2,  3, -0.5};
    const int64_t corners[] = {0, 1, 2, 3, 4, 5, 3, 5, 6, 7, 8, 9, 7, 9, 10};
    const int32_t kinds[] = {0, 1, 1, 0, 0};
    solver.add_patches(11, rest, 5, corners, kinds);
    solver.set_text("linking", "rows");
    solver.set_double("accuracy", 0.2);
    CHECK(static_cast<int>(solver.solve()) >= 0);
    solver.write_checkpoint(folder.file("sliver.hrad"));
    other.read_checkpoint(folder.file("sliver.hrad"));
    CHECK(solver.state_hash() == other.state_hash());
  }
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

void the_bytes_are_the_same_for_any_threads() {
  const Folder folder("threads");
  for (const SolveCase& c : {cases[2], SolveCase{"cornell", "pairs", "error", 0.4}, cases[5]}) {
    std::string first;
    for (int threads : {1, 2, 4}) {
      const auto solver = solver_of(c, threads);
      solver->solve();
      solver->write_checkpoint(folder.file("a.hrad"));
      const std::string bytes = bytes_of_file(folder.file("a.hrad"));
      if (threads == 1) first = bytes;
      CHECK(bytes == first);
    }
  }
}

void a_scene_without_a_solve_is_kept_open() {
  const Folder folder("open");
  const auto solver = solver_of(cases[0]);
  solver->write_checkpoint(folder.file("scene.hrad"));
  Solver other;
  other.read_checkpoint(folder.file("scene.hrad"));
  CHECK(!other.solved());
  CHECK_EQUAL(other.scene().patch_count(), solver->scene().patch_count());
  other.add_material({});
  other.set_int("seed", 2);
  other.set_int("seed", 1);
  CHECK(other.solve() == Status::ok);
  solver->solve();
  CHECK(other.state_hash() == solver->state_hash());
  // An empty solver is a state like any other.
  Solver empty, also_empty;
  empty.write_checkpoint(folder.file("empty.hrad"));
  also_empty.read_checkpoint(folder.file("empty.hrad"));
  CHECK_EQUAL(also_empty.scene().patch_count(), 0);
}

void the_parameters_of_the_file_hold() {
  const Folder folder("parameters");
  const auto solver = solver_of(cases[0]);
  solver->solve();
  solver->write_checkpoint(folder.file("a.hrad"));
  Solver other;
  other.set_double("accuracy", 0.3);
  other.set_int("threads", 2);
  other.read_checkpoint(folder.file("a.hrad"));
  CHECK(other.params().accuracy == 0.1);
  CHECK_EQUAL(other.params().threads, 2);
  CHECK_FAILS(other.set_int("seed", 7), Status::state, "'seed' is 1");
  CHECK_FAILS(other.set_int("seed", 7), Status::state, "7");
  CHECK_FAILS(other.set_double("accuracy", 0.2), Status::state, "0.1");
  other.set_double("accuracy", 0.05);
  CHECK(other.solve() == Status::ok);
  solver->set_double("accuracy", 0.05);
  CHECK(solver->solve() == Status::ok);
  CHECK(solver->state_hash() == other.state_hash());
}

void what_can_not_be_read_changes_nothing() {
  const Folder folder("refused");
  const auto solver = solver_of(cases[0]), other = solver_of({"furnace", "rows", "error", 0.2});
  solver->solve();
  other->solve();
  solver->write_checkpoint(folder.file("a.hrad"));
  other->write_checkpoint(folder.file("b.hrad"));
  const uint64_t hash = solver->state_hash();
  const std::vector<double> answers = answers_of(*solver);
  CHECK_FAILS(solver->read_checkpoint(folder.file("b.hrad")), Status::state,
              "12 patches and the scene 36");
  CHECK_FAILS(solver->read_checkpoint(folder.file("none.hrad")), Status::file, "none.hrad");
  CHECK_FAILS(solver->read_checkpoint(folder.file("")), Status::file, "");
  write_bytes(folder.file("cut.hrad"), bytes_of_file(folder.file("a.hrad")).substr(0, 5000));
  CHECK_FAILS(solver->read_checkpoint(folder.file("cut.hrad")), Status::format, "cut short");
  Solver small;
  small.set_int("max_memory", 50000);
  CHECK_FAILS(small.read_checkpoint(folder.file("a.hrad")), Status::memory, "max_memory");
  CHECK_EQUAL(small.scene().patch_count(), 0);
  CHECK(small.params().accuracy == hrad::Params().accuracy);
  CHECK(solver->state_hash() == hash && answers_of(*solver) == answers);
  // The same scene with other light is another scene.
  const double emission[3] = {1, 2, 3};
  const auto lit = solver_of(cases[0]);
  lit->set_emission(5, 1, emission);
  CHECK_FAILS(lit->read_checkpoint(folder.file("a.hrad")), Status::state,
              "the emission of patch 5 in band 0 is 0 in the file and 1 in the scene");
}

void older_files_are_kept() {
  const Folder folder("older");
  const auto solver = solver_of(cases[0]);
  const auto write = [&](int64_t keep, double accuracy) {
    solver->set_int("checkpoint_keep", keep);
    solver->set_double("accuracy", accuracy);
    solver->write_checkpoint(folder.file("a.hrad"));
    return bytes_of_file(folder.file("a.hrad"));
  };
  const std::string first = write(0, 0.5), second = write(0, 0.4);
  CHECK_EQUAL(folder.count(), 1);
  const std::string third = write(1, 0.3);
  CHECK(bytes_of_file(folder.file("a.hrad.prev")) == second);
  const std::string fourth = write(3, 0.2);
  CHECK(bytes_of_file(folder.file("a.hrad.prev")) == third);
  CHECK(bytes_of_file(folder.file("a.hrad.prev2")) == second);
  CHECK_EQUAL(folder.count(), 3);
  write(3, 0.1);
  write(3, 0.05);
  CHECK(bytes_of_file(folder.file("a.hrad.prev3")) == third);
  CHECK_EQUAL(folder.count(), 4);
  CHECK(first != second);
}

void a_second_writer_is_refused() {
  const Folder folder("lock");
  const auto one = solver_of(cases[0]), other = solver_of(cases[0]);
  one->lock_checkpoint(folder.file("a.hrad"));
  CHECK_FAILS(other->write_checkpoint(folder.file("a.hrad")), Status::file, "another process");
  CHECK_FAILS(other->lock_checkpoint(folder.file("a.hrad")), Status::file, "another process");
  one->write_checkpoint(folder.file("a.hrad"));
  one->lock_checkpoint(folder.file("a.hrad"));
  CHECK_FAILS(other->write_checkpoint(folder.file("./a.hrad")), Status::file, "another process");
  one->lock_checkpoint(folder.file("b.hrad"));
  other->write_checkpoint(folder.file("a.hrad"));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(what_is_read_is_what_was_written),
                              HRAD_TEST(the_bytes_are_the_same_for_any_threads),
                              HRAD_TEST(a_scene_without_a_solve_is_kept_open),
                              HRAD_TEST(the_parameters_of_the_file_hold),
                              HRAD_TEST(what_can_not_be_read_changes_nothing),
                              HRAD_TEST(older_files_are_kept),
                              HRAD_TEST(slivers_in_solids_are_read_back),
                              HRAD_TEST(a_second_writer_is_refused)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
