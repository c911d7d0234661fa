/* Solving over MPI: by every method what one process finds, on groups of ranks side by side, after
 * a stop that any rank asks for, and after memory that one rank lacks. */
#include <string.h>

#include "api/api.h"
#include "mpi_program.h"

static const char* const methods[] = {"pairs", "clusters", "rows"};
enum { method_count = sizeof methods / sizeof *methods };

static void prepare(hrad_solver* solver, const char* scene, const char* linking) {
  assert_ok(hrad_set_int(solver, "threads", 1));
  assert_ok(hrad_set_text(solver, "linking", linking));
  assert_ok(hrad_set_double(solver, "accuracy", 0.5));
  assert_ok(hrad_make_scene(solver, scene));
}

static hrad_solver* solver_over(MPI_Comm comm, const char* scene, const char* linking) {
  hrad_solver* solver = NULL;
  assert_ok(hrad_create_mpi(comm, &solver));
  prepare(solver, scene, linking);
  return solver;
}

static uint64_t hash_of(hrad_solver* solver) {
  uint64_t hash = 0;
  assert_ok(hrad_state_hash(solver, &hash));
  return hash;
}

/* What one process finds alone: found once. */
static uint64_t hash_alone(const char* scene, const char* linking) {
  static struct {
    const char *scene, *linking;
    uint64_t hash;
  } known[8];
  static int count = 0;
  hrad_solver* solver;
  uint64_t hash;
  int k;
  for (k = 0; k < count; ++k)
    if (strcmp(known[k].scene, scene) == 0 && strcmp(known[k].linking, linking) == 0)
      return known[k].hash;
  assert_true(count < 8);
  solver = new_solver();
  prepare(solver, scene, linking);
  assert_ok(hrad_solve(solver));
  hash = hash_of(solver);
  hrad_destroy(&solver);
  known[count].scene = scene;
  known[count].linking = linking;
  known[count++].hash = hash;
  return hash;
}

static void together_as_alone(void** state) {
  int k;
  (void)state;
  for (k = 0; k < method_count; ++k) {
    hrad_solver* solver = solver_over(MPI_COMM_WORLD, "cornell", methods[k]);
    hrad_stats stats = {.struct_size = sizeof stats};
    assert_ok(hrad_solve(solver));
    assert_true(hash_of(solver) == hash_alone("cornell", methods[k]));
    assert_ok(hrad_get_stats(solver, &stats));
    assert_int_equal(stats.ranks, size_of_world());
    assert_true((stats.messages[1] > 0) == (size_of_world() > 1));
    hrad_destroy(&solver);
  }
}

/* Odd and even ranks solve other scenes at the same time, and all of them a third one in between,
 * in reversed order. */
static void two_groups_at_once(void** state) {
  const int rank = rank_of_world();
  const char* scene = rank % 2 ? "furnace" : "cornell";
  MPI_Comm half, reversed;
  hrad_solver *one, *other;
  (void)state;
  MPI_Comm_split(MPI_COMM_WORLD, rank % 2, rank, &half);
  MPI_Comm_split(MPI_COMM_WORLD, 0, -rank, &reversed);
  one = solver_over(half, scene, methods[rank % 2]);
  other = solver_over(reversed, "cornell", "rows");
  MPI_Comm_free(&half);
  MPI_Comm_free(&reversed);
  assert_ok(hrad_partition(other));
  assert_ok(hrad_solve(one));
  assert_ok(hrad_solve(other));
  assert_true(hash_of(one) == hash_alone(scene, methods[rank % 2]));
  assert_true(hash_of(other) == hash_alone("cornell", "rows"));
  hrad_destroy(&one);
  hrad_destroy(&other);
}

/* Stops in one stage after the other. */
static int32_t stop_in_new_stage(const hrad_progress* progress, void* user) {
  char* last = (char*)user;
  if (strcmp(last, progress->stage) == 0) return 0;
  strcpy(last, progress->stage);
  return 1;
}

static void a_stop_of_any_rank_stops_all(void** state) {
  int k;
  (void)state;
  for (k = 0; k < method_count; ++k) {
    hrad_solver* solver = solver_over(MPI_COMM_WORLD, "cornell", methods[k]);
    char stage[32] = "";
    hrad_status status = HRAD_STOPPED;
    int stops = 0;
    /* The last rank asks before it begins. */
    if (rank_of_world() == size_of_world() - 1) hrad_request_stop(solver);
    assert_status(hrad_solve(solver), HRAD_STOPPED);
    assert_ok(hrad_set_progress(solver, stop_in_new_stage, stage));
    while (status == HRAD_STOPPED && stops < 50) {
      status = hrad_solve(solver);
      ++stops;
    }
    assert_int_equal(status, HRAD_OK);
    assert_true(stops >= 3);
    assert_true(hash_of(solver) == hash_alone("cornell", methods[k]));
    hrad_destroy(&solver);
  }
}

/* Too little on the last rank alone. */
static void memory_of_one_rank(void** state) {
  const int last = rank_of_world() == size_of_world() - 1;
  int64_t limit;
  int failures = 0;
  (void)state;
  for (limit = 10000; limit < 4000000; limit *= 8) {
    hrad_solver* solver = solver_over(MPI_COMM_WORLD, "cornell", "pairs");
    hrad_status status;
    int same[2], least[2];
    assert_ok(hrad_set_int(solver, "max_memory", last ? limit : 0));
    status = hrad_solve(solver);
    same[0] = status;
    same[1] = -status;
    MPI_Allreduce(same, least, 2, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    assert_int_equal(least[0], -least[1]);
    if (status < 0) {
      assert_int_equal(status, HRAD_ERROR_MEMORY);
      assert_non_null(strstr(hrad_error_message(), "max_memory"));
      ++failures;
    }
    assert_ok(hrad_set_int(solver, "max_memory", 0));
    assert_ok(hrad_solve(solver));
    assert_true(hash_of(solver) == hash_alone("cornell", "pairs"));
    hrad_destroy(&solver);
  }
  assert_true(failures > 1);
}

int main(int argc, char** argv) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(together_as_alone),
      cmocka_unit_test(two_groups_at_once),
      cmocka_unit_test(a_stop_of_any_rank_stops_all),
      cmocka_unit_test(memory_of_one_rank),
  };
  int level = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  run_together(tests, sizeof tests / sizeof *tests);
  MPI_Finalize();
  return 0;
}
