/* Compiles a text of a growth notation, shows what is said of it, and grows what comes of it. */
#ifndef TARTAN_TESTS_FUZZ_TEXT_H
#define TARTAN_TESTS_FUZZ_TEXT_H

#include <string.h>

#include "runtime/load.h"
#include "tests/fuzz/grow.h"
#include "tests/support/compile_file.h"

/* Files of the standard library may be named; paths could reach anything on this machine. */
static inline bool names_a_path(const uint8_t *data, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        if (data[i] != '"')
            continue;
        for (i++; i < size && data[i] != '"' && data[i] != '\n'; i++)
            if (data[i] == '/' || data[i] == '.')
                return true;
    }
    return false;
}

static inline void fuzz_show(tn_compilation *compilation, bool json)
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

static inline void fuzz_load(const tn_compilation *compilation)
{
    tn_module *module;
    tn_error error;
    if (tn_module_load(compilation->module, compilation->module_size, NULL, &module, &error) != TN_OK) {
        fprintf(stderr, "refused: %s\n", error.message);
        abort();
    }
    grow_module(module);
    tn_module_free(module);
}

static inline void fuzz_growth_text(const char *path, const uint8_t *data, size_t size)
{
    static const char *const dirs[] = {TARTAN_SOURCE_DIR "/stdlib"};
    library_folders options = {.stdlib_dirs = dirs, .stdlib_dir_count = 1};
    tn_compilation compilation;
    if (names_a_path(data, size))
        return;
    tn_status status = compile_text(path, (const char *)data, size, &options, &compilation);
    fuzz_show(&compilation, false);
    fuzz_show(&compilation, true);
    if (status == TN_OK) {
        fuzz_load(&compilation);
    } else if (compilation.diagnostics.error_count == 0) {
        fprintf(stderr, "failed without an error\n");
        abort();
    }
    tn_compilation_clear(&compilation);
}

#endif
