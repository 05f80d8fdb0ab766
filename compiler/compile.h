/* Compiling: a text and all that it uses, to a module's bytes.
 *
 * The text comes from the caller, and what it uses from the caller's resolver: the compiler opens no file, and needs no
 * file name. The way through: grammar/ parses each text into a syntax tree, `use` imports are followed (import.h), what
 * the notation means is checked, and the result is emitted. Errors of all texts are collected; nothing is emitted where
 * there is one.
 */
#ifndef TARTAN_COMPILER_COMPILE_H
#define TARTAN_COMPILER_COMPILE_H

#include "compiler/notation.h"

/* Compiles a text of the notation. The result's diagnostics say what is wrong; returns TN_OK, or TN_INVALID where there
 * is an error, or TN_STOPPED. The input and what the resolver found are not needed afterwards. Free with
 * tn_compilation_clear in any case. */
tn_status tn_compile_text(const tn_notation *notation, const tn_input *input, const tn_compile_options *options,
                          tn_compilation *compilation);

void tn_compilation_clear(tn_compilation *compilation);

#endif
