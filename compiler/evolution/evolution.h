/* The `evolution { ... }` block of a .study file: what is evolved, how, and towards what.
 *
 *   evolution {
 *     grammar "words"            # of the standard library, or a path
 *     match "hello world"        # the problem: match, fit, grow, or keep and drop
 *     population 500
 *     selection tournament 3
 *   }
 *
 * A study of fields or designs of boxes names what they are bred from instead of a grammar.
 *
 * docs/evolution.md has all settings, runtime/genome/settings.def their kinds and ranges. The syntax tree lives in the
 * compilation's arena; the checked study becomes the SETTING records of a module, whose grammar is beside them.
 */
#ifndef TARTAN_COMPILER_EVOLUTION_EVOLUTION_H
#define TARTAN_COMPILER_EVOLUTION_EVOLUTION_H

#include "compiler/common/arena.h"
#include "compiler/common/compilation.h"
#include "compiler/common/lexical.h"
#include "compiler/common/token.h"
#include "runtime/genome/settings.h"

/* ---- the syntax tree */

typedef struct tn_evolution_text {
    const char *text;
    size_t length;
} tn_evolution_text;

typedef enum tn_evolution_value_kind {
    TN_EVOLUTION_WORD,
    TN_EVOLUTION_NUMBER,
    TN_EVOLUTION_RANGE,
    TN_EVOLUTION_STRING,
    TN_EVOLUTION_UNCLOSED /* a text without its closing quote, which has been reported */
} tn_evolution_value_kind;

typedef struct tn_evolution_value {
    tn_evolution_value_kind kind;
    tn_span span;
    const char *text; /* zero-ended; a string without its quotes and escapes */
    struct tn_evolution_value *next, *last;
} tn_evolution_value;

typedef struct tn_evolution_setting {
    const char *name;
    tn_span span;
    tn_evolution_value *values;
    struct tn_evolution_setting *next;
} tn_evolution_setting;

typedef struct tn_evolution_reader {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    uint32_t file, at;
    tn_evolution_setting *first, *last;
    size_t blocks;
    tn_span head; /* of the first block: the word and the brace */
    tn_span open; /* of the block that is being read */
    bool failed;
    tn_span outside;   /* the first that stands outside the blocks; empty: nothing does */
    tn_tokens *tokens; /* where the lexer leaves what it read, or NULL */
    tn_lexer_pool pool;
} tn_evolution_reader;

/* Parses the blocks of a text, `size` bytes followed by two zero bytes. */
void tn_evolution_read(tn_evolution_reader *reader, char *text, size_t size);

/* For the grammar. */
void tn_evolution_block(tn_evolution_reader *reader, tn_span head);
void tn_evolution_outside(tn_evolution_reader *reader, tn_span span);
void tn_evolution_setting_new(tn_evolution_reader *reader, tn_span span, tn_evolution_text name,
                              tn_evolution_value *values);
tn_evolution_value *tn_evolution_value_new(tn_evolution_reader *reader, tn_evolution_value_kind kind, tn_span span,
                                           tn_evolution_text text);
tn_evolution_value *tn_evolution_value_add(tn_evolution_value *list, tn_evolution_value *value);
void tn_evolution_unexpected(tn_evolution_reader *reader, tn_span span, const char *token);
void tn_evolution_unclosed_text(tn_evolution_reader *reader, tn_span span);
void tn_evolution_unclosed_block(tn_evolution_reader *reader, tn_span span);

/* ---- checking */

/* Only the settings, from a study's text: its grammar is not looked for. Texts of the study live in the arena. False
 * if there are errors. */
bool tn_evolution_settings_read(tn_sources *sources, uint32_t file, tn_diagnostics *diagnostics, tn_arena *arena,
                                tn_evolution_study *study);

/* What the settings mean, but for the grammar's file. False if there are errors. */
bool tn_evolution_check(const tn_evolution_reader *reader, tn_evolution_study *study);

#endif
