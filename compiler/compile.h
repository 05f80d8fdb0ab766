/* Compiling: a source file and all that it uses, to a module's bytes.
 *
 * The way through: grammar/ parses each file into an AST (ast.h), `use` imports are followed (import.h), names,
 * schemas, specifiers and expressions are checked (check_*.h) into a program (program.h), which is emitted (emit.h).
 * Errors of all files are collected; nothing is emitted where there is one.
 */
#ifndef TARTAN_COMPILER_COMPILE_H
#define TARTAN_COMPILER_COMPILE_H

#include "compiler/arena.h"
#include "compiler/diagnostic.h"
#include "compiler/import.h"
#include "compiler/program.h"

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
    tn_program *program; /* checked; NULL where there were errors */
    /* for editors, of a .plan file, and also where there were errors: the files with their syntax trees (import.h), and
     * what became of them (check.h) */
    const struct tn_imports *imports;
    const struct tn_checked *checked;
    uint8_t *module; /* bytes of the module, owned; NULL where there were errors */
    size_t module_size;
} tn_compilation;

/* Compiles a text; `path` is its name in diagnostics and where relative imports start. The result's diagnostics say
 * what is wrong; returns TN_OK, or TN_INVALID where there is an error. Free with tn_compilation_clear in any case. */
tn_status tn_compile_text(const char *path, const char *text, size_t size, const tn_compile_options *options,
                          tn_compilation *compilation);

void tn_compilation_clear(tn_compilation *compilation);

#endif
