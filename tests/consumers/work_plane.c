/* How bright is it on the desks of a room? Builds the room from arrays, solves it, and reads the
 * irradiance on a plane 0.8 m above the floor, lamp by lamp and together. Used by the Makefile and
 * the CMake project beside it. */
#include <hrad/hrad.h>
#include <stdio.h>
#include <stdlib.h>

enum { BANDS = 3, SENSORS = 9 };

/* Every call's status is looked at; the message says what to do. */
static void require(hrad_status status) {
  if (status >= 0) return;
  fprintf(stderr, "work_plane: %s: %s\n", hrad_status_name(status), hrad_error_message());
  exit(1);
}

/* A room of 4 x 3 x 2.5 m, seen from inside: two triangles a wall, the corners anticlockwise. */
static void add_room(hrad_solver *solver) {
  static const double xyz[] = {0, 0, 0,   4, 0, 0,   4, 3, 0,   0, 3, 0,
                               0, 0, 2.5, 4, 0, 2.5, 4, 3, 2.5, 0, 3, 2.5};
  static const int64_t vertex[] = {0, 1, 2, 0, 2, 3, 4, 7, 6, 4, 6, 5, 0, 4, 5, 0, 5, 1,
                                   1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0};
  static const double white[BANDS] = {0.7, 0.7, 0.65};
  hrad_material wall = {0};
  int32_t number[12];
  wall.struct_size = sizeof wall;
  wall.name = "wall";
  wall.reflectance = white;
  require(hrad_add_material(solver, &wall, &number[0]));
  for (int i = 1; i < 12; ++i) number[i] = number[0];
  require(hrad_add_patches(solver, 8, xyz, 12, vertex, number));
}

/* A square lamp of 0.6 m under the ceiling, facing down. */
static void add_lamp(hrad_solver *solver, double x, double y) {
  const double a = x - 0.3, b = x + 0.3, c = y - 0.3, d = y + 0.3, z = 2.45;
  const double xyz[] = {a, c, z, a, d, z, b, d, z, b, c, z};
  static const int64_t vertex[] = {0, 1, 2, 0, 2, 3};
  static const double glow[BANDS] = {100, 100, 90}, grey[BANDS] = {0.5, 0.5, 0.5};
  hrad_material lamp = {0};
  int32_t number[2];
  lamp.struct_size = sizeof lamp;
  lamp.name = "lamp";
  lamp.reflectance = grey;
  lamp.emission = glow;
  require(hrad_add_material(solver, &lamp, &number[0]));
  number[1] = number[0];
  require(hrad_add_patches(solver, 4, xyz, 2, vertex, number));
}

static double mean_on_the_plane(const hrad_solver *solver) {
  double xyz[3 * SENSORS], normal[3 * SENSORS], irradiance[BANDS * SENSORS], sum = 0;
  for (int i = 0; i < SENSORS; ++i) {
    xyz[3 * i] = 0.5 + 1.5 * (i % 3);
    xyz[3 * i + 1] = 0.5 + 1.0 * (i / 3);
    xyz[3 * i + 2] = 0.8;
    normal[3 * i] = normal[3 * i + 1] = 0;
    normal[3 * i + 2] = 1;
  }
  require(hrad_query_sensors(solver, SENSORS, xyz, normal, irradiance, NULL));
  for (int i = 0; i < SENSORS; ++i) sum += irradiance[BANDS * i] / SENSORS;
  return sum;
}

int main(void) {
  const double on[2 * BANDS] = {100, 100, 90, 100, 100, 90}, off[2 * BANDS] = {0};
  hrad_solver *solver = NULL;
  double both, left, right;
  require(hrad_create(&solver));
  require(hrad_set_double(solver, "accuracy", 0.05));
  add_room(solver);
  add_lamp(solver, 1, 1.5);
  add_lamp(solver, 3, 1.5);
  require(hrad_solve(solver));
  both = mean_on_the_plane(solver);

  /* Other light on the same mesh takes sweeps alone. */
  require(hrad_set_int(solver, "refine", 0));
  require(hrad_set_emission(solver, 14, 2, off));
  require(hrad_solve(solver));
  left = mean_on_the_plane(solver);
  require(hrad_set_emission(solver, 12, 2, off));
  require(hrad_set_emission(solver, 14, 2, on));
  require(hrad_solve(solver));
  right = mean_on_the_plane(solver);

  printf("work plane: left lamp %.2f, right lamp %.2f, both %.2f W/m2\n", left, right, both);
  hrad_destroy(&solver);
  /* Light adds up. */
  return left > 0 && right > 0 && both > 0.97 * (left + right) && both < 1.03 * (left + right) ? 0
                                                                                               : 2;
}
