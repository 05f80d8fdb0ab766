/* What a notation is: a row of compiler/notations.def and a front end, which its folder gives as one constant.
 *
 * A front end reads a text for its tokens, compiles it, lays it out and lists what it has. compiler/compile.h has the
 * table.
 */
#ifndef TARTAN_COMPILER_COMMON_NOTATION_H
#define TARTAN_COMPILER_COMMON_NOTATION_H

#include "compiler/common/compilation.h"
#include "compiler/common/layout.h"
#include "compiler/common/token.h"
#include "compiler/common/words.h"
#include "runtime/module/module.h"

/* A text read for its tokens: what formatting and editors need. */
typedef struct tn_reading {
    uint32_t file;
    tn_tokens tokens;
    void *tree; /* the front end's own; may be NULL */
} tn_reading;

typedef struct tn_front {
    /* Reads source reading->file, which is UTF-8 text, into the arena; what is wrong is in the diagnostics. False where
     * out of memory. */
    bool (*read)(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading);

    /* Makes the module of the compilation, whose first source is the text. What is wrong is in the diagnostics, and the
     * status is TN_INVALID then. */
    tn_status (*compile)(tn_compilation *compilation, const tn_compile_options *options, tn_error *error);

    /* Was this module, or the part that matters, compiled from a file of the notation? */
    bool (*made)(const tn_module *module);

    /* Are several files one text, in the order given? Commands then compile all that they are given together. */
    bool joins;

    /* Has it params, whose values the options may give? */
    bool settable;

    /* Lists what the text has, from its tokens. NULL: it is listed from what was compiled, where that is a plan's. */
    void (*list)(tn_listing *listing);

    const tn_vocabulary *words; /* what editors offer and explain; NULL: no table of them is there */

    /* ---- laying out (compiler/format.h) */
    void (*lay_out)(tn_format *format);
    tn_format_spell *spell; /* how words of the language are written */
    bool nests;             /* has brackets that come in pairs, or else an error of syntax */

    /* The text with newer words for older ones that are still read, zero-ended, and in *said what there is to say of
     * that; NULL: it has none. NULL as a function: no words were renamed. Out of memory is the arena's to remember. */
    const char *(*renew)(tn_arena *arena, const tn_source *source, const tn_tokens *tokens, const char **said);

    /* Leaves out what is white space and was read into tokens; NULL: nothing is. */
    void (*trim)(const tn_source *source, tn_tokens *tokens);

    /* After laying out: gives tokens that name lines their new text, and says whether one changed. NULL: none do. */
    bool (*rename)(tn_arena *arena, const tn_source *source, const tn_reading *from, const tn_format *format,
                   tn_format_token *tokens);

    /* Do the two mean the same? NULL: where they have the same tokens. Out of memory is the arena's to remember. */
    bool (*same)(const tn_reading *one, const tn_reading *other);
} tn_front;

typedef struct tn_notation {
    const char *name, *extension, *word, *what, *commands, *manual; /* as in notations.def */
    const tn_front *front;
} tn_notation;

static inline bool tn_read(tn_arena *arena, tn_diagnostics *diagnostics, const tn_notation *notation, uint32_t file,
                           tn_reading *reading)
{
    *reading = (tn_reading){.file = file, .tokens = {.arena = arena}};
    return notation->front->read(arena, diagnostics, reading);
}

#endif
