/* Compiling: a text and all that it uses, to a module's bytes.
 *
 * The text comes from the caller, and what it uses from the caller's resolver: the compiler opens no file, and needs no
 * file name. The way through: grammar/ parses each text into a syntax tree, `use` imports are followed (import.h), what
 * the notation means is checked, and the result is emitted. Errors of all texts are collected; nothing is emitted where
 * there is one.
 */
#ifndef TARTAN_COMPILER_COMPILE_H
#define TARTAN_COMPILER_COMPILE_H

#include "compiler/common/notation.h"

/* The notations of rule files: the table that compiler/notations.def says, and how a text's notation is found. */

extern const tn_notation tn_notations[];
extern const size_t tn_notation_count;

enum {
#define NOTATION(ID, ...) TN_NOTATION_ROW_##ID,
#include "compiler/notations.def"
};

/* The notation of this id: TN_NOTATION(plan). */
#define TN_NOTATION(ID) (&tn_notations[TN_NOTATION_ROW_##ID])

/* The notation of a file, by the end of its path and, where several have that, by its text: the one whose word heads a
 * block in it. NULL if no notation's files end so. */
const tn_notation *tn_notation_of(const char *path, const char *text, size_t size);

/* The same, where texts whose path says nothing are taken for the first notation's. */
const tn_notation *tn_notation_or_first(const char *path, const char *text, size_t size);

/* The notation of a text by what editors and --notation call its language, which is its extension without the point.
 * NULL if there is none. */
const tn_notation *tn_notation_of_language(const char *language, const char *text, size_t size);

/* The notation that a module was compiled from: the first row whose front end made it. NULL if there is nothing in
 * it.
 */
const tn_notation *tn_notation_of_module(const tn_module *module);

/* Is it the first of those with its extension? There is one for every extension. */
static inline bool tn_notation_is_main(const tn_notation *notation)
{
    return notation->word[0] == '\0';
}

/* "plan": what editors and --notation call it. */
static inline const char *tn_notation_language(const tn_notation *notation)
{
    return notation->extension + 1;
}

/* Is the command (by its name) about what such a file says? */
bool tn_notation_takes(const tn_notation *notation, const char *command);

/* "it is a grammar that genomes are mapped through: `tartan map` takes it", into a text of that size. */
void tn_notation_help(const tn_notation *notation, char *text, size_t size);

/* Compiles a text of the notation. The result's diagnostics say what is wrong; returns TN_OK, or TN_INVALID if there
 * is an error, or TN_STOPPED. The input and what the resolver found are not needed afterwards. Free with
 * tn_compilation_clear in any case. */
tn_status tn_compile_text(const tn_notation *notation, const tn_input *input, const tn_compile_options *options,
                          tn_compilation *compilation);

#endif
