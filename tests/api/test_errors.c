/* Wrong calls: every pointer NULL in turn, counts that are negative or overflow, sizes of structs
 * that can't be meant, calls out of order. Each answers its status, leaves its outputs alone and
 * says why; messages belong to threads. */
#include <pthread.h>
#include <stdio.h>

#include "api.h"

static hrad_solver* gray_room(void) {
  hrad_solver* solver = new_solver();
  add_room(solver, add_gray(solver, 0.5, 1, 0));
  return solver;
}

static void version_and_names(void** state) {
  int32_t major = HRAD_VERSION_MAJOR, minor = HRAD_VERSION_MINOR, patch = HRAD_VERSION_PATCH;
  char text[64];
  (void)state;
  assert_int_equal(hrad_version(), major * 10000 + minor * 100 + patch);
  snprintf(text, sizeof text, "%d.%d.%d", (int)major, (int)minor, (int)patch);
  assert_string_equal(hrad_version_text(), text);
  assert_string_equal(hrad_status_name(HRAD_OK), "HRAD_OK");
  assert_string_equal(hrad_status_name(HRAD_NOT_CONVERGED), "HRAD_NOT_CONVERGED");
  assert_string_equal(hrad_status_name(HRAD_STOPPED), "HRAD_STOPPED");
  assert_string_equal(hrad_status_name(HRAD_ERROR_ARGUMENT), "HRAD_ERROR_ARGUMENT");
  assert_string_equal(hrad_status_name(HRAD_ERROR_INTERNAL), "HRAD_ERROR_INTERNAL");
  assert_string_equal(hrad_status_name(3), "HRAD_UNKNOWN");
  assert_string_equal(hrad_status_name(-10), "HRAD_UNKNOWN");
  for (hrad_status i = HRAD_ERROR_INTERNAL; i <= HRAD_STOPPED; ++i)
    for (hrad_status j = HRAD_ERROR_INTERNAL; j < i; ++j)
      assert_string_not_equal(hrad_status_name(i), hrad_status_name(j));
}

static void create_and_destroy(void** state) {
  hrad_solver* solver = NULL;
  (void)state;
  assert_status(hrad_create(NULL), HRAD_ERROR_ARGUMENT);
  hrad_destroy(NULL);
  hrad_destroy(&solver);
  assert_ok(hrad_create(&solver));
  hrad_destroy(&solver);
  assert_null(solver);
  hrad_destroy(&solver);
}

/* Every function of a solver, with NULL for the solver. */
static void null_solver(void** state) {
  hrad_material material = {.struct_size = sizeof material};
  hrad_patch patch = {.struct_size = sizeof patch};
  hrad_stats stats = {.struct_size = sizeof stats};
  const double reals[9] = {0};
  const int64_t indices[3] = {0, 1, 2};
  double out[16];
  int64_t whole = 0;
  int32_t small = 0;
  uint64_t hash = 0;
  char text[64];
  (void)state;
  assert_status(hrad_set_log(NULL, NULL, NULL, 1), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_int(NULL, "seed", 1), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_double(NULL, "accuracy", 0.1), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_text(NULL, "seed", "1"), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_int(NULL, "seed", &whole), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_double(NULL, "accuracy", out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_text(NULL, "seed", text, 64, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_add_material(NULL, &material, &small), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_add_patches(NULL, 3, reals, 1, indices, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_load_scene(NULL, "a.obj"), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_make_scene(NULL, "cornell"), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_scene_size(NULL, &whole, &whole), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_patch(NULL, 0, &patch), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_material(NULL, 0, text, 64, NULL, out, out, &small), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_diagnostic(NULL, 0, text, 64, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_emission(NULL, 0, 1, reals), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_reflectance(NULL, 0, 1, reals), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_partition(NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_patch_owner(NULL, 0, &small), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_describe_machine(NULL, text, 64, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_progress(NULL, NULL, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_solve(NULL), HRAD_ERROR_ARGUMENT);
  hrad_request_stop(NULL);
  assert_status(hrad_get_stats(NULL, &stats), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_state_hash(NULL, &hash), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(NULL, 0, 0, 0, 1, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_points(NULL, 0, 0, 1, indices, reals, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_sensors(NULL, 1, reals, reals, out, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_leaf_count(NULL, &whole), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_leaves(NULL, 0, 1, &whole, NULL, NULL, NULL, NULL, NULL),
                HRAD_ERROR_ARGUMENT);
  assert_status(hrad_power_balance(NULL, out, out, out, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_write_checkpoint(NULL, "a"), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_read_checkpoint(NULL, "a"), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_export(NULL, "a.csv"), HRAD_ERROR_ARGUMENT);
}

/* Every other pointer that must not be NULL. */
static void null_arguments(void** state) {
  hrad_solver* solver = gray_room();
  const double reals[9] = {0};
  const int64_t index = 0;
  double out[16];
  (void)state;
  assert_status(hrad_set_int(solver, NULL, 1), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_double(solver, NULL, 1), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_text(solver, NULL, "1"), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_text(solver, "seed", NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_int(solver, "seed", NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_int(solver, NULL, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_double(solver, "accuracy", NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_text(solver, NULL, NULL, 0, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_describe_param(0, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_add_material(solver, NULL, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_load_scene(solver, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_make_scene(solver, NULL), HRAD_ERROR_ARGUMENT);
  assert_ok(hrad_scene_size(solver, NULL, NULL));
  assert_status(hrad_get_patch(solver, 0, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_material(solver, 0, NULL, 8, NULL, NULL, NULL, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_emission(solver, 0, 1, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_reflectance(solver, 0, 1, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_patch_owner(solver, 0, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_describe_machine(solver, NULL, 8, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_stats(solver, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_state_hash(solver, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(solver, HRAD_EMISSION, 0, 0, 1, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_points(solver, 0, 0, 1, NULL, reals, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_points(solver, 0, 0, 1, &index, NULL, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_points(solver, 0, 0, 1, &index, reals, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_sensors(solver, 1, NULL, reals, out, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_sensors(solver, 1, reals, NULL, out, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_sensors(solver, 1, reals, reals, NULL, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_leaf_count(solver, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_write_checkpoint(solver, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_read_checkpoint(solver, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_export(solver, NULL), HRAD_ERROR_ARGUMENT);
  assert_ok(hrad_set_progress(solver, NULL, NULL));
  assert_ok(hrad_set_log(solver, NULL, NULL, HRAD_LOG_INFO));
  assert_int_equal(patch_count(solver), 12);
  hrad_destroy(&solver);
}

static void wrong_numbers(void** state) {
  hrad_solver* solver = gray_room();
  const double up[3] = {0, 0, 1}, zero[3] = {0, 0, 0}, middle[3] = {0.5, 0.5, 0.5};
  const double infinite[3] = {0, INFINITY, 0};
  const int64_t patch = 0, no_patch = 12;
  const double corner[2] = {0, 0}, outside[2] = {0.6, 0.6}, nan_uv[2] = {NAN, 0};
  double out[3] = {-7, -7, -7};
  int32_t rank = -7;
  (void)state;
  assert_status(hrad_set_log(solver, NULL, NULL, -1), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_log(solver, NULL, NULL, 4), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(solver, -1, 0, 0, 1, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(solver, 4, 0, 0, 1, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(solver, HRAD_EMISSION, 2, 0, 1, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(solver, HRAD_EMISSION, -1, 0, 1, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(solver, HRAD_EMISSION, 0, -1, 1, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(solver, HRAD_EMISSION, 0, 0, -1, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(solver, HRAD_EMISSION, 0, 12, 1, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(solver, HRAD_EMISSION, 0, 1, 12, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(solver, HRAD_EMISSION, 0, 1, INT64_MAX, out),
                HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_patches(solver, HRAD_EMISSION, 0, INT64_MAX, INT64_MAX, out),
                HRAD_ERROR_ARGUMENT);
  assert_ok(hrad_query_patches(solver, HRAD_EMISSION, 0, 12, 0, NULL));
  assert_status(hrad_query_points(solver, 0, 0, 1, &no_patch, corner, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_points(solver, 0, 0, 1, &patch, outside, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_points(solver, 0, 0, 1, &patch, nan_uv, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_points(solver, 7, 0, 1, &patch, corner, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_points(solver, 0, 7, 1, &patch, corner, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_points(solver, 0, 0, -1, &patch, corner, out), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_points(solver, 0, 0, INT64_MAX, &patch, corner, out),
                HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_sensors(solver, 1, middle, zero, out, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_sensors(solver, 1, infinite, up, out, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_sensors(solver, 1, middle, infinite, out, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_sensors(solver, -1, middle, up, out, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_query_sensors(solver, INT64_MAX, middle, up, out, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_patch_owner(solver, 12, &rank), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_patch_owner(solver, -1, &rank), HRAD_ERROR_ARGUMENT);
  assert_int_equal(rank, -7);
  assert_true(out[0] == -7 && out[1] == -7 && out[2] == -7);
  hrad_destroy(&solver);
}

static void wrong_struct_sizes(void** state) {
  hrad_solver* solver = gray_room();
  hrad_stats stats;
  hrad_param param;
  (void)state;
  memset(&stats, 0x5a, sizeof stats);
  memset(&param, 0x5a, sizeof param);
  for (size_t size = 0; size < sizeof(size_t); ++size) {
    stats.struct_size = param.struct_size = size;
    assert_fails(hrad_get_stats(solver, &stats), HRAD_ERROR_ARGUMENT, "struct_size");
    assert_fails(hrad_describe_param(0, &param), HRAD_ERROR_ARGUMENT, "struct_size");
  }
  assert_int_equal(stats.ranks, 0x5a5a5a5a);
  /* A size within a pointer: no half pointer is followed. */
  for (size_t size = sizeof(size_t); size < sizeof(hrad_material); ++size) {
    const double rho[3] = {0.25, 0.25, 0.25};
    double read[3] = {0, 0, 0};
    int32_t number = -1;
    hrad_material material = {size, rho, rho, 0, "name"};
    assert_ok(hrad_add_material(solver, &material, &number));
    assert_ok(hrad_get_material(solver, number, NULL, 0, NULL, read, NULL, NULL));
    assert_near(read[1], size < offsetof(hrad_material, emission) ? 0.5 : 0.25, 0);
  }
  stats.struct_size = offsetof(hrad_stats, threads);
  assert_ok(hrad_get_stats(solver, &stats));
  assert_int_equal(stats.converged, 0);
  assert_int_equal(stats.ranks, 1);
  assert_int_equal(stats.threads, 0x5a5a5a5a);
  stats.struct_size = sizeof(size_t);
  assert_ok(hrad_get_stats(solver, &stats));
  hrad_destroy(&solver);
}

static void calls_before_a_solve(void** state) {
  hrad_solver* solver = gray_room();
  const double middle[3] = {0.5, 0.5, 0.5}, uv[2] = {0.25, 0.25};
  const int64_t patch = 3;
  hrad_stats stats = {.struct_size = sizeof stats};
  double out[36] = {-7};
  int64_t leaves = -7;
  int32_t rank = -7;
  uint64_t hash = 7;
  (void)state;
  assert_status(hrad_patch_owner(solver, 0, &rank), HRAD_ERROR_STATE);
  assert_status(hrad_state_hash(solver, &hash), HRAD_ERROR_STATE);
  for (int32_t quantity = HRAD_RADIOSITY; quantity <= HRAD_NET_FLUX; ++quantity) {
    if (quantity == HRAD_EMISSION) continue;
    assert_status(hrad_query_patches(solver, quantity, 0, 0, 1, out), HRAD_ERROR_STATE);
    assert_status(hrad_query_points(solver, quantity, 0, 1, &patch, uv, out), HRAD_ERROR_STATE);
  }
  assert_status(hrad_query_sensors(solver, 1, middle, middle, out, NULL), HRAD_ERROR_STATE);
  assert_status(hrad_leaf_count(solver, &leaves), HRAD_ERROR_STATE);
  assert_status(hrad_query_leaves(solver, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL),
                HRAD_ERROR_STATE);
  assert_status(hrad_power_balance(solver, out, out, out, out), HRAD_ERROR_STATE);
  assert_status(hrad_export(solver, "never-written.csv"), HRAD_ERROR_STATE);
  assert_true(out[0] == -7 && leaves == -7 && rank == -7 && hash == 7);
  assert_ok(hrad_query_patches(solver, HRAD_EMISSION, HRAD_FRONT, 0, 12, out));
  assert_true(out[0] == 1 && out[35] == 1);
  assert_ok(hrad_get_stats(solver, &stats));
  assert_true(stats.converged == 0 && stats.iterations == 0 && stats.error_estimate < 0);
  assert_fails(hrad_write_checkpoint(solver, "no_such_folder/a.hrad"), HRAD_ERROR_FILE, "a.hrad");
  assert_fails(hrad_read_checkpoint(solver, "no_such_file.hrad"), HRAD_ERROR_FILE,
               "such_file.hrad");
  hrad_destroy(&solver);
}

static void partition_closes_the_scene(void** state) {
  hrad_solver* solver = new_solver();
  const double triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int64_t corners[3] = {0, 1, 2};
  const hrad_material plain = {.struct_size = sizeof plain};
  int32_t rank = -7;
  (void)state;
  assert_status(hrad_partition(solver), HRAD_ERROR_SCENE);
  assert_status(hrad_solve(solver), HRAD_ERROR_SCENE);
  add_room(solver, add_gray(solver, 0.5, 1, 0));
  assert_ok(hrad_partition(solver));
  assert_ok(hrad_partition(solver));
  assert_ok(hrad_patch_owner(solver, 11, &rank));
  assert_int_equal(rank, 0);
  assert_status(hrad_add_material(solver, &plain, NULL), HRAD_ERROR_STATE);
  assert_status(hrad_add_patches(solver, 3, triangle, 1, corners, NULL), HRAD_ERROR_STATE);
  assert_status(hrad_make_scene(solver, "cornell"), HRAD_ERROR_STATE);
  assert_status(hrad_load_scene(solver, "a.obj"), HRAD_ERROR_STATE);
  assert_status(hrad_set_text(solver, "visibility", "embree"), HRAD_ERROR_STATE);
  assert_ok(hrad_set_double(solver, "accuracy", 0.3)); /* the solve has not begun */
  assert_int_equal(patch_count(solver), 12);
  assert_int_equal(material_count(solver), 1);
  hrad_destroy(&solver);
}

static void* fail_elsewhere(void* user) {
  char* message = user;
  message[0] = hrad_error_message()[0] ? '!' : '.'; /* nothing failed on this thread yet */
  hrad_set_int(NULL, "seed", 1);
  snprintf(message + 1, 255, "%s", hrad_error_message());
  return NULL;
}

static void messages_belong_to_threads(void** state) {
  char elsewhere[256] = "", here[256];
  hrad_solver* solver = new_solver();
  pthread_t thread;
  (void)state;
  assert_status(hrad_set_int(solver, "sead", 1), HRAD_ERROR_ARGUMENT);
  snprintf(here, sizeof here, "%s", hrad_error_message());
  assert_int_equal(pthread_create(&thread, NULL, fail_elsewhere, elsewhere), 0);
  assert_int_equal(pthread_join(thread, NULL), 0);
  assert_int_equal(elsewhere[0], '.');
  assert_non_null(strstr(elsewhere, "solver"));
  assert_string_equal(hrad_error_message(), here);
  assert_ok(hrad_set_int(solver, "seed", 1)); /* a success leaves the message */
  assert_string_equal(hrad_error_message(), here);
  hrad_destroy(&solver);
}

static void machine_is_described(void** state) {
  hrad_solver* solver = new_solver();
  char text[8192], first[8];
  int64_t needed = -1;
  (void)state;
  assert_ok(hrad_describe_machine(solver, text, sizeof text, &needed));
  assert_int_equal(needed, strlen(text) + 1);
  assert_non_null(strchr(text, ':'));
  assert_ok(hrad_describe_machine(solver, first, sizeof first, NULL));
  assert_int_equal(strlen(first), 7);
  assert_memory_equal(first, text, 7);
  hrad_destroy(&solver);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(version_and_names),
      cmocka_unit_test(create_and_destroy),
      cmocka_unit_test(null_solver),
      cmocka_unit_test(null_arguments),
      cmocka_unit_test(wrong_numbers),
      cmocka_unit_test(wrong_struct_sizes),
      cmocka_unit_test(calls_before_a_solve),
      cmocka_unit_test(partition_closes_the_scene),
      cmocka_unit_test(messages_belong_to_threads),
      cmocka_unit_test(machine_is_described),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
