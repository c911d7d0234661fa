// A scene in which far less light arrives than its lamps' power says, so that linking by rows
// begins anew with tolerances that follow the light: the same bits on several threads and from any
// stop.
#include <memory>
#include <vector>

#include "solver/checkpoint_files.h"

namespace {

using namespace hrad_test;
using hrad::Material;
using hrad::Solver;
using hrad::Status;

// The six walls of a box as seen from within; materials: of these and of the ceiling.
void add_room(Solver& solver, double x, double size, int32_t wall, int32_t ceiling) {
  const double y = size, z = size;
  const double xyz[] = {x, 0, 0, x + size, 0, 0, x + size, y, 0, x, y, 0,
                        x, 0, z, x + size, 0, z, x + size, y, z, x, y, z};
  const int64_t corners[] = {0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 5, 1, 0, 4, 5,
                             3, 2, 6, 3, 6, 7, 0, 3, 7, 0, 7, 4, 1, 5, 6, 1, 6, 2};
  const int32_t materials[] = {wall, wall, ceiling, ceiling, wall, wall,
                               wall, wall, wall,    wall,    wall, wall};
  solver.add_patches(8, xyz, 12, corners, materials);
}

// One room with a dim ceiling, and a black one beside it with a lamp of a thousand times the power.
std::unique_ptr<Solver> dark_scene(int threads) {
  auto solver = std::make_unique<Solver>();
  solver->set_int("bands", 1);
  solver->set_text("linking", "rows");
  solver->set_double("accuracy", 0.1);
  solver->set_int("threads", threads);
  solver->set_int("resumable", 1);
  solver->add_material(Material{"wall", {0.6}, {0}, false, false});
  solver->add_material(Material{"dim", {0.6}, {1}, false, false});
  solver->add_material(Material{"black", {0}, {0}, false, false});
  solver->add_material(Material{"lamp", {0}, {1000}, false, false});
  add_room(*solver, 0, 2, 0, 1);
  add_room(*solver, 3, 2, 2, 3);
  return solver;
}

void stops_change_nothing() {
  const Folder folder("dark");
  const auto whole = dark_scene(1);
  // Beginning anew must not take the progress back.
  double before = 0;
  int64_t calls = 0;
  whole->set_progress([&](const hrad::Progress& progress) {
    if (progress.stage != std::string("linking")) return true;
    CHECK(progress.fraction >= before);
    before = progress.fraction;
    ++calls;
    return true;
  });
  CHECK(whole->solve() != Status::stopped);
  CHECK(calls > 10);
  const auto threads = dark_scene(3);
  threads->solve();
  CHECK(threads->state_hash() == whole->state_hash());
  int64_t stops = 0;
  for (double share : {0.1, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}) {
    const auto solver = dark_scene(2);
    solver->set_progress([&](const hrad::Progress& progress) {
      return progress.stage != std::string("linking") || progress.stage_share < share;
    });
    if (solver->solve() != Status::stopped) continue;
    ++stops;
    solver->set_progress(nullptr);
    solver->write_checkpoint(folder.file("a.hrad"));
    Solver other;
    other.read_checkpoint(folder.file("a.hrad"));
    CHECK(other.solve() != Status::stopped);
    CHECK(other.state_hash() == whole->state_hash());
    CHECK_EQUAL(other.stats().rays, whole->stats().rays);
  }
  CHECK(stops >= 6);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(stops_change_nothing)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
