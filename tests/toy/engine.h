/* Runs a counter of a module that was loaded with the toy engine. */
#ifndef TARTAN_TESTS_TOY_ENGINE_H
#define TARTAN_TESTS_TOY_ENGINE_H

#include "runtime/module/module.h"

/* Where a counter is in the end: its start, and all its steps. */
uint64_t toy_count(const tn_module *module, uint32_t counter);

#endif
