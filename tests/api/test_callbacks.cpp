// Callbacks written in C++ that throw: no exception leaves the library, the call fails as INTERNAL
// and the solver stays usable.
#include <stdexcept>
#include <string>

#include "hrad/hrad.h"
#include "support/check.h"

namespace {

struct Destroyer {
  hrad_solver* solver = nullptr;
  ~Destroyer() { hrad_destroy(&solver); }
};

bool message_has(const char* text) {
  return std::string(hrad_error_message()).find(text) != std::string::npos;
}

void throw_log(int32_t, const char*, void*) { throw std::runtime_error("from the log"); }

int32_t throw_progress(const hrad_progress*, void* user) {
  ++*static_cast<int*>(user);
  throw 42;
}

uint64_t cornell_hash(hrad_solver* solver) {
  uint64_t hash = 0;
  CHECK_EQUAL(hrad_state_hash(solver, &hash), HRAD_OK);
  return hash;
}

// A log function that throws while patches are added: nothing is added.
void log_that_throws_adds_nothing() {
  Destroyer owner;
  CHECK_EQUAL(hrad_create(&owner.solver), HRAD_OK);
  CHECK_EQUAL(hrad_set_log(owner.solver, throw_log, nullptr, HRAD_LOG_DEBUG), HRAD_OK);
  const double flat[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
  const int64_t corners[3] = {0, 1, 2};
  int64_t patches = -1, materials = -1;
  CHECK_EQUAL(hrad_add_patches(owner.solver, 3, flat, 1, corners, nullptr), HRAD_ERROR_INTERNAL);
  CHECK(message_has("log"));
  CHECK_EQUAL(hrad_scene_size(owner.solver, &patches, &materials), HRAD_OK);
  CHECK_EQUAL(patches, 0);
  CHECK_EQUAL(materials, 0);
  CHECK(hrad_get_diagnostic(owner.solver, 0, nullptr, 0, nullptr) == HRAD_ERROR_ARGUMENT);
}

// Callbacks that throw stop a solve, which then goes on to the same bits.
void solve_survives(bool from_log) {
  Destroyer calm, disturbed;
  for (hrad_solver** solver : {&calm.solver, &disturbed.solver}) {
    CHECK_EQUAL(hrad_create(solver), HRAD_OK);
    CHECK_EQUAL(hrad_make_scene(*solver, "cornell"), HRAD_OK);
    CHECK_EQUAL(hrad_set_double(*solver, "accuracy", 0.1), HRAD_OK);
  }
  CHECK_EQUAL(hrad_solve(calm.solver), HRAD_OK);
  int calls = 0;
  if (from_log)
    CHECK_EQUAL(hrad_set_log(disturbed.solver, throw_log, nullptr, HRAD_LOG_DEBUG), HRAD_OK);
  else
    CHECK_EQUAL(hrad_set_progress(disturbed.solver, throw_progress, &calls), HRAD_OK);
  const hrad_status status = hrad_solve(disturbed.solver);
  // A solve that logs nothing has nothing to fail of.
  if (!from_log || status != HRAD_OK) {
    CHECK_EQUAL(status, HRAD_ERROR_INTERNAL);
    CHECK(message_has(from_log ? "log" : "progress"));
  }
  if (!from_log) CHECK_EQUAL(calls, 1);
  CHECK_EQUAL(hrad_set_log(disturbed.solver, nullptr, nullptr, HRAD_LOG_DEBUG), HRAD_OK);
  CHECK_EQUAL(hrad_set_progress(disturbed.solver, nullptr, nullptr), HRAD_OK);
  CHECK_EQUAL(hrad_solve(disturbed.solver), HRAD_OK);
  CHECK(cornell_hash(disturbed.solver) == cornell_hash(calm.solver));
}

void progress_that_throws() { solve_survives(false); }
void log_that_throws() { solve_survives(true); }

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(log_that_throws_adds_nothing),
                              HRAD_TEST(progress_that_throws), HRAD_TEST(log_that_throws)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
