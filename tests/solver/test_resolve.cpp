// Solving again for another light on the present mesh and links: the result is that of mesh, links
// and light, whatever was solved in between, and what was not measured is measured when asked.
#include <utility>
#include <vector>

#include "solver/solver.h"
#include "support/check.h"

namespace {

using namespace hrad;
using namespace hrad_test;

using Values = std::vector<double>;

struct Room {
  explicit Room(const char* linking, int threads = 1) {
    const bool by_pairs = linking[0] == 'p';
    solver.make_scene(by_pairs ? "cornell" : "furnished-room");
    solver.set_text("linking", linking);
    solver.set_double("accuracy", by_pairs ? 0.3 : 0.1);
    solver.set_int("threads", threads);
    emission = solver.scene().emission;
    reflectance = solver.scene().reflectance;
    CHECK(solver.solve() == Status::ok);
    first = hash_as_refined();
    solver.set_int("refine", 0);
  }

  int64_t patches() const { return solver.scene().patch_count(); }
  void emit(const Values& values) { solver.set_emission(0, patches(), values.data()); }
  void reflect(const Values& values) { solver.set_reflectance(0, patches(), values.data()); }
  // `refine` counts as a parameter of the result.
  uint64_t hash_as_refined() {
    const int64_t refine = solver.params().refine;
    solver.set_int("refine", 1);
    const uint64_t hash = solver.state_hash();
    solver.set_int("refine", refine);
    return hash;
  }
  uint64_t solved_hash() {
    CHECK(solver.solve() == Status::ok);
    return hash_as_refined();
  }

  // Lights of the same power and of another colour, and one from the floor.
  Values other_emission(int which) const {
    Values e = emission;
    const size_t bands = static_cast<size_t>(solver.scene().bands);
    for (size_t k = 0; k < e.size(); ++k) e[k] *= which + static_cast<double>(k % bands);
    if (which == 2)
      for (size_t b = 0; b < bands; ++b) e[b] = 3;
    return e;
  }
  Values other_reflectance(double by) const {
    Values r = reflectance;
    for (double& value : r) value *= by;
    return r;
  }

  Solver solver;
  Values emission, reflectance;
  uint64_t first = 0;
};

// Once straight on, once by detours.
void emission_leaves_no_trace() {
  for (const char* linking : {"rows", "pairs"}) {
    uint64_t home[2], one[2], two[2];
    for (int way = 0; way < 2; ++way) {
      Room room(linking, way == 0 ? 1 : 3);
      home[way] = room.solved_hash();
      if (way == 0) room.emit(room.other_emission(1));
      if (way == 1) room.emit(room.other_emission(2));
      one[way] = room.solved_hash();
      room.emit(room.other_emission(way == 0 ? 2 : 1));
      two[way] = room.solved_hash();
      room.emit(room.emission);
      CHECK_EQUAL(room.solved_hash(), home[way]);
      // Asking again for the same changes nothing either.
      CHECK_EQUAL(room.solved_hash(), home[way]);
    }
    CHECK_EQUAL(home[0], home[1]);
    CHECK_EQUAL(one[0], two[1]);
    CHECK_EQUAL(two[0], one[1]);
    CHECK(one[0] != two[0] && one[0] != home[0]);
  }
}

void reflectance_leaves_no_trace() {
  for (const char* linking : {"rows", "pairs"}) {
    Room straight(linking, 1), detour(linking, 3);
    const uint64_t home = straight.solved_hash();
    straight.reflect(straight.other_reflectance(0.5));
    const uint64_t darker = straight.solved_hash();
    detour.reflect(detour.other_reflectance(0));
    detour.solved_hash();
    detour.emit(detour.other_emission(1));
    detour.solved_hash();
    detour.emit(detour.emission);
    detour.reflect(detour.other_reflectance(0.5));
    CHECK_EQUAL(detour.solved_hash(), darker);
    detour.reflect(detour.reflectance);
    CHECK_EQUAL(detour.solved_hash(), home);
    CHECK(home != darker);
  }
}

// By rows a solve from the start sweeps from B = E over its last mesh and links too.
void a_solve_from_the_start_has_the_same_bits() {
  Room room("rows");
  CHECK_EQUAL(room.solved_hash(), room.first);
  room.emit(room.other_emission(2));
  CHECK(room.solved_hash() != room.first);
  room.emit(room.emission);
  CHECK_EQUAL(room.solved_hash(), room.first);
  // And refining for a light that the mesh was made for finds nothing to do.
  room.emit(room.other_emission(1));
  room.solved_hash();
  room.emit(room.emission);
  room.solver.set_int("refine", 1);
  CHECK_EQUAL(room.solved_hash(), room.first);
}

// The mesh follows the light as soon as it may, also when that light was swept for before.
void refining_makes_up_for_sweeps_alone() {
  Room room("rows");
  room.emit(room.other_emission(2));
  const uint64_t on_old_mesh = room.solved_hash();
  room.solver.set_int("refine", 1);
  const uint64_t on_new_mesh = room.solved_hash();
  CHECK(on_new_mesh != on_old_mesh);
  Room other("rows");
  other.emit(other.other_emission(2));
  other.solver.set_int("refine", 1);
  CHECK_EQUAL(other.solved_hash(), on_new_mesh);
}

void a_stopped_resolve_goes_on_to_the_same_bits() {
  for (const char* linking : {"rows", "pairs"}) {
    Room straight(linking), stopped(linking);
    straight.emit(straight.other_emission(1));
    const uint64_t wanted = straight.solved_hash();
    stopped.emit(stopped.other_emission(1));
    int calls = 0;
    stopped.solver.set_progress([&](const Progress&) { return ++calls % 3 != 0; });
    int stops = 0;
    while (stopped.solver.solve() == Status::stopped) CHECK(++stops < 1000);
    CHECK(stops > 1);
    CHECK_EQUAL(stopped.hash_as_refined(), wanted);
    // Another light in the middle of it starts anew.
    stopped.emit(stopped.emission);
    calls = 1;
    CHECK(stopped.solver.solve() == Status::stopped);
    stopped.emit(stopped.other_emission(1));
    stopped.solver.set_progress({});
    CHECK_EQUAL(stopped.solved_hash(), wanted);
  }
}

// max_iterations is the limit of each solve.
void sweeps_do_not_run_out() {
  Room room("rows");
  const int64_t sweeps = room.solver.stats().iterations;
  const int64_t limit = room.solver.params().max_iterations;
  CHECK(sweeps > 0 && sweeps < limit);
  for (int64_t done = 0; done <= limit + sweeps; done += sweeps) {
    room.emit(room.emission);
    CHECK(room.solver.solve() == Status::ok);
  }
  CHECK(room.solver.stats().iterations > limit);
}

void what_is_measured_is_the_same_and_later() {
  Room room("rows");
  const size_t bands = static_cast<size_t>(room.solver.scene().bands);
  const auto balance = [&] {
    Values all(4 * bands);
    room.solver.power_balance(&all[0], &all[bands], &all[2 * bands], &all[3 * bands]);
    return all;
  };
  const Stats before = room.solver.stats();
  const Values power = balance();
  room.emit(room.other_emission(1));
  room.solved_hash();
  room.emit(room.emission);
  room.solved_hash();
  // Asked for the balance first, then for the rest.
  CHECK(balance() == power);
  const Stats after = room.solver.stats();
  CHECK_EQUAL(after.error_estimate, before.error_estimate);
  CHECK_EQUAL(after.error_standard_error, before.error_standard_error);
  CHECK_EQUAL(after.back_share, before.back_share);
  CHECK(after.rays > before.rays);
  CHECK_EQUAL(room.solver.stats().rays, after.rays);
  // The other way round.
  room.emit(room.other_emission(1));
  room.solved_hash();
  room.emit(room.emission);
  room.solved_hash();
  CHECK_EQUAL(room.solver.stats().error_estimate, before.error_estimate);
  CHECK(balance() == power);
}

// What was solved for is gone from the scene before anybody asked.
void a_light_that_is_gone_is_not_measured() {
  Room room("rows");
  double unused[16];
  room.emit(room.other_emission(1));
  room.solved_hash();
  room.emit(room.other_emission(2));
  CHECK(room.solver.stats().error_estimate < 0);
  CHECK_FAILS(room.solver.power_balance(unused, nullptr, nullptr, nullptr), Status::state,
              "hrad_solve");
  // Back again it can be.
  room.emit(room.other_emission(1));
  CHECK(room.solver.stats().error_estimate >= 0);
  room.solver.power_balance(unused, nullptr, nullptr, nullptr);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(emission_leaves_no_trace),
      HRAD_TEST(reflectance_leaves_no_trace),
      HRAD_TEST(a_solve_from_the_start_has_the_same_bits),
      HRAD_TEST(refining_makes_up_for_sweeps_alone),
      HRAD_TEST(a_stopped_resolve_goes_on_to_the_same_bits),
      HRAD_TEST(sweeps_do_not_run_out),
      HRAD_TEST(what_is_measured_is_the_same_and_later),
      HRAD_TEST(a_light_that_is_gone_is_not_measured),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
