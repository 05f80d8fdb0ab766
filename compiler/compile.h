/* Compiling: a source file and all that it uses, to a module's bytes.
 *
 * The way through: grammar/ parses each file into an AST (ast.h), `use` imports are followed (import.h), names,
 * schemas, specifiers and expressions are checked (check_*.h) into a program (program.h), which is emitted (emit.h).
 * Errors of all files are collected; nothing is emitted where there is one.
 */
#ifndef TARTAN_COMPILER_COMPILE_H
#define TARTAN_COMPILER_COMPILE_H

#include "compiler/common/compilation.h"

/* Compiles a text; `path` is its name in diagnostics and where relative imports start. The result's diagnostics say
 * what is wrong; returns TN_OK, or TN_INVALID where there is an error. Free with tn_compilation_clear in any case. */
tn_status tn_compile_text(const char *path, const char *text, size_t size, const tn_compile_options *options,
                          tn_compilation *compilation);

void tn_compilation_clear(tn_compilation *compilation);

#endif
