/* What the tests of the C API share: checks of statuses with their messages, and small scenes made
 * from arrays. They see hrad.h alone. */
#ifndef HRAD_TESTS_API_H
#define HRAD_TESTS_API_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* cmocka.h wants the headers above first. */
#include <cmocka.h>
#include <hrad/hrad.h>
#include <math.h>
#include <string.h>

/* The call gives this status; an error has a message. */
#define assert_status(call, wanted)                                                         \
  do {                                                                                      \
    const hrad_status status_ = (call);                                                     \
    if (status_ != (wanted))                                                                \
      fail_msg("%s gave %s, wanted %s; last message: %s", #call, hrad_status_name(status_), \
               hrad_status_name(wanted), hrad_error_message());                             \
    if (status_ < 0) assert_true(strlen(hrad_error_message()) > 10);                        \
  } while (0)
#define assert_ok(call) assert_status(call, HRAD_OK)

/* The call fails like this and its message contains the text. */
#define assert_fails(call, wanted, text)                                        \
  do {                                                                          \
    assert_status(call, wanted);                                                \
    if (!strstr(hrad_error_message(), text))                                    \
      fail_msg("%s said '%s', wanted '%s'", #call, hrad_error_message(), text); \
  } while (0)

#define assert_near(value, wanted, tolerance)                                            \
  do {                                                                                   \
    const double value_ = (value), wanted_ = (wanted), tolerance_ = (tolerance);         \
    if (!(fabs(value_ - wanted_) <= tolerance_))                                         \
      fail_msg("%s = %.12g, wanted %.12g +- %.3g", #value, value_, wanted_, tolerance_); \
  } while (0)

static inline hrad_solver* new_solver(void) {
  hrad_solver* solver = NULL;
  assert_ok(hrad_create(&solver));
  assert_non_null(solver);
  return solver;
}

static inline int64_t patch_count(const hrad_solver* solver) {
  int64_t patches = -1;
  assert_ok(hrad_scene_size(solver, &patches, NULL));
  return patches;
}

static inline int64_t material_count(const hrad_solver* solver) {
  int64_t materials = -1;
  assert_ok(hrad_scene_size(solver, NULL, &materials));
  return materials;
}

/* The same reflectance and emission in every band, of which there are up to 16. */
static inline int32_t add_gray(hrad_solver* solver, double reflectance, double emission,
                               int32_t flags) {
  double rho[16], e[16];
  hrad_material material = {sizeof material, rho, e, flags, "gray"};
  int32_t number = -1, band;
  for (band = 0; band < 16; ++band) {
    rho[band] = reflectance;
    e[band] = emission;
  }
  assert_ok(hrad_add_material(solver, &material, &number));
  return number;
}

/* Two triangles with the corners a, b, c, d, anticlockwise seen from the front. */
static inline void add_quad(hrad_solver* solver, const double corners[12], int32_t material) {
  const int64_t vertex[6] = {0, 1, 2, 0, 2, 3};
  const int32_t both[2] = {material, material};
  assert_ok(hrad_add_patches(solver, 4, corners, 2, vertex, both));
}

/* A level square of side 2*half at height z around (x, y), facing down (down != 0) or up. */
static inline void add_square(hrad_solver* solver, double x, double y, double z, double half,
                              int down, int32_t material) {
  const double up_corners[12] = {x - half, y - half, z, x + half, y - half, z,
                                 x + half, y + half, z, x - half, y + half, z};
  const double down_corners[12] = {x - half, y - half, z, x - half, y + half, z,
                                   x + half, y + half, z, x + half, y - half, z};
  add_quad(solver, down ? down_corners : up_corners, material);
}

/* The unit cube seen from within: twelve patches whose fronts face inward. Patches 0, 1 are the
 * floor (z = 0), 2, 3 the ceiling. */
static inline void add_room(hrad_solver* solver, int32_t material) {
  const double xyz[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  const int64_t vertex[36] = {0, 1, 2, 0, 2, 3, 4, 7, 6, 4, 6, 5, 0, 4, 5, 0, 5, 1,
                              1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0};
  int32_t all[12];
  int i;
  for (i = 0; i < 12; ++i) all[i] = material;
  assert_ok(hrad_add_patches(solver, 8, xyz, 12, vertex, all));
}

#endif
