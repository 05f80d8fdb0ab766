/* Ranks that are threads of the test: what tartan-mpi does by MPI. */
#ifndef TARTAN_TESTS_TEST_RANKS_H
#define TARTAN_TESTS_TEST_RANKS_H

#include "runtime/ranks/ranks.h"

/* Has `count` ranks (8 at most) do the work at the same time, and waits for all. cmocka's assertions are for the thread
 * that calls this: the work keeps its results in the context. */
typedef void test_ranks_work(const tn_ranks *ranks, void *context);
void test_ranks_run(unsigned count, test_ranks_work *work, void *context);

#endif
