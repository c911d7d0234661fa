/* The C side of the Fortran tests: the same calls from C, whose results the Fortran ones must equal
 * bit for bit, and structs made in Fortran taken apart by C's own declarations. */
#define _POSIX_C_SOURCE 200112L /* for pthread_barrier_t */
#include <hrad/hrad.h>
#include <pthread.h>

/* cornell, solved to an accuracy of 0.1; NULL when something failed. */
hrad_solver *reference_create(void);
hrad_solver *reference_create(void) {
  hrad_solver *solver = NULL;
  if (hrad_create(&solver) != HRAD_OK || hrad_make_scene(solver, "cornell") != HRAD_OK ||
      hrad_set_double(solver, "accuracy", 0.1) != HRAD_OK || hrad_solve(solver) != HRAD_OK)
    hrad_destroy(&solver);
  return solver;
}

/* Everything that the solution answers, as one row of numbers each; 0 when all calls succeeded. */
int32_t reference_results(hrad_solver *solver, uint64_t *hash, int64_t *leaves, double *radiosity,
                          double *flux, double *balance);
int32_t reference_results(hrad_solver *solver, uint64_t *hash, int64_t *leaves, double *radiosity,
                          double *flux, double *balance) {
  return hrad_state_hash(solver, hash) | hrad_leaf_count(solver, leaves) |
         hrad_query_patches(solver, HRAD_RADIOSITY, HRAD_FRONT, 0, 36, radiosity) |
         hrad_query_patches(solver, HRAD_NET_FLUX, HRAD_FRONT, 5, 20, flux) |
         hrad_power_balance(solver, balance, balance + 3, balance + 6, balance + 9);
}

int32_t reference_points(hrad_solver *solver, int64_t count, const int64_t *patch, const double *uv,
                         double *out, const double *xyz, const double *normal, double *irradiance,
                         double *standard_error);
int32_t reference_points(hrad_solver *solver, int64_t count, const int64_t *patch, const double *uv,
                         double *out, const double *xyz, const double *normal, double *irradiance,
                         double *standard_error) {
  return hrad_query_points(solver, HRAD_IRRADIANCE, HRAD_FRONT, count, patch, uv, out) |
         hrad_query_sensors(solver, count, xyz, normal, irradiance, standard_error);
}

int32_t reference_leaves(hrad_solver *solver, int64_t first, int64_t count, int64_t *patch,
                         int64_t *face, int32_t *side, double *corners_xyz, double *area,
                         double *radiosity);
int32_t reference_leaves(hrad_solver *solver, int64_t first, int64_t count, int64_t *patch,
                         int64_t *face, int32_t *side, double *corners_xyz, double *area,
                         double *radiosity) {
  return hrad_query_leaves(solver, first, count, patch, face, side, corners_xyz, area, radiosity);
}

void reference_destroy(hrad_solver *solver);
void reference_destroy(hrad_solver *solver) { hrad_destroy(&solver); }

/* Runs a procedure on two threads at once, as number 1 and 2; 0 when both were started. */
static void (*both_do)(int32_t number, pthread_barrier_t *meeting);
static pthread_barrier_t both_meet;

static void *first_thread(void *unused) {
  both_do(1, &both_meet);
  return unused;
}

static void *second_thread(void *unused) {
  both_do(2, &both_meet);
  return unused;
}

int32_t reference_two_threads(void (*procedure)(int32_t number, pthread_barrier_t *meeting));
int32_t reference_two_threads(void (*procedure)(int32_t number, pthread_barrier_t *meeting)) {
  pthread_t first, second;
  both_do = procedure;
  if (pthread_barrier_init(&both_meet, NULL, 2) != 0) return 1;
  if (pthread_create(&first, NULL, first_thread, NULL) != 0) return 2;
  if (pthread_create(&second, NULL, second_thread, NULL) != 0) return 3;
  pthread_join(first, NULL);
  pthread_join(second, NULL);
  pthread_barrier_destroy(&both_meet);
  return 0;
}

/* Waits until both threads are here. */
void reference_meet(pthread_barrier_t *meeting);
void reference_meet(pthread_barrier_t *meeting) { pthread_barrier_wait(meeting); }

/* The sizes of the structs: patch, rank load, stats. */
void reference_sizes(int64_t sizes[3]);
void reference_sizes(int64_t sizes[3]) {
  sizes[0] = (int64_t)sizeof(hrad_patch);
  sizes[1] = (int64_t)sizeof(hrad_rank_load);
  sizes[2] = (int64_t)sizeof(hrad_stats);
}

/* The fields of structs in the order of hrad.h, struct_size left out. */
void reference_take_apart(const hrad_patch *patch, const hrad_rank_load *load,
                          const hrad_stats *stats, double patch_fields[13], double load_fields[9],
                          double stats_fields[32]);
void reference_take_apart(const hrad_patch *patch, const hrad_rank_load *load,
                          const hrad_stats *stats, double patch_fields[13], double load_fields[9],
                          double stats_fields[32]) {
  int i;
  double *to = patch_fields;
  for (i = 0; i < 9; ++i) *to++ = patch->corners_xyz[i];
  *to++ = patch->area;
  *to++ = (double)patch->face;
  *to++ = patch->material;
  *to++ = patch->flags;

  to = load_fields;
  *to++ = (double)load->patches;
  *to++ = load->work;
  for (i = 0; i < 3; ++i) *to++ = load->lower[i];
  for (i = 0; i < 3; ++i) *to++ = load->upper[i];
  *to++ = load->remote;

  to = stats_fields;
  *to++ = stats->converged;
  *to++ = stats->ranks;
  *to++ = stats->threads;
  *to++ = stats->up_axis;
  *to++ = (double)stats->rounds;
  *to++ = (double)stats->iterations;
  *to++ = (double)stats->patches;
  *to++ = (double)stats->elements;
  *to++ = (double)stats->leaves;
  *to++ = (double)stats->links;
  *to++ = (double)stats->rays;
  *to++ = (double)stats->pairs;
  *to++ = stats->area;
  *to++ = stats->sealed_area;
  *to++ = stats->back_share;
  *to++ = stats->error_estimate;
  *to++ = stats->error_standard_error;
  *to++ = stats->seconds_load;
  *to++ = stats->seconds_initial;
  *to++ = stats->seconds_linking;
  *to++ = stats->seconds_iterative;
  *to++ = stats->seconds_output;
  *to++ = stats->cpu_seconds;
  *to++ = (double)stats->memory_peak_bytes;
  *to++ = (double)stats->link_bytes;
  *to++ = (double)stats->node_bytes;
  for (i = 0; i < 3; ++i) *to++ = (double)stats->messages[i];
  for (i = 0; i < 3; ++i) *to++ = (double)stats->message_bytes[i];
  *to++ = (double)stats->swept_links;
}
