// What one rank is told otherwise than the others: all ranks answer the same, none of them keeps a
// part of what failed, and they go on together.
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/checkpoint_files.h"
#include "support/solver_ranks.h"

namespace {

using namespace hrad_test;

constexpr int ranks = 3;

// A value that one rank refuses is set on none.
void no_rank_keeps_a_parameter_that_one_refuses() {
  for (int other = 0; other < ranks; ++other) {
    const auto answers = solve_together(ranks, [&](SolverRank& one) {
      const bool is_it = one.rank == other;
      int64_t seed = 0, limit = -1;
      double accuracy = 0;
      char text[32] = "";
      one.note(hrad_set_int(one.solver, "seed", is_it ? -5 : 7));
      one.note(hrad_set_int(one.solver, is_it ? nullptr : "max_memory", 12345));
      one.note(hrad_set_double(one.solver, "accuracy", is_it ? 2.0 : 0.25));
      one.note(hrad_set_text(one.solver, "linking", is_it ? "by hand" : "pairs"));
      one.note(hrad_get_int(one.solver, "seed", &seed));
      one.note(hrad_get_int(one.solver, "max_memory", &limit));
      one.note(hrad_get_double(one.solver, "accuracy", &accuracy));
      one.note(hrad_get_text(one.solver, "linking", text, sizeof text, nullptr));
      const bool untouched =
          seed == 1 && limit == 0 && accuracy == 0.02 && std::string(text) == "auto";
      one.note_number(untouched ? 1 : 0);
    });
    const auto errors = errors_of(answers);
    CHECK_EQUAL(errors.size(), size_t{4});
    for (const Answer& error : errors) CHECK_EQUAL(error.status, HRAD_ERROR_ARGUMENT);
    CHECK(errors[0].text.find("seed") != std::string::npos);
    CHECK(last_of(answers) == "1");
  }
}

// Parameters that are valid but not the same are told by name when they begin to matter, and can be
// put right.
void parameters_that_differ_are_named() {
  const std::string wanted = hash_of_one("furnace", "pairs", 0.1);
  for (int other = 0; other < ranks; ++other)
    for (const bool partitioned : {false, true}) {
      const auto answers = solve_together(ranks, [&](SolverRank& one) {
        one.prepare("furnace", "pairs", 0.1);
        if (partitioned) one.note(hrad_partition(one.solver));
        one.note(hrad_set_int(one.solver, "seed", one.rank == other ? 7 : 1));
        one.note(hrad_solve(one.solver));
        one.note(hrad_set_int(one.solver, "seed", 1));
        one.note(hrad_solve(one.solver));
        one.note_hash();
      });
      check_one_error(answers, HRAD_ERROR_ARGUMENT, "parameter 'seed'");
      CHECK(last_of(answers) == wanted);
    }
}

// Run parameters are each rank's own.
void run_parameters_may_differ() {
  const std::string wanted = hash_of_one("cornell", "rows", 0.2);
  const auto answers = solve_together(ranks, [&](SolverRank& one) {
    one.prepare("cornell", "rows", 0.2);
    one.note(hrad_set_int(one.solver, "threads", 1 + one.rank));
    one.note(hrad_set_int(one.solver, "max_memory", one.rank == 1 ? 0 : int64_t{1} << 40));
    one.note(hrad_set_int(one.solver, "smt", one.rank % 2));
    one.note(hrad_set_int(one.solver, "resumable", one.rank == 2 ? 1 : 0));
    one.note(hrad_solve(one.solver));
    one.note_hash();
  });
  CHECK(errors_of(answers).empty());
  CHECK(last_of(answers) == wanted);
}

void another_scene_on_one_rank() {
  for (const bool partition_first : {false, true}) {
    const auto answers = solve_together(ranks, [&](SolverRank& one) {
      one.note(hrad_set_int(one.solver, "threads", 1));
      one.note(hrad_make_scene(one.solver, one.rank == 2 ? "furnace" : "cornell"));
      one.note(partition_first ? hrad_partition(one.solver) : hrad_solve(one.solver));
    });
    check_one_error(answers, HRAD_ERROR_ARGUMENT, "another scene");
  }
}

// What one rank can't plan none plans, before the partition; after it each plans by itself.
void plans_are_made_together_or_alone() {
  const auto answers = solve_together(ranks, [&](SolverRank& one) {
    const bool is_it = one.rank == 1;
    one.note(hrad_make_scene(one.solver, "furnace"));
    std::vector<int32_t> owner(64, -7);
    one.note(hrad_plan_partition(one.solver, is_it ? nullptr : "cost", 2, owner.data(), nullptr));
    one.note(hrad_export_partition(one.solver, is_it ? "metis" : "cost", 2, "/none/a.vtu"));
    one.note(hrad_set_int(one.solver, "max_memory", is_it ? 1 : 0));
    one.note(hrad_plan_partition(one.solver, "cost", 2, owner.data(), nullptr));
    one.note(hrad_set_int(one.solver, "max_memory", 0));
    one.note_number(owner[0] == -7);
    one.note(hrad_partition(one.solver));
    const hrad_status alone =
        hrad_plan_partition(one.solver, is_it ? nullptr : "cost", 2, owner.data(), nullptr);
    one.note_number((alone == HRAD_OK) != is_it);
  });
  const auto errors = errors_of(answers);
  CHECK_EQUAL(errors.size(), size_t{3});
  CHECK_EQUAL(errors[0].status, HRAD_ERROR_ARGUMENT);
  CHECK_EQUAL(errors[1].status, HRAD_ERROR_ARGUMENT);
  CHECK_EQUAL(errors[2].status, HRAD_ERROR_MEMORY);
  for (const Answer& answer : answers) CHECK(answer.text != "0");
}

// What fails on one rank changes nothing on the others.
void nobody_keeps_a_lock_or_a_count_that_one_refuses() {
  const Folder folder("ranks-arguments");
  const auto answers = solve_together(ranks, [&](SolverRank& one) {
    const bool is_it = one.rank == 2;
    one.prepare("furnace", "rows", 0.4);
    one.note_number(one.stats().ranks == ranks);
    one.note(hrad_export(one.solver, folder.file("scene.obj").c_str()));  // needs no solve
    one.note(hrad_export(one.solver, folder.file("scene.csv").c_str()));
    one.note(hrad_solve(one.solver));
    int64_t count = -7;
    one.note(hrad_leaf_count(one.solver, is_it ? nullptr : &count));
    one.note_number(count == -7);
    one.note(hrad_lock_checkpoint(one.solver, folder.file("a.hrad").c_str()));
    one.note(hrad_lock_checkpoint(one.solver, is_it ? nullptr : folder.file("b.hrad").c_str()));
  });
  const auto errors = errors_of(answers);
  CHECK_EQUAL(errors.size(), size_t{3});
  CHECK_EQUAL(errors[0].status, HRAD_ERROR_STATE);
  CHECK_EQUAL(errors[1].status, HRAD_ERROR_ARGUMENT);
  CHECK_EQUAL(errors[2].status, HRAD_ERROR_ARGUMENT);
  for (const Answer& answer : answers) CHECK(answer.text != "0");
  CHECK(std::ifstream(folder.file("scene.obj")).good());
  CHECK(!std::ifstream(folder.file("b.hrad.lock")).good());
}

// Rank 0 describes the scene, the others need nothing in their hands.
void only_rank_0_has_a_scene() {
  const Folder folder("ranks-arguments");
  std::ofstream(folder.file("bad.obj")) << "v 0 0 0\nv 1 0 0\nf 1 2 3\n";
  std::ofstream(folder.file("good.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto answers = solve_together(ranks, [&](SolverRank& one) {
    const bool first = one.rank == 0;
    const auto path = [&](const char* name) { return first ? folder.file(name) : std::string(); };
    one.note(hrad_load_scene(one.solver, first ? folder.file("none.obj").c_str() : nullptr));
    one.note(hrad_load_scene(one.solver, first ? nullptr : "ignored.obj"));
    one.note(hrad_load_scene(one.solver, first ? path("bad.obj").c_str() : nullptr));
    one.note_patches();
    one.note(hrad_load_scene(one.solver, first ? path("good.obj").c_str() : nullptr));
    one.note_patches();
    const double xyz[] = {0, 0, 1, 0, 1, 1, 1, 0, 1};
    const int64_t wrong[] = {0, 1, 3}, vertex[] = {0, 1, 2};
    const double emission[] = {1, 2, 3};
    hrad_material material{};
    material.struct_size = sizeof material;
    material.emission = emission;
    int32_t number = -1;
    one.note(hrad_add_material(one.solver, first ? &material : nullptr, &number));
    one.note_number(static_cast<uint64_t>(number));
    one.note(hrad_add_patches(one.solver, first ? 3 : 0, first ? xyz : nullptr, first ? 1 : 0,
                              first ? wrong : nullptr, nullptr));
    one.note_patches();
    one.note(hrad_add_patches(one.solver, first ? 3 : -1, first ? xyz : nullptr, first ? 1 : -1,
                              first ? vertex : nullptr, nullptr));
    one.note(
        hrad_set_emission(one.solver, first ? 1 : -9, first ? 1 : 0, first ? emission : nullptr));
    one.note_patches();
    one.note(hrad_set_int(one.solver, "threads", 1));
    one.note(hrad_solve(one.solver));
    one.note_hash();
  });
  const auto errors = errors_of(answers);
  CHECK_EQUAL(errors.size(), size_t{4});
  CHECK_EQUAL(errors[0].status, HRAD_ERROR_FILE);
  CHECK_EQUAL(errors[1].status, HRAD_ERROR_ARGUMENT);
  CHECK_EQUAL(errors[2].status, HRAD_ERROR_SCENE);
  CHECK(errors[2].text.find("bad.obj:3") != std::string::npos);
  CHECK_EQUAL(errors[3].status, HRAD_ERROR_ARGUMENT);
  std::vector<std::string> sizes;
  for (const Answer& answer : answers)
    if (answer.status == HRAD_OK && answer.text.size() == 1) sizes.push_back(answer.text);
  CHECK(sizes == (std::vector<std::string>{"0", "1", "1", "1", "2"}));
}

// Queries are each rank's own; a bad one fails them all, and nobody's output is touched.
void one_query_fails_for_all() {
  const auto answers = solve_together(ranks, [&](SolverRank& one) {
    double out[3] = {-7, -7, -7};
    uint64_t hash = 0;
    one.note(hrad_state_hash(one.solver, &hash));
    one.prepare("furnace", "rows", 0.2);
    one.note(hrad_solve(one.solver));
    one.note(
        hrad_query_patches(one.solver, HRAD_RADIOSITY, HRAD_FRONT, one.rank == 1 ? 99 : 0, 1, out));
    CHECK_EQUAL(out[0], -7.0);
    one.note(hrad_state_hash(one.solver, one.rank == 2 ? nullptr : &hash));
    one.note(hrad_query_patches(one.solver, HRAD_RADIOSITY, HRAD_FRONT, 0, one.rank == 1 ? 0 : 1,
                                one.rank == 1 ? nullptr : out));
    CHECK((out[0] != -7) == (one.rank != 1));
    // Wrong points and leaves of another rank.
    out[0] = -7;
    const int64_t patch = one.rank == 1 ? 1000 : 0;
    const double uv[] = {0.25, 0.25};
    one.note(hrad_query_points(one.solver, HRAD_RADIOSITY, HRAD_FRONT, 1, &patch, uv, out));
    one.note(hrad_query_leaves(one.solver, one.rank == 2 ? -1 : 0, 1, nullptr, nullptr, nullptr,
                               nullptr, out, nullptr));
    CHECK_EQUAL(out[0], -7.0);
  });
  const auto errors = errors_of(answers);
  CHECK_EQUAL(errors.size(), size_t{5});
  CHECK_EQUAL(errors[0].status, HRAD_ERROR_STATE);
  CHECK_EQUAL(errors[1].status, HRAD_ERROR_ARGUMENT);
  CHECK_EQUAL(errors[2].status, HRAD_ERROR_ARGUMENT);
  CHECK_EQUAL(errors[3].status, HRAD_ERROR_ARGUMENT);
  CHECK_EQUAL(errors[4].status, HRAD_ERROR_ARGUMENT);
}

// Callbacks that throw, each on one rank: all stop and say so, and can go on.
void throw_log(int32_t, const char*, void*) { throw std::runtime_error("from the log"); }
int32_t throw_progress(const hrad_progress*, void*) { throw std::runtime_error("from progress"); }

void callbacks_that_throw() {
  const std::string wanted = hash_of_one("cornell", "pairs", 0.4);
  for (int other = 0; other < ranks; ++other) {
    const auto answers = solve_together(ranks, [&](SolverRank& one) {
      one.prepare("cornell", "pairs", 0.4);
      // So many threads are warned of.
      one.note(hrad_set_int(one.solver, "threads", 64));
      if (one.rank == other) hrad_set_log(one.solver, throw_log, nullptr, HRAD_LOG_DEBUG);
      one.note(hrad_partition(one.solver));
      hrad_set_log(one.solver, nullptr, nullptr, HRAD_LOG_DEBUG);
      one.note(hrad_set_int(one.solver, "threads", 1));
      one.note(hrad_add_patches(one.solver, 0, nullptr, 0, nullptr, nullptr));  // it is still open
      one.note(hrad_partition(one.solver));
      one.note(hrad_solve(one.solver));
      one.note_hash();
    });
    check_one_error(answers, HRAD_ERROR_INTERNAL, "the log function threw");
    CHECK(last_of(answers) == wanted);
  }
  const auto answers = solve_together(ranks, [&](SolverRank& one) {
    one.prepare("cornell", "pairs", 0.4);
    if (one.rank == 0) hrad_set_progress(one.solver, throw_progress, nullptr);
    one.note(hrad_solve(one.solver));
    hrad_set_progress(one.solver, nullptr, nullptr);
    one.note(hrad_solve(one.solver));
    one.note_hash();
  });
  check_one_error(answers, HRAD_ERROR_INTERNAL, "the progress function threw");
  CHECK(last_of(answers) == wanted);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(no_rank_keeps_a_parameter_that_one_refuses),
      HRAD_TEST(parameters_that_differ_are_named),
      HRAD_TEST(run_parameters_may_differ),
      HRAD_TEST(another_scene_on_one_rank),
      HRAD_TEST(plans_are_made_together_or_alone),
      HRAD_TEST(nobody_keeps_a_lock_or_a_count_that_one_refuses),
      HRAD_TEST(only_rank_0_has_a_scene),
      HRAD_TEST(one_query_fails_for_all),
      HRAD_TEST(callbacks_that_throw),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
