/* Making a scene through the C API: materials, patches from arrays, and values set apart. Errors
 * leave the scene as it was, and numbers never shift. */
#include <stdio.h>

#include "api.h"

static const double kTriangle[9] = {0, 0, 0, 2, 0, 0, 0, 1, 0};
static const int64_t kCorners[3] = {0, 1, 2};

static hrad_patch patch_at(const hrad_solver* solver, int64_t number) {
  hrad_patch patch = {.struct_size = sizeof patch};
  assert_ok(hrad_get_patch(solver, number, &patch));
  return patch;
}

static void materials_are_copied(void** state) {
  hrad_solver* solver = new_solver();
  double rho[3] = {0.1, 0.2, 0.3}, e[3] = {1, 2, 3}, rho_out[3], e_out[3];
  char name[32] = "lamp";
  hrad_material material = {sizeof material, rho, e, HRAD_TWO_SIDED, name};
  const hrad_material plain = {.struct_size = sizeof plain};
  int32_t number = -1, flags = -1;
  int64_t needed = -1;
  (void)state;
  assert_ok(hrad_add_material(solver, &material, &number));
  assert_int_equal(number, 0);
  rho[0] = 0.9;
  e[0] = 9;
  strcpy(name, "changed");
  assert_ok(hrad_add_material(solver, &plain, &number));
  assert_int_equal(number, 1);
  assert_ok(hrad_add_material(solver, &plain, NULL));
  assert_int_equal(material_count(solver), 3);

  assert_ok(hrad_get_material(solver, 0, name, sizeof name, &needed, rho_out, e_out, &flags));
  assert_string_equal(name, "lamp");
  assert_int_equal(needed, 5);
  assert_true(rho_out[0] == 0.1 && rho_out[1] == 0.2 && rho_out[2] == 0.3);
  assert_true(e_out[0] == 1 && e_out[1] == 2 && e_out[2] == 3);
  assert_int_equal(flags, HRAD_TWO_SIDED);
  assert_ok(hrad_get_material(solver, 1, NULL, 0, &needed, rho_out, e_out, &flags));
  assert_int_equal(needed, 1);
  assert_true(rho_out[0] == 0.5 && rho_out[2] == 0.5 && e_out[0] == 0 && e_out[2] == 0);
  assert_int_equal(flags, 0);
  assert_ok(hrad_get_material(solver, 1, NULL, 0, NULL, NULL, NULL, NULL));
  assert_status(hrad_get_material(solver, 3, NULL, 0, NULL, NULL, NULL, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_material(solver, -1, NULL, 0, NULL, NULL, NULL, NULL),
                HRAD_ERROR_ARGUMENT);
  hrad_destroy(&solver);
}

static void wrong_materials_are_refused(void** state) {
  static const double wrong_rho[] = {1, 1.5, -0.01, NAN, INFINITY};
  static const double wrong_e[] = {-1, -1e-300, NAN, INFINITY};
  hrad_solver* solver = new_solver();
  double rho[3] = {0.5, 0.5, 0.5}, e[3] = {0, 0, 0};
  hrad_material material = {sizeof material, rho, e, 0, NULL};
  int32_t number = -7;
  (void)state;
  for (size_t i = 0; i < sizeof wrong_rho / sizeof *wrong_rho; ++i) {
    rho[2] = wrong_rho[i];
    assert_fails(hrad_add_material(solver, &material, &number), HRAD_ERROR_ARGUMENT, "reflectance");
  }
  rho[2] = 0.5;
  for (size_t i = 0; i < sizeof wrong_e / sizeof *wrong_e; ++i) {
    e[1] = wrong_e[i];
    assert_fails(hrad_add_material(solver, &material, &number), HRAD_ERROR_ARGUMENT, "emission");
  }
  e[1] = 1;
  material.flags = HRAD_BLOCKER;
  assert_fails(hrad_add_material(solver, &material, &number), HRAD_ERROR_ARGUMENT, "blocker");
  material.flags = 4;
  assert_fails(hrad_add_material(solver, &material, &number), HRAD_ERROR_ARGUMENT, "flags");
  material.flags = 0;
  material.struct_size = 0;
  assert_fails(hrad_add_material(solver, &material, &number), HRAD_ERROR_ARGUMENT, "struct_size");
  assert_int_equal(number, -7);
  assert_int_equal(material_count(solver), 0);
  /* A program whose struct ends before `flags` is understood. */
  material.struct_size = offsetof(hrad_material, flags);
  material.flags = 4;
  assert_ok(hrad_add_material(solver, &material, &number));
  assert_int_equal(number, 0);
  hrad_destroy(&solver);
}

static void patch_numbers_go_on(void** state) {
  hrad_solver* solver = new_solver();
  const int32_t sheet = add_gray(solver, 0.5, 0, HRAD_TWO_SIDED);
  const int32_t wall = add_gray(solver, 0.5, 0, HRAD_BLOCKER);
  hrad_patch patch;
  (void)state;
  add_square(solver, 0, 0, 0, 1, 0, sheet);
  add_square(solver, 0, 0, 3, 1, 1, wall);
  assert_ok(hrad_add_patches(solver, 3, kTriangle, 1, kCorners, NULL));
  assert_int_equal(patch_count(solver), 5);
  patch = patch_at(solver, 0);
  assert_int_equal(patch.flags, HRAD_PATCH_TWO_SIDED);
  assert_int_equal(patch.material, sheet);
  assert_near(patch.area, 2, 1e-12);
  patch = patch_at(solver, 3);
  assert_int_equal(patch.flags, HRAD_PATCH_BLOCKER);
  assert_int_equal(patch.material, wall);
  assert_int_equal(patch.face, 3);
  patch = patch_at(solver, 4);
  assert_int_equal(patch.material, 0); /* the material added first */
  assert_near(patch.area, 1, 1e-12);
  for (int i = 0; i < 9; ++i) assert_true(patch.corners_xyz[i] == kTriangle[i]);
  assert_status(hrad_get_patch(solver, 5, &patch), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_patch(solver, -1, &patch), HRAD_ERROR_ARGUMENT);
  patch.struct_size = 0;
  assert_status(hrad_get_patch(solver, 0, &patch), HRAD_ERROR_ARGUMENT);
  hrad_destroy(&solver);
}

static void without_material_patches_are_gray(void** state) {
  hrad_solver* solver = new_solver();
  double rho[3], e[3];
  (void)state;
  assert_ok(hrad_add_patches(solver, 3, kTriangle, 1, kCorners, NULL));
  assert_int_equal(material_count(solver), 1);
  assert_int_equal(patch_at(solver, 0).material, 0);
  assert_ok(hrad_get_material(solver, 0, NULL, 0, NULL, rho, e, NULL));
  assert_true(rho[0] == 0.5 && rho[1] == 0.5 && rho[2] == 0.5);
  assert_true(e[0] == 0 && e[1] == 0 && e[2] == 0);
  hrad_destroy(&solver);
}

static void wrong_patches_add_nothing(void** state) {
  hrad_solver* solver = new_solver();
  const double bad[] = {NAN, INFINITY, -INFINITY, 1.0001e30, -1.0001e30};
  const int64_t low[3] = {0, -1, 2}, high[3] = {0, 1, 3};
  const int32_t no_such[1] = {1}, negative[1] = {-1};
  double xyz[9];
  (void)state;
  for (int round = 0; round < 2; ++round) {
    const int64_t patches = patch_count(solver), materials = material_count(solver);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
      memcpy(xyz, kTriangle, sizeof xyz);
      xyz[7] = bad[i];
      assert_fails(hrad_add_patches(solver, 3, xyz, 1, kCorners, NULL), HRAD_ERROR_ARGUMENT,
                   "vertex 2");
    }
    assert_status(hrad_add_patches(solver, 3, kTriangle, 1, low, NULL), HRAD_ERROR_ARGUMENT);
    assert_status(hrad_add_patches(solver, 3, kTriangle, 1, high, NULL), HRAD_ERROR_ARGUMENT);
    assert_status(hrad_add_patches(solver, 3, kTriangle, 1, kCorners, no_such),
                  HRAD_ERROR_ARGUMENT);
    assert_status(hrad_add_patches(solver, 3, kTriangle, 1, kCorners, negative),
                  HRAD_ERROR_ARGUMENT);
    assert_status(hrad_add_patches(solver, -1, kTriangle, 1, kCorners, NULL), HRAD_ERROR_ARGUMENT);
    assert_status(hrad_add_patches(solver, 3, kTriangle, -1, kCorners, NULL), HRAD_ERROR_ARGUMENT);
    assert_status(hrad_add_patches(solver, INT64_MAX, kTriangle, 1, kCorners, NULL),
                  HRAD_ERROR_ARGUMENT);
    assert_status(hrad_add_patches(solver, 3, kTriangle, INT64_MAX, kCorners, NULL),
                  HRAD_ERROR_ARGUMENT);
    assert_status(hrad_add_patches(solver, 3, kTriangle, INT64_C(1) << 40, kCorners, NULL),
                  HRAD_ERROR_ARGUMENT);
    assert_status(hrad_add_patches(solver, 3, NULL, 1, kCorners, NULL), HRAD_ERROR_ARGUMENT);
    assert_status(hrad_add_patches(solver, 3, kTriangle, 1, NULL, NULL), HRAD_ERROR_ARGUMENT);
    assert_status(hrad_add_patches(solver, 0, NULL, 1, kCorners, NULL), HRAD_ERROR_ARGUMENT);
    assert_ok(hrad_add_patches(solver, 0, NULL, 0, NULL, NULL));
    assert_ok(hrad_add_patches(solver, 3, kTriangle, 0, NULL, NULL));
    assert_int_equal(patch_count(solver), patches);
    assert_int_equal(material_count(solver), materials);
    /* The second round goes over a scene that has a patch. */
    assert_ok(hrad_add_patches(solver, 3, kTriangle, 1, kCorners, NULL));
  }
  /* What was refused left no vertices behind: the next patch has the right corners. */
  for (int i = 0; i < 9; ++i) assert_true(patch_at(solver, 1).corners_xyz[i] == kTriangle[i]);
  hrad_destroy(&solver);
}

static int diagnostics_mention(const hrad_solver* solver, const char* word) {
  char text[512];
  int64_t index = 0;
  while (hrad_get_diagnostic(solver, index++, text, sizeof text, NULL) == HRAD_OK)
    if (strstr(text, word)) return 1;
  return 0;
}

static void dropped_patches_keep_their_numbers(void** state) {
  hrad_solver* solver = new_solver();
  const double xyz[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 0, 0, 1};
  /* a good one; no area; the first again; it turned round; the first with its corners rotated */
  const int64_t vertex[18] = {0, 1, 2, 0, 1, 3, 0, 1, 2, 0, 2, 1, 1, 2, 0, 0, 1, 4};
  const int wanted[6] = {0, 1, 1, 0, 1, 0};
  (void)state;
  assert_ok(hrad_add_patches(solver, 5, xyz, 6, vertex, NULL));
  assert_int_equal(patch_count(solver), 6);
  for (int i = 0; i < 6; ++i) {
    const hrad_patch patch = patch_at(solver, i);
    assert_int_equal((patch.flags & HRAD_PATCH_DROPPED) != 0, wanted[i]);
    assert_near(patch.area, wanted[i] ? 0 : 0.5, 1e-12);
  }
  assert_true(diagnostics_mention(solver, "area"));
  /* Earlier calls count as well. */
  assert_ok(hrad_add_patches(solver, 5, xyz, 1, vertex, NULL));
  assert_true(patch_at(solver, 6).flags & HRAD_PATCH_DROPPED);
  assert_int_equal(patch_at(solver, 0).flags, 0);
  hrad_destroy(&solver);
}

static void values_are_set_apart(void** state) {
  hrad_solver* solver = new_solver();
  const int32_t gray = add_gray(solver, 0.5, 2, 0), wall = add_gray(solver, 0.5, 0, HRAD_BLOCKER);
  double e[12] = {1, 2, 3, 4, 5, 6}, out[12], rho[6] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  (void)state;
  add_square(solver, 0, 0, 0, 1, 0, gray);
  add_square(solver, 0, 0, 1, 1, 1, wall);
  assert_ok(hrad_set_emission(solver, 1, 1, e));
  assert_ok(hrad_query_patches(solver, HRAD_EMISSION, HRAD_FRONT, 0, 4, out));
  assert_true(out[0] == 2 && out[2] == 2 && out[3] == 1 && out[4] == 2 && out[5] == 3);
  assert_true(out[6] == 0 && out[11] == 0);
  assert_ok(hrad_query_patches(solver, HRAD_EMISSION, HRAD_BACK, 0, 2, out));
  assert_true(out[0] == 0 && out[5] == 0);
  assert_ok(hrad_set_reflectance(solver, 0, 2, rho));
  assert_ok(hrad_set_emission(solver, 4, 0, NULL));

  assert_fails(hrad_set_emission(solver, 1, 2, e), HRAD_ERROR_STATE, "blocker");
  memset(e, 0, sizeof e);
  assert_ok(hrad_set_emission(solver, 2, 2, e));
  e[5] = -1;
  assert_fails(hrad_set_emission(solver, 0, 2, e), HRAD_ERROR_ARGUMENT, "patch 1");
  e[5] = NAN;
  assert_fails(hrad_set_emission(solver, 0, 2, e), HRAD_ERROR_ARGUMENT, "patch 1");
  rho[3] = 1;
  assert_fails(hrad_set_reflectance(solver, 0, 2, rho), HRAD_ERROR_ARGUMENT, "patch 1");
  assert_status(hrad_set_emission(solver, -1, 1, e), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_emission(solver, 3, 2, e), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_emission(solver, 5, 0, e), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_emission(solver, 0, -1, e), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_emission(solver, 0, INT64_MAX, e), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_set_reflectance(solver, INT64_MAX, INT64_MAX, rho), HRAD_ERROR_ARGUMENT);
  /* Nothing of the refused calls was taken. */
  assert_ok(hrad_query_patches(solver, HRAD_EMISSION, HRAD_FRONT, 0, 4, out));
  assert_true(out[0] == 2 && out[3] == 1 && out[5] == 3 && out[6] == 0);
  hrad_destroy(&solver);
}

static void scene_without_light_is_told(void** state) {
  hrad_solver* solver = new_solver();
  char text[256] = "untouched";
  (void)state;
  assert_status(hrad_get_diagnostic(solver, 0, text, sizeof text, NULL), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_diagnostic(solver, -1, text, sizeof text, NULL), HRAD_ERROR_ARGUMENT);
  assert_string_equal(text, "untouched");
  assert_ok(hrad_add_patches(solver, 3, kTriangle, 1, kCorners, NULL));
  assert_true(diagnostics_mention(solver, "emit"));
  hrad_destroy(&solver);
}

struct heard {
  int32_t level;
  int count;
  char last[512];
};

static void hear(int32_t level, const char* message, void* user) {
  struct heard* heard = user;
  heard->level = level;
  heard->count++;
  snprintf(heard->last, sizeof heard->last, "%s", message);
}

static void dropped_patches_are_logged(void** state) {
  const double flat[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
  struct heard heard = {-1, 0, ""};
  hrad_solver* solver = new_solver();
  (void)state;
  assert_ok(hrad_set_log(solver, hear, &heard, HRAD_LOG_WARNING));
  assert_ok(hrad_add_patches(solver, 3, flat, 1, kCorners, NULL));
  assert_int_equal(heard.count, 1);
  assert_int_equal(heard.level, HRAD_LOG_WARNING);
  assert_true(strlen(heard.last) > 10 && !strchr(heard.last, '\n'));
  assert_ok(hrad_set_log(solver, hear, &heard, HRAD_LOG_ERROR));
  assert_ok(hrad_add_patches(solver, 3, flat, 1, kCorners, NULL));
  assert_ok(hrad_set_log(solver, NULL, NULL, HRAD_LOG_DEBUG));
  assert_ok(hrad_add_patches(solver, 3, flat, 1, kCorners, NULL));
  assert_int_equal(heard.count, 1);
  hrad_destroy(&solver);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(materials_are_copied),
      cmocka_unit_test(wrong_materials_are_refused),
      cmocka_unit_test(patch_numbers_go_on),
      cmocka_unit_test(without_material_patches_are_gray),
      cmocka_unit_test(wrong_patches_add_nothing),
      cmocka_unit_test(dropped_patches_keep_their_numbers),
      cmocka_unit_test(values_are_set_apart),
      cmocka_unit_test(scene_without_light_is_told),
      cmocka_unit_test(dropped_patches_are_logged),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
