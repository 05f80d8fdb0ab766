/* The syntax tree of a .plan file, and its constructors, one for each action of grammar/plan.y.
 *
 * Every node starts with a tn_ast_node: its span and its neighbour in the list that it is in. Nodes live in the parse's
 * arena. A constructor returns NULL where out of memory, and takes NULL for parts that could not be made:
 * tn_arena_failed tells in the end. Fields marked "checked" are filled by check_*.c.
 */
#ifndef TARTAN_COMPILER_PLAN_SYNTAX_AST_H
#define TARTAN_COMPILER_PLAN_SYNTAX_AST_H

#include "compiler/plan/syntax/parse.h"
#include "compiler/plan/syntax/program.h"

typedef struct tn_ast_node {
    struct tn_ast_node *next;
    tn_span span;
} tn_ast_node;

typedef struct tn_ast_list {
    tn_ast_node *first, *last;
    size_t count;
} tn_ast_list;

typedef enum tn_operator { TN_LESS, TN_AT_MOST, TN_EQUAL, TN_UNEQUAL, TN_AT_LEAST, TN_GREATER } tn_operator;

typedef enum tn_word_kind {
    TN_WORD_NAME,
    TN_WORD_NUMBER,
    TN_WORD_LENGTH,
    TN_WORD_STRING,
    TN_WORD_NOT,
    TN_WORD_OPERATOR,
    TN_WORD_AREA,     /* or a volume */
    TN_WORD_DECIMAL,  /* or a percentage */
    TN_WORD_RANGE,    /* in a specifier: `4'..8'` */
    TN_WORD_GROUP,    /* in a specifier: `(4' or 8')` */
    TN_WORD_ABSENT,   /* in a plan that is written as plan lines are: `-` */
    TN_WORD_OF_DEPTH, /* there, too: the `:` between a fill and its depth */
    TN_WORD_RATIO,    /* of what a room has: `1:12` */
    TN_WORD_SIGN,     /* in a specifier: of arithmetic, `+`, `-`, `*`, `/` */
} tn_word_kind;

/* A name, a number, a length, a string; in specifiers also `not`, comparison signs, those of arithmetic, ranges and
 * groups. */
typedef struct tn_ast_word {
    tn_ast_node node;
    tn_word_kind kind;
    tn_operator op;
    bool broken;                          /* already reported as wrong: say nothing more about it */
    const char *text;                     /* a name, or what a string says; otherwise as written */
    int64_t value;                        /* of a number or (nanometres) length */
    const struct tn_ast_word *low, *high; /* of a range or a ratio */
    struct tn_ast_item *group;
    const char *exact; /* of a constant that was worked out: its value, of this power of a length; NULL: as written */
    int power;
} tn_ast_word;

/* ---- conditions: the E of `quantity`, `sum` and `occurrences` */

typedef enum tn_cond_kind {
    TN_COND_COMPARE,
    TN_COND_WITHIN,
    TN_COND_REMAINDER,
    TN_COND_AND,
    TN_COND_OR,
    TN_COND_NOT
} tn_cond_kind;

typedef struct tn_ast_range {
    const tn_ast_word *low, *high; /* the same word where only one was written */
    tn_span span;
} tn_ast_range;

typedef struct tn_ast_cond {
    tn_ast_node node;
    tn_cond_kind kind;
    tn_operator op;                  /* compare, remainder */
    const tn_ast_word *left, *right; /* compare: both sides; remainder: variable and remainder; within: variable */
    const tn_ast_word *modulus;
    tn_ast_range range;
    tn_ast_list parts; /* and, or, not: tn_ast_cond */
    uint32_t depth;
} tn_ast_cond;

/* ---- tray specifiers */

typedef struct tn_ast_alternative {
    tn_ast_node node;
    tn_ast_list words;
} tn_ast_alternative;

typedef struct tn_ast_item {
    tn_ast_node node;
    tn_ast_list alternatives;
    bool made; /* with bound words or params: no value need be so */
} tn_ast_item;

/* ---- rule expressions */

typedef enum tn_expr_kind {
    TN_EXPR_TRAY,
    TN_EXPR_ANY,
    TN_EXPR_NAME,
    TN_EXPR_AND,
    TN_EXPR_OR,
    TN_EXPR_NOT,
    TN_EXPR_NEIGHBOUR,
    TN_EXPR_SYMMETRIC,
    TN_EXPR_QUANTITY,
    TN_EXPR_SUM,
    TN_EXPR_OCCURRENCES,
    TN_EXPR_MANY,
    TN_EXPR_OPTIONAL,
    TN_EXPR_DISTANCE,
    TN_EXPR_BEGINNING,
    TN_EXPR_END,
    TN_EXPR_IMPLIES,
    TN_EXPR_EVERY,      /* every(a, b) */
    TN_EXPR_NEAR,       /* a beside b, a within K of b, a at least K from every b: parts are a, b and K */
    TN_EXPR_EVERY_NEAR, /* every a beside b, ...: likewise */
    TN_EXPR_WHERE,      /* a where b */
    TN_EXPR_REPEAT,     /* repeat(a, 2..4), written out */
    TN_EXPR_MIRRORED,   /* mirrored(f, g): `names` */
    TN_EXPR_REMAINDER,  /* a sum mod a number, compared: parts are the sum, the number, the rest */
    TN_EXPR_SOME,       /* some v in FIELD (...): expanded before it is checked */
    TN_EXPR_EACH,       /* every v in FIELD (...): likewise */
    TN_EXPR_CALL,       /* of a rule with parameters: likewise */
    TN_EXPR_PLAN,       /* plan [...] */
    TN_EXPR_COMPARE,    /* of two sums */
    TN_EXPR_WITHIN,     /* a sum in a range: parts are the sum, low, high */
    TN_EXPR_TRUE,       /* what a quantifier leaves: every stretch */
    TN_EXPR_FALSE,
    TN_EXPR_CELL,    /* of a form: items as of a tray */
    TN_EXPR_SECTION, /* of a form: items of section values */
    TN_EXPR_ROOM,    /* of a form: items as of a cell, and what is about the whole room */
    TN_EXPR_TOUCH,   /* parts: two cells */
    TN_EXPR_APART,   /* parts: from, to, and perhaps by way of */
    TN_EXPR_BROKEN,  /* already reported */

    TN_EXPR_RANGE, /* 2..4, 2.. of a call: parts are the least and the most */

    /* sums: QUANTITY, OCCURRENCES and SUM without a condition are such too */
    TN_EXPR_NUMBER, /* a constant: `name` */
    TN_EXPR_TRAYS,
    TN_EXPR_MATCHES,
    TN_EXPR_VALUES,  /* values(f): `name` */
    TN_EXPR_EXTREME, /* max(X of a), min(X of a): `figure`, `extreme`; parts are a, or nothing */
    TN_EXPR_GAP,     /* max(gap from a to b by f): `extreme`; parts are a and b; `name` is f, or NULL */
    TN_EXPR_WALK,    /* walk(from, to): `extreme`, `kinds`; parts: from, to unless that is `name` (outside), by way of */
    TN_EXPR_EXITS,   /* exits(cell(...)) */
    TN_EXPR_PLUS,
    TN_EXPR_MINUS,
    TN_EXPR_TIMES,
    TN_EXPR_OVER,
    TN_EXPR_NEGATIVE,
    /* only in arithmetic over one tray */
    TN_EXPR_FIGURE, /* a field of lengths, a zone's depth, a `number`: `name`, `detail` */
    TN_EXPR_LEAST,
    TN_EXPR_MOST,
} tn_expr_kind;

/* Where a count or a sum looks, of the stretch that a `where` is about. */
typedef enum tn_ast_region { TN_AST_STRETCH, TN_AST_BEFORE, TN_AST_AFTER } tn_ast_region;

/* Which of many numbers is meant. */
typedef enum tn_ast_extreme_kind { TN_EXTREME_MOST, TN_EXTREME_LEAST } tn_ast_extreme_kind;

/* How a stretch lies to another one that shares no tray with it. */
typedef enum tn_nearness { TN_NEAR_BESIDE, TN_NEAR_WITHIN, TN_NEAR_APART } tn_nearness;

/* Constants of sums: an exact rational with a dimension (amount.h). */
typedef struct tn_sum_amount {
    const char *value; /* "p/q" in nanometres to the power; NULL: not known */
    int power;         /* of a length: 0 a plain number, 1 a length, 2 an area, 3 a volume */
    bool any;          /* a literal 0: it fits every dimension */
} tn_sum_amount;

struct tn_checked_rule;
struct tn_checked_spec;
struct tn_checked_condition;

/* Of a symmetric: which of its two ways counts; both, unless a changed tree says otherwise. */
typedef enum tn_ast_sides { TN_SIDES_BOTH, TN_SIDES_WRITTEN, TN_SIDES_MIRRORED } tn_ast_sides;

typedef struct tn_ast_expr {
    tn_ast_node node;
    tn_expr_kind kind;
    uint32_t depth;
    const tn_ast_word *name;   /* of a rule; of the field of a sum or quantifier; a constant */
    const tn_ast_word *detail; /* the word after a sum's field: `depth` */
    tn_ast_list items;         /* tray, cell, room, section: tn_ast_item; of a section each ends with a tn_ast_shape */
    tn_ast_list kinds;         /* touch, apart: tn_ast_word after `by` */
    tn_ast_list parts;         /* tn_ast_expr; distance: source, destination, separator; call: arguments */
    tn_ast_sides sides;        /* symmetric */
    bool loose;                /* tray: of an open plan: blanks alone may separate its items */
    tn_ast_list names;         /* quantifier: the words that it binds; mirrored: fields */
    tn_operator op;            /* of a comparison */
    tn_nearness near;          /* of a relation to what lies around */
    tn_ast_region region;      /* quantity, occurrences, sum */
    tn_ast_extreme_kind extreme; /* extreme, gap */
    struct tn_ast_expr *figure;  /* sum: what it adds up, where that is more than a field; extreme: its numbers */
    tn_ast_cond *condition;
    size_t unit; /* expanded: the file in whose scope its names are, plus one; 0: that of what it stands in */
    const struct tn_checked_schema *older;          /* expanded: the schema that its words are of; NULL: that in use */
    struct tn_checked_rule *rule;                   /* checked: what a name means */
    struct tn_checked_ask *ask;                     /* checked: what is asked of houses; NULL: nothing */
    struct tn_checked_spec *spec;                   /* checked: tray, any, and what a sum without a part counts */
    struct tn_checked_condition *condition_checked; /* checked */
    struct tn_checked_sum *sum;         /* checked: comparison: the left side less the right; a `within`: less low */
    struct tn_checked_sum *high;        /* checked: `within`: the sum less high */
    struct tn_checked_sum *over;        /* checked: comparison of a quotient: what it is divided by; `sum`, `high`: what
                                                 is divided less so many times that */
    struct tn_checked_extreme *numbers; /* checked: extreme */
    struct tn_checked_number *number;   /* checked: figure: a number of the tray */
    bool place;                  /* checked: figure: of a field whose values have an order: the place of the value */
    const char *constant;        /* checked: figure: of a number that is written out */
    bool figure_good;            /* checked: sum */
    int64_t modulus;             /* checked: remainder: in nanometres to the sum's power; 0: already reported */
    tn_sum_amount figure_amount; /* checked: sum: the dimension of what it adds up */
    tn_ast_list tests;           /* checked: tray: comparisons of its numbers */
    bool resolved;               /* checked: its name has been looked up */
    bool settable;        /* written out: TRUE or FALSE with this value of a param, and perhaps not with another */
    tn_ast_list idle;     /* written out: what such a value leaves out, tn_ast_expr: it is checked all the same */
    uint32_t least, most; /* repeat: how often; most 0: any number */
    bool again;           /* checked: a name of a rule in the same circle of rules */
    bool from_sum;        /* checked: a condition on a sum, written out */
    bool whole;           /* checked: speaks of the whole plan, whatever it stands in */
    uint32_t field;       /* checked: of a sum */
    uint32_t function;    /* emitted: of what a symmetric mirrors, plus one; 0: not yet */
    uint32_t part_whole, part_holds, tally; /* emitted: of a sum's part or figure, plus one; 0: not yet */
} tn_ast_expr;

/* ---- items of a file */

typedef enum tn_item_kind {
    TN_ITEM_USE,
    TN_ITEM_SCHEMA,
    TN_ITEM_RULE,
    TN_ITEM_MEASURE, /* a tn_ast_rule whose body is a sum */
    TN_ITEM_LET,     /* a tn_ast_rule whose body is a constant or a name */
    TN_ITEM_PARAM,   /* the same, whose value may be given */
    TN_ITEM_LIBRARY,
    TN_ITEM_TEST,
    TN_ITEM_FORM
} tn_item_kind;

typedef struct tn_ast_top {
    tn_ast_node node;
    tn_item_kind kind;
} tn_ast_top;

typedef struct tn_ast_use {
    tn_ast_top top;
    const tn_ast_word *path;
} tn_ast_use;

typedef struct tn_ast_value {
    tn_ast_node node;
    const tn_ast_word *word; /* NULL: `...` */
    bool has_depths;
    tn_ast_list depths; /* tn_ast_word */
    const tn_ast_word *doc, *role;
} tn_ast_value;

typedef enum tn_field_form {
    TN_FORM_VALUES,
    TN_FORM_FLAG,
    TN_FORM_ZONE,
    TN_FORM_MEASURE, /* what a measure says of a plan */
    TN_FORM_RULE     /* what a rule says */
} tn_field_form;

typedef struct tn_ast_field {
    tn_ast_node node;
    tn_field_form form;
    const tn_ast_word *name, *doc, *role;
    const tn_ast_word *said_by; /* the measure or rule; NULL: of other forms */
    tn_ast_list values;         /* tn_ast_value */
    bool ordered;               /* its values go from the least to the greatest */
    bool extends;               /* begins with `...`: the values that an older schema gives the field come first */
} tn_ast_field;

/* Which trays there are: `forbid`, those that are not so; `only`, those that are. */
typedef struct tn_ast_forbid {
    tn_ast_node node;
    tn_ast_expr *expr; /* of `tray(...)`, `any`, and, or, not, implies */
    bool only;
} tn_ast_forbid;

/* A number of a tray: the first of its cases that the tray meets says it. */
typedef struct tn_ast_number {
    tn_ast_node node;
    const tn_ast_word *name, *doc;
    tn_ast_list cases; /* tn_ast_number_case */
} tn_ast_number;

typedef struct tn_ast_number_case {
    tn_ast_node node;
    tn_ast_expr *sum;
    tn_ast_expr *tray; /* NULL: every tray */
} tn_ast_number_case;

/* A schema's body under construction. */
typedef struct tn_ast_body {
    tn_ast_list fields, forbids, numbers;
    bool broken;
} tn_ast_body;

/* What became of counting the plans of a library for a schema (compiler/plan/rows.h). */
typedef struct tn_ast_census {
    const struct tn_census *census; /* a column for each field that a measure or a rule says, in their order; or NULL */
    bool circular;                  /* the library is one of the schema's own */
    bool failed;                    /* `error` says why there is no census; else what is wrong with the other texts */
    bool brief;                     /* only little was tried */
    tn_error error;
    const tn_ast_word *place; /* of the error: the library, or what says a field */
} tn_ast_census;

typedef struct tn_ast_schema {
    tn_ast_top top;
    const tn_ast_word *name, *doc, *from;
    const tn_ast_word *of; /* the library whose plans its trays stand for, or NULL */
    tn_ast_body body;
    struct tn_ast_census *counted; /* of a library: what is known of its plans before the file is checked */
} tn_ast_schema;

typedef struct tn_ast_rule {
    tn_ast_top top;
    const tn_ast_word *name, *doc, *using;
    tn_ast_list params;         /* tn_ast_word */
    tn_ast_list allow;          /* tn_ast_word */
    tn_ast_expr *body;          /* of a param: its default */
    const tn_ast_expr *written; /* the body as it stands in the file */
    tn_ast_list words;          /* of a param of words: tn_ast_word, the default first */
    tn_ast_expr *low, *high;    /* of a param: its range, or NULL */
    tn_ast_expr *given;         /* of a param: what it has instead of its default, or NULL; */
    size_t given_unit;          /* the file whose words that is in */
} tn_ast_rule;

/* The value that a param is given: `NAME = VALUE`. */
typedef struct tn_ast_setting {
    tn_ast_node node;
    const tn_ast_word *name;
    tn_ast_expr *value;
} tn_ast_setting;

typedef enum tn_clause_form {
    TN_FORM_TRAYS,
    TN_FORM_TOTAL_RANGE,
    TN_FORM_TOTAL_COMPARE,
    TN_FORM_REQUIRE,
    TN_FORM_GENERATE,
    TN_FORM_PRUNE,
    TN_FORM_WEIGHT,
    TN_FORM_PREFER,
    TN_FORM_ALLOW
} tn_clause_form;

typedef struct tn_ast_clause {
    tn_ast_node node;
    tn_clause_form form;
    tn_ast_range range;                /* trays, total */
    tn_operator op;                    /* total */
    const tn_ast_word *word;           /* total: what it is compared with; weight, prefer: its number, or NULL */
    const tn_ast_word *field, *detail; /* total: the word after the field: `depth` */
    tn_ast_expr *expr;                 /* weight: the quantity of what single trays are */
    const tn_ast_expr *written;        /* as it stands in the file */
    const tn_ast_word *name, *doc;
    tn_ast_list allow; /* tn_ast_word */
} tn_ast_clause;

typedef struct tn_ast_library {
    tn_ast_top top;
    const tn_ast_word *name, *doc, *using, *from, *in, *onto;
    tn_span projected;   /* with `onto`: from `from` on */
    tn_ast_list clauses; /* tn_ast_clause */
} tn_ast_library;

typedef struct tn_ast_tray {
    tn_ast_node node;
    tn_ast_list words;
} tn_ast_tray;

/* What is in a case's brackets: trays, or the line of a house. */
typedef struct tn_ast_literal {
    tn_ast_list trays; /* tn_ast_tray */
    const tn_ast_word *house;
} tn_ast_literal;

typedef struct tn_ast_case {
    tn_ast_node node;
    tn_ast_list expectations; /* tn_ast_word, a value of tn_expectation each: one for each subject */
    bool todo;                /* expected to fail */
    tn_ast_literal literal;
    const tn_ast_word *doc;
    tn_ast_list by;     /* tn_ast_word */
    tn_ast_expr *value; /* of a measure: what it has to be */
} tn_ast_case;

typedef struct tn_ast_test {
    tn_ast_top top;
    tn_ast_list subjects; /* tn_ast_word */
    tn_ast_list settings; /* tn_ast_setting: the values of params for its cases */
    tn_ast_list cases;
} tn_ast_test;

typedef struct tn_ast_file {
    tn_ast_list items;       /* tn_ast_top */
    tn_ast_expr *expression; /* where one was parsed alone */
    tn_ast_list pattern;     /* where an open plan was */
    tn_ast_literal literal;  /* where a plan in brackets was */
    tn_ast_setting *setting; /* where the value of a param was */
    bool broken;             /* an item is missing: its name could not be read */
    bool skipped;            /* a clause is missing */
} tn_ast_file;

/* Does a measure or a rule of plans say the field? */
static inline bool tn_field_is_said(const tn_ast_field *field)
{
    return field->said_by != NULL;
}

/* Iterates over a list whose nodes are `TYPE`s. */
#define TN_EACH(TYPE, node, list)                                                                                      \
    TYPE *node = (TYPE *)(list).first;                                                                                 \
    node;                                                                                                              \
    node = (TYPE *)((const tn_ast_node *)node)->next

tn_ast_list tn_ast_empty(void);

/* The same with the sides changed: `a < b` is `b > a`. */
tn_operator tn_operator_turned(tn_operator op);

/* What an expression asks of a tray, a cell or a room: tn_ast_item; empty for all others. */
static inline tn_ast_list tn_ast_tray_items(const tn_ast_expr *expr)
{
    return expr->kind == TN_EXPR_SECTION ? tn_ast_empty() : expr->items;
}

tn_ast_list tn_ast_append(tn_ast_list list, void *node); /* NULL adds nothing */
tn_ast_list tn_ast_one(void *node);
tn_ast_list tn_ast_join(tn_ast_list first, tn_ast_list second);
tn_ast_list tn_ast_lost(tn_ast_list items, tn_parse *parse);      /* an item could not be read: notes it */
tn_ast_list tn_ast_skipped(tn_ast_list clauses, tn_parse *parse); /* a clause could not be read: notes it */
tn_ast_file *tn_ast_unread(tn_ast_file *file);                    /* the whole file could not be read: notes it */
void tn_ast_too_deep(tn_parse *parse, tn_span span);              /* E0830, once */

tn_ast_word *tn_ast_word_new(tn_parse *parse, tn_word_kind kind, tn_span span, const char *text, int64_t value);
tn_ast_word *tn_ast_not_word(tn_parse *parse, tn_span span);
tn_ast_word *tn_ast_operator(tn_parse *parse, tn_span span, tn_operator op);
tn_ast_word *tn_ast_sign(tn_parse *parse, tn_span span);
tn_ast_word *tn_ast_negative(tn_parse *parse, tn_span span, const tn_ast_word *number);

tn_ast_word *tn_ast_word_range(tn_parse *parse, tn_span span, const tn_ast_word *low, const tn_ast_word *high);
tn_ast_word *tn_ast_word_ratio(tn_parse *parse, tn_span span, const tn_ast_word *of, const tn_ast_word *to);
tn_ast_word *tn_ast_group(tn_parse *parse, tn_span span, tn_ast_list alternatives);

tn_ast_range tn_ast_range_new(tn_span span, const tn_ast_word *low, const tn_ast_word *high);
tn_ast_range tn_ast_range_dash(tn_parse *parse, tn_span span, const tn_ast_word *low,
                               const tn_ast_word *high); /* E0412 */

tn_ast_cond *tn_ast_compare(tn_parse *parse, tn_span span, const tn_ast_word *left, tn_operator op,
                            const tn_ast_word *right);
/* `2 <= n <= 4`: E0409, and the first comparison alone. */
tn_ast_cond *tn_ast_chained(tn_parse *parse, tn_span span, tn_ast_cond *first, tn_operator op,
                            const tn_ast_word *right);
tn_ast_cond *tn_ast_within(tn_parse *parse, tn_span span, const tn_ast_word *variable, tn_ast_range range);
tn_ast_cond *tn_ast_remainder(tn_parse *parse, tn_span span, const tn_ast_word *variable, const tn_ast_word *modulus,
                              tn_operator op, const tn_ast_word *remainder);
tn_ast_cond *tn_ast_cond_join(tn_parse *parse, tn_cond_kind kind, tn_ast_cond *first, tn_ast_cond *second);
tn_ast_cond *tn_ast_cond_add(tn_parse *parse, tn_ast_cond *joined, tn_ast_cond *part);
tn_ast_cond *tn_ast_cond_not(tn_parse *parse, tn_span span, tn_ast_cond *part);

tn_ast_alternative *tn_ast_alternative_new(tn_parse *parse, tn_span span, tn_ast_list words);
tn_ast_item *tn_ast_item_new(tn_parse *parse, tn_span span, tn_ast_list alternatives);

tn_ast_expr *tn_ast_leaf(tn_parse *parse, tn_expr_kind kind, tn_span span);
tn_ast_expr *tn_ast_tray_new(tn_parse *parse, tn_span span, tn_ast_list items);
tn_ast_expr *tn_ast_name(tn_parse *parse, const tn_ast_word *name);
tn_ast_expr *tn_ast_expr_join(tn_parse *parse, tn_expr_kind kind, tn_ast_expr *first, tn_ast_expr *second);
tn_ast_expr *tn_ast_expr_add(tn_parse *parse, tn_ast_expr *joined, tn_ast_expr *part);
tn_ast_expr *tn_ast_of(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_list parts);
/* condition: NULL for a number. */
tn_ast_expr *tn_ast_counted(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_expr *part, tn_ast_region region,
                            tn_ast_cond *condition);
/* figure: arithmetic over one tray; condition: NULL for a number. */
tn_ast_expr *tn_ast_sum(tn_parse *parse, tn_span span, tn_ast_expr *figure, tn_ast_expr *part, tn_ast_region region,
                        tn_ast_cond *condition);
/* part: NULL for every tray. */
tn_ast_expr *tn_ast_extreme(tn_parse *parse, tn_span span, tn_ast_extreme_kind extreme, tn_ast_expr *figure,
                            tn_ast_expr *part);
/* by: a field; NULL for trays. */
tn_ast_expr *tn_ast_extreme_gap(tn_parse *parse, tn_span span, tn_ast_extreme_kind extreme, tn_ast_expr *source,
                                tn_ast_expr *destination, const tn_ast_word *by);
tn_ast_expr *tn_ast_constant(tn_parse *parse, const tn_ast_word *word);
tn_ast_expr *tn_ast_figure(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *detail);
tn_ast_expr *tn_ast_arithmetic(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_expr *left, tn_ast_expr *right);
tn_ast_expr *tn_ast_sum_compared(tn_parse *parse, tn_span span, tn_ast_expr *left, tn_operator op, tn_ast_expr *right);
tn_ast_expr *tn_ast_sum_within(tn_parse *parse, tn_span span, tn_ast_expr *sum, tn_ast_expr *low, tn_ast_expr *high);
tn_ast_expr *tn_ast_sum_remainder(tn_parse *parse, tn_span span, tn_ast_expr *sum, tn_ast_expr *modulus, tn_operator op,
                                  tn_ast_expr *rest);
tn_ast_expr *tn_ast_where(tn_parse *parse, tn_span span, tn_ast_expr *what, tn_ast_expr *where);
/* `a where b implies c` and the like: E0421, and the first of them alone. */
tn_ast_expr *tn_ast_mixed(tn_parse *parse, tn_span span, tn_ast_expr *first);
/* `a < b < c`: E0409, and the first comparison alone. */
tn_ast_expr *tn_ast_compared_chained(tn_parse *parse, tn_span span, tn_ast_expr *first);
tn_ast_expr *tn_ast_implies(tn_parse *parse, tn_span span, tn_ast_expr *left, tn_ast_expr *right);
/* `a implies b implies c`: E0421, and the first two alone. */
tn_ast_expr *tn_ast_implies_chained(tn_parse *parse, tn_span span, tn_ast_expr *first);
tn_ast_expr *tn_ast_every(tn_parse *parse, tn_span span, tn_ast_expr *which, tn_ast_expr *what);
/* distance: NULL for `beside`. */
tn_ast_expr *tn_ast_near(tn_parse *parse, tn_span span, tn_nearness near, tn_ast_expr *source, tn_ast_expr *distance,
                         tn_ast_expr *destination);
/* `a beside b beside c`: E0409, and the first two alone. */
tn_ast_expr *tn_ast_near_chained(tn_parse *parse, tn_span span, tn_ast_expr *first);
tn_ast_expr *tn_ast_every_near(tn_parse *parse, tn_span span, tn_ast_expr *near);
tn_ast_expr *tn_ast_quantifier(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_list names,
                               const tn_ast_word *field, tn_ast_expr *part);
/* high: or NULL. */
tn_ast_expr *tn_ast_range_of(tn_parse *parse, tn_span span, tn_ast_expr *low, tn_ast_expr *high);

tn_ast_expr *tn_ast_call(tn_parse *parse, tn_span span, const tn_ast_word *name, tn_ast_list arguments);
tn_ast_expr *tn_ast_open_tray(tn_parse *parse, tn_span span, tn_ast_list items); /* of an open plan */
tn_ast_expr *tn_ast_gap(tn_parse *parse, tn_span span); /* `...` in a neighbour or pattern: optional(many(any)) */
tn_ast_expr *tn_ast_distance(tn_parse *parse, tn_span span, tn_ast_expr *from, tn_ast_expr *to, tn_ast_expr *by);

void *tn_ast_use_new(tn_parse *parse, tn_span span, const tn_ast_word *path);
void *tn_ast_value_new(tn_parse *parse, tn_span span, const tn_ast_word *word, const tn_ast_list *depths,
                       const tn_ast_word *doc, const tn_ast_word *role);
void *tn_ast_field_new(tn_parse *parse, tn_span span, tn_field_form form, tn_ast_field head, tn_ast_list values);
void *tn_ast_ordered_new(tn_parse *parse, tn_span span, tn_ast_field head, tn_ast_list values);
/* `a < b | c`: E0212, and all of them. */
tn_ast_list tn_ast_mixed_order(tn_parse *parse, tn_span sign, tn_ast_list values, void *value);
/* from: the older schema, or NULL. */
void *tn_ast_schema_new(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *doc,
                        const tn_ast_word *from, tn_ast_body body);
/* of: a library. */
void *tn_ast_rows_new(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *doc,
                      const tn_ast_word *of, tn_ast_body body);
/* `frontage = measure front`, `corner = rule corner-house` */
void *tn_ast_said_new(tn_parse *parse, tn_span span, tn_field_form form, tn_ast_field head, const tn_ast_word *said_by);
void *tn_ast_older_values(tn_parse *parse, tn_span span); /* `...` among the values of a field */
void *tn_ast_number_new(tn_parse *parse, tn_span span, tn_ast_field head, tn_ast_list cases);
void *tn_ast_number_case_new(tn_parse *parse, tn_span span, tn_ast_expr *sum, tn_ast_expr *tray);
tn_ast_body tn_ast_body_number(tn_ast_body body, void *number);
void *tn_ast_measure_new(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *doc,
                         const tn_ast_word *using, tn_ast_expr *body);
void *tn_ast_let_new(tn_parse *parse, tn_span span, const tn_ast_word *name, tn_ast_expr *body);
/* Of the head: name and doc, and a range or words. value: NULL for words. */
void *tn_ast_param_new(tn_parse *parse, tn_span span, tn_ast_rule head, tn_ast_expr *value);
void *tn_ast_setting_new(tn_parse *parse, tn_span span, const tn_ast_word *name, tn_ast_expr *value);
tn_ast_body tn_ast_body_field(tn_ast_body body, void *field);
void *tn_ast_forbid_new(tn_parse *parse, tn_span span, tn_ast_expr *expr, bool only);
tn_ast_body tn_ast_body_forbid(tn_ast_body body, void *forbid);
tn_ast_body tn_ast_body_broken(tn_ast_body body);
void *tn_ast_rule_new(tn_parse *parse, tn_span span, tn_ast_rule head, tn_ast_expr *body);
void *tn_ast_library_new(tn_parse *parse, tn_span span, tn_ast_library head, tn_ast_list clauses);
tn_ast_clause *tn_ast_trays(tn_parse *parse, tn_span span, tn_ast_range range);
tn_ast_clause *tn_ast_total_range(tn_parse *parse, tn_span span, tn_ast_list field, tn_ast_range range,
                                  const tn_ast_word *doc);
tn_ast_clause *tn_ast_total_compare(tn_parse *parse, tn_span span, tn_ast_list field, tn_operator op,
                                    const tn_ast_word *word, const tn_ast_word *doc);
tn_ast_clause *tn_ast_require(tn_parse *parse, tn_span span, tn_ast_expr *expr, const tn_ast_word *doc);
tn_ast_clause *tn_ast_generate(tn_ast_clause *require); /* of what stands there as in a `require` */
tn_ast_clause *tn_ast_prune(tn_parse *parse, tn_span span, tn_ast_expr *expr, const tn_ast_word *name,
                            const tn_ast_word *doc);
/* worth, name: NULL where they are not written. */
tn_ast_clause *tn_ast_preference(tn_parse *parse, tn_span span, tn_ast_expr *expr, const tn_ast_word *worth,
                                 const tn_ast_word *name, const tn_ast_word *doc);
/* number: NULL where it is not written. */
tn_ast_clause *tn_ast_weight(tn_parse *parse, tn_span span, tn_ast_expr *expr, const tn_ast_word *number);
tn_ast_clause *tn_ast_allow(tn_parse *parse, tn_span span, tn_ast_list codes);
void *tn_ast_test_new(tn_parse *parse, tn_span span, tn_ast_list subjects, tn_ast_list settings, tn_ast_list cases);
tn_ast_word *tn_ast_expect(tn_parse *parse, tn_span span, const char *text, tn_expectation expectation);
void *tn_ast_case_todo(void *test_case);
void *tn_ast_case_new(tn_parse *parse, tn_span span, tn_ast_list expectations, tn_ast_literal literal,
                      const tn_ast_word *doc, tn_ast_list by);
void *tn_ast_value_case(tn_parse *parse, tn_span span, tn_ast_literal literal, tn_ast_expr *value,
                        const tn_ast_word *doc);
void *tn_ast_literal_tray(tn_parse *parse, tn_span span, tn_ast_list words);

#endif
