/* hrad_mpi.h - solvers over several processes that MPI started.
 *
 * It belongs to the library `hrad_mpi`, which is linked before `hrad`. Everything else is as hrad.h
 * says; a program of one process needs neither this header nor MPI. A whole program, for
 * `mpirun -n 4`:
 *
 *   #include <hrad/hrad_mpi.h>
 *   int main(int argc, char **argv) {
 *     hrad_solver *solver = NULL;
 *     int level, failed;
 *     MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
 *     failed = hrad_create_mpi(MPI_COMM_WORLD, &solver) < 0 ||
 *              hrad_make_scene(solver, "cornell") < 0 || hrad_solve(solver) < 0 ||
 *              hrad_export(solver, "cornell.csv") < 0;
 *     hrad_destroy(&solver);
 *     MPI_Finalize();
 *     return failed;
 *   }
 *
 * RANKS. A function that hrad.h marks [C] is called by all ranks of the communicator in the same
 * order, and gives the same status and message on each. Arrays and files that describe the scene
 * are read on rank 0 alone. The solution has the same bits for any number of ranks.
 *
 * MPI belongs to the program: the library calls neither MPI_Init nor MPI_Finalize nor MPI_Abort,
 * and the program's communicator, its messages and its error handler stay as they are. What MPI
 * reports as failed on a duplicate is HRAD_ERROR_MPI, on a file HRAD_ERROR_FILE: every rank opens
 * the checkpoint that all write on MPI_COMM_SELF.
 *
 * THREADS. A solver is used on one thread, which must be allowed to call MPI: below
 * MPI_THREAD_SERIALIZED that is the thread of MPI_Init_thread. The library's own threads never call
 * MPI, so that MPI_THREAD_FUNNELED is enough; with MPI_THREAD_SINGLE set the parameter `threads` to
 * 1. With MPI_THREAD_MULTIPLE solvers of different threads may work at the same time.
 */
#ifndef HRAD_HRAD_MPI_H
#define HRAD_HRAD_MPI_H

#include <hrad/hrad.h>
/* Not the C++ bindings of old. */
#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1
#endif
#ifndef MPICH_SKIP_MPICXX
#define MPICH_SKIP_MPICXX 1
#endif
#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/* [C] Makes an empty solver whose ranks are the processes of comm and stores it in *solver. comm is
 * duplicated and may be freed afterwards. The caller owns the solver and gives it back with
 * hrad_destroy, on all ranks and before MPI_Finalize. Errors: MPI before MPI_Init, after
 * MPI_Finalize, on a thread that may not call MPI, and where a function of MPI fails; ARGUMENT for
 * MPI_COMM_NULL or an intercommunicator, and on all ranks when `solver` is NULL on one; MEMORY. */
HRAD_API hrad_status hrad_create_mpi(MPI_Comm comm, hrad_solver **solver);

/* [C] The same for a communicator of Fortran, as an integer. Errors: those of hrad_create_mpi. */
HRAD_API hrad_status hrad_create_mpi_f(MPI_Fint comm, hrad_solver **solver);

#ifdef __cplusplus
}
#endif

#endif
