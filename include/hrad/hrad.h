/* hrad.h - hierarchical radiosity: the light (or heat) that bounces between diffuse surfaces.
 *
 * This header is the manual of the C library `hrad`. A whole program:
 *
 *   #include <hrad/hrad.h>
 *   #include <stdio.h>
 *   int main(void) {
 *     hrad_solver *solver = NULL;
 *     double power[3], front[3], back[3], escaped[3];
 *     if (hrad_create(&solver) < 0 || hrad_make_scene(solver, "cornell") < 0 ||
 *         hrad_set_double(solver, "accuracy", 0.05) < 0 || hrad_solve(solver) < 0 ||
 *         hrad_power_balance(solver, power, front, back, escaped) < 0 ||
 *         hrad_export(solver, "cornell.csv") < 0) {
 *       fprintf(stderr, "%s\n", hrad_error_message());
 *       return 1;
 *     }
 *     printf("emitted %g W, absorbed %g W\n", power[0], front[0] + back[0]);
 *     hrad_destroy(&solver);
 *     return 0;
 *   }
 *
 * METHOD. Padron, Amor, Boo, Rodriguez, Doallo, "Parallel Hierarchical Radiosity on Hybrid
 * Platforms" (the three stages), after Hanrahan, Saltzman, Aupperle, "A rapid hierarchical
 * radiosity algorithm" (SIGGRAPH '91). Theory: Cohen and Wallace, "Radiosity and Realistic Image
 * Synthesis" (Academic Press, 1993). Each patch is a Lambertian surface that obeys
 *     B = E + rho * H,   H_i = sum_j F_ij B_j.
 *
 * UNITS. Lengths are in the scene's unit (metres unless parameter `unit` says otherwise), areas in
 * its square. Reflectance rho is in [0,1). Emission E, radiosity B and irradiance H are in W/m2 per
 * band (radiant exitance: no pi anywhere; radiance = B/pi). Any consistent photometric unit (lm/m2)
 * works as well. There are 1 to 16 bands, by default 3 (red, green, blue).
 *
 * SIDES. The front of a triangle is the side from which its corners run anticlockwise. One-sided
 * surfaces (the default) emit and reflect on the front and are black behind; two-sided ones have a
 * radiosity on each side and emit E on each (power 2EA). Every triangle blocks light from both
 * sides. A blocker blocks and exchanges nothing else.
 *
 * PATCHES are the input triangles, numbered from 0 in input order after polygons are triangulated;
 * a number never shifts. A dropped triangle (zero area, or same corners and winding as an earlier
 * one) keeps its number, has area and values 0 and the flag HRAD_PATCH_DROPPED. Coincident
 * triangles of opposite winding are a legal sheet. Of surfaces pressed against each other within
 * 1e-6 scene radii the covered parts see nothing there (B = E); the sealed area is reported. Means
 * of leaves and patches are over the whole area, sealed parts included.
 *
 * ACCURACY a (parameter `accuracy`, default 0.02, allowed 0.0005 to 0.5) is the promise
 *     sqrt(sum A (B-B*)^2 / sum A B*^2) <= a
 * over the means of patches with E = 0, all bands together, B* being exact. Errors at points are
 * larger.
 *
 * BALANCE. emitted = absorbed + absorbed_back + escaped; each term is measured by its own links or
 * rays, none is the remainder of the others, and no row of form factors is rescaled.
 *
 * PARAMETERS. Result parameters (bands, accuracy, linking, oracle, thresholds, seed, ...) decide
 * the bits of the result; run parameters (threads, smt, bind, max_memory, ...) never change a bit.
 * Those that say how to compute (threads, smt, bind, partition, instruction_set) hold from
 * hrad_partition on.
 *
 * BITS. The solution and its hash do not depend on the number of ranks or threads or on the
 * processor.
 *
 * ERRORS. Every function that can fail returns a status: 0 done, positive a normal event, negative
 * an error. After an error the outputs are untouched and the solver is usable as before the call,
 * unless the function says otherwise; hrad_error_message() tells what happened, where, and what to
 * do. "Errors:" lists what a function may answer, the HRAD_ERROR_ left out. What holds for all of
 * them is not told each time: ARGUMENT for a NULL where none is allowed, a number out of its range,
 * a negative size or count, a struct_size too small to hold itself; STATE for a call from a
 * callback; MEMORY; with several ranks MPI where a communication fails; INTERNAL. The library never
 * prints, exits, aborts, or installs a signal handler.
 *
 * THREADS. Different solvers may be used from different threads at the same time. One solver is
 * used by one thread at a time; only hrad_request_stop may be called on it from anywhere. Callbacks
 * must not call functions of the solver that called them, which answer HRAD_ERROR_STATE, except
 * hrad_request_stop, and hrad_write_checkpoint in the progress callback.
 *
 * [C] marks collective functions: all ranks of the solver's communicator call them in the same
 * order. [L] marks local ones. A solver made by hrad_create has one rank, one made by
 * hrad_create_mpi of hrad_mpi.h those of its communicator.
 *
 * TEXT that a function returns goes into a caller's buffer (char *text, int64_t size,
 * int64_t *needed): at most size bytes are written, always ended by NUL when size > 0, and *needed
 * (may be NULL) receives the size that the whole text needs, NUL included. A buffer too small is no
 * error: the text is cut. Text in structs has static lifetime unless its field says otherwise.
 *
 * STRUCTS begin with size_t struct_size, which the caller sets to sizeof the struct; only that much
 * is read or written, so that programs built against an older header keep working. Of an array of
 * structs the first one's size holds for all: it is also the distance from one to the next.
 */
#ifndef HRAD_HRAD_H
#define HRAD_HRAD_H

#include <stddef.h>
#include <stdint.h>

#if defined(HRAD_SHARED) && defined(__GNUC__)
#define HRAD_API __attribute__((visibility("default")))
#else
#define HRAD_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define HRAD_VERSION_MAJOR 0
#define HRAD_VERSION_MINOR 1
#define HRAD_VERSION_PATCH 0

/* The solver: an opaque handle. */
typedef struct hrad_solver hrad_solver;

/* ---- status ---------------------------------------------------------------------------------- */

typedef int32_t hrad_status;
enum {
  HRAD_OK = 0,
  HRAD_NOT_CONVERGED = 1,      /* max_iterations reached, or the measured error less three of its
                                  standard errors above twice the accuracy and above 2 % (not judged
                                  with a tolerance of one's own or oracle=energy); the result is
                                  usable, the promise is not kept */
  HRAD_STOPPED = 2,            /* hrad_request_stop or the progress callback asked for it */
  HRAD_ERROR_ARGUMENT = -1,    /* a NULL, a value out of range, an unknown name */
  HRAD_ERROR_STATE = -2,       /* a call out of order */
  HRAD_ERROR_MEMORY = -3,      /* out of memory, or over the parameter max_memory */
  HRAD_ERROR_FILE = -4,        /* a file can't be opened, read or written */
  HRAD_ERROR_FORMAT = -5,      /* a file's content is not what it should be */
  HRAD_ERROR_SCENE = -6,       /* a scene is invalid; the message names file:line or the patch */
  HRAD_ERROR_MPI = -7,         /* a communication failed */
  HRAD_ERROR_UNSUPPORTED = -8, /* not in this build or version */
  HRAD_ERROR_INTERNAL = -9     /* a fault of the library: please report it */
};

/* [L] The library's version as major*10000 + minor*100 + patch, and as text "0.1.0". Never fail. */
HRAD_API int32_t hrad_version(void);
HRAD_API const char *hrad_version_text(void);

/* [L] The name of a status, "HRAD_OK" for 0; "HRAD_UNKNOWN" for a value not listed. Static text. */
HRAD_API const char *hrad_status_name(hrad_status status);

/* [L] What this thread's last failing call said, "" if none failed. One sentence: what, where
 * (file: line for input), what to do. Owned by the library, valid until this thread's next failing
 * call. */
HRAD_API const char *hrad_error_message(void);

/* ---- log ------------------------------------------------------------------------------------- */

enum { HRAD_LOG_ERROR = 0, HRAD_LOG_WARNING = 1, HRAD_LOG_INFO = 2, HRAD_LOG_DEBUG = 3 };

/* Receives one message, without a newline at its end; message lives during the call only. */
typedef void (*hrad_log_function)(int32_t level, const char *message, void *user);

/* [L] From now on every message of level <= level goes to function(level, message, user), called on
 * the thread that called the solver; function NULL turns messages off (the default). Warnings are of
 * doubtful scenes, of an MPI that was started for one thread, and of processes whose threads would
 * fight for the same processors, with what helps; information is which threads each process starts.
 * Rank 0 is told of all processes and nodes, the others of warnings about their own.
 * Errors: ARGUMENT for a NULL solver or a level outside 0..3. */
HRAD_API hrad_status hrad_set_log(hrad_solver *solver, hrad_log_function function, void *user,
                                  int32_t level);

/* ---- create ---------------------------------------------------------------------------------- */

/* [L] Makes an empty solver for this process alone and stores it in *solver. The caller owns it and
 * gives it back with hrad_destroy. Errors: ARGUMENT for NULL, MEMORY. */
HRAD_API hrad_status hrad_create(hrad_solver **solver);

/* [C] Frees *solver and everything in it, waits for its threads, and sets *solver to NULL. NULL and
 * a pointer to NULL are fine. Must not be called from a callback of the same solver. */
HRAD_API void hrad_destroy(hrad_solver **solver);

/* ---- parameters ------------------------------------------------------------------------------ */

enum { HRAD_PARAM_INT = 0, HRAD_PARAM_DOUBLE = 1, HRAD_PARAM_TEXT = 2 };

/* One row of the parameter table. All text has static lifetime. */
typedef struct hrad_param {
  size_t struct_size;
  const char *name;
  int32_t type;             /* HRAD_PARAM_INT, _DOUBLE, _TEXT */
  int32_t is_result;        /* 1: decides the bits of the result; 0: a run parameter */
  const char *default_text; /* the default, as hrad_set_text takes it */
  double minimum, maximum;  /* allowed range, both included; 0, 0 for text */
  const char *choices;      /* for text: the allowed words separated by '|', or NULL: any text */
  const char *unit;         /* "" where there is none */
  const char *help;         /* one sentence */
} hrad_param;

/* [C] Sets a parameter by its name. hrad_set_text takes every type in its text form ("0.02",
 * "rows").
 * Errors: ARGUMENT for an unknown name, a wrong type or a value out of range (the message names the
 * range); STATE for a result parameter after hrad_solve has begun, unless it is a smaller
 * `accuracy`, a larger `max_iterations`, `refine`, or the value it already has. `bands` only before
 * the first material, `visibility` only before hrad_partition. */
HRAD_API hrad_status hrad_set_int(hrad_solver *solver, const char *name, int64_t value);
HRAD_API hrad_status hrad_set_double(hrad_solver *solver, const char *name, double value);
HRAD_API hrad_status hrad_set_text(hrad_solver *solver, const char *name, const char *value);

/* [L] Reads a parameter. hrad_get_text takes every type. Errors: ARGUMENT as above. */
HRAD_API hrad_status hrad_get_int(const hrad_solver *solver, const char *name, int64_t *value);
HRAD_API hrad_status hrad_get_double(const hrad_solver *solver, const char *name, double *value);
HRAD_API hrad_status hrad_get_text(const hrad_solver *solver, const char *name, char *text,
                                   int64_t size, int64_t *needed);

/* [L] Row `index` (from 0) of the parameter table. Errors: ARGUMENT past its end, so that a loop
 * until the first error reads the whole table. */
HRAD_API hrad_status hrad_describe_param(int64_t index, hrad_param *param);

/* ---- load ------------------------------------------------------------------------------------ */

enum { HRAD_TWO_SIDED = 1, HRAD_BLOCKER = 2 };

typedef struct hrad_material {
  size_t struct_size;
  const double *reflectance; /* bands values in [0,1); NULL: 0.5 in every band */
  const double *emission;    /* bands values in W/m2: 0, or 1e-30 to 1e30; NULL: 0 */
  int32_t flags;             /* HRAD_TWO_SIDED | HRAD_BLOCKER */
  const char *name;          /* may be NULL; copied */
} hrad_material;

/* [C] Adds a material and stores its number (from 0) in *number (may be NULL). Everything is
 * copied. Errors: ARGUMENT for a value out of range or not finite, or a blocker with emission;
 * STATE after hrad_partition. */
HRAD_API hrad_status hrad_add_material(hrad_solver *solver, const hrad_material *material,
                                       int32_t *number);

/* [C] Adds n_triangles patches: xyz has 3*n_vertices coordinates, vertex 3*n_triangles indices into
 * this call's vertices (from 0), material n_triangles material numbers (NULL: the material added
 * first, or reflectance 0.5 if there is none). Everything is copied. May be called repeatedly;
 * patch numbers go on.
 * Errors: ARGUMENT for negative counts, an index out of range, a coordinate not finite or beyond
 * 1e30; STATE after hrad_partition; MEMORY. Nothing is added then. */
HRAD_API hrad_status hrad_add_patches(hrad_solver *solver, int64_t n_vertices, const double *xyz,
                                      int64_t n_triangles, const int64_t *vertex,
                                      const int32_t *material);

/* [C] Loads an OBJ file with its MTL files (Kd reflectance, Ke emission; no material: Kd 0.5, Ke 0;
 * textures are ignored, counted and warned about; the comments "# hrad: two-sided" and "# hrad:
 * blocker" in a material's definition set its flags). MTL files are read from the scene's folder
 * and those below it alone. Only rank 0 opens files. Parameter `sides` says how windings are read
 * (front | two-sided | flip). Needs bands = 1 or 3 (1: the mean of the three channels). Adds to
 * what is there.
 * Errors: FILE; SCENE with file:line; STATE after hrad_partition, or for other bands; MEMORY.
 * Nothing is added then. */
HRAD_API hrad_status hrad_load_scene(hrad_solver *solver, const char *path);

/* [C] Makes a built-in scene in an empty solver: building, classroom, each also as NAME-x10 and
 * NAME-x100, cornell, furnace and others: see hrad_scene_name. Errors: ARGUMENT for an unknown name
 * (the message lists all); STATE if there are patches or materials already. */
HRAD_API hrad_status hrad_make_scene(hrad_solver *solver, const char *name);

/* [L] The name of built-in scene `index` (from 0), NULL past the last. Static text. */
HRAD_API const char *hrad_scene_name(int64_t index);

/* [L] The number of patches (dropped ones included) and of materials. Either may be NULL. Errors:
 * ARGUMENT for a NULL solver. */
HRAD_API hrad_status hrad_scene_size(const hrad_solver *solver, int64_t *patches,
                                     int64_t *materials);

enum {
  HRAD_PATCH_DROPPED = 1,  /* zero area, or a repetition of an earlier patch */
  HRAD_PATCH_TWO_SIDED = 2,
  HRAD_PATCH_BLOCKER = 4
};

typedef struct hrad_patch {
  size_t struct_size;
  double corners_xyz[9]; /* anticlockwise seen from the front, in the scene's unit */
  double area;           /* of one side, unit^2; 0 when dropped */
  int64_t face;          /* number of the face in its OBJ file, from 0; else the patch's number */
  int32_t material;
  int32_t flags;         /* HRAD_PATCH_... */
} hrad_patch;

/* [L] Describes one patch. Errors: ARGUMENT for a number out of range. */
HRAD_API hrad_status hrad_get_patch(const hrad_solver *solver, int64_t patch, hrad_patch *out);

/* [L] The name, reflectance and emission (bands values each, either may be NULL) and the flags (may
 * be NULL) of a material, as loaded. The name goes into a caller's buffer. Errors: ARGUMENT for a
 * number out of range. */
HRAD_API hrad_status hrad_get_material(const hrad_solver *solver, int32_t material, char *name,
                                       int64_t size, int64_t *needed, double *reflectance,
                                       double *emission, int32_t *flags);

/* [L] Diagnostics of the scene: everything doubtful that was kept, repaired or dropped, one
 * sentence each, with its count, `index` from 0. More is known after hrad_partition (the share of
 * rays that meet back faces, patches too small for the scene) and after hrad_solve (sealed area).
 * Errors: ARGUMENT past the last. */
HRAD_API hrad_status hrad_get_diagnostic(const hrad_solver *solver, int64_t index, char *text,
                                         int64_t size, int64_t *needed);

/* [C] Sets emission (W/m2: 0, or 1e-30 to 1e30) or reflectance ([0,1)) of `count` patches from
 * `first_patch` on; count*bands values, the bands of a patch side by side. Also after a solve: the
 * next hrad_solve then starts from B = E, with refine = 0 on the mesh and the links as they are.
 * Until then queries answer with the new values and the irradiance that was solved for,
 * hrad_power_balance with the old light.
 * Errors: ARGUMENT for ranges and values; STATE for a blocker with emission. */
HRAD_API hrad_status hrad_set_emission(hrad_solver *solver, int64_t first_patch, int64_t count,
                                       const double *emission);
HRAD_API hrad_status hrad_set_reflectance(hrad_solver *solver, int64_t first_patch, int64_t count,
                                          const double *reflectance);

/* ---- partition and machine ------------------------------------------------------------------- */

/* [C] Closes the scene, builds the visibility structure and gives every patch an owner (the paper's
 * Initial Stage). Optional: hrad_solve does it. Errors: SCENE for a scene without patches,
 * smaller than 1e-8, larger than 1e11 or more than 1e10 of its radii from the origin; MEMORY;
 * UNSUPPORTED for a ray engine that is not in this build; ARGUMENT on several ranks whose result
 * parameters or scenes differ. */
HRAD_API hrad_status hrad_partition(hrad_solver *solver);

/* [L] The rank that owns a patch: 0 in a solver made by hrad_create. With several ranks patches may
 * change their owners before a round of refinement, by what the last one cost each of them; no bit
 * of the result depends on it. Errors: ARGUMENT for a patch out of range, STATE before
 * hrad_partition. */
HRAD_API hrad_status hrad_patch_owner(const hrad_solver *solver, int64_t patch, int32_t *rank);

/* What one of several ranks would get. Work is in rays, about: guessed from geometry and
 * parameters, before light shows where elements become small. */
typedef struct hrad_rank_load {
  size_t struct_size;
  int64_t patches;           /* that exchange light */
  double work;               /* predicted, of all its patches */
  double lower[3], upper[3]; /* the box around its patches, in the scene's unit; 0 without any */
  double remote;             /* 0 to 1: of the light that reaches it, the share that comes from
                                patches of other ranks, whose radiosity takes messages; by a sample
                                of rays, off by some percent */
} hrad_rank_load;

enum { HRAD_MOST_RANKS = 65536 }; /* that can be planned for */

/* [C] before hrad_partition, [L] after it: plans a partition for `ranks` ranks without starting
 * them: what a cluster would have to do, before it is booked. method: "grid", the paper's uniform
 * grid made tight (Padron et al., Section 3.1), or "cost", halves of equal predicted work. owner: a
 * rank per patch of the scene, 0 for patches that exchange no light; loads: one per rank,
 * struct_size set in the first; either may be NULL. Closes the scene as hrad_partition does. The
 * same for any number of threads.
 * Errors: those of hrad_partition; ARGUMENT for an unknown method or ranks outside
 * 1 .. HRAD_MOST_RANKS. */
HRAD_API hrad_status hrad_plan_partition(hrad_solver *solver, const char *method, int32_t ranks,
                                         int32_t *owner, hrad_rank_load *loads);

/* [C] or [L] likewise: writes such a plan as a .vtu file for ParaView: the patches with `owner`,
 * `work` (rays, predicted) and `patch` as cell data. Errors: those of hrad_plan_partition; FILE;
 * ARGUMENT for another ending. */
HRAD_API hrad_status hrad_export_partition(hrad_solver *solver, const char *method, int32_t ranks,
                                           const char *path);

/* [L] What hwloc sees of this machine and the thread pool that this solver would start, as text,
 * one `name: value` a line. Works on an empty solver. Errors: ARGUMENT for a NULL solver, a
 * negative size, or a NULL text of a positive size. */
HRAD_API hrad_status hrad_describe_machine(const hrad_solver *solver, char *text, int64_t size,
                                           int64_t *needed);

/* ---- solve ----------------------------------------------------------------------------------- */

typedef struct hrad_progress {
  size_t struct_size;
  const char *stage;   /* "initial", "linking", "refine", "sweep", "measure" */
  int64_t iteration;   /* sweeps done */
  double fraction;     /* of the whole solve, 0 to 1, never falling within one hrad_solve */
  double seconds;      /* since hrad_solve began */
  double seconds_left; /* estimate; negative while unknown */
} hrad_progress;

/* Called between tasks, up to some thousand times a second, on rank 0's calling thread; nonzero
 * stops the solve. */
typedef int32_t (*hrad_progress_function)(const hrad_progress *progress, void *user);

/* [L] Sets the progress callback; NULL for none. Errors: ARGUMENT for a NULL solver. */
HRAD_API hrad_status hrad_set_progress(hrad_solver *solver, hrad_progress_function function,
                                       void *user);

/* [C] Solves: linking, then refinement and sweeps until the radiosity transported stands still and
 * the accuracy is met; goes on from the present state if there is one.
 * With the parameter refine = 0, for a new emission or reflectance: sweeps from B = E over the
 * present mesh and links alone, a small part of the time of a whole solve. The result depends on
 * these and on the light, not on any light that was solved for in between. How good the present
 * mesh is for the new light is measured when hrad_get_stats or hrad_power_balance first asks, which
 * takes longer than the sweeps; the status tells here only whether the sweeps converged.
 * Returns HRAD_OK, HRAD_NOT_CONVERGED, or HRAD_STOPPED (call it again to go on; the queries answer
 * from the last whole round, or STATE when there is none, as when rows are being made anew for
 * another light or accuracy; hrad_power_balance answers STATE until a solve has come to its end).
 * Errors: SCENE for an empty scene, STATE for refine = 0 without links, UNSUPPORTED for a method
 * that is not in this build, MEMORY; after MEMORY the solution is gone and the scene and the
 * parameters stay. */
HRAD_API hrad_status hrad_solve(hrad_solver *solver);

/* [L] Asks a running hrad_solve, or else the next one, to stop at the next safe point; the wish is
 * taken back when a solve returns, however it ends. Any thread, async-signal-safe, NULL is fine. */
HRAD_API void hrad_request_stop(hrad_solver *solver);

typedef struct hrad_stats {
  size_t struct_size;
  int32_t converged;          /* 1 when the last solve returned HRAD_OK */
  int32_t ranks, threads;     /* threads of this rank; rays to pairs below are those of all ranks */
  int32_t up_axis;            /* of the scene: 1 y, 2 z (parameter `up`); 0 where nobody has said */
  int64_t rounds, iterations; /* refinement rounds; sweeps */
  int64_t patches, elements, leaves, links; /* elements: all nodes of the hierarchy */
  int64_t rays;               /* visibility, exposure and measuring rays together */
  int64_t pairs;              /* pairs of patches whose form factor the linking stage computed */
  double area, sealed_area;   /* unit^2, both sides of two-sided surfaces */
  double back_share;          /* of measuring rays: those that met a black back, 0..1 */
  double error_estimate;      /* by the definition of ACCURACY; negative when not measured */
  double error_standard_error;
  double seconds_load, seconds_initial, seconds_linking, seconds_iterative, seconds_output;
  double cpu_seconds;         /* user CPU spent in solves, of all ranks together */
  int64_t memory_peak_bytes;  /* of the rank that needed most, as the next two */
  int64_t link_bytes, node_bytes; /* memory of links and of nodes at the end */
  /* Between ranks: [0] R, ids of elements whose radiosity is asked for; [1] U, radiosity of these,
   * when they are asked for and after every sweep; [2] T, the radiosity transported, and the light
   * on patches where all ranks need it. */
  int64_t messages[3], message_bytes[3];
  int64_t swept_links; /* of the links, those that sweeps read; the rest brings direct light to
                          single points, for pictures and queries */
} hrad_stats;

/* [C] Counts and times so far; zeros before a solve. After a solve with refine = 0 the first call
 * measures error and balance by rays (error_estimate stays negative when emission or reflectance
 * changed in between). Errors: ARGUMENT for a NULL or for a struct_size too small to hold
 * itself. */
HRAD_API hrad_status hrad_get_stats(const hrad_solver *solver, hrad_stats *stats);

/* [C] A hash of scene, result parameters, tree, links and radiosity; the same for any number of
 * ranks and threads. Errors: STATE before a solve. */
HRAD_API hrad_status hrad_state_hash(const hrad_solver *solver, uint64_t *hash);

/* ---- query ----------------------------------------------------------------------------------- */

enum { HRAD_RADIOSITY = 0, HRAD_IRRADIANCE = 1, HRAD_EMISSION = 2, HRAD_NET_FLUX = 3 };
enum { HRAD_FRONT = 0, HRAD_BACK = 1 };

/* [C] The mean of a quantity over each of `count` patches from `first` on: count*bands values.
 * NET_FLUX is radiosity (leaving) minus irradiance (arriving). The back of a one-sided patch and a
 * blocker answer 0. Errors: ARGUMENT for ranges; STATE before a solve (EMISSION always works). */
HRAD_API hrad_status hrad_query_patches(const hrad_solver *solver, int32_t quantity, int32_t side,
                                        int64_t first, int64_t count, double *out);

/* [C] A quantity at points of patches: point i lies at (1-u-v)*corner0 + u*corner1 + v*corner2 of
 * patch[i] with u = uv[2*i], v = uv[2*i+1], u, v >= 0, u+v <= 1 (with a margin of 1e-9). Linear
 * reconstruction from the leaves; by rows, reflected light on facets much smaller than the cells of
 * the scene is evened out over those that meet in one plane or at 20 degrees or less, and their
 * mean stays. A sealed point answers B = E, H = 0. count*bands values. Errors: ARGUMENT for ranges;
 * STATE before a solve. */
HRAD_API hrad_status hrad_query_points(const hrad_solver *solver, int32_t quantity, int32_t side,
                                       int64_t count, const int64_t *patch, const double *uv,
                                       double *out);

/* [C] Irradiance at `count` free points: xyz and normal have 3*count values (a normal need not have
 * length 1, but not 0), irradiance count*bands values, standard_error as many or NULL. By rays to
 * the solved leaves, for each sensor as many as bring the standard error below a quarter of the
 * accuracy, all bands together: from 1,024 to 32/accuracy^2 (2,048 to 131,072). It says nothing of
 * the error of the solution itself. Errors: ARGUMENT for a normal of length 0 or a coordinate not
 * finite, STATE before a solve. */
HRAD_API hrad_status hrad_query_sensors(const hrad_solver *solver, int64_t count, const double *xyz,
                                        const double *normal, double *irradiance,
                                        double *standard_error);

/* [C] The number of leaves (a two-sided patch has those of both sides). Errors: STATE before a
 * solve. */
HRAD_API hrad_status hrad_leaf_count(const hrad_solver *solver, int64_t *count);

/* [C] Leaves `first` .. `first+count-1` in key order (patch, side, path): patch, face and side of
 * each, corners (9 coordinates each, anticlockwise seen from the leaf's side), area (unit^2), mean
 * radiosity (bands values each). Any array may be NULL. Errors: ARGUMENT for ranges, STATE before a
 * solve. */
HRAD_API hrad_status hrad_query_leaves(const hrad_solver *solver, int64_t first, int64_t count,
                                       int64_t *patch, int64_t *face, int32_t *side,
                                       double *corners_xyz, double *area, double *radiosity);

/* [C] Power in W per band (bands values each, any may be NULL): emitted; absorbed by fronts;
 * absorbed by black backs, blockers and inside sealed contacts; escaped to the outside. Each is
 * measured by its own links or rays; after a solve with refine = 0 when first asked for. Errors:
 * STATE before a solve, or when emission or reflectance changed before that. */
HRAD_API hrad_status hrad_power_balance(const hrad_solver *solver, double *emitted,
                                        double *absorbed, double *absorbed_back, double *escaped);

/* ---- files ----------------------------------------------------------------------------------- */

/* A checkpoint (.hrad) holds scene, result parameters, mesh, links, light, measurements and how far
 * the solve has come; hrad-checkpoint(5) describes the bytes. It does not depend on the number of
 * threads or ranks, nor on time or machine. A file that grows past the limit of the process
 * (RLIMIT_FSIZE) makes the kernel send SIGXFSZ, which ends a program that neither ignores nor
 * handles it; one that does gets FILE. */

/* [C] Writes a checkpoint at any time between other calls (of a solver with a scene alone, after a
 * solve, or after one that was stopped) and from the progress callback of a solve, which then goes
 * on. Between sweeps nothing is lost; of linking and of rounds of refinement the finished tasks are
 * kept with the parameter resumable = 1, so that a solve that goes on from it repeats some seconds
 * at the most, and with resumable = 0 all of what was under way. The file appears whole under its
 * name or not at all; what was there before stays as PATH.prev, and older ones as PATH.prev2 and so
 * on, as the parameter checkpoint_keep says (0: none). While it is written PATH.lock keeps other
 * writers away. Several ranks pack and write a part each, through MPI-IO into a folder that all of
 * them must share (rank 0's path counts); the bytes are those of one rank, and no rank holds the
 * links of all. Errors: FILE (what failed, on whichever rank; the old file is whole), also when
 * another process holds the lock; STATE from the progress callback while there is nothing yet to go
 * on from, or of several ranks, which must write together: stop the solve there, write on all of
 * them, and solve on. */
HRAD_API hrad_status hrad_write_checkpoint(hrad_solver *solver, const char *path);

/* [C] Locks a checkpoint against other writers, in this and in other processes, before it is first
 * written and until the solver locks another one or is destroyed. Errors: FILE when it is locked
 * already or PATH.lock can't be made. */
HRAD_API hrad_status hrad_lock_checkpoint(hrad_solver *solver, const char *path);

/* [C] Reads a checkpoint: the solver is then as the one that wrote it was, with the same hash, and
 * hrad_solve goes on to the same bits as without a stop. The result parameters become those of the
 * file, the run parameters stay: so refine is what it was when the file was written. A solver that
 * has patches must have the same scene, present emission and reflectance included: this is how a
 * program makes sure that a file belongs to its scene. An empty one takes all from the file;
 * hrad_query_patches then tells the emission. Everything in the file is checked before it is used.
 * Errors: FILE; FORMAT for a file that is damaged or none of these, with section and byte; STATE
 * for another scene, with the first difference; MEMORY when it holds more than max_memory. The
 * solver is then as it was. */
HRAD_API hrad_status hrad_read_checkpoint(hrad_solver *solver, const char *path);

/* [L] Checks a whole checkpoint as reading does, without a solver, and describes it as text, one
 * `name: value` a line: what wrote it, sizes, how far the solve has come, bytes of each section.
 * Errors: as for hrad_read_checkpoint. */
HRAD_API hrad_status hrad_describe_checkpoint(const char *path, char *text, int64_t size,
                                              int64_t *needed);

/* [C] Writes the solution in the format of the path's ending: .csv (one row per leaf: patch, face,
 * side, corners, area, mean radiosity per band), .vtu (VTK unstructured grid), .ply (polygon file)
 * or .glb (binary glTF 2.0): README, "Files it writes"; .obj writes the scene itself with its .mtl
 * beside it and needs no solve. The file appears whole under its name or not at all. Errors:
 * ARGUMENT for another ending, or .obj with other bands than 1 or 3, FILE, STATE before a solve,
 * UNSUPPORTED for a solution larger than the format can hold (.glb: 4 GiB). */
HRAD_API hrad_status hrad_export(const hrad_solver *solver, const char *path);

#ifdef __cplusplus
}
#endif
#endif /* HRAD_HRAD_H */
