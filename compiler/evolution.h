/* The `evolution { ... }` block of a .study file: what is evolved, how, and towards what.
 *
 *   evolution {
 *     grammar "words"            # of the standard library, or a path
 *     match "hello world"        # the problem: match, fit, grow, or keep and drop
 *     population 500
 *     selection tournament 3
 *   }
 *
 * docs/evolution.md has all settings. The syntax tree and the checked study live in the compilation's arena.
 */
#ifndef TARTAN_COMPILER_EVOLUTION_H
#define TARTAN_COMPILER_EVOLUTION_H

#include "compiler/arena.h"
#include "compiler/compile.h"
#include "compiler/token.h"

/* ---- the checked study: names are as the engine's own lists have them */

typedef enum tn_evolution_problem {
    TN_EVOLVE_NOTHING,
    TN_EVOLVE_MATCH,
    TN_EVOLVE_FIT,
    TN_EVOLVE_LEARN,
    TN_EVOLVE_GROW
} tn_evolution_problem;

typedef struct tn_evolution_study {
    const char *grammar;   /* as written */
    uint32_t grammar_file; /* among the sources */
    tn_evolution_problem problem;
    const char *match;       /* the text */
    const char *fit;         /* path of the data */
    const char *keep, *drop; /* learn: paths of plans */
    const char *grow;        /* path of a growth study */
    const char *schema;      /* of those plans, as `use` names it */
    uint64_t seed, population, generations;
    const char *initialise;
    uint64_t codons, codon_limit, max_codons;
    uint64_t depth_low, depth_high;
    double tail;
    const char *seeds; /* path of genomes, or NULL */
    const char *selection;
    bool says_selection_value;
    double selection_value;
    const char *crossover;
    double crossover_rate;
    const char *mutation;
    double mutation_rate; /* negative: the operator's own */
    const char *points;   /* used or anywhere */
    uint64_t elites;
    const char *replacement;
    uint64_t max_depth, wraps, tree_depth, max_steps;
    bool says_max_depth, says_wraps, says_stop, says_tree_depth;
    double stop;          /* as soon as the best is not above it */
    double length_weight; /* learn: what a byte of a rule costs */
    tn_span span;
} tn_evolution_study;

/* ---- the syntax tree */

typedef struct tn_evolution_text {
    const char *text;
    size_t length;
} tn_evolution_text;

typedef enum tn_evolution_value_kind {
    TN_EVOLUTION_WORD,
    TN_EVOLUTION_NUMBER,
    TN_EVOLUTION_RANGE,
    TN_EVOLUTION_STRING
} tn_evolution_value_kind;

typedef struct tn_evolution_value {
    tn_evolution_value_kind kind;
    tn_span span;
    const char *text; /* zero-ended; a string without its quotes */
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
    tn_span block;
    bool failed;
    tn_tokens *tokens; /* where the lexer leaves what it read, or NULL */
} tn_evolution_reader;

/* Parses the blocks of a text, `size` bytes followed by two zero bytes. */
void tn_evolution_read(tn_evolution_reader *reader, char *text, size_t size);

/* For the grammar. */
void tn_evolution_block(tn_evolution_reader *reader, tn_span span);
void tn_evolution_setting_new(tn_evolution_reader *reader, tn_span span, tn_evolution_text name,
                              tn_evolution_value *values);
tn_evolution_value *tn_evolution_value_new(tn_evolution_reader *reader, tn_evolution_value_kind kind, tn_span span,
                                           tn_evolution_text text);
tn_evolution_value *tn_evolution_value_add(tn_evolution_value *list, tn_evolution_value *value);
void tn_evolution_unexpected(tn_evolution_reader *reader, tn_span span, const char *token);

/* ---- checking */

/* Makes the module (of the grammar) of a compilation whose first source is a study, and its checked settings. */
tn_status tn_evolution_compile(const tn_compile_options *options, tn_compilation *compilation, tn_error *error);

/* Only the settings, from a study's text: its grammar is not looked for. The study lives in the arena. */
bool tn_evolution_settings_read(tn_sources *sources, uint32_t file, tn_diagnostics *diagnostics, tn_arena *arena,
                                tn_evolution_study *study);

/* Has the text of a study an evolution block? Is it a .study file that has one? */
bool tn_has_evolution(const char *text);
bool tn_is_evolution(const char *path, const char *text);

/* What the settings mean, but for the grammar's file. False where there are errors. */
bool tn_evolution_check(const tn_evolution_reader *reader, tn_evolution_study *study);

#endif
