/* The toy engine's column `fuzz`: runs the counters of a module from anywhere. */
#include "tests/fuzz/engines.h"
#include "tests/toy/engine.h"

void fuzz_toy(const tn_module *module)
{
    for (uint32_t i = 0; i < module->COUNTER_count; i++)
        if (toy_count(module, i) < module->COUNTER_records[i].start)
            fuzz_broken("a counter counts up");
}
