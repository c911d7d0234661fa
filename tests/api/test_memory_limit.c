/* The parameter max_memory: a scene or a solve that needs more answers MEMORY with figures and
 * advice, whatever the number of threads, and the solver goes on as if it had not been asked. */
#include "api.h"

static hrad_solver* cornell(const char* linking, int64_t limit, int64_t threads) {
  hrad_solver* solver = new_solver();
  assert_ok(hrad_set_text(solver, "linking", linking));
  assert_ok(hrad_set_double(solver, "accuracy", strcmp(linking, "pairs") == 0 ? 0.2 : 0.03));
  assert_ok(hrad_set_int(solver, "threads", threads));
  assert_ok(hrad_make_scene(solver, "cornell"));
  assert_ok(hrad_set_int(solver, "max_memory", limit));
  return solver;
}

static hrad_stats stats_of(const hrad_solver* solver) {
  hrad_stats stats = {.struct_size = sizeof stats};
  assert_ok(hrad_get_stats(solver, &stats));
  return stats;
}

static void scene_over_the_limit(void** state) {
  hrad_solver* solver = new_solver();
  (void)state;
  assert_ok(hrad_set_int(solver, "max_memory", 100000));
  assert_fails(hrad_make_scene(solver, "building"), HRAD_ERROR_MEMORY, "max_memory");
  assert_int_equal(patch_count(solver), 0);
  assert_int_equal(material_count(solver), 0);
  assert_ok(hrad_make_scene(solver, "cornell"));
  hrad_destroy(&solver);
}

static void check_over_the_limit(const char* linking) {
  hrad_solver* free_solver = cornell(linking, 0, 1);
  hrad_stats stats;
  uint64_t wanted, hash;
  int64_t limit, leaves;
  assert_ok(hrad_solve(free_solver));
  assert_ok(hrad_state_hash(free_solver, &wanted));
  stats = stats_of(free_solver);
  assert_true(stats.link_bytes + stats.node_bytes > 100000);
  /* Too little for the rays, for the first links, for the refined ones. */
  for (limit = 1000; limit < stats.link_bytes + stats.node_bytes; limit *= 4)
    for (int64_t threads = 1; threads <= 3; threads += 2) {
      hrad_solver* solver = cornell(linking, limit, threads);
      assert_fails(hrad_solve(solver), HRAD_ERROR_MEMORY, "raise it, or use a larger accuracy");
      assert_non_null(strstr(hrad_error_message(), "MiB more and"));
      assert_true(patch_count(solver) > 0);
      assert_status(hrad_leaf_count(solver, &leaves), HRAD_ERROR_STATE);
      assert_ok(hrad_set_int(solver, "max_memory", 0));
      assert_ok(hrad_solve(solver));
      assert_ok(hrad_state_hash(solver, &hash));
      assert_true(hash == wanted);
      hrad_destroy(&solver);
    }
  hrad_destroy(&free_solver);
}

static void solve_over_the_limit(void** state) {
  (void)state;
  check_over_the_limit("pairs");
  check_over_the_limit("rows");
}

/* A limit that is kept changes nothing; it may be lowered between two solves. */
static void limit_may_change(void** state) {
  hrad_solver *solver = cornell("pairs", 0, 1), *limited = cornell("pairs", INT64_C(1) << 30, 1);
  uint64_t wanted, hash;
  (void)state;
  assert_ok(hrad_solve(solver));
  assert_ok(hrad_state_hash(solver, &wanted));
  assert_ok(hrad_solve(limited));
  assert_ok(hrad_state_hash(limited, &hash));
  assert_true(hash == wanted);
  assert_ok(hrad_set_int(limited, "max_memory", 200000));
  assert_ok(hrad_set_double(limited, "accuracy", 0.1));
  assert_fails(hrad_solve(limited), HRAD_ERROR_MEMORY, "200000 bytes");
  assert_ok(hrad_set_text(limited, "max_memory", "0"));
  assert_ok(hrad_solve(limited));
  hrad_destroy(&solver);
  hrad_destroy(&limited);
}

/* What a solve has needed for a while is given back: however many follow, with and without a
 * journal of their steps, the limit is the same. */
static void solves_leave_nothing_counted(void** state) {
  const char* const linking[] = {"rows", "pairs"};
  double light[3 * 36];
  int64_t resumable;
  int method, k, times;
  (void)state;
  for (method = 0; method < 2; ++method)
    for (resumable = 0; resumable < 2; ++resumable) {
      hrad_solver* solver = cornell(linking[method], 0, 1);
      hrad_stats stats;
      assert_ok(hrad_set_double(solver, "accuracy", 0.3));
      assert_ok(hrad_set_int(solver, "resumable", resumable));
      assert_ok(hrad_query_patches(solver, HRAD_EMISSION, HRAD_FRONT, 0, 36, light));
      assert_ok(hrad_solve(solver));
      stats = stats_of(solver);
      assert_ok(hrad_set_int(solver, "max_memory", 6 * (stats.link_bytes + stats.node_bytes)));
      for (times = 0; times < 8; ++times) {
        for (k = 0; k < 3 * 36; ++k) light[k] *= 1.25;
        assert_ok(hrad_set_emission(solver, 0, 36, light));
        assert_true(hrad_solve(solver) >= 0);
      }
      hrad_destroy(&solver);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(scene_over_the_limit),
      cmocka_unit_test(solve_over_the_limit),
      cmocka_unit_test(limit_may_change),
      cmocka_unit_test(solves_leave_nothing_counted),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
