/* Scenes from OBJ files and built-in ones through the C API; the reader itself is tested in
 * tests/scene. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "api.h"

static hrad_patch patch_at(const hrad_solver* solver, int64_t number) {
  hrad_patch patch = {.struct_size = sizeof patch};
  assert_ok(hrad_get_patch(solver, number, &patch));
  return patch;
}

static void builtin_scenes_are_made(void** state) {
  static const char* const promised[] = {"building",      "classroom",     "cornell",
                                         "furnace",       "building-x10",  "building-x100",
                                         "classroom-x10", "classroom-x100"};
  int64_t names = 0;
  hrad_solver* solver = new_solver();
  (void)state;
  while (hrad_scene_name(names)) ++names;
  assert_null(hrad_scene_name(-1));
  assert_null(hrad_scene_name(INT64_MAX));
  for (size_t i = 0; i < sizeof promised / sizeof *promised; ++i) {
    int64_t found = 0;
    while (found < names && strcmp(hrad_scene_name(found), promised[i])) ++found;
    assert_true(found < names);
  }
  assert_fails(hrad_make_scene(solver, "no such scene"), HRAD_ERROR_ARGUMENT, "cornell");
  assert_int_equal(patch_count(solver), 0);
  assert_int_equal(material_count(solver), 0);
  for (int64_t i = 0; i < names; ++i) {
    if (strstr(hrad_scene_name(i), "-x10")) continue; /* large ones: bench and physics make them */
    hrad_destroy(&solver);
    solver = new_solver();
    assert_ok(hrad_make_scene(solver, hrad_scene_name(i)));
    assert_true(patch_count(solver) > 0);
    assert_fails(hrad_make_scene(solver, "cornell"), HRAD_ERROR_STATE, "empty");
  }
  hrad_destroy(&solver);
}

/* A folder of its own for the files of one test. */
static void make_folder(char* folder, size_t size) {
  const char* root = getenv("TMPDIR");
  snprintf(folder, size, "%s/hrad-load-XXXXXX", root && *root ? root : "/tmp");
  assert_non_null(mkdtemp(folder));
}

static void write_file(const char* folder, const char* name, const char* content, char* path,
                       size_t size) {
  FILE* file;
  snprintf(path, size, "%s/%s", folder, name);
  file = fopen(path, "w");
  assert_non_null(file);
  assert_true(fputs(content, file) >= 0);
  assert_int_equal(fclose(file), 0);
}

static void files_are_loaded(void** state) {
  static const char obj[] =
      "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl lamp\nf 1 2 3 4\nf 3 2 1\n";
  static const char mtl[] = "newmtl lamp\nKd 0.1 0.2 0.6\nKe 1 2 6\n";
  char folder[512], obj_path[600], mtl_path[600], bad_path[600];
  hrad_solver* solver = new_solver();
  hrad_patch patch;
  double e[9];
  (void)state;
  make_folder(folder, sizeof folder);
  write_file(folder, "room.obj", obj, obj_path, sizeof obj_path);
  write_file(folder, "room.mtl", mtl, mtl_path, sizeof mtl_path);
  write_file(folder, "bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n", bad_path,
             sizeof bad_path);

  assert_ok(hrad_load_scene(solver, obj_path));
  assert_int_equal(patch_count(solver), 3);
  assert_int_equal(patch_at(solver, 1).face, 0);
  assert_int_equal(patch_at(solver, 2).face, 1);
  assert_ok(hrad_query_patches(solver, HRAD_EMISSION, HRAD_FRONT, 0, 1, e));
  assert_true(e[0] == 1 && e[1] == 2 && e[2] == 6);
  assert_fails(hrad_load_scene(solver, bad_path), HRAD_ERROR_SCENE, "bad.obj:5");
  assert_status(hrad_load_scene(solver, "/no/such/folder/scene.obj"), HRAD_ERROR_FILE);
  assert_status(hrad_load_scene(solver, folder), HRAD_ERROR_FILE);
  assert_status(hrad_load_scene(solver, ""), HRAD_ERROR_FILE);
  assert_int_equal(patch_count(solver), 3);
  /* It adds to what is there; the repetition is dropped but counted. */
  assert_ok(hrad_load_scene(solver, obj_path));
  assert_int_equal(patch_count(solver), 6);
  assert_true(patch_at(solver, 3).flags & HRAD_PATCH_DROPPED);
  hrad_destroy(&solver);

  solver = new_solver();
  assert_ok(hrad_set_int(solver, "bands", 1));
  assert_ok(hrad_set_text(solver, "sides", "flip"));
  assert_ok(hrad_load_scene(solver, obj_path));
  assert_ok(hrad_query_patches(solver, HRAD_EMISSION, HRAD_FRONT, 0, 3, e));
  assert_near(e[0], 3, 1e-12);
  patch = patch_at(solver, 0);
  { /* turned round: the front faces down */
    const double* c = patch.corners_xyz;
    assert_true((c[3] - c[0]) * (c[7] - c[1]) - (c[4] - c[1]) * (c[6] - c[0]) < 0);
  }
  hrad_destroy(&solver);

  solver = new_solver();
  assert_ok(hrad_set_text(solver, "sides", "two-sided"));
  assert_ok(hrad_load_scene(solver, obj_path));
  assert_true(patch_at(solver, 0).flags & HRAD_PATCH_TWO_SIDED);
  hrad_destroy(&solver);

  solver = new_solver();
  assert_ok(hrad_set_int(solver, "bands", 2));
  assert_fails(hrad_load_scene(solver, obj_path), HRAD_ERROR_STATE, "bands");
  hrad_destroy(&solver);
  assert_int_equal(remove(obj_path) | remove(mtl_path) | remove(bad_path) | rmdir(folder), 0);
}

static void count_warning(int32_t level, const char* message, void* user) {
  if (level == HRAD_LOG_WARNING && strstr(message, "no emitter")) ++*(int*)user;
}

/* A scene without light is told of once: in the log when it is loaded, in the diagnostics as long
 * as it is dark. */
static void a_dark_scene_is_told_of_once(void** state) {
  const double light[3] = {1, 1, 1};
  char folder[512], path[600], text[512];
  int warnings = 0, diagnostics = 0;
  hrad_solver* solver = new_solver();
  (void)state;
  make_folder(folder, sizeof folder);
  write_file(folder, "plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", path, sizeof path);
  assert_ok(hrad_set_log(solver, count_warning, &warnings, HRAD_LOG_DEBUG));
  assert_ok(hrad_load_scene(solver, path));
  assert_int_equal(warnings, 1);
  for (int64_t i = 0; hrad_get_diagnostic(solver, i, text, sizeof text, NULL) == HRAD_OK; ++i)
    diagnostics += strstr(text, "emit") || strstr(text, "dark");
  assert_int_equal(diagnostics, 1);
  assert_ok(hrad_set_emission(solver, 0, 1, light));
  for (int64_t i = 0; hrad_get_diagnostic(solver, i, text, sizeof text, NULL) == HRAD_OK; ++i)
    assert_null(strstr(text, "emit"));
  hrad_destroy(&solver);
  assert_int_equal(remove(path) | rmdir(folder), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(builtin_scenes_are_made),
      cmocka_unit_test(files_are_loaded),
      cmocka_unit_test(a_dark_scene_is_told_of_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
