// Ranks with little or nothing to do: more of them than patches, an emitter on one of them, other
// numbers of threads on each, two groups of ranks at once. And what they do together: every pair
// once, every request once.
#include <array>
#include <map>
#include <string>
#include <vector>

#include "support/solver_ranks.h"

namespace {

using namespace hrad_test;

void set(SolverRank& one, const char* linking, double accuracy, int threads = 1) {
  one.note(hrad_set_int(one.solver, "threads", threads));
  one.note(hrad_set_text(one.solver, "linking", linking));
  one.note(hrad_set_double(one.solver, "accuracy", accuracy));
}

// Triangles over each other, the first of which shines: rank 0 describes them.
void add_triangles(SolverRank& one, int count) {
  const double emission[] = {1, 2, 3}, dark[] = {0, 0, 0};
  hrad_material material{};
  material.struct_size = sizeof material;
  for (const double* e : {emission, dark}) {
    material.emission = e;
    one.note(hrad_add_material(one.solver, &material, nullptr));
  }
  const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1, 0, 1};
  const int64_t vertex[] = {0, 1, 2, 3, 4, 5};
  const int32_t kinds[] = {0, 1};
  one.note(hrad_add_patches(one.solver, 6, xyz, count, vertex, kinds));
}

// Everything a user may ask for.
void note_answers(SolverRank& one, int patches) {
  std::vector<double> out(3 * static_cast<size_t>(patches)), balance(12);
  const double at[] = {0.2, 0.2, 0.5}, up[] = {0, 0, 1};
  double light[3], error[3];
  one.note_hash();
  one.note(hrad_query_patches(one.solver, HRAD_RADIOSITY, HRAD_FRONT, 0, patches, out.data()));
  one.note(hrad_query_sensors(one.solver, 1, at, up, light, error));
  one.note(hrad_power_balance(one.solver, &balance[0], &balance[3], &balance[6], &balance[9]));
  for (double v : out) one.answers.push_back({HRAD_OK, std::to_string(v)});
  for (double v : balance) one.answers.push_back({HRAD_OK, std::to_string(v)});
  for (double v : light) one.answers.push_back({HRAD_OK, std::to_string(v)});
  one.note_number(static_cast<uint64_t>(one.stats().rays));
}

void more_ranks_than_patches() {
  for (int patches : {1, 2})
    for (const char* linking : {"pairs", "clusters", "rows"})
      for (const char* partition : {"grid", "cost"}) {
        std::vector<Answer> wanted;
        for (int ranks : {1, 2, 5}) {
          const auto answers = solve_together(ranks, [&](SolverRank& one) {
            set(one, linking, 0.1);
            one.note(hrad_set_text(one.solver, "partition", partition));
            add_triangles(one, patches);
            one.note(hrad_solve(one.solver));
            note_answers(one, patches);
          });
          CHECK(errors_of(answers).empty());
          if (ranks == 1) wanted = answers;
          CHECK(answers == wanted);
        }
      }
}

// Of a room one patch shines, so that all but one rank begin in the dark.
void an_emitter_on_one_rank() {
  for (const char* linking : {"pairs", "clusters", "rows"}) {
    std::vector<Answer> wanted;
    for (int ranks : {1, 4}) {
      std::vector<int32_t> owners(12, -1);
      const auto answers = solve_together(ranks, [&](SolverRank& one) {
        set(one, linking, 0.2);
        one.note(hrad_make_scene(one.solver, "furnace"));
        std::vector<double> dark(36, 0.0), bright(3, 5.0);
        one.note(hrad_set_emission(one.solver, 0, 12, dark.data()));
        one.note(hrad_set_emission(one.solver, 7, 1, bright.data()));
        one.note(hrad_solve(one.solver));
        note_answers(one, 12);
        for (int k = 0; one.rank == 0 && k < 12; ++k)
          hrad_patch_owner(one.solver, k, &owners[static_cast<size_t>(k)]);
      });
      CHECK(errors_of(answers).empty());
      if (ranks == 1) wanted = answers;
      CHECK(answers == wanted);
      if (ranks == 1) continue;
      std::map<int32_t, int> patches;
      for (int32_t owner : owners) ++patches[owner];
      CHECK_EQUAL(patches.size(), static_cast<size_t>(ranks));
    }
  }
}

// A quadrangle as two patches, seen from where its corners run counter-clockwise.
void add_quad(SolverRank& one, const std::array<double, 12>& corners, int32_t material) {
  const int64_t vertex[] = {0, 1, 2, 0, 2, 3};
  const int32_t kinds[] = {material, material};
  one.note(hrad_add_patches(one.solver, 4, corners.data(), 2, vertex, kinds));
}

// A room with two lamps that face each other across a slot, and the slot's floor, far brighter than
// all else: rank 0 describes it.
void add_slot_of_lamps(SolverRank& one) {
  const double emission[] = {3, 2, 1}, bright[] = {.8, .8, .8}, grey[] = {.5, .4, .3};
  hrad_material material{};
  material.struct_size = sizeof material;
  material.reflectance = grey;
  one.note(hrad_add_material(one.solver, &material, nullptr));
  material.reflectance = bright;
  one.note(hrad_add_material(one.solver, &material, nullptr));
  material.emission = emission;
  one.note(hrad_add_material(one.solver, &material, nullptr));
  add_quad(one, {0, 0, 0, 4, 0, 0, 4, 3, 0, 0, 3, 0}, 0);
  add_quad(one, {0, 0, 3, 0, 3, 3, 4, 3, 3, 4, 0, 3}, 0);
  add_quad(one, {0, 0, 0, 0, 0, 3, 4, 0, 3, 4, 0, 0}, 0);
  add_quad(one, {0, 3, 0, 4, 3, 0, 4, 3, 3, 0, 3, 3}, 0);
  add_quad(one, {0, 0, 0, 0, 3, 0, 0, 3, 3, 0, 0, 3}, 0);
  add_quad(one, {4, 0, 0, 4, 0, 3, 4, 3, 3, 4, 3, 0}, 0);
  add_quad(one, {1.9, 1, 1, 1.9, 2, 1, 1.9, 2, 1.5, 1.9, 1, 1.5}, 2);
  add_quad(one, {2.1, 1, 1, 2.1, 1, 1.5, 2.1, 2, 1.5, 2.1, 2, 1}, 2);
  add_quad(one, {1.9, 1, 1, 2.1, 1, 1, 2.1, 2, 1, 1.9, 2, 1}, 1);
}

// What lamps reflect of each other's light is known to all ranks from the beginning.
void lamps_that_light_each_other() {
  for (const char* linking : {"pairs", "clusters", "rows"}) {
    std::vector<Answer> wanted;
    for (int ranks : {1, 2, 3, 5}) {
      const auto answers = solve_together(ranks, [&](SolverRank& one) {
        set(one, linking, 0.1);
        add_slot_of_lamps(one);
        one.note(hrad_solve(one.solver));
        note_answers(one, 18);
      });
      CHECK(errors_of(answers).empty());
      if (ranks == 1) wanted = answers;
      CHECK(answers == wanted);
    }
  }
}

void other_threads_on_each_rank() {
  for (const char* linking : {"pairs", "clusters", "rows"}) {
    const std::string wanted = hash_of_one("cornell", linking, 0.5);
    for (const auto& threads : std::vector<std::vector<int>>{{3, 1}, {1, 4, 2}}) {
      const auto answers = solve_together(static_cast<int>(threads.size()), [&](SolverRank& one) {
        set(one, linking, 0.5, threads[static_cast<size_t>(one.rank)]);
        one.note(hrad_make_scene(one.solver, "cornell"));
        one.note(hrad_solve(one.solver));
        one.note_hash();
      });
      CHECK(last_of(answers) == wanted);
    }
  }
}

// Groups that don't know of each other, at the same time; and of one rank two solvers, one after
// the other in each call.
void two_groups_at_once() {
  const std::string cornell = hash_of_one("cornell", "rows", 0.2),
                    furnace = hash_of_one("furnace", "pairs", 0.1);
  std::string found;
  std::thread beside([&] {
    try {
      found = last_of(solve_together(3, [](SolverRank& one) {
        one.prepare("furnace", "pairs", 0.1);
        one.note(hrad_solve(one.solver));
        one.note_hash();
      }));
    } catch (const std::exception& error) {
      found = error.what();
    }
  });
  Hub other_hub(3);
  const auto answers = solve_together(3, [&](SolverRank& one) {
    SolverRank other(other_hub, 2 - one.rank);
    other.prepare("furnace", "pairs", 0.1);
    one.prepare("cornell", "rows", 0.2);
    other.note(hrad_partition(other.solver));
    one.note(hrad_solve(one.solver));
    other.note(hrad_solve(other.solver));
    one.note_hash();
    other.note_hash();
    for (const Answer& answer : other.answers) one.answers.push_back(answer);
    one.note_hash();
  });
  beside.join();
  CHECK(found == furnace);
  CHECK(last_of(answers) == cornell);
  bool seen = false;
  for (const Answer& answer : answers) seen = seen || answer.text == furnace;
  CHECK(seen);
}

// linking=pairs: what the ranks have computed together is what one computes, and messages flow.
void every_pair_once() {
  for (const char* scene : {"cornell", "furnished-room"}) {
    int64_t wanted = 0;
    for (int ranks : {1, 2, 3, 8}) {
      std::vector<int64_t> pairs(static_cast<size_t>(ranks));
      const auto answers = solve_together(ranks, [&](SolverRank& one) {
        one.prepare(scene, "pairs", 0.5);
        one.note(hrad_set_text(one.solver, "oracle", "energy"));
        one.note(hrad_set_int(one.solver, "max_iterations", 1));
        one.note(hrad_set_text(one.solver, "partition", ranks % 2 ? "grid" : "cost"));
        one.note(hrad_solve(one.solver));
        pairs[static_cast<size_t>(one.rank)] = one.stats().pairs;
      });
      CHECK(errors_of(answers).empty());
      if (ranks == 1) wanted = pairs[0];
      CHECK(wanted > 100);
      for (int64_t all : pairs) CHECK_EQUAL(all, wanted);
    }
  }
}

// Stops after every sweep.
int32_t stop_after_sweep(const hrad_progress* progress, void*) {
  return std::string(progress->stage) == "sweep" ? 1 : 0;
}

// Requests (R) go when links are made, and in no further sweep over them; updates (U) in every one.
void requests_once_a_round() {
  for (const char* linking : {"pairs", "clusters", "rows"}) {
    struct Seen {
      int64_t rounds, iterations, requests, updates;
    };
    std::vector<Seen> seen;
    const auto answers = solve_together(3, [&](SolverRank& one) {
      one.prepare("cornell", linking, 0.4);
      if (one.rank == 0) hrad_set_progress(one.solver, stop_after_sweep, nullptr);
      hrad_status status = HRAD_STOPPED;
      for (int calls = 0; status == HRAD_STOPPED && calls < 200; ++calls) {
        status = one.note(hrad_solve(one.solver));
        const hrad_stats s = one.stats();
        if (one.rank == 0) seen.push_back({s.rounds, s.iterations, s.messages[0], s.messages[1]});
      }
    });
    CHECK(errors_of(answers).empty());
    int sweeps_of_a_round = 0;
    for (size_t k = 1; k < seen.size(); ++k) {
      if (seen[k].rounds != seen[k - 1].rounds) continue;
      CHECK_EQUAL(seen[k].requests, seen[k - 1].requests);
      if (seen[k].iterations != seen[k - 1].iterations + 1 || seen[k].updates == 0) continue;
      CHECK(seen[k].updates > seen[k - 1].updates);
      ++sweeps_of_a_round;
    }
    CHECK(sweeps_of_a_round >= 3);
    CHECK(seen.back().requests > 0);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(more_ranks_than_patches),     HRAD_TEST(an_emitter_on_one_rank),
      HRAD_TEST(lamps_that_light_each_other), HRAD_TEST(other_threads_on_each_rank),
      HRAD_TEST(two_groups_at_once),          HRAD_TEST(every_pair_once),
      HRAD_TEST(requests_once_a_round),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
