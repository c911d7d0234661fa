// Memory that ends: the n-th allocation of a small solve fails, for every n or a sample. The call
// says MEMORY and why, nothing is lost, and the same solver then gives the same bits as one that
// never failed.
#include <hrad/hrad.h>
#include <stdlib.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/allocation.h"
#include "support/check.h"
#include "support/thorough.h"

namespace {

std::atomic<int64_t> allocations_left{-1};  // before one fails; negative: none fails
std::atomic<int64_t> living{0};             // blocks that were not given back

}  // namespace

bool hrad_test::may_allocate() {
  if (allocations_left.load() < 0) return true;
  // The one that reaches 0 fails, and no other: what follows finds memory again.
  return allocations_left.fetch_sub(1) != 0;
}
void hrad_test::note_allocated(void*) { ++living; }
void hrad_test::note_given_back(void*) { --living; }

namespace {

struct Folder {
  std::string path;
  Folder() {
    char name[] = "/tmp/hrad_test_allocation_XXXXXX";
    CHECK(mkdtemp(name) != nullptr);
    path = name;
    std::ofstream(path + "/a.mtl") << "newmtl lamp\nKd 0.5\nKe 1 1 1\nmap_Kd x.png\n";
    std::ofstream(path + "/a.obj") << "mtllib a.mtl none.mtl\nv 0.4 0.4 0.9\nv 0.4 0.6 0.9\n"
                                      "v 0.6 0.6 0.9\nv 0.6 0.4 0.9\nusemtl lamp\nf 1 2 3 4\n"
                                      "f 1 2 2\nf 1 2 3\nusemtl none\nf 4 3 2\nl 1 2\n";
  }
  ~Folder() {
    if (std::system(("rm -rf '" + path + "'").c_str()) != 0) std::perror("rm");
  }
};

// What a program does with a solver, step by step.
class Program {
 public:
  // linking: by pairs with no smaller elements than the patches, for the solve is to be made a
  // thousand times; or another way, coarsely.
  explicit Program(const Folder& folder, const char* linking = "pairs")
      : linking_(linking),
        scene_(folder.path + "/a.obj"),
        table_(folder.path + "/a.csv"),
        checkpoint_(folder.path + "/a.hrad") {}
  ~Program() { hrad_destroy(&solver_); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  static constexpr int steps = 18, solve_step = 6;

  // A new solver with which the steps before this one are done.
  void begin(int number) {
    hrad_destroy(&solver_);
    for (int i = 0; i < number; ++i) CHECK_EQUAL(step(i), HRAD_OK);
  }

  hrad_status step(int number) {
    static const double xyz[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                                   0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    static const int64_t vertex[36] = {0, 1, 2, 0, 2, 3, 4, 7, 6, 4, 6, 5, 0, 4, 5, 0, 5, 1,
                                       1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0};
    static const double middle[3] = {0.5, 0.5, 0.5}, uv[2] = {0.2, 0.2};
    static const int64_t patch = 1;
    double out[64];
    char text[256];
    switch (number) {
      case 0:
        return hrad_create(&solver_);
      case 1:
        return linking_ == "rows" ? hrad_set_text(solver_, "accuracy", "0.5")
                                  : hrad_set_text(solver_, "min_area", "10");
      case 2:
        if (linking_ != "rows" && hrad_set_text(solver_, "tolerance", "1") != HRAD_OK)
          return HRAD_ERROR_MEMORY;
        return hrad_set_text(solver_, "linking", linking_.c_str());
      case 3:
        return hrad_set_int(solver_, "threads", 1);
      case 14:
        return hrad_set_text(solver_, "partition", "grid");
      case 4:
        return hrad_add_patches(solver_, 8, xyz, 12, vertex, nullptr);
      case 5:
        return hrad_load_scene(solver_, scene_.c_str());
      case 6:
        return hrad_solve(solver_);
      case 7:
        return hrad_query_patches(solver_, HRAD_RADIOSITY, 0, 0, 12, out);
      case 8:
        return hrad_query_points(solver_, HRAD_RADIOSITY, 0, 1, &patch, uv, out);
      case 9:
        return hrad_query_sensors(solver_, 1, middle, middle, out, nullptr);
      case 10:
        return hrad_get_diagnostic(solver_, 0, text, sizeof text, nullptr);
      case 11:
        return hrad_describe_machine(solver_, text, sizeof text, nullptr);
      case 12:
        return hrad_get_text(solver_, "linking", text, sizeof text, nullptr);
      case 13:
        return hrad_export(solver_, table_.c_str());
      case 15:
        return hrad_write_checkpoint(solver_, checkpoint_.c_str());
      case 16:
        return hrad_read_checkpoint(solver_, checkpoint_.c_str());
      default:
        return hrad_state_hash(solver_, &hash_);
    }
  }

  uint64_t hash() const { return hash_; }
  hrad_solver* solver() const { return solver_; }

 private:
  std::string linking_, scene_, table_, checkpoint_;
  hrad_solver* solver_ = nullptr;
  uint64_t hash_ = 0;
};

// The same steps with nothing failing.
uint64_t hash_without_failure(const Folder& folder) {
  Program program(folder);
  for (int i = 0; i < Program::steps; ++i) CHECK_EQUAL(program.step(i), HRAD_OK);
  return program.hash();
}

// Repeats one step on the same solver: the first allocation fails, then the second, until it makes
// fewer than that and succeeds. The number of failures.
// step: only every so many of them.
int64_t fail_every_allocation(Program& program, int number, int64_t step = 1) {
  for (int64_t n = 0;; n += step) {
    allocations_left = n;
    const hrad_status status = program.step(number);
    const bool failed = allocations_left.exchange(-1) < 0;
    try {
      if (status == HRAD_OK && !failed) return n;
      CHECK(failed);
      if (status == HRAD_OK) {
        program.begin(number);  // it was done without: giving back spare memory, for one
        continue;
      }
      CHECK_EQUAL(status, HRAD_ERROR_MEMORY);
      CHECK(std::string(hrad_error_message()).find("memory") != std::string::npos);
      if (number == 0) continue;  // there is no solver yet
      int64_t patches = -1;
      CHECK_EQUAL(hrad_scene_size(program.solver(), &patches, nullptr), HRAD_OK);
      CHECK_EQUAL(patches, number <= 4 ? 0 : number == 5 ? 12 : 17);
    } catch (const hrad_test::Failure& failure) {
      throw hrad_test::Failure("step " + std::to_string(number) + ", allocation " +
                               std::to_string(n) + ": " + failure.what());
    }
  }
}

void every_allocation_may_fail() {
  const Folder folder;
  const uint64_t hash = hash_without_failure(folder);
  const int64_t before = living;
  CHECK(hash == hash_without_failure(folder));
  CHECK_EQUAL(living.load(), before);
  {
    Program program(folder);
    int64_t failures = 0;
    // A checkpoint is made of many small pieces: of these a sample. A solve and what follows it
    // takes long to be made again.
    for (int i = 0; i < Program::steps; ++i)
      failures += fail_every_allocation(program, i,
                                        i == 15 || i == 16         ? 101
                                        : i >= Program::solve_step ? hrad_test::every(5)
                                                                   : 1);
    CHECK(failures > 500);  // otherwise nothing was tested
    CHECK(program.hash() == hash);
  }
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path))
    files += entry.is_regular_file();
  CHECK_EQUAL(files, 5);  // the scene, the table and two checkpoints: no temporaries
  CHECK_EQUAL(living.load(), before);
}

// The solve alone by the other ways of linking, which allocate for every element: a sample, of a
// step that falls on all sorts of them.
void every_allocation_of_a_solve_may_fail(const char* linking) {
  constexpr int solve = Program::solve_step;
  const Folder folder;
  {
    Program program(folder, linking);
    program.begin(solve + 1);  // what is made once in a thread's life is there from now on
  }
  const int64_t before = living;
  {
    Program program(folder, linking);
    program.begin(solve);
    const int64_t failures =
        fail_every_allocation(program, solve, hrad_test::thorough() ? 211 : 631);
    CHECK(failures > 50);
    uint64_t hash = 0, undisturbed = 0;
    CHECK_EQUAL(hrad_state_hash(program.solver(), &hash), HRAD_OK);
    program.begin(solve);
    CHECK_EQUAL(program.step(solve), HRAD_OK);
    CHECK_EQUAL(hrad_state_hash(program.solver(), &undisturbed), HRAD_OK);
    CHECK(hash == undisturbed);
  }
  CHECK_EQUAL(living.load(), before);
}
void solves_by_rows() { every_allocation_of_a_solve_may_fail("rows"); }
void solves_by_clusters() { every_allocation_of_a_solve_may_fail("clusters"); }

}  // namespace

int main() {
  // A machine that is quickly looked at: every solve does that.
  setenv("HWLOC_SYNTHETIC", "pack:1 core:2 pu:1", 1);
  const CMUnitTest tests[] = {HRAD_TEST(every_allocation_may_fail), HRAD_TEST(solves_by_rows),
                              HRAD_TEST(solves_by_clusters)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
