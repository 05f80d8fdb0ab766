/* Evolution blocks of studies: any text is read, or refused with a reason. */
#include <stdlib.h>

#include "compiler/evolution/evolution.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    tn_sources sources = {0};
    tn_diagnostics diagnostics;
    tn_arena *arena = tn_arena_new();
    tn_evolution_study study;
    uint32_t file;
    tn_diagnostics_init(&diagnostics, &sources);
    if (arena && tn_sources_add(&sources, "fuzz.study", (const char *)data, size, &file, NULL) == TN_OK &&
        !tn_evolution_settings_read(&sources, file, &diagnostics, arena, &study) && diagnostics.error_count == 0)
        abort();
    tn_diagnostics_clear(&diagnostics);
    tn_sources_clear(&sources);
    tn_arena_free(arena);
    return 0;
}
