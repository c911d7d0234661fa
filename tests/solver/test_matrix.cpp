// The same bits everywhere: hash and exported bytes over ranks, threads and partitions, by every
// method of linking. A sample of it as a test; with the argument `all` the whole of it, on four
// scenes, a line for each: tests/matrix.sh.
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "base/hash.h"
#include "solver/checkpoint_files.h"
#include "support/solver_ranks.h"

namespace {

using namespace hrad_test;

struct Point {
  int ranks, threads;
  const char* partition;
};

const std::string original_box = HRAD_TEST_DATA "/cli/scenes/CornellBox-Original.obj";
const char* const endings[] = {".csv", ".vtu", ".glb", ".ply", ".hrad"};

// What a user gets to hold in his hands, as one text.
std::string outcome(const std::string& scene, const char* linking, double accuracy,
                    const Point& at) {
  const Folder folder("matrix");
  const bool is_file = scene.find('/') != std::string::npos;
  const auto answers = solve_together(at.ranks, [&](SolverRank& one) {
    one.note(hrad_set_int(one.solver, "threads", at.threads));
    one.note(hrad_set_text(one.solver, "partition", at.partition));
    one.note(hrad_set_text(one.solver, "linking", linking));
    one.note(hrad_set_double(one.solver, "accuracy", accuracy));
    one.note(is_file ? hrad_load_scene(one.solver, scene.c_str())
                     : hrad_make_scene(one.solver, scene.c_str()));
    one.note(hrad_solve(one.solver));
    for (const char* ending : endings) {
      const std::string path = folder.file(std::string("out") + ending);
      one.note(std::strcmp(ending, ".hrad") == 0 ? hrad_write_checkpoint(one.solver, path.c_str())
                                                 : hrad_export(one.solver, path.c_str()));
    }
    one.note_hash();
  });
  CHECK(errors_of(answers).empty());
  std::string text = "hash " + last_of(answers);
  for (const char* ending : endings) {
    const std::string bytes = bytes_of_file(folder.file(std::string("out") + ending));
    CHECK(bytes.size() > 100);
    hrad::Hasher hash;
    for (unsigned char byte : bytes) hash.add(uint64_t{byte});
    text += std::string(" ") + ending + " " + std::to_string(hash.value());
  }
  return text;
}

void check_points(const std::string& scene, const char* linking, double accuracy,
                  const std::vector<Point>& points) {
  const std::string wanted = outcome(scene, linking, accuracy, {1, 1, "cost"});
  for (const Point& at : points) {
    const std::string other = outcome(scene, linking, accuracy, at);
    if (other == wanted) continue;
    failed(__FILE__, __LINE__,
           scene + " by " + linking + " on " + std::to_string(at.ranks) + " ranks of " +
               std::to_string(at.threads) + " threads by " + at.partition + ": " + other +
               ", alone: " + wanted);
  }
}

void a_sample_of_it() {
  const std::vector<Point> points = {{2, 1, "grid"}, {3, 2, "cost"}, {8, 1, "grid"}};
  for (const char* linking : {"pairs", "clusters", "rows"}) {
    check_points("cornell", linking, 0.5, points);
    check_points(original_box, linking, 0.5, {{2, 4, "cost"}, {5, 1, "grid"}});
  }
}

// Returns the exit code.
int all_of_it() {
  std::vector<Point> points;
  for (int ranks : {1, 2, 3, 4, 5, 8})
    for (int threads : {1, 2, 4})
      for (const char* partition : {"grid", "cost"}) points.push_back({ranks, threads, partition});
  const struct {
    std::string scene;
    double accuracy;
  } scenes[] = {{"cornell", 0.2}, {"furnished-room", 0.3}, {"building", 0.5}, {original_box, 0.2}};
  int failures = 0;
  for (const auto& s : scenes)
    for (const char* linking : {"pairs", "clusters", "rows"}) {
      try {
        check_points(s.scene, linking, s.accuracy, points);
        std::printf("%s by %s: the same at %zu points\n", s.scene.c_str(), linking, points.size());
      } catch (const std::exception& error) {
        std::printf("FAILED: %s\n", error.what());
        ++failures;
      }
      std::fflush(stdout);
    }
  return failures > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "all") == 0) return all_of_it();
  const CMUnitTest tests[] = {HRAD_TEST(a_sample_of_it)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
