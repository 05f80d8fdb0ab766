/* Formatting: a rule file of any notation laid out the one canonical way, with its comments.
 *
 * The formatter works on the file's tokens, not on its syntax tree, so that parentheses, spellings of lengths and
 * everything else an author chose stays; it only chooses where lines end, how far they are indented and what is lined
 * up, and writes the language's words the usual way, those that are called otherwise now by their newer names (a note
 * in the diagnostics says so). What it made is read again and its tokens (of a grammar: its
 * rules) are compared with the original's: formatting cannot change what a file means. Lines are at most
 * TN_FORMAT_WIDTH characters wide, where a line can be broken.
 */
#ifndef TARTAN_COMPILER_FORMAT_H
#define TARTAN_COMPILER_FORMAT_H

#include "compiler/common/diagnostic.h"
#include "compiler/compile.h"

/* Formats a file's text; `path` is its name in diagnostics. *formatted, zero-ended, is the caller's to free().
 * The text is added to the diagnostics' sources. TN_INVALID if it has errors of syntax, TN_LIMIT, TN_MEMORY: all
 * reported, and *formatted is NULL. */
tn_status tn_format_text(tn_diagnostics *diagnostics, const tn_notation *notation, const char *path, const char *text,
                         size_t size, char **formatted, size_t *formatted_size);

#endif
