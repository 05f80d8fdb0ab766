/* The .study notation: how a rewrite system is to be grown (docs/growth.md): syntax tree, checking, what is emitted.
 *
 * A study is a list of statements. Those of a file that it uses come first; settings of the using file then stand
 * instead of theirs, and forces, boundaries and goals add up. Everything lives in the compilation's arena.
 */
#ifndef TARTAN_COMPILER_STUDY_STUDY_H
#define TARTAN_COMPILER_STUDY_STUDY_H

#include "compiler/common/expression.h"
#include "compiler/common/import.h"
#include "compiler/common/parsing.h"
#include "compiler/common/token.h"
#include "compiler/common/words.h"
#include "compiler/hemls/hemls.h"

typedef enum tn_study_kind {
    /* settings, each once in a file */
    TN_STUDY_TITLE,
    TN_STUDY_RULES,
    TN_STUDY_STEPS,
    TN_STUDY_SCALE,
    TN_STUDY_START,
    TN_STUDY_START_LENGTH,
    TN_STUDY_SEED,
    TN_STUDY_BRANCH_ANGLE,
    TN_STUDY_BRANCH_LENGTH,
    TN_STUDY_EDGE_LIMIT,
    TN_STUDY_SETS_FIXED_CENTRE,
    TN_STUDY_SETS_FIXED_PERIMETER,
    TN_STUDY_SETS_FACING,
    TN_STUDY_SETS_MIRROR,
    TN_STUDY_SETS_RAW,
    TN_STUDY_SUN,
    TN_STUDY_DISTANCE_TO,
    TN_STUDY_SETTING_COUNT,
    /* as many as one likes */
    TN_STUDY_USE = TN_STUDY_SETTING_COUNT,
    TN_STUDY_FORCE,
    TN_STUDY_BOUNDARY,
    TN_STUDY_GOAL,
    TN_STUDY_REQUIREMENT,
} tn_study_kind;

/* An optional part of a statement. */
typedef enum tn_study_part_kind {
    TN_PART_STRENGTH,
    TN_PART_EXPONENT,
    TN_PART_SIDE, /* value: inside */
    TN_PART_MODE, /* value: tn_boundary_mode */
    TN_PART_TARGET,
    TN_PART_WEIGHT,
    TN_STUDY_PART_COUNT
} tn_study_part_kind;

typedef struct tn_study_part {
    tn_study_part_kind kind;
    double value;
    tn_span span;
    struct tn_study_part *next;
} tn_study_part;

typedef struct tn_study_vector {
    double x, y, z;
    tn_span span;
} tn_study_vector;

typedef struct tn_study_item {
    tn_study_kind kind;
    tn_span span;
    uint32_t which; /* tn_force_kind or tn_boundary_kind */
    tn_study_vector a, b;
    tn_decimal number;
    const char *text; /* a path, a title or a term */
    tn_span text_span;
    tn_study_part *parts;      /* the last first */
    tn_expression *expression; /* of a requirement, or of a goal that is one, which `text` names */
    tn_use *use;               /* of `use` and `rules`: where it leads */
    struct tn_study_item *next;
} tn_study_item;

typedef struct tn_study_file {
    tn_study_item *first, *last;
    bool damaged;
} tn_study_file;

typedef struct tn_study_text {
    const char *text;
    tn_span span;
} tn_study_text;

/* The lexer, for its parser: NULL if out of memory. */
void *tn_study_lexer_new(tn_parsing *parse);
void tn_study_lexer_free(void *scanner);

/* Parses the source as a .study file without evolution. NULL if out of memory; errors are in the
 * diagnostics. */
tn_study_file *tn_parse_study(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens);

/* Does a statement start with this word? */
bool tn_study_heads(const char *text, size_t size);

/* Is this a word of the notation, in capitals or not? */
bool tn_study_has_word(const char *text, size_t size);

/* Constructors; out of memory is the arena's to remember. */
tn_study_item *tn_study_item_new(tn_parsing *parse, tn_study_kind kind, tn_span span);
tn_study_part *tn_study_part_new(tn_parsing *parse, tn_study_part_kind kind, tn_span span, double value,
                                 tn_study_part *before);
void tn_study_add(tn_parsing *parse, tn_study_item *item);

typedef struct tn_checked_study {
    const char *name;
    const tn_study_item *settings[TN_STUDY_SETTING_COUNT]; /* NULL: not given */
    const tn_study_item **forces, **boundaries, **goals, **requirements;
    uint32_t force_count, boundary_count, goal_count, requirement_count;
    uint32_t flags;
    tn_span span;
} tn_checked_study;

/* Checks the studies among the units. False if there were errors. */
bool tn_check_study(tn_arena *arena, tn_diagnostics *diagnostics, const tn_imports *imports, tn_checked_study *study);

/* What fitness expressions speak of: everything that is measured of a surface. */
extern const tn_expression_scope tn_study_scope;

/* The tn_measured of a name, or their number. */
uint32_t tn_study_term(const char *name);

/* Lays out a .study file, with an evolution block or without. */
void tn_format_study(tn_format *format);

/* Lists the statements of a study, and of an evolution block its settings. */
void tn_study_list(tn_listing *listing);

/* ---- words: sets of the places of words.def, as TN_STUDY_AT(FORCE) */

enum tn_study_word_place {
#define PLACE(ID, BLOCK, HEADS, WHERE) TN_STUDY_WORD_PLACE_##ID,
#include "compiler/study/words.def"
    TN_STUDY_WORD_PLACE_COUNT
};
_Static_assert(TN_STUDY_WORD_PLACE_COUNT < 64, "a set of places has a bit for each");
#define TN_STUDY_AT(ID) (UINT64_C(1) << TN_STUDY_WORD_PLACE_##ID)

extern const tn_vocabulary tn_study_words;

#endif
