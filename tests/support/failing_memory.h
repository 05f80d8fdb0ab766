/* Allocations that fail on demand: the program that uses this is linked with --wrap for each allocating function
 * (tests/CMakeLists.txt does so for the tests named memory_*). */
#ifndef TARTAN_TESTS_FAILING_MEMORY_H
#define TARTAN_TESTS_FAILING_MEMORY_H

#include <stddef.h>

/* From now on the allocation with this number (from 0) fails, and with `all_after` every later one too. */
void fail_allocation(size_t number, int all_after);

/* Allocations succeed again; how many were asked for since fail_allocation. */
size_t stop_failing(void);

#endif
