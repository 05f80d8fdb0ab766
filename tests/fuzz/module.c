/* Modules that verify and are hostile: changes modules by their records and their code (module_change.h), makes the
 * hash right, and runs every engine on what still loads. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/load.h"
#include "runtime/module/layout.h"
#include "tests/fuzz/engines.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/module_change.h"

static size_t seen, verified; /* inputs of this process, and those of them that were run */

/* How many there were is what a run is worth. */
__attribute__((destructor)) static void say_counts(void)
{
    fprintf(stderr, "%zu modules, %zu of them verified and run\n", seen, verified);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    tn_module *module;
    tn_module_limits limits = {.bytes = 1u << 20, .records = 10000, .stack = 64};
    seen++;
    if (tn_module_load(data, size, &limits, &module, NULL) != TN_OK)
        return 0;
    verified++;
    fuzz_engines(module);
    tn_module_free(module);
    return 0;
}

/* What is no module stays as it is. */
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
    uint8_t *bytes;
    size_t changed;
    if (!change_module(data, size, seed, max_size, &bytes, &changed))
        return size;
    memcpy(data, bytes, changed);
    free(bytes);
    return changed;
}
