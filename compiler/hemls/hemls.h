/* The HEMLS notation: syntax tree, checking, and what is emitted (docs/growth.md).
 *
 * A line is a sequence of symbols, perhaps with successors: the grammar is permissive, and what a line must be to mean
 * something is checked, so that mistakes are explained in terms of edges and turtles. Everything lives in the
 * compilation's arena.
 */
#ifndef TARTAN_COMPILER_HEMLS_HEMLS_H
#define TARTAN_COMPILER_HEMLS_HEMLS_H

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"
#include "compiler/common/layout.h"
#include "compiler/common/parsing.h"
#include "compiler/common/token.h"
#include "compiler/common/words.h"
#include "runtime/growth/model/system.h"
#include "runtime/module/builder.h"
#include "runtime/module/code.h"

/* ---- syntax */

typedef enum tn_hemls_kind {
    TN_HEMLS_EDGE,
    TN_HEMLS_TURN, /* + - & ^ \ / : `sign` says which */
    TN_HEMLS_TILDE,
    TN_HEMLS_OPEN,
    TN_HEMLS_CLOSE,
    TN_HEMLS_LESS,
    TN_HEMLS_GREATER,
} tn_hemls_kind;

typedef struct tn_hemls_symbol {
    tn_hemls_kind kind;
    tn_span span;
    char sign;         /* of a turn */
    const char *name;  /* of an edge, without its age: "Edge0" or "A" */
    bool letter;       /* of an edge: "A" rather than "Edge0" */
    bool broken;       /* of an edge: it was complained of already */
    uint32_t number;   /* of an EdgeN; letters are numbered by checking */
    tn_age_change age; /* of an edge */
    struct tn_hemls_symbol *next;
} tn_hemls_symbol;

typedef struct tn_hemls_symbols {
    tn_hemls_symbol *first, *last;
} tn_hemls_symbols;

/* What follows a successor. */
typedef struct tn_hemls_choice {
    bool weighted;
    tn_comparison comparison; /* TN_ALWAYS: no condition */
    double value;             /* the weight or the bound */
    tn_span span;
} tn_hemls_choice;

typedef struct tn_hemls_alternative {
    tn_hemls_symbols symbols;
    tn_hemls_choice choice;
    tn_span span;
    struct tn_hemls_alternative *next;
} tn_hemls_alternative;

typedef struct tn_hemls_alternatives {
    tn_hemls_alternative *first, *last;
} tn_hemls_alternatives;

typedef enum tn_hemls_line_kind {
    TN_HEMLS_AXIOM,
    TN_HEMLS_RULE,
    TN_HEMLS_ANGLE,
    TN_HEMLS_BRANCH_ANGLE,
    TN_HEMLS_SYNC,
    TN_HEMLS_EVEN
} tn_hemls_line_kind;

typedef struct tn_hemls_line {
    tn_hemls_line_kind kind;
    tn_span span;
    tn_hemls_symbols symbols;           /* a seed, or a rule's predecessor */
    tn_hemls_alternatives alternatives; /* of a rule */
    double number;                      /* of an angle */
    struct tn_hemls_line *next;
} tn_hemls_line;

typedef struct tn_hemls_file {
    tn_hemls_line *first, *last;
    bool damaged; /* lines are missing because of errors already reported */
} tn_hemls_file;

/* The lexer, for its parser: NULL if out of memory. */
void *tn_hemls_lexer_new(tn_parsing *parse);
void tn_hemls_lexer_free(void *scanner);

/* Parses the source as a .hemls file. NULL if out of memory; errors are in the diagnostics. Its tokens go to
 * `tokens` where that is not NULL. */
tn_hemls_file *tn_parse_hemls(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens);

/* Constructors; NULL if out of memory. */
tn_hemls_symbol *tn_hemls_symbol_new(tn_parsing *parse, tn_hemls_kind kind, tn_span span);
tn_hemls_symbols tn_hemls_symbols_add(tn_hemls_symbols list, tn_hemls_symbol *symbol);
tn_hemls_alternative *tn_hemls_alternative_new(tn_parsing *parse, tn_span span, tn_hemls_symbols symbols,
                                               tn_hemls_choice choice);
tn_hemls_alternatives tn_hemls_alternatives_add(tn_hemls_alternatives list, tn_hemls_alternative *one);
tn_hemls_line *tn_hemls_line_new(tn_parsing *parse, tn_hemls_line_kind kind, tn_span span);
void tn_hemls_add_line(tn_parsing *parse, tn_hemls_line *line);

/* ---- meaning */

/* What replaces an edge: symbols that are all moves of the turtle, which the turtle has nothing against. */
typedef struct tn_checked_successor {
    const tn_hemls_symbols *symbols;
    tn_span span;
    uint32_t depth; /* brackets that are open at once, at most */
} tn_checked_successor;

typedef struct tn_checked_alternative {
    tn_checked_successor successor;
    uint32_t function; /* once it is emitted */
    tn_hemls_choice choice;
    struct tn_checked_alternative *next;
} tn_checked_alternative;

typedef struct tn_checked_rewrite {
    uint32_t left, right; /* numbers of the context, or TN_NO_LABEL */
    uint32_t *numbers;    /* the predecessor's edges */
    uint32_t number_count;
    tn_checked_alternative *alternatives;
    uint32_t alternative_count;
    bool conditional; /* some alternative asks for the age: the first that holds is taken */
    tn_span span;
    struct tn_checked_rewrite *next;
    struct tn_checked_rewrite *next_in_group; /* most specific first */
} tn_checked_rewrite;

typedef struct tn_checked_group {
    tn_checked_rewrite *rules;
    uint32_t rule_count;
    struct tn_checked_group *next;
} tn_checked_group;

typedef struct tn_checked_label {
    uint32_t number;
    const char *name;
    bool made; /* some seed or successor draws it */
    struct tn_checked_label *next;
} tn_checked_label;

typedef struct tn_checked_growth {
    const char *name;
    tn_checked_label *labels; /* ascending numbers */
    uint32_t label_count;
    uint32_t *axiom;
    bool *axiom_reversed;
    uint32_t axiom_count;
    tn_span axiom_span;
    tn_checked_group *groups;
    double angle, branch_angle;
    bool sync, even;
    tn_span span;
} tn_checked_growth;

/* Do weights choose between a rule's successors? */
static inline bool tn_rewrite_by_chance(const tn_checked_rewrite *rule)
{
    return !rule->conditional && rule->alternative_count > 1;
}

/* The move of the turtle that a symbol of a successor is (an edge: without its label); PASS where it is none. */
tn_instruction tn_hemls_move(const tn_hemls_symbol *symbol, double angle);

/* Lets the turtle try the symbols of a successor, and finds its depth. Errors are reported; false then, or where out of
 * memory. */
bool tn_hemls_check_successor(tn_arena *arena, tn_diagnostics *diagnostics, double angle,
                              tn_checked_successor *checked);

/* Checks a file; NULL if there were errors (which are in the diagnostics) or no memory. */
tn_checked_growth *tn_check_hemls(tn_arena *arena, tn_diagnostics *diagnostics, const tn_hemls_file *file,
                                  uint32_t source);

/* Writes the system's code and records. */
void tn_emit_growth(tn_builder *builder, const tn_checked_growth *growth);

/* ---- words: sets of the places of words.def, as TN_HEMLS_AT(RULE) */

enum tn_hemls_word_place {
#define PLACE(ID, BLOCK, HEADS, WHERE) TN_HEMLS_WORD_PLACE_##ID,
#include "compiler/hemls/words.def"
    TN_HEMLS_WORD_PLACE_COUNT
};
_Static_assert(TN_HEMLS_WORD_PLACE_COUNT < 64, "a set of places has a bit for each");
#define TN_HEMLS_AT(ID) (UINT64_C(1) << TN_HEMLS_WORD_PLACE_##ID)

extern const tn_vocabulary tn_hemls_words;

#endif
