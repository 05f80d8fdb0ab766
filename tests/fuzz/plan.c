/* The plan language's front end on any text: it ends, says what is wrong, and what it accepts makes a module that
 * loads. */
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

#include "runtime/load.h"
#include "runtime/module/module.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/compile_file.h"

/* Imports by name reach the stdlib; by path they could reach anything on this machine. A text in quotes shortly after a
 * `use`, with a slash or a dot in it, is taken for a path. */
static bool imports_by_path(const uint8_t *data, size_t size)
{
    size_t use = size; /* where the last `use` was */
    for (size_t i = 0; i + 3 < size; i++) {
        if (strncasecmp((const char *)data + i, "use", 3) == 0)
            use = i;
        if (data[i] != '"' || use == size || i - use > 100)
            continue;
        for (size_t k = i + 1; k < size && data[k] != '"' && data[k] != '\n'; k++)
            if (data[k] == '/' || data[k] == '.')
                return true;
    }
    return false;
}

static void show(tn_compilation *compilation, bool json)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (out) {
        tn_diagnostics_show(&compilation->diagnostics, &(tn_show_options){.json = json, .colour = true}, out);
        fclose(out);
    }
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (imports_by_path(data, size))
        return 0;
    static const char *const dirs[] = {TARTAN_SOURCE_DIR "/stdlib"};
    library_folders options = {.stdlib_dirs = dirs, .stdlib_dir_count = 1};
    tn_compilation compilation;
    tn_status status = compile_text("fuzz.plan", (const char *)data, size, &options, &compilation);
    show(&compilation, false);
    show(&compilation, true);
    if (status == TN_OK) {
        tn_module *module;
        tn_error error;
        if (tn_module_load(compilation.module, compilation.module_size, NULL, &module, &error) != TN_OK) {
            fprintf(stderr, "refused: %s\n", error.message);
            abort();
        }
        tn_module_free(module);
    } else if (compilation.diagnostics.error_count == 0) {
        fprintf(stderr, "failed without an error\n");
        abort();
    }
    tn_compilation_clear(&compilation);
    return 0;
}
