/* The plan language's front end on any text: it ends, says what is wrong, and what it accepts makes a module that
 * loads. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/compile.h"
#include "runtime/vm/module.h"
#include "tests/fuzz/fuzz.h"

/* Imports by name reach the stdlib; by path they could reach anything on this machine. */
static bool imports_by_path(const uint8_t *data, size_t size)
{
    return memmem(data, size, "use", 3) && (memchr(data, '/', size) || memchr(data, '.', size));
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
    tn_compile_options options = {.stdlib_dirs = dirs, .stdlib_dir_count = 1};
    tn_compilation compilation;
    tn_status status = tn_compile_text("fuzz.plan", (const char *)data, size, &options, &compilation);
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
