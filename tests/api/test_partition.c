/* Planned partitions through the C API. */
#include <stdio.h>
#include <stdlib.h>

#include "api.h"

enum { RANKS = 6 };

static hrad_solver* scene(const char* name) {
  hrad_solver* solver = new_solver();
  assert_ok(hrad_make_scene(solver, name));
  return solver;
}

static void owners_and_loads_agree(void** state) {
  hrad_solver* solver = scene("furnished-room");
  const int64_t patches = patch_count(solver);
  int32_t* owner = malloc((size_t)patches * sizeof *owner);
  const char* const methods[] = {"grid", "cost"};
  double largest[2];
  (void)state;
  for (int m = 0; m < 2; ++m) {
    hrad_rank_load loads[RANKS] = {{.struct_size = sizeof *loads}};
    int64_t count[RANKS] = {0};
    assert_ok(hrad_plan_partition(solver, methods[m], RANKS, owner, loads));
    for (int64_t p = 0; p < patches; ++p) {
      hrad_patch patch = {.struct_size = sizeof patch};
      assert_true(owner[p] >= 0 && owner[p] < RANKS);
      ++count[owner[p]];
      assert_ok(hrad_get_patch(solver, p, &patch));
      for (int axis = 0; axis < 3; ++axis)
        assert_true(patch.corners_xyz[axis] >= loads[owner[p]].lower[axis] &&
                    patch.corners_xyz[axis] <= loads[owner[p]].upper[axis]);
    }
    largest[m] = 0;
    for (int r = 0; r < RANKS; ++r) {
      assert_int_equal(loads[r].struct_size, sizeof *loads);
      assert_int_equal(loads[r].patches, count[r]);
      /* A cell of the grid may be empty. */
      assert_true(count[r] > 0 || m == 0);
      assert_true(count[r] > 0 ? loads[r].work > 0 && loads[r].remote > 0 : loads[r].work == 0);
      assert_true(loads[r].remote <= 1);
      largest[m] = fmax(largest[m], loads[r].work);
    }
  }
  assert_true(largest[1] <= largest[0]);
  free(owner);
  hrad_destroy(&solver);
}

static void one_rank_has_all_and_needs_nobody(void** state) {
  hrad_solver* solver = scene("cornell");
  hrad_rank_load load = {.struct_size = sizeof load};
  (void)state;
  assert_ok(hrad_plan_partition(solver, "cost", 1, NULL, &load));
  assert_int_equal(load.patches, patch_count(solver));
  assert_near(load.remote, 0, 0);
  /* More accurate is more work. */
  const double before = load.work;
  assert_ok(hrad_set_double(solver, "accuracy", 0.005));
  assert_ok(hrad_plan_partition(solver, "cost", 1, NULL, &load));
  assert_true(load.work > 2 * before);
  hrad_destroy(&solver);
}

static void threads_change_nothing(void** state) {
  int32_t owner[2][36];
  hrad_rank_load loads[2][RANKS];
  (void)state;
  memset(loads, 0, sizeof loads);
  for (int k = 0; k < 2; ++k) {
    hrad_solver* solver = scene("cornell");
    assert_true(patch_count(solver) <= 36);
    assert_ok(hrad_set_int(solver, "threads", k ? 3 : 1));
    loads[k][0].struct_size = sizeof loads[k][0];
    assert_ok(hrad_plan_partition(solver, "cost", RANKS, owner[k], loads[k]));
    hrad_destroy(&solver);
  }
  assert_memory_equal(loads[0], loads[1], sizeof loads[0]);
}

/* An older program's structs are smaller: each is as long as the first says. */
static void structs_may_be_shorter(void** state) {
  hrad_solver* solver = scene("cornell");
  struct old {
    size_t struct_size;
    int64_t patches;
  } loads[3] = {{.struct_size = sizeof *loads}};
  (void)state;
  assert_ok(hrad_plan_partition(solver, "grid", 3, NULL, (hrad_rank_load*)loads));
  assert_int_equal(loads[0].patches + loads[1].patches + loads[2].patches, patch_count(solver));
  assert_int_equal(loads[2].struct_size, sizeof *loads);
  hrad_destroy(&solver);
}

static void what_is_wrong_is_said(void** state) {
  hrad_solver* solver = scene("cornell");
  hrad_solver* empty = new_solver();
  hrad_rank_load load = {.struct_size = 3};
  (void)state;
  assert_status(hrad_plan_partition(NULL, "cost", 2, NULL, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_plan_partition(solver, NULL, 2, NULL, NULL), HRAD_ERROR_ARGUMENT);
  assert_fails(hrad_plan_partition(solver, "metis", 2, NULL, NULL), HRAD_ERROR_ARGUMENT, "grid");
  assert_fails(hrad_plan_partition(solver, "cost", 0, NULL, NULL), HRAD_ERROR_ARGUMENT, "0 ranks");
  assert_fails(hrad_plan_partition(solver, "cost", HRAD_MOST_RANKS + 1, NULL, NULL),
               HRAD_ERROR_ARGUMENT, "65536");
  assert_status(hrad_plan_partition(solver, "cost", 1, NULL, &load), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_plan_partition(empty, "cost", 2, NULL, NULL), HRAD_ERROR_SCENE);
  assert_ok(hrad_plan_partition(solver, "cost", HRAD_MOST_RANKS, NULL, NULL));
  assert_status(hrad_export_partition(solver, "cost", 2, NULL), HRAD_ERROR_ARGUMENT);
  assert_fails(hrad_export_partition(solver, "cost", 2, "owners.csv"), HRAD_ERROR_ARGUMENT, ".vtu");
  assert_status(hrad_export_partition(solver, "cost", 2, "nowhere/owners.vtu"), HRAD_ERROR_FILE);
  assert_status(hrad_export_partition(NULL, "cost", 2, "owners.vtu"), HRAD_ERROR_ARGUMENT);
  hrad_destroy(&solver);
  /* What can't be done closes no scene. */
  assert_status(hrad_plan_partition(empty, "metis", 2, NULL, NULL), HRAD_ERROR_ARGUMENT);
  assert_ok(hrad_make_scene(empty, "furnace"));
  assert_status(hrad_plan_partition(empty, "metis", 2, NULL, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_export_partition(empty, "cost", 2, "owners.csv"), HRAD_ERROR_ARGUMENT);
  assert_ok(hrad_add_material(empty, &(hrad_material){.struct_size = sizeof(hrad_material)}, NULL));
  hrad_destroy(&empty);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(owners_and_loads_agree), cmocka_unit_test(one_rank_has_all_and_needs_nobody),
      cmocka_unit_test(threads_change_nothing), cmocka_unit_test(structs_may_be_shorter),
      cmocka_unit_test(what_is_wrong_is_said),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
