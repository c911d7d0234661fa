/* The frame of a test program that runs on every rank of mpirun: a failure on one rank ends all,
 * which would wait for it otherwise. */
#ifndef HRAD_TESTS_MPI_PROGRAM_H
#define HRAD_TESTS_MPI_PROGRAM_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* cmocka.h wants the headers above first, and doesn't say that it is C. */
#ifdef __cplusplus
extern "C" {
#endif
#include <cmocka.h>
#ifdef __cplusplus
}
#endif
#include <hrad/hrad_mpi.h>
#include <stdio.h>

#include "support/sanitized.h"

/* A leak is told by the name of the module that it is in, if that is still there: MPI's modules
 * must stay, so that what they leak can be left out of account. */
#if HRAD_TEST_ADDRESSES
#ifdef __cplusplus
extern "C"
#endif
    int
    dlclose(void* handle);
int dlclose(void* handle) {
  (void)handle;
  return 0;
}
#endif

static inline int rank_of_world(void) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

static inline int size_of_world(void) {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

/* Runs the tests one by one: a failure of one ends the program on all ranks at once. */
static inline void run_together(const struct CMUnitTest* tests, size_t count) {
  size_t k;
  for (k = 0; k < count; ++k)
    if (_cmocka_run_group_tests(tests[k].name, &tests[k], 1, NULL, NULL) != 0) {
      fprintf(stderr, "rank %d: %s failed\n", rank_of_world(), tests[k].name);
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
}

#endif
