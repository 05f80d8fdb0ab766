/* Formatting any text as any notation: it ends, says what is wrong or lays the text out so that it means the same
 * (which formatting itself checks: it fails with TN_INTERNAL otherwise), and what is laid out stays as it is. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/format.h"
#include "tests/fuzz/fuzz.h"

static void fail(const char *what, const tn_notation *notation)
{
    fprintf(stderr, "%s: %s\n", notation->name, what);
    abort();
}

static char *format(const tn_notation *notation, const char *text, size_t size, size_t *formatted_size)
{
    tn_sources sources = {0};
    tn_diagnostics diagnostics;
    char *formatted;
    tn_diagnostics_init(&diagnostics, &sources);
    tn_status status = tn_format_text(&diagnostics, notation, "fuzz", text, size, &formatted, formatted_size);
    if (status != TN_OK && status != TN_INVALID && status != TN_LIMIT)
        fail("laid out, it would mean something else", notation);
    if (status != TN_OK && diagnostics.error_count == 0)
        fail("failed without an error", notation);
    tn_diagnostics_clear(&diagnostics);
    tn_sources_clear(&sources);
    return formatted;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    for (size_t n = 0; n < tn_notation_count; n++) {
        const tn_notation *notation = &tn_notations[n];
        size_t once_size, twice_size;
        char *once = format(notation, (const char *)data, size, &once_size);
        if (!once)
            continue;
        char *twice = format(notation, once, once_size, &twice_size);
        if (!twice || once_size != twice_size || memcmp(once, twice, once_size) != 0)
            fail("laid out again, it is laid out otherwise", notation);
        free(once);
        free(twice);
    }
    return 0;
}
