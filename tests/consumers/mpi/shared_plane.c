/* The light on a plane in a room, over several processes, as `mpirun -n 2 shared_plane`: rank 0
 * describes the room by arrays, all solve it together, each measures its own rows of a plane 0.8 m
 * above the floor, and rank 0 prints their mean. */
#include <hrad/hrad_mpi.h>
#include <stdio.h>
#include <string.h>

enum { BANDS = 3, COLUMNS = 8, ROWS = 6 };

/* Every call's status is looked at. That of a collective call is the same on all ranks: rank 0
 * speaks for them. */
static void require(hrad_status status) {
  int rank;
  if (status >= 0) return;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0)
    fprintf(stderr, "shared_plane: %s: %s\n", hrad_status_name(status), hrad_error_message());
  MPI_Abort(MPI_COMM_WORLD, 1);
}

/* The room of 4 x 3 x 2.5 m, its walls looking inside, and a square lamp of 0.6 m under the
 * ceiling. All ranks make these calls; arrays count on rank 0 alone. */
static void add_room(hrad_solver *solver, int rank) {
  static const double room[] = {0, 0, 0,   4, 0, 0,   4, 3, 0,   0, 3, 0,
                                0, 0, 2.5, 4, 0, 2.5, 4, 3, 2.5, 0, 3, 2.5};
  static const int64_t walls[] = {0, 1, 2, 0, 2, 3, 4, 7, 6, 4, 6, 5, 0, 4, 5, 0, 5, 1,
                                  1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0};
  static const double lamp[] = {1.7, 1.2, 2.45, 1.7, 1.8, 2.45, 2.3, 1.8, 2.45, 2.3, 1.2, 2.45};
  static const int64_t halves[] = {0, 1, 2, 0, 2, 3};
  static const double white[BANDS] = {0.7, 0.7, 0.65}, glow[BANDS] = {100, 100, 90};
  hrad_material material = {0};
  int32_t number, numbers[12];
  material.struct_size = sizeof material;
  material.name = "wall";
  material.reflectance = white;
  require(hrad_add_material(solver, &material, &number));
  for (int i = 0; i < 12; ++i) numbers[i] = number;
  if (rank == 0)
    require(hrad_add_patches(solver, 8, room, 12, walls, numbers));
  else
    require(hrad_add_patches(solver, 0, NULL, 0, NULL, NULL));
  material.name = "lamp";
  material.emission = glow;
  require(hrad_add_material(solver, &material, &number));
  numbers[0] = numbers[1] = number;
  if (rank == 0)
    require(hrad_add_patches(solver, 4, lamp, 2, halves, numbers));
  else
    require(hrad_add_patches(solver, 0, NULL, 0, NULL, NULL));
}

/* The irradiance, all bands together, on rows first, first + step, ... of the plane: the sum over
 * their points. A query is collective, and every rank makes its own, which may be of no points. */
static double sum_of_rows(const hrad_solver *solver, int first, int step) {
  double xyz[3 * COLUMNS * ROWS], normal[3 * COLUMNS * ROWS], irradiance[BANDS * COLUMNS * ROWS];
  double sum = 0;
  int64_t count = 0;
  memset(normal, 0, sizeof normal);
  for (int row = first; row < ROWS; row += step)
    for (int column = 0; column < COLUMNS; ++column, ++count) {
      xyz[3 * count] = (column + 0.5) * 4 / COLUMNS;
      xyz[3 * count + 1] = (row + 0.5) * 3 / ROWS;
      xyz[3 * count + 2] = 0.8;
      normal[3 * count + 2] = 1;
    }
  require(hrad_query_sensors(solver, count, xyz, normal, irradiance, NULL));
  for (int64_t i = 0; i < BANDS * count; ++i) sum += irradiance[i];
  return sum;
}

int main(int argc, char **argv) {
  hrad_solver *solver = NULL;
  int level, rank, ranks;
  double own, whole = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  require(hrad_create_mpi(MPI_COMM_WORLD, &solver));
  require(hrad_set_double(solver, "accuracy", 0.05));
  add_room(solver, rank);
  require(hrad_solve(solver));
  own = sum_of_rows(solver, rank, ranks);
  MPI_Reduce(&own, &whole, 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  if (rank == 0)
    printf("plane: mean %.2f W/m2, measured by %d ranks\n", whole / (COLUMNS * ROWS), ranks);
  hrad_destroy(&solver);
  MPI_Finalize();
  return 0;
}
