// Memory that runs out on one rank alone (its max_memory): all ranks fail with one message,
// wherever that meets them, and go on as if nothing had been asked once there is room.
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "solver/checkpoint_files.h"
#include "support/solver_ranks.h"

namespace {

using namespace hrad_test;

constexpr int ranks = 3;

struct SolveOf {
  const char *scene, *linking;
  double accuracy;
};

// Stops a solve where a stage is under way.
struct StopAt {
  std::string stage;
  bool reached = false, off = false;
  static int32_t asked(const hrad_progress* progress, void* user) {
    auto* stop = static_cast<StopAt*>(user);
    if (stop->off || stop->stage != progress->stage) return 0;
    stop->reached = true;
    return 1;
  }
};

// What is short on one rank from the beginning: too little for the ray engine, for the first links,
// for refined ones.
void limits_from_the_beginning() {
  for (const SolveOf& c : {SolveOf{"cornell", "pairs", 0.4}, SolveOf{"cornell", "clusters", 0.5},
                           SolveOf{"cornell", "rows", 0.2}}) {
    int64_t needed = 0;
    const std::string wanted = last_of(solve_together(ranks, [&](SolverRank& one) {
      one.prepare(c.scene, c.linking, c.accuracy);
      one.note(hrad_solve(one.solver));
      const hrad_stats stats = one.stats();
      if (one.rank == 0) needed = stats.link_bytes + stats.node_bytes;
      one.note_hash();
    }));
    int failures = 0, other = 0;
    for (int64_t limit = 1000; limit < 2 * needed; limit *= 3) {
      other = (other + 1) % ranks;
      const auto answers = solve_together(ranks, [&](SolverRank& one) {
        one.prepare(c.scene, c.linking, c.accuracy);
        one.note(hrad_set_int(one.solver, "threads", 1 + one.rank % 2));
        one.note(hrad_set_int(one.solver, "max_memory", one.rank == other ? limit : 0));
        one.note(hrad_solve(one.solver));
        one.note(hrad_set_int(one.solver, "max_memory", 0));
        one.note(hrad_solve(one.solver));
        one.note_hash();
      });
      CHECK(last_of(answers) == wanted);
      if (errors_of(answers).empty()) continue;
      check_one_error(answers, HRAD_ERROR_MEMORY, "max_memory");
      ++failures;
    }
    CHECK(failures > 3);
  }
}

// What becomes short while a stage is under way: its next request fails.
void limits_in_every_stage() {
  std::set<std::string> stages_met;
  for (const SolveOf& c : {SolveOf{"cornell", "pairs", 0.4}, SolveOf{"cornell", "clusters", 0.5},
                           SolveOf{"cornell", "rows", 0.2}}) {
    const std::string wanted = hash_of_one(c.scene, c.linking, c.accuracy);
    for (const char* stage : {"linking", "refine", "sweep"})
      for (int other : {0, ranks - 1}) {
        StopAt stop{stage};
        const auto answers = solve_together(ranks, [&](SolverRank& one) {
          one.prepare(c.scene, c.linking, c.accuracy);
          if (one.rank == 0) hrad_set_progress(one.solver, StopAt::asked, &stop);
          const hrad_status status = one.note(hrad_solve(one.solver));
          if (status == HRAD_STOPPED) {
            if (one.rank == 0) stop.off = true;
            one.note(hrad_set_int(one.solver, "max_memory", one.rank == other ? 1 : 0));
            one.note(hrad_solve(one.solver));
            one.note(hrad_set_int(one.solver, "max_memory", 0));
            one.note(hrad_solve(one.solver));
          }
          one.note_hash();
        });
        CHECK(last_of(answers) == wanted);
        if (!stop.reached) continue;
        check_one_error(answers, HRAD_ERROR_MEMORY, "max_memory");
        stages_met.insert(stage);
      }
  }
  CHECK_EQUAL(stages_met.size(), size_t{3});
}

// The partition is made by all or by none: the scene stays open.
void limits_of_the_partition() {
  const std::string wanted = hash_of_one("furnished-room", "rows", 0.4);
  int failures = 0;
  for (int64_t limit = 1000; failures < 30; limit = limit * 5 / 4) {
    const auto answers = solve_together(ranks, [&](SolverRank& one) {
      one.prepare("furnished-room", "rows", 0.4);
      one.note(hrad_set_int(one.solver, "max_memory", one.rank == 1 ? limit : 0));
      one.note(hrad_partition(one.solver));
    });
    if (errors_of(answers).empty()) break;
    check_one_error(answers, HRAD_ERROR_MEMORY, "max_memory");
    ++failures;
    if (failures % 3 != 0) continue;
    const auto again = solve_together(ranks, [&](SolverRank& one) {
      int32_t owner = 0;
      one.prepare("furnished-room", "rows", 0.4);
      one.note(hrad_set_int(one.solver, "max_memory", one.rank == 1 ? limit : 0));
      one.note(hrad_partition(one.solver));
      one.note(hrad_patch_owner(one.solver, 0, &owner));
      one.note(hrad_set_int(one.solver, "max_memory", 0));
      one.note(hrad_set_text(one.solver, "visibility", "builtin"));
      one.note(hrad_solve(one.solver));
      one.note_hash();
    });
    CHECK_EQUAL(errors_of(again).size(), size_t{2});
    CHECK(last_of(again) == wanted);
  }
  CHECK(failures > 5);
}

// A checkpoint that one rank has no room for is read by none: the solvers keep what they had.
void limits_of_reading() {
  const Folder folder("ranks-memory");
  const std::string path = folder.file("solved.hrad"), alone = folder.file("scene.hrad");
  const SolveOf c{"cornell", "rows", 0.2};
  const std::string wanted = last_of(solve_together(ranks, [&](SolverRank& one) {
    one.prepare(c.scene, c.linking, c.accuracy);
    one.note(hrad_write_checkpoint(one.solver, alone.c_str()));
    one.note(hrad_solve(one.solver));
    one.note(hrad_write_checkpoint(one.solver, path.c_str()));
    one.note_hash();
  }));
  for (const std::string& file : {path, alone}) {
    int failures = 0, other = 0;
    for (int64_t limit = 1000; failures < 60; limit = limit * 3 / 2) {
      other = (other + 1) % ranks;
      const auto answers = solve_together(ranks, [&](SolverRank& one) {
        one.prepare(c.scene, "pairs", 0.5);
        one.note(hrad_solve(one.solver));
        one.note_hash();
        one.note(hrad_set_int(one.solver, "max_memory", one.rank == other ? limit : 0));
        const hrad_status status = one.note(hrad_read_checkpoint(one.solver, file.c_str()));
        one.note(hrad_set_int(one.solver, "max_memory", 0));
        if (status < 0) {
          one.note_hash();  // that of before
          one.note(hrad_read_checkpoint(one.solver, file.c_str()));
        }
        one.note(hrad_solve(one.solver));
        one.note_hash();
      });
      CHECK(last_of(answers) == wanted);
      if (errors_of(answers).empty()) break;
      check_one_error(answers, HRAD_ERROR_MEMORY, "max_memory");
      std::vector<std::string> hashes;
      for (const Answer& answer : answers)
        if (answer.text.size() > 9 && answer.status == HRAD_OK) hashes.push_back(answer.text);
      CHECK(hashes.size() == 3 && hashes[0] == hashes[1]);
      ++failures;
    }
    CHECK(failures > 1);
  }
}

// A file that is damaged, or not there, or of another scene.
void files_that_can_not_be_read() {
  const Folder folder("ranks-memory");
  const std::string good = folder.file("good.hrad"), bad = folder.file("bad.hrad");
  const auto answers = solve_together(ranks, [&](SolverRank& one) {
    one.prepare("furnace", "rows", 0.2);
    one.note(hrad_solve(one.solver));
    one.note(hrad_write_checkpoint(one.solver, good.c_str()));
    if (one.rank == 0) {
      std::string bytes = bytes_of_file(good);
      bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
      write_bytes(bad, bytes);
    }
    one.note_hash();
    one.note(hrad_read_checkpoint(one.solver, bad.c_str()));
    one.note(hrad_read_checkpoint(one.solver, folder.file("none.hrad").c_str()));
    one.note(hrad_read_checkpoint(one.solver, one.rank == 1 ? nullptr : good.c_str()));
    // Only rank 0 opens the file.
    one.note(hrad_read_checkpoint(one.solver, one.rank == 0 ? good.c_str() : "elsewhere.hrad"));
    one.note_hash();
  });
  const auto errors = errors_of(answers);
  CHECK_EQUAL(errors.size(), size_t{3});
  CHECK_EQUAL(errors[0].status, HRAD_ERROR_FORMAT);
  CHECK_EQUAL(errors[1].status, HRAD_ERROR_FILE);
  CHECK_EQUAL(errors[2].status, HRAD_ERROR_ARGUMENT);
  const auto other = solve_together(ranks, [&](SolverRank& one) {
    one.prepare("cornell", "rows", 0.4);
    one.note(hrad_read_checkpoint(one.solver, good.c_str()));
  });
  check_one_error(other, HRAD_ERROR_STATE, "another scene");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(limits_from_the_beginning),  HRAD_TEST(limits_in_every_stage),
      HRAD_TEST(limits_of_the_partition),    HRAD_TEST(limits_of_reading),
      HRAD_TEST(files_that_can_not_be_read),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
