/* A compilation: what it is told, and all that it makes. compile.h does it. */
#ifndef TARTAN_COMPILER_COMMON_COMPILATION_H
#define TARTAN_COMPILER_COMMON_COMPILATION_H

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"
#include "compiler/common/import.h"

typedef struct tn_compile_options {
    const char *const *stdlib_dirs; /* where `use "name"` without slash or extension is looked for, in order */
    size_t stdlib_dir_count;
    bool warnings_are_errors;
    tn_overlay *overlay; /* or NULL */
    void *overlay_context;
} tn_compile_options;

typedef struct tn_compilation {
    tn_sources sources;
    tn_diagnostics diagnostics;
    tn_arena *arena;
    struct tn_program *program; /* checked; NULL where there were errors */
    /* for editors, of a .plan file, and also where there were errors: the files with their syntax trees (import.h), and
     * what became of them (check.h) */
    const struct tn_imports *imports;
    const struct tn_checked *checked;
    uint8_t *module; /* bytes of the module, owned; NULL where there were errors */
    size_t module_size;
} tn_compilation;

#endif
