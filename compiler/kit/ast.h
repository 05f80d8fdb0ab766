/* The syntax tree of .kit files: parts with connectors, and what is placed of them (docs/kit-language.md).
 *
 * Everything that a kit says is a node; which of a node's members say something, its kind tells. Nodes live in the
 * compilation's arena, which remembers where memory ran out. */
#ifndef TARTAN_COMPILER_KIT_AST_H
#define TARTAN_COMPILER_KIT_AST_H

#include "compiler/common/expression.h"
#include "compiler/common/import.h"
#include "compiler/common/words.h"
#include "compiler/hemls/hemls.h"

typedef struct tn_kit_text {
    const char *text; /* NULL: none */
    tn_span span;
} tn_kit_text;

/* A number with the name of what it counts: `4 studs`. */
typedef struct tn_kit_length {
    tn_span digits; /* without the sign */
    tn_span span;
    bool negative;
    tn_kit_text unit; /* LDU where there is none */
} tn_kit_length;

typedef struct tn_kit_vector {
    tn_kit_length at[3];
    tn_span span;
    bool given;
} tn_kit_vector;

typedef enum tn_kit_kind {
    /* of a file */
    TN_KIT_UNIT,      /* size, count[0]: turns */
    TN_KIT_LENGTH,    /* name, size[0] */
    TN_KIT_CONNECTOR, /* name, other: what it joins, count[0]: turns, size[0]: distance in a grid */
    TN_KIT_PART,      /* name, doc, inner: FILL, HAS, MASS, PRICE; outer: `from ldraw`, other: a file, or none */
    TN_KIT_SPACE,     /* name, inner: one of a space */
    TN_KIT_RULE,      /* name, outer: NAMED connectors, inner: PLACES and DRAWN */
    TN_KIT_MODEL,     /* name, doc, inner: INSIDE, START, COLOUR, REQUIRES and what follows these */
    TN_KIT_TEST,      /* name: of a model, inner: CONDITION */
    /* of a part */
    TN_KIT_FILL,  /* size, at; of a slope doc: the word, name, other: the sides between which it is */
    TN_KIT_HAS,   /* name: of a connector, other: its axis, count: of a grid, at */
    TN_KIT_MASS,  /* count[0] */
    TN_KIT_PRICE, /* count[0] */
    /* of a space */
    TN_KIT_SHAPE, /* name, inner: LENGTH */
    TN_KIT_FILED, /* name, doc: a file, other: the axis that is up; inner: LENGTH, perhaps none */
    TN_KIT_NAMED, /* name */
    TN_KIT_BOTH,
    TN_KIT_EITHER,
    TN_KIT_NOT,
    TN_KIT_MOVED,    /* inner: one, at */
    TN_KIT_TURNED,   /* inner: one, count[0] */
    TN_KIT_REPEATED, /* inner: one, count[0], at */
    /* of a rule */
    TN_KIT_DRAWN,  /* inner: PLACES with weights */
    TN_KIT_PLACES, /* inner: PLACED, perhaps none; count[0]: weight */
    TN_KIT_PLACED, /* name: of a part; count[0]: colour; outer: NAMED rules to go on with; stops; at; count[1]: turns */
    /* of a model */
    TN_KIT_INSIDE,    /* inner: one of a space */
    TN_KIT_START,     /* name: of a connector, doc: its axis, at, count[0]: turns, other: a rule */
    TN_KIT_STANDS,    /* doc: a file, other: a rule */
    TN_KIT_COLOUR,    /* count[0] */
    TN_KIT_REQUIRES,  /* inner: CONDITION */
    TN_KIT_MINIMIZES, /* inner: one CONDITION, which is a number */
    TN_KIT_MAXIMIZES,
    TN_KIT_SEARCHES, /* name, count[0] */
    TN_KIT_REPEATS,  /* count[0]: turns; or name: mirror, other: an axis */
    TN_KIT_ORDERS,   /* name */
    TN_KIT_STEPS,    /* name, or count[0] */
    TN_KIT_STOCKS,   /* inner: STOCKED */
    TN_KIT_STOCKED,  /* name: of a part, count[0] */
    TN_KIT_CONDITION /* expression */
} tn_kit_kind;

typedef struct tn_kit_node tn_kit_node;

typedef struct tn_kit_nodes {
    tn_kit_node *first, *last;
} tn_kit_nodes;

struct tn_kit_node {
    tn_kit_kind kind;
    tn_span span;
    tn_kit_text name, doc, other;
    tn_kit_length size[3];
    tn_kit_length count[2]; /* plain numbers; not given where their span is empty */
    tn_kit_vector at;
    bool stops;
    uint32_t depth; /* of what it is in a space */
    tn_kit_nodes inner, outer;
    tn_expression *expression;
    tn_kit_node *next;
};

typedef struct tn_kit_use {
    tn_kit_text path;
    struct tn_kit_use *next;
} tn_kit_use;

typedef struct tn_kit_file {
    tn_kit_node *first, *last;
    struct {
        tn_kit_use *first, *last;
    } uses;
    bool damaged; /* something is missing because of errors already reported */
} tn_kit_file;

/* Parses the source as a .kit file. NULL where out of memory; errors are in the diagnostics. Its tokens go to `tokens`
 * where that is not NULL. */
tn_kit_file *tn_parse_kit(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens);

/* The same for conditions alone, which become a test without a name. */
tn_kit_file *tn_parse_kit_conditions(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file);

void *tn_kit_lexer_new(tn_growth_parse *parse);
void tn_kit_lexer_free(void *scanner);

/* Constructors. */
tn_kit_node *tn_kit_node_new(tn_growth_parse *parse, tn_kit_kind kind, tn_span span, tn_kit_text name);
tn_kit_nodes tn_kit_nodes_add(tn_kit_nodes list, tn_kit_node *node);
tn_kit_node *tn_kit_space_of(tn_growth_parse *parse, tn_kit_kind kind, tn_span span, tn_kit_node *a, tn_kit_node *b);
void tn_kit_add(tn_growth_parse *parse, tn_kit_node *node);
void tn_kit_add_use(tn_growth_parse *parse, tn_kit_text path);
void tn_kit_lost(tn_growth_parse *parse);

static inline bool tn_kit_given(const tn_kit_length *length)
{
    return length->span.end > length->span.begin;
}

/* ---- words: sets of the places of words.def, as TN_KIT_AT(RULE) | TN_KIT_AT(SPACE) */

enum tn_kit_place {
#define PLACE(ID, BLOCK, HEADS, WHERE) TN_KIT_PLACE_##ID,
#include "compiler/kit/words.def"
    TN_KIT_PLACE_COUNT
};
_Static_assert(TN_KIT_PLACE_COUNT < 64, "a set of places has a bit for each");
#define TN_KIT_AT(ID) (UINT64_C(1) << TN_KIT_PLACE_##ID)

extern const tn_vocabulary tn_kit_words;

#endif
