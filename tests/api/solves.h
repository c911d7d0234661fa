/* Solves of built-in scenes, and the hash that says whether their bits are the same. */
#ifndef HRAD_TEST_SOLVES_H
#define HRAD_TEST_SOLVES_H

#include "api.h"

enum { BANDS = 3 };

static inline hrad_solver* prepared(const char* scene, double accuracy, int64_t threads) {
  hrad_solver* solver = new_solver();
  assert_ok(hrad_make_scene(solver, scene));
  assert_ok(hrad_set_double(solver, "accuracy", accuracy));
  assert_ok(hrad_set_int(solver, "threads", threads));
  return solver;
}

static inline uint64_t hash_of(const hrad_solver* solver) {
  uint64_t hash = 0;
  assert_ok(hrad_state_hash(solver, &hash));
  return hash;
}

static inline uint64_t cornell_hash(int64_t threads) {
  hrad_solver* solver = prepared("cornell", 0.1, threads);
  uint64_t hash;
  assert_ok(hrad_solve(solver));
  hash = hash_of(solver);
  hrad_destroy(&solver);
  return hash;
}

#endif
