/* Reads a file of plans of any origin to its end, and stops the program where what is read is not legal. */
#ifndef TARTAN_TESTS_FUZZ_READ_PLANS_H
#define TARTAN_TESTS_FUZZ_READ_PLANS_H

#include "runtime/plan/text/stream.h"

void read_plans(const char *path, tn_plan_format format);

#endif
