/* A solution through the C API: every query in every shape, and that they agree with each other.
 * What the numbers should be is asked in tests/physics. */
#include <stdlib.h>

#include "api.h"

enum { BANDS = 3 };

static hrad_solver* solved(const char* scene, double accuracy) {
  hrad_solver* solver = new_solver();
  assert_ok(hrad_make_scene(solver, scene));
  assert_ok(hrad_set_double(solver, "accuracy", accuracy));
  assert_ok(hrad_solve(solver));
  return solver;
}

/* Solved once, shared by the tests, which only read it. */
static hrad_solver* cornell;

static int set_up(void** state) {
  (void)state;
  return hrad_create(&cornell) < 0 || hrad_make_scene(cornell, "cornell") < 0 ||
         hrad_set_double(cornell, "accuracy", 0.1) < 0 || hrad_solve(cornell) != HRAD_OK;
}

static int tear_down(void** state) {
  (void)state;
  hrad_destroy(&cornell);
  return 0;
}

static double* query(int32_t quantity, int32_t side) {
  const int64_t patches = patch_count(cornell);
  double* out = malloc((size_t)patches * BANDS * sizeof *out);
  assert_ok(hrad_query_patches(cornell, quantity, side, 0, patches, out));
  return out;
}

static double largest(const double* values, int64_t count) {
  double result = 0;
  for (int64_t i = 0; i < count; ++i) result = fmax(result, fabs(values[i]));
  return result;
}

static void furnace_is_flat(void** state) {
  hrad_solver* solver = solved("furnace", 0.1);
  const int64_t patches = patch_count(solver);
  double* b = malloc((size_t)patches * BANDS * sizeof *b);
  (void)state;
  assert_ok(hrad_query_patches(solver, HRAD_RADIOSITY, HRAD_FRONT, 0, patches, b));
  for (int64_t i = 0; i < patches * BANDS; ++i)
    assert_near(b[i], 2, 0.1 * 2); /* E/(1-rho), by the accuracy */
  free(b);
  hrad_destroy(&solver);
}

static void patches_obey_the_equation(void** state) {
  double *b = query(HRAD_RADIOSITY, HRAD_FRONT), *h = query(HRAD_IRRADIANCE, HRAD_FRONT);
  double *e = query(HRAD_EMISSION, HRAD_FRONT), *net = query(HRAD_NET_FLUX, HRAD_FRONT);
  const int64_t patches = patch_count(cornell);
  const double top = largest(b, patches * BANDS);
  (void)state;
  assert_true(top > 0 && largest(h, patches * BANDS) > 0);
  for (int64_t p = 0; p < patches; ++p) {
    hrad_patch patch = {.struct_size = sizeof patch};
    double rho[BANDS];
    assert_ok(hrad_get_patch(cornell, p, &patch));
    assert_ok(hrad_get_material(cornell, patch.material, NULL, 0, NULL, rho, NULL, NULL));
    for (int64_t k = 0; k < BANDS; ++k) {
      const int64_t i = p * BANDS + k;
      assert_true(b[i] >= e[i] && h[i] >= 0);
      assert_near(b[i], e[i] + rho[k] * h[i], 1e-5 * top);
      assert_near(net[i], b[i] - h[i], 1e-6 * top);
    }
  }
  free(b);
  free(h);
  free(e);
  free(net);
}

static void backs_are_black(void** state) {
  const int64_t patches = patch_count(cornell);
  (void)state;
  for (int32_t quantity = HRAD_RADIOSITY; quantity <= HRAD_NET_FLUX; ++quantity) {
    double* out = query(quantity, HRAD_BACK);
    for (int64_t i = 0; i < patches * BANDS; ++i) assert_true(out[i] == 0);
    free(out);
  }
}

static void parts_answer_like_the_whole(void** state) {
  double *whole = query(HRAD_RADIOSITY, HRAD_FRONT), part[2 * BANDS];
  const int64_t patches = patch_count(cornell);
  (void)state;
  for (int64_t first = 0; first + 2 <= patches; ++first) {
    assert_ok(hrad_query_patches(cornell, HRAD_RADIOSITY, HRAD_FRONT, first, 2, part));
    assert_memory_equal(part, whole + first * BANDS, sizeof part);
  }
  assert_ok(hrad_query_patches(cornell, HRAD_RADIOSITY, HRAD_FRONT, patches, 0, NULL));
  free(whole);
}

static double triangle_area(const double* c) {
  const double u[3] = {c[3] - c[0], c[4] - c[1], c[5] - c[2]};
  const double v[3] = {c[6] - c[0], c[7] - c[1], c[8] - c[2]};
  const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                       u[0] * v[1] - u[1] * v[0]};
  return 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

/* Leaves tile their patches, and their area-weighted means are the patches' means. */
static void leaves_agree_with_patches(void** state) {
  const int64_t patches = patch_count(cornell);
  double* b = query(HRAD_RADIOSITY, HRAD_FRONT);
  double* mean = calloc((size_t)patches * BANDS, sizeof *mean);
  double* covered = calloc((size_t)patches, sizeof *covered);
  const double top = largest(b, patches * BANDS);
  int64_t leaves = -1;
  (void)state;
  assert_ok(hrad_leaf_count(cornell, &leaves));
  assert_true(leaves >= patches);
  {
    int64_t* patch = malloc((size_t)leaves * sizeof *patch);
    int64_t* face = malloc((size_t)leaves * sizeof *face);
    int32_t* side = malloc((size_t)leaves * sizeof *side);
    double* corners = malloc((size_t)leaves * 9 * sizeof *corners);
    double* area = malloc((size_t)leaves * sizeof *area);
    double* radiosity = malloc((size_t)leaves * BANDS * sizeof *radiosity);
    assert_ok(hrad_query_leaves(cornell, 0, leaves, patch, face, side, corners, area, radiosity));
    for (int64_t i = 0; i < leaves; ++i) {
      hrad_patch of = {.struct_size = sizeof of};
      assert_true(i == 0 || patch[i - 1] <= patch[i]);
      assert_ok(hrad_get_patch(cornell, patch[i], &of));
      assert_int_equal(face[i], of.face);
      assert_int_equal(side[i], HRAD_FRONT);
      assert_near(triangle_area(corners + 9 * i), area[i], 1e-9 * of.area);
      covered[patch[i]] += area[i];
      for (int k = 0; k < BANDS; ++k)
        mean[patch[i] * BANDS + k] += area[i] * radiosity[i * BANDS + k];
    }
    for (int64_t p = 0; p < patches; ++p) {
      hrad_patch of = {.struct_size = sizeof of};
      assert_ok(hrad_get_patch(cornell, p, &of));
      assert_near(covered[p], of.area, 1e-9 * of.area);
      for (int k = 0; k < BANDS; ++k)
        assert_near(mean[p * BANDS + k] / covered[p], b[p * BANDS + k], 1e-5 * top);
    }
    /* One leaf alone, and arrays left out. */
    {
      const int64_t i = leaves / 2;
      double one_area = -1, one[BANDS];
      assert_ok(hrad_query_leaves(cornell, i, 1, NULL, NULL, NULL, NULL, &one_area, NULL));
      assert_true(one_area == area[i]);
      assert_ok(hrad_query_leaves(cornell, i, 1, NULL, NULL, NULL, NULL, NULL, one));
      assert_memory_equal(one, radiosity + i * BANDS, sizeof one);
      assert_ok(hrad_query_leaves(cornell, leaves, 0, NULL, NULL, NULL, NULL, NULL, NULL));
      assert_status(hrad_query_leaves(cornell, leaves, 1, NULL, NULL, NULL, NULL, NULL, one),
                    HRAD_ERROR_ARGUMENT);
      assert_status(hrad_query_leaves(cornell, -1, 1, NULL, NULL, NULL, NULL, NULL, one),
                    HRAD_ERROR_ARGUMENT);
      assert_status(hrad_query_leaves(cornell, 1, INT64_MAX, NULL, NULL, NULL, NULL, NULL, one),
                    HRAD_ERROR_ARGUMENT);
      assert_status(hrad_query_leaves(cornell, 0, -1, NULL, NULL, NULL, NULL, NULL, one),
                    HRAD_ERROR_ARGUMENT);
    }
    free(patch);
    free(face);
    free(side);
    free(corners);
    free(area);
    free(radiosity);
  }
  free(b);
  free(mean);
  free(covered);
}

static void points_lie_within_the_solution(void** state) {
  static const double places[][2] = {{0, 0}, {1, 0}, {0, 1}, {1.0 / 3, 1.0 / 3}, {0.5, 0.5}};
  enum { PLACES = sizeof places / sizeof *places };
  const int64_t patches = patch_count(cornell);
  double *e = query(HRAD_EMISSION, HRAD_FRONT), *means = query(HRAD_RADIOSITY, HRAD_FRONT);
  const double top = largest(means, patches * BANDS);
  (void)state;
  for (int64_t p = 0; p < patches; ++p) {
    int64_t patch[PLACES];
    double uv[2 * PLACES], b[PLACES * BANDS], h[PLACES * BANDS], one[BANDS], emission[BANDS];
    for (int i = 0; i < PLACES; ++i) {
      patch[i] = p;
      uv[2 * i] = places[i][0];
      uv[2 * i + 1] = places[i][1];
    }
    assert_ok(hrad_query_points(cornell, HRAD_RADIOSITY, HRAD_FRONT, PLACES, patch, uv, b));
    assert_ok(hrad_query_points(cornell, HRAD_IRRADIANCE, HRAD_FRONT, PLACES, patch, uv, h));
    for (int i = 0; i < PLACES * BANDS; ++i) {
      assert_true(b[i] >= e[p * BANDS + i % BANDS] - 1e-6 * top && b[i] <= 4 * top);
      assert_true(h[i] >= -1e-6 * top && isfinite(h[i]));
    }
    assert_ok(hrad_query_points(cornell, HRAD_RADIOSITY, HRAD_FRONT, 1, patch + 3, uv + 6, one));
    assert_memory_equal(one, b + 3 * BANDS, sizeof one);
    assert_ok(
        hrad_query_points(cornell, HRAD_EMISSION, HRAD_FRONT, 1, patch + 3, uv + 6, emission));
    assert_memory_equal(emission, e + p * BANDS, sizeof emission);
    assert_ok(hrad_query_points(cornell, HRAD_RADIOSITY, HRAD_BACK, 1, patch + 3, uv + 6, one));
    assert_true(one[0] == 0 && one[1] == 0 && one[2] == 0);
  }
  assert_ok(hrad_query_points(cornell, HRAD_RADIOSITY, HRAD_FRONT, 0, NULL, NULL, NULL));
  free(e);
  free(means);
}

/* In a furnace every direction is as bright as every other, whatever the length of the normal. */
static void sensors_see_the_furnace(void** state) {
  hrad_solver* solver = solved("furnace", 0.1);
  hrad_patch patch = {.struct_size = sizeof patch};
  double low[3] = {1e30, 1e30, 1e30}, high[3] = {-1e30, -1e30, -1e30}, xyz[6];
  const double normal[6] = {0, 0, 1, 7, -3, 2};
  double h[6], error[6], again[6];
  (void)state;
  for (int64_t p = 0; p < patch_count(solver); ++p) {
    assert_ok(hrad_get_patch(solver, p, &patch));
    for (int i = 0; i < 9; ++i) {
      low[i % 3] = fmin(low[i % 3], patch.corners_xyz[i]);
      high[i % 3] = fmax(high[i % 3], patch.corners_xyz[i]);
    }
  }
  for (int i = 0; i < 6; ++i) xyz[i] = 0.5 * (low[i % 3] + high[i % 3]);
  assert_ok(hrad_query_sensors(solver, 2, xyz, normal, h, error));
  for (int i = 0; i < 6; ++i) {
    assert_true(error[i] >= 0 && error[i] < 0.2);
    assert_near(h[i], 2, 0.02 + 5 * error[i]);
  }
  assert_ok(hrad_query_sensors(solver, 2, xyz, normal, again, NULL));
  assert_memory_equal(again, h, sizeof h);
  assert_ok(hrad_query_sensors(solver, 0, NULL, NULL, NULL, NULL));
  hrad_destroy(&solver);
}

static void power_is_accounted_for(void** state) {
  double emitted[BANDS], absorbed[BANDS], back[BANDS], escaped[BANDS], alone[BANDS];
  double *e = query(HRAD_EMISSION, HRAD_FRONT), sum[BANDS] = {0};
  (void)state;
  assert_ok(hrad_power_balance(cornell, emitted, absorbed, back, escaped));
  for (int64_t p = 0; p < patch_count(cornell); ++p) {
    hrad_patch patch = {.struct_size = sizeof patch};
    assert_ok(hrad_get_patch(cornell, p, &patch));
    for (int k = 0; k < BANDS; ++k) sum[k] += patch.area * e[p * BANDS + k];
  }
  for (int k = 0; k < BANDS; ++k) {
    assert_near(emitted[k], sum[k], 1e-6 * sum[k]);
    assert_true(absorbed[k] > 0 && back[k] >= 0 && escaped[k] >= 0);
    assert_near(absorbed[k] + back[k] + escaped[k], emitted[k], 0.1 * emitted[k]);
  }
  assert_ok(hrad_power_balance(cornell, NULL, alone, NULL, NULL));
  assert_memory_equal(alone, absorbed, sizeof alone);
  assert_ok(hrad_power_balance(cornell, NULL, NULL, NULL, NULL));
  free(e);
}

static void statistics_are_filled(void** state) {
  hrad_stats stats = {.struct_size = sizeof stats};
  int64_t leaves = -1;
  (void)state;
  assert_ok(hrad_get_stats(cornell, &stats));
  assert_ok(hrad_leaf_count(cornell, &leaves));
  assert_int_equal(stats.struct_size, sizeof stats);
  assert_int_equal(stats.converged, 1);
  assert_int_equal(stats.ranks, 1);
  assert_true(stats.threads >= 1);
  assert_int_equal(stats.patches, patch_count(cornell));
  assert_int_equal(stats.leaves, leaves);
  assert_true(stats.elements >= stats.leaves && stats.links > 0 && stats.rays > 0);
  assert_true(stats.swept_links > 0 && stats.swept_links < stats.links);
  assert_true(stats.iterations > 0 && stats.area > 0);
  assert_true(stats.back_share >= 0 && stats.back_share <= 1);
  assert_true(stats.error_estimate >= 0 && stats.error_estimate <= 0.1);
  assert_true(stats.seconds_load >= 0 && stats.seconds_initial >= 0);
  assert_true(stats.memory_peak_bytes > 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(furnace_is_flat),           cmocka_unit_test(patches_obey_the_equation),
      cmocka_unit_test(backs_are_black),           cmocka_unit_test(parts_answer_like_the_whole),
      cmocka_unit_test(leaves_agree_with_patches), cmocka_unit_test(points_lie_within_the_solution),
      cmocka_unit_test(sensors_see_the_furnace),   cmocka_unit_test(power_is_accounted_for),
      cmocka_unit_test(statistics_are_filled),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
