/* Checking: from syntax trees to what the emitter needs, with every name resolved. Internal to check_*.c and emit_*.c.
 *
 * Everything lives in the compilation's arena and borrows the syntax trees.
 */
#ifndef TARTAN_COMPILER_PLAN_CHECK_CHECK_H
#define TARTAN_COMPILER_PLAN_CHECK_CHECK_H

#include <gmp.h>

#include "compiler/common/compilation.h"
#include "compiler/common/import.h"
#include "compiler/common/names.h"
#include "compiler/plan/syntax/ast.h"
#include "runtime/choices/choices.h"
#include "runtime/module/module.h"
#include "runtime/module/opcodes.h"

#define TN_NONE UINT32_MAX
#define TN_NUMBER_CASES_MAX 256  /* of a number of a tray */
#define TN_EXPANSIONS_MAX 10000u /* of calls and quantifiers, over all files */

typedef struct tn_checked_value {
    const char *name, *spelling, *measure, *doc; /* as in a VALUE record; doc may be NULL */
    tn_fill_role role;
    int64_t length;
    bool has_depth;     /* of a zone's fill */
    const char *number; /* of a field whose values have an order: what it is in sums, "p/q" */
    tn_span span;
} tn_checked_value;

typedef struct tn_checked_field {
    const tn_ast_field *ast;
    const char *name, *doc;
    tn_field_kind kind;
    tn_field_role role;
    tn_checked_value *values;
    uint32_t value_count;
    bool ordered;         /* a choice whose values go from the least to the greatest */
    bool measured;        /* such a choice whose values are numbers that a measure says, and no names */
    int power;            /* theirs: of a length */
    uint32_t older_count; /* of them: values that the schema it is made from has */
    uint32_t first_bit;   /* of its values in the schema's masks */
    struct tn_checked_sum
        *said; /* of a schema of a library: what it is of a plan, a rule 1 or 0; NULL: it is not said */
} tn_checked_field;

typedef struct tn_checked_spec {
    struct tn_checked_schema *schema;
    uint64_t *mask; /* schema->words; a bit per value */
    tn_span span;
    const char *key;   /* equal for equal masks of one schema */
    uint32_t index;    /* emitted: of its record */
    uint32_t function; /* emitted: 1 + that of one such tray; 0: none yet */
    bool broken;       /* already reported */
} tn_checked_spec;

/* The trays of several specifiers that share none. */
typedef struct tn_checked_trays {
    tn_checked_spec **boxes; /* NULL: already reported */
    size_t count;
} tn_checked_trays;

/* Trays as a set; which are not in it is kept apart: a tray is neither, if to say which means dividing by 0. */
typedef struct tn_tray_set {
    tn_choice_set yes, no;
} tn_tray_set;

/* A number of a tray: its cases in order, the first that fits counts. */
typedef struct tn_checked_number {
    const tn_ast_number *ast;
    const struct tn_checked_schema *of; /* the schema that declares it */
    const char *name, *doc;
    int power;
    tn_checked_trays *cases;
    bool broken;
} tn_checked_number;

typedef struct tn_checked_schema {
    const tn_ast_schema *ast;
    const char *name, *doc;
    size_t unit;
    struct tn_checked_schema *base; /* the schema that it is made from, or NULL */
    tn_checked_field *fields;
    uint32_t field_count;
    uint32_t value_count, words; /* over all fields; 64-bit words of a mask */
    uint32_t length_field;       /* the first of kind length, or TN_NONE */
    tn_checked_spec **forbids;   /* what its `forbid`s and `only`s leave out */
    tn_span *forbid_places;      /* of the line that says so */
    uint32_t forbid_count;
    size_t forbid_room;
    tn_choice_diagram *choices; /* sets of its trays, where some were made; tn_check_program frees it */
    tn_choice_set legal;        /* once `legal_known` */
    bool legal_known;
    tn_checked_number *numbers;
    uint32_t number_count;
    int state;
    bool broken;          /* something of it was already reported */
    uint32_t index;       /* of its record */
    uint32_t field_first; /* emitted: of its first FIELD record */
} tn_checked_schema;

/* One instruction of a condition. */
typedef struct tn_condition_step {
    tn_opcode opcode;
    int64_t first, second;
    tn_span span;
} tn_condition_step;

typedef struct tn_checked_condition {
    tn_condition_step *steps; /* in postfix order, without ANSWER */
    size_t count, capacity;
    tn_span span;
    bool broken;
    uint32_t function; /* emitted: its function plus one; 0: not yet */
} tn_checked_condition;

typedef enum tn_term_kind {
    TN_TERM_SINGLES = TN_SUM_SINGLES, /* trays that the part fits, each with what its figure says (1 without one) */
    TN_TERM_STARTS = TN_SUM_STARTS,   /* places where the part starts */
    TN_TERM_MATCHES = TN_SUM_MATCHES, /* 1 where the plan as a whole is matched */
    TN_TERM_PRESENT = TN_SUM_PRESENT, /* 1 if a tray of the stretch meets `any`, here a specifier */
    TN_TERM_EXTREME,                  /* max(X of a), min(X of a) */
    TN_TERM_GAP,                      /* max(gap from a to b), min(gap from a to b) */
    TN_TERM_CELLS,                    /* what is added up over a house: the part asks for it */
    TN_TERM_AREAS,
    TN_TERM_ROOMS,
    TN_TERM_COST,
    TN_TERM_WALK,
    TN_TERM_EXITS,
} tn_term_kind;

typedef struct tn_checked_term {
    tn_term_kind kind;
    tn_ast_region region;
    const char *factor; /* "p/q", in nanometres */
    /* What is counted or added up: one of these, or none for costs. Of an extreme or a gap `part` is the whole of it.
     */
    tn_ast_expr *part;
    struct tn_checked_rule *rule; /* the part is this rule's name */
    tn_checked_spec *any;         /* every tray: `trays`, and `sum` without `of` */
    tn_span span;                 /* of that, where it is written first */
    tn_ast_expr *figure;
} tn_checked_term;

/* What `max(X of a)` can be: the numbers X that a tray can have, in the order in which they are reached: ascending for
 * the greatest, descending for the least. */
typedef struct tn_checked_extreme {
    const char **values; /* as the constants of sums are */
    size_t count;
    uint32_t *reached; /* emitted: plus one: the function of "some tray that is a has this number or a better one" */
} tn_checked_extreme;

typedef struct tn_checked_sum {
    struct tn_checked_schema *schema;
    tn_checked_term *terms;
    size_t count;
    const char *constant;
    int power;
    bool any;                           /* 0: of any dimension */
    bool whole;                         /* has `matches` */
    bool partial;                       /* has extremes or gaps: some stretches have no value */
    struct tn_checked_sum *over;        /* what it is divided by, or NULL */
    bool houses;                        /* has terms about houses */
    bool walks;                         /* has walks among them: some houses have no value */
    const struct tn_checked_form *form; /* theirs */
    tn_span span;
    uint32_t index; /* emitted: of its SUM record */
} tn_checked_sum;

/* A param, beyond its being a `let`. */
typedef struct tn_checked_param {
    bool seen, good;        /* good: what it may be is known */
    tn_sum_amount kind;     /* of numbers: their dimension */
    const char *low, *high; /* its range, or NULL */
    tn_span range;
} tn_checked_param;

typedef struct tn_checked_rule {
    tn_ast_rule *ast;
    const char *name;
    size_t unit;
    tn_checked_schema *schema; /* NULL: already reported */
    tn_ast_expr *meaning;      /* the body, through names: not a TN_EXPR_NAME; NULL where names go round */
    uint32_t min_trays;        /* what its body fits takes at least so many */
    struct tn_checked_rule **uses;
    tn_ast_expr **use_places;
    size_t use_count, use_capacity;
    int state; /* of ordering */
    size_t next_use;
    uint32_t number, lowest,
        finished; /* of ordering: when it was met, the first that it leads back to, when it was done */
    struct tn_checked_rule *circle; /* the first in order of the circle of rules that it is in; NULL: none */
    size_t circle_size;             /* of that one: how many these are */
    bool ends;                      /* in a circle: some row of trays is one */
    bool is_measure;
    const struct tn_checked_rule *outer; /* while it is being written out: the call that it stands in */
    tn_ast_expr *written;                /* the body before anything was written out */
    bool is_template;                    /* has parameters: only calls of it mean something */
    bool is_let;
    bool settable;              /* what it means depends on a param */
    tn_checked_param *param;    /* of a `let` whose value may be given; else NULL */
    bool used, seen;            /* by a library or measure, also by way of others; seen: what it names is marked too */
    bool generates;             /* a `generate` names it, also by way of others */
    bool hidden;                /* made of a call, or of a rule of an older schema: the file does not name it */
    bool listed;                /* of a hidden measure: it has a record all the same */
    bool about_plan;            /* has a comparison that speaks of the whole plan, */
    bool looked;                /* which is being looked for in it */
    bool failed;                /* of a template: a call of it was wrong inside; of a `let`: it uses itself */
    const tn_ast_expr *call;    /* what a hidden rule was made for first, or NULL */
    struct tn_checked_rule *of; /* the template, or rule of an older schema, that a hidden rule was made of */
    tn_checked_sum *sum;        /* of a measure; NULL: already reported */
    struct tn_checked_form *form; /* whose houses it is about; NULL: it is about plans */
    uint32_t serial;              /* among all that is checked as rules are */
    uint32_t index, whole, holds; /* emitted: of its record and functions */
} tn_checked_rule;

typedef struct tn_checked_clause {
    const tn_ast_clause *ast;
    tn_clause_kind kind;
    const char *name, *doc;
    size_t unit;                           /* the file that it is in */
    const struct tn_checked_schema *older; /* the schema that it was written for */
    tn_ast_expr *written;                  /* before anything was written out */
    tn_ast_expr *expr;
    tn_checked_rule *rule;                /* the clause is this rule's */
    tn_checked_condition *condition;      /* total */
    tn_checked_spec *any;                 /* total */
    uint32_t field;                       /* total */
    struct tn_checked_library *above;     /* whose plans lie above those of this library: of a projection; else NULL, */
    const struct tn_checked_schema *onto; /* and the same in the fields of this schema */
    tn_span span;
    bool settable;     /* what is written in it depends on a param */
    uint32_t function; /* emitted: plus one; 0: not yet */
} tn_checked_clause;

/* What plans of a library should match, and how much that counts. */
typedef struct tn_checked_preference {
    const tn_ast_clause *ast;
    const char *name;                      /* its own, a rule's, or "prefer@12" */
    const char *doc;                       /* or NULL */
    const char *worth;                     /* "p/q" */
    size_t unit;                           /* the file that it is in */
    const struct tn_checked_schema *older; /* the schema that it was written for */
    tn_ast_expr *written;                  /* before anything was written out */
    tn_ast_expr *expr;
    tn_span span;
} tn_checked_preference;

/* Each single tray that the sum counts, of one term, makes a plan so many times as likely. */
typedef struct tn_checked_weight {
    const tn_ast_clause *ast;
    const char *name;                      /* a rule's, or "weight@12" */
    const char *factor;                    /* "p/q" */
    size_t unit;                           /* the file that it is in */
    const struct tn_checked_schema *older; /* the schema that it was written for */
    tn_ast_expr *written;                  /* the quantity, before anything was written out */
    tn_checked_sum *sum;
    tn_span span;
} tn_checked_weight;

typedef struct tn_checked_library {
    const tn_ast_library *ast;
    const char *name;
    size_t unit;
    tn_checked_schema *schema; /* NULL: already reported */
    struct tn_checked_library *from;
    struct tn_checked_library *plans; /* of a library of houses: whose plans they stand on */
    struct tn_checked_form *form;     /* of a library of houses; NULL: of plans */
    tn_checked_clause **clauses;
    size_t clause_count, clause_capacity;
    tn_names clause_names; /* name -> tn_checked_clause */
    tn_checked_weight **weights;
    size_t weight_count, weight_capacity;
    tn_names weight_names;
    tn_checked_preference **preferences;
    size_t preference_count, preference_capacity;
    tn_names preference_names;
    tn_checked_sum *preferred;  /* what they add up to, a term for each; NULL: there are none */
    const tn_ast_clause *trays; /* its own, or taken over */
    uint32_t trays_min, trays_max;
    tn_ast_list allow;
    int state;
    bool broken;      /* what it is made from is not known */
    unsigned heights; /* how many libraries lie above it, each projected onto the schema of the next */
    uint32_t index;
} tn_checked_library;

/* What a rule's or library's name means: exactly one of the two. */
typedef struct tn_checked_name {
    tn_checked_rule *rule;
    tn_checked_library *library;
    tn_span span;
    size_t unit;
} tn_checked_name;

typedef struct tn_checked {
    tn_checked_schema **schemas;
    size_t schema_count;
    bool uncounted;          /* the trays of some schema of a library are not known, and there need be no error */
    tn_checked_rule **rules; /* in file order, imported files first */
    tn_checked_rule **order; /* callees first */
    size_t records, measure_records; /* of rules and measures so far */
    size_t rule_count, rule_capacity, ordered, settled;
    tn_checked_library **libraries;
    size_t library_count;
    struct tn_checked_form **forms;
    size_t form_count;
    tn_program *program;
    tn_checked_library *asked;               /* the library that the command line is about; NULL: not clear */
    const tn_checked_schema *pattern_schema; /* of the next, and of a plan in brackets */
    tn_ast_expr **pattern;                   /* an open plan's trays: each a rule expression, a gap NULL */
    size_t pattern_count;
    const uint8_t *asked_plan; /* a plan that was written in brackets: tn_program.plan */
    size_t asked_length;
} tn_checked;

/* Expressions that the command line gives: parsed. */
typedef struct tn_asked_for {
    const char *library; /* or NULL */
    tn_ast_expr **wheres;
    size_t where_count;
    tn_ast_list settings;          /* tn_ast_setting: the values of params */
    const char *schema;            /* of the next two */
    const tn_ast_list *pattern;    /* an open plan, or NULL */
    const tn_ast_literal *literal; /* a plan in brackets, or NULL */
} tn_asked_for;

typedef struct tn_check {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    const tn_imports *imports;
    const tn_asked_for *asked;
    tn_checked *result;
    tn_names schemas;                    /* name -> tn_checked_schema */
    tn_names names;                      /* name -> tn_checked_name */
    tn_names specs;                      /* key -> tn_checked_spec */
    tn_names conditions;                 /* key -> tn_checked_condition */
    bool incomplete;                     /* names may be missing because of errors already reported */
    bool skipped;                        /* clauses may be missing because of errors already reported */
    bool *no_schema_said, *several_said; /* per unit */
    bool too_many_said;
    tn_names calls;  /* key -> tn_checked_rule made of a call */
    size_t expanded; /* calls and values of quantifiers written out so far */
    bool has_lets;
    bool extends;                /* some schema is made from another */
    bool quiet;                  /* what is being checked was checked before for an older schema: no warnings */
    tn_checked_rule **templates; /* rules with parameters */
    size_t template_count;
    const tn_checked_rule *open; /* the call that is being written out, or NULL */
    bool in_schema;              /* schemas are being checked: they know no params */
    bool met_param;              /* what has been written out so far depends on a param */
    bool out_of_memory;          /* elsewhere than in the arena */

    /* of the rule or library being checked */
    size_t unit;
    tn_checked_schema *schema;
    tn_checked_rule *rule;        /* NULL in a library */
    bool settable;                /* what is checked depends on a param: what is always so may be otherwise */
    struct tn_checked_form *form; /* of a library of houses */
    bool form_wrong;              /* it has another one than it says, which was reported */
    bool asking;                  /* what the command line asks is checked */
    tn_ast_list allow;
} tn_check;

/* Checks everything. TN_MEMORY, else TN_OK: errors are in the diagnostics. */
tn_status tn_check_program(tn_arena *arena, tn_diagnostics *diagnostics, const tn_imports *imports,
                           const tn_asked_for *asked, tn_checked *result);

/* ---- names.c */
typedef enum tn_want {
    TN_WANT_RULE,
    TN_WANT_LIBRARY,
    TN_WANT_EITHER,
    TN_WANT_MEASURE
} tn_want;                              /* RULE: or a measure */
void tn_check_collect(tn_check *check); /* makes the lists and tables of schemas, rules, libraries */
/* Is there room for one more than `count`? The first time that there is none is reported (E0831). */
bool tn_check_room(tn_check *check, size_t count, size_t limit, const char *what, tn_span span, const char *help);
tn_checked_schema *tn_check_schema_for(tn_check *check, size_t unit, const tn_ast_word *using,
                                       tn_span place);                                        /* NULL: reported */
const tn_checked_name *tn_check_name(tn_check *check, const tn_ast_word *word, tn_want want); /* NULL: reported */
const tn_checked_name *tn_check_call_name(tn_check *check,
                                          const tn_ast_expr *call); /* the rule called; NULL: reported */
bool tn_check_grow_rules(tn_check *check);                          /* room for one more */
/* Is the word that a parameter or quantifier binds none that means something already? */
bool tn_check_new_word(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word, bool bound);
void tn_check_allow(tn_check *check,
                    tn_ast_list codes);    /* resolves the words of an `allow`: value is the tn_code, 0 where wrong */
void tn_check_allowances(tn_check *check); /* collects all of them for the program */
void tn_check_settable(tn_check *check);   /* collects what depends on params for the program */
bool tn_check_wanted(const tn_check *check, tn_code warning); /* is it not allowed in what is being checked? */

/* ---- schema.c */
void tn_check_schema(tn_check *check, tn_checked_schema *schema);
/* Finds the schema that it is made from, and checks that first; reports circles. */
void tn_check_base(tn_check *check, tn_checked_schema *schema);
bool tn_schema_extends(const tn_checked_schema *schema, const tn_checked_schema *older); /* not the same one */
/* How the schema takes the words of a text written for `older` (NULL: for itself): an older word keeps its meaning. */
const tn_checked_schema *tn_schema_of_word(const tn_checked_schema *schema, const tn_checked_schema *older,
                                           const char *word);
void tn_check_older_fields(tn_check *check, tn_checked_schema *schema); /* each `... |` has older values */
void tn_check_older_measures(tn_check *check); /* measures of older schemas, for the plans of those made from them */

/* ---- rows.c: schemas of libraries */
/* The one of a library that the schema is or is made from, however far; NULL: there is none. */
const tn_checked_schema *tn_schema_of_library(const tn_checked_schema *schema);
const tn_census *tn_schema_census(const tn_checked_schema *schema); /* of that library; NULL: there is none */
/* The column of the census that a field of the schema's own has, which a measure or a rule says. */
size_t tn_said_column(const tn_checked_schema *schema, const tn_ast_field *field);
void tn_check_said_values(tn_check *check, tn_checked_schema *schema, tn_checked_field *field); /* of a measure */
/* The trays that a row of the census is about: schema->words of a mask. */
void tn_schema_row_mask(const tn_checked_schema *schema, size_t row, uint64_t *mask);
/* The trays that stand for no plan. false: reported. */
bool tn_check_rows_legal(tn_check *check, tn_checked_schema *schema, tn_checked_trays *out);
void tn_check_rows(tn_check *check); /* what schemas of libraries name, and why the plans of some are not known */

/* ---- trays.c */
void tn_check_numbers(tn_check *check, tn_checked_schema *schema); /* what they say of which trays */
void tn_check_forbids(tn_check *check, tn_checked_schema *schema);
void tn_check_covered(tn_check *check, tn_checked_schema *schema); /* do they say something of all legal trays? */
/* The tray, a value of each field, as a person writes it: "3m stair". */
void tn_say_tray(const tn_checked_schema *schema, const uint8_t *values, char *text, size_t size);

/* ---- tray_sets.c: sets of trays */
tn_choice_diagram *tn_schema_choices(tn_check *check, tn_checked_schema *schema); /* NULL: out of memory */
/* What a specifier lets in, also by comparing sums. older: as tn_check_spec. false: reported. */
bool tn_check_tray_set(tn_check *check, tn_checked_schema *schema, const tn_checked_schema *older,
                       const tn_ast_expr *tray, tn_tray_set *set);
/* What is said of single trays by `tray(...)`, `any`, and, or, not, implies. false: reported. */
bool tn_check_limit_set(tn_check *check, tn_checked_schema *schema, const tn_checked_schema *older,
                        const tn_ast_expr *expr, tn_tray_set *set);
tn_choice_set tn_legal_set(tn_check *check, tn_checked_schema *schema); /* TN_CHOICE_LOST: not known */
/* The set as specifiers, so many at most. false: reported, at the span. */
bool tn_check_boxes(tn_check *check, tn_checked_schema *schema, tn_choice_set set, size_t most, tn_span span,
                    tn_checked_trays *trays);
/* Is a legal tray neither in the set nor not? Then that is reported. */
bool tn_check_undivided(tn_check *check, tn_checked_schema *schema, tn_tray_set set, tn_span span);
/* Of a rule: takes the items that compare sums out of the specifier, and sets its spec and tests. false: it has none.
 */
bool tn_check_sums_of_tray(tn_check *check, tn_ast_expr *tray);

/* ---- tray_sums.c: items of specifiers that compare sums */
/* Does the item compare sums? rule: in a rule, where a number of a tray that is compared with a constant is none. */
bool tn_is_sum_item(const tn_checked_schema *schema, const tn_ast_item *item, bool rule);
/* The trays that meet it. false: reported. */
bool tn_check_sum_item(tn_check *check, tn_checked_schema *schema, const tn_ast_item *item, tn_tray_set *set);
/* Arithmetic over one tray, in nanometres to its power. cases: which case of each number counts; NULL: the first that
 * the tray meets. */
typedef enum tn_figure_value { TN_FIGURE_NONE, TN_FIGURE_OVER_ZERO, TN_FIGURE_SAYS } tn_figure_value;
tn_figure_value tn_figure_compute(const tn_checked_schema *schema, const tn_ast_expr *figure, const size_t *cases,
                                  const uint8_t *values, mpq_t out);
/* Notes the fields that it depends on. */
void tn_figure_fields(const tn_checked_schema *schema, const tn_ast_expr *figure, const size_t *cases, bool *depends);
/* Has the tray, a value of each field, what the specifier allows? */
bool tn_check_meets(const tn_checked_schema *schema, const tn_checked_spec *spec, const uint8_t *values);
/* Looks for a legal tray that meets both, a value of each field; false: none was found soon. */
bool tn_check_both(tn_check *check, const tn_checked_spec *a, const tn_checked_spec *b, uint8_t *values);
/* The same of one that meets `a` (NULL: any) and not `b`. */
bool tn_check_one_alone(tn_check *check, const tn_checked_spec *a, const tn_checked_spec *b, uint8_t *values);

/* ---- spec.c */
/* Trays with the value: shared with other specifiers that are alike, or one of its own. */
tn_checked_spec *tn_check_value_spec(tn_check *check, tn_checked_schema *schema, uint32_t field, uint32_t value,
                                     tn_span span);
tn_checked_spec *tn_value_spec(tn_arena *arena, tn_checked_schema *schema, uint32_t field, uint32_t value,
                               tn_span span);

/* ---- values.c: fields and values by name, and in words */
uint32_t tn_field_find(const tn_checked_schema *schema, const char *name);
/* The schema's `number` of that name; NULL: it has none. */
tn_checked_number *tn_schema_number(const tn_checked_schema *schema, const char *name);
bool tn_field_has(const tn_checked_field *field, const char *name); /* a choice's value or a zone's fill of that name */
/* The one field that has the value; TN_NONE where none or several have: then reported, unless the schema is broken. */
uint32_t tn_value_field(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word);
bool tn_schema_says(const tn_checked_schema *schema, const char *word); /* is it a field or a value? */
/* Is the unknown word so like one of the schema's that an error about it says which is meant? */
bool tn_value_guessed(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word);
void tn_say_values(const tn_checked_field *field, const char *fill, char *text, size_t size); /* "4', 8' or 12'" */
void tn_say_items(const tn_checked_schema *schema, char *text, size_t size); /* "`use room`, `width >= 4'`" */
/* A value that the field does not have: E0303. */
void tn_report_value(tn_check *check, const tn_checked_schema *schema, uint32_t field, const tn_ast_word *word);
/* E0008; schema: the one whose lengths are meant, or NULL. */
/* A field whose values are plain numbers, which a measure says; NULL: there is none. */
const tn_checked_field *tn_field_of_numbers(const tn_checked_schema *schema);
void tn_report_unit(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *number);
bool tn_word_is(const tn_ast_word *word, const char *text); /* case does not count */

/* ---- spec.c */
/* older: the schema that the words are of; NULL: this one. */
tn_checked_spec *tn_check_spec(tn_check *check, tn_checked_schema *schema, const tn_checked_schema *older,
                               const tn_ast_expr *tray);
/* One alternative of an item, from `first` on, for whoever puts items together in another way: the trays that meet it.
 * `context`: the field and fill of the alternatives before it in the item (field TN_NONE: none). NULL: reported. */
typedef struct tn_item_context {
    uint32_t field;
    const char *fill;
} tn_item_context;
tn_checked_spec *tn_check_alternative(tn_check *check, tn_checked_schema *schema, const tn_ast_word *first,
                                      tn_span span, tn_item_context *context);
tn_checked_spec *tn_check_any(tn_check *check, tn_checked_schema *schema, tn_span span);
/* Trays by their mask, schema->words of it: copied. */
tn_checked_spec *tn_box_spec(tn_check *check, tn_checked_schema *schema, const uint64_t *mask, tn_span span);

/* ---- condition.c */
#define TN_AREAS (TN_NONE - 1) /* instead of a field: areas are added, in halves of a square micrometre */
/* `field`: whose lengths are added, or TN_NONE for a count. */
tn_checked_condition *tn_check_condition(tn_check *check, const tn_ast_cond *cond, uint32_t field);
/* That of `quantity` or `occurrences`, whose parts are checked. */
tn_checked_condition *tn_check_count(tn_check *check, const tn_ast_expr *quantity);
/* The condition of a `total`. */
tn_checked_condition *tn_check_total(tn_check *check, const tn_ast_clause *clause, uint32_t field);
bool tn_check_range(tn_check *check, const tn_ast_range *range, bool lengths); /* false: reported */

/* ---- rule.c */
/* Is the word after the field of a sum or total `depth`, and the field a zone? NULL is good. */
bool tn_check_detail(tn_check *check, const tn_checked_field *field, const tn_ast_word *detail);
void tn_check_expr(tn_check *check, tn_ast_expr *expr);       /* names, specifiers, conditions, what may stand where */
void tn_check_expr_known(tn_check *check, tn_ast_expr *expr); /* the same where a name in its place is resolved */
uint32_t tn_check_field_named(tn_check *check, const tn_ast_word *name); /* TN_NONE: reported */
void tn_check_expr_name(tn_check *check, tn_ast_expr *expr);             /* finds what a name means, once */
void tn_check_meaning(tn_check *check, tn_ast_expr *expr); /* what needs the rules that it names to be in order */
uint32_t tn_min_trays(const tn_ast_expr *expr);            /* a lower bound of what it fits */

/* ---- near.c */
void tn_check_near(tn_check *check, tn_ast_expr *near); /* its parts; the distance becomes a rule of the gap */
/* The rule of gaps that compare so with a number: of trays, or added up by a field. At most TN_GAP_MAX. */
#define TN_GAP_MAX INT64_C(1000000000000000)
tn_ast_expr *tn_check_gap_rule(tn_check *check, tn_span span, const tn_ast_word *by, tn_operator op, int64_t number);

/* ---- extreme.c: the greatest and the least number of a tray, the longest and the shortest gap */
void tn_check_extreme(tn_check *check, tn_ast_expr *expr);
/* What it can be, once all that it names is checked; NULL: reported. */
tn_checked_extreme *tn_extreme_values(tn_check *check, tn_ast_expr *extreme);
/* Writes a comparison of a gap with a number as a relation that says the same. left: gap * factor + constant. */
void tn_check_gap_compared(tn_check *check, tn_ast_expr *expr, const tn_checked_term *gap, const char *constant);

/* ---- sum.c */
bool tn_is_arithmetic(tn_expr_kind kind);     /* `+`, `-`, `*`, `/` of numbers */
bool tn_compares_numbers(tn_expr_kind kind);  /* a comparison, a range, a remainder: its parts are numbers */
bool tn_is_constant(const tn_ast_expr *expr); /* is it made of constants alone? */
bool tn_is_sum(const tn_ast_expr *expr);      /* is it a number, not a rule? Names are to be resolved */
void tn_check_sum_expr(tn_check *check, tn_ast_expr *expr);
tn_checked_sum *tn_check_sum(tn_check *check, tn_ast_expr *expr); /* NULL: reported */
void tn_check_remainder(tn_check *check, tn_ast_expr *expr);      /* likewise */
void tn_check_comparison(tn_check *check, tn_ast_expr *expr);     /* makes its sums; what it names is checked */
void tn_check_plan_measure(tn_check *check, tn_checked_rule *measure);

/* Sums while they are worked out: a constant and terms. */
typedef struct tn_sum_parts {
    tn_checked_term *terms;
    size_t count;
    tn_sum_amount constant;
    const struct tn_sum_parts *over; /* what the rest is divided by, or NULL */
} tn_sum_parts;

/* false: reported, of what was checked before. */
bool tn_sum_eval(tn_check *check, tn_ast_expr *expr, tn_sum_parts *out);

/* kind: TN_EXPR_TIMES or OVER, a constant. false: a number has too many digits. */
bool tn_sum_scale(tn_check *check, tn_sum_parts *s, tn_expr_kind kind, tn_sum_amount by);

/* kind: TN_EXPR_PLUS or MINUS. expr: has both sides as its parts, for what is said. false: reported. */
bool tn_sum_add_up(tn_check *check, const tn_ast_expr *expr, tn_expr_kind kind, const char *verb, const tn_sum_parts *a,
                   const tn_sum_parts *b, tn_sum_parts *out);

/* As the emitter takes it; NULL: out of memory. */
tn_checked_sum *tn_sum_finish(tn_check *check, const tn_sum_parts *s, tn_span span);

bool tn_sum_has_extremes(const tn_sum_parts *s);
void tn_report_quotient(tn_check *check, tn_span span); /* E0429: it does not stand alone */

/* ---- comparison.c */
tn_ast_expr *tn_expr_copy(tn_check *check, const tn_ast_expr *expr); /* the node alone, in no list; NULL: no memory */
void tn_check_sum_condition(tn_check *check, tn_ast_expr *sum);      /* makes comparisons of a sum's condition */
void tn_check_tests_of_numbers(tn_check *check, tn_ast_expr *tray);  /* takes the items about numbers out: `tests` */

/* ---- rule.c: what stands only in some places */
void tn_check_around(tn_check *check, const tn_ast_expr *expr); /* does `where` say what lies before and behind? */
/* Comparisons with `matches` stand only where the plan as a whole is meant. Is one in it? */
bool tn_check_whole(tn_check *check, const tn_ast_expr *expr);

/* ---- expand.c: calls, values of `let`, quantifiers */
void tn_expand(tn_check *check, tn_ast_expr **expr);
/* What a clause of a library for the schema `older` means for the schema at hand. */
tn_ast_expr *tn_expand_older(tn_check *check, const tn_ast_expr *written, size_t unit, const tn_checked_schema *older);
/* The measure for the schema at hand; NULL: reported. */
tn_checked_rule *tn_expand_older_measure(tn_check *check, tn_checked_rule *measure);
tn_ast_expr *tn_let_value(tn_check *check, tn_checked_rule *let);       /* NULL: reported */
#define TN_PARAMETERS_MAX 16                                            /* of a rule */
void tn_check_parameters(tn_check *check, const tn_checked_rule *rule); /* what each is, told by its uses */

/* ---- check.c */
/* Can a `let` stand for this: a constant, or values of a field? Reports where not. */
void tn_check_let(tn_check *check, const tn_ast_expr *value);

/* ---- param.c */
void tn_check_param(tn_check *check, tn_checked_rule *param); /* what it is, and its range; once */
void tn_check_settings(tn_check *check);                      /* those of the command line: they are given already */
void tn_check_list_params(tn_check *check);                   /* for the program */
/* Is what stands in a schema the name of a param? Then that is reported. */
bool tn_refuse_param(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word);
void tn_check_with(tn_check *check, const tn_ast_test *test); /* those of a test in check->unit */
/* ---- circle.c */
/* Puts the rules that were added since the last time behind what they name. Circles are found, and looked at. */
void tn_check_order(tn_check *check);
void tn_check_circle(tn_checked_rule *const *members); /* what is to be known of all of its rules before any of them */

/* ---- check.c */
void tn_check_settle(tn_check *check); /* checks the rules that were added since the last time */

/* ---- warnings.c */
void tn_check_warnings(tn_check *check, const tn_ast_expr *expr);
void tn_check_unused(tn_check *check);                                       /* warns about rules that nothing uses */
void tn_check_weight_warnings(tn_check *check, const tn_ast_expr *quantity); /* of what single trays are weighed */

/* ---- house.c: what is asked of houses */
/* `cell`, `room`, `section`, `touch`, `apart`: finds the form that is meant, and what they say of it. */
void tn_check_ask(tn_check *check, tn_ast_expr *expr);
bool tn_sums_areas(const tn_ast_expr *sum); /* is it `sum(area of cell(...), ...)`? */
void tn_check_areas(tn_check *check, tn_ast_expr *sum);

/* What a measure of houses adds up: the CELL or ROOM that a quantity counts, through a name; else NULL. */
tn_ast_expr *tn_counts_house(const tn_ast_expr *quantity);
bool tn_sums_cost(const tn_check *check, const tn_ast_expr *sum); /* is it `sum(cost)`? */
void tn_check_cost(tn_check *check, tn_ast_expr *sum);
bool tn_means_cost(const tn_check *check, const char *word); /* of houses: `cost` or the like, and there is a form */
/* Of houses: helps whoever asks how high one is, and says whether `word` did. */
bool tn_help_height(tn_check *check, tn_diagnostic *d, const char *word);
void tn_check_house_sum(tn_check *check, const tn_checked_sum *sum);    /* what else it counts is of plans */
void tn_check_compared_sum(tn_check *check, const tn_checked_sum *sum); /* the same of a comparison's */
/* A rule that is named: is it about houses of the same form as what names it? */
void tn_check_same_form(tn_check *check, const tn_ast_expr *name);
/* The form called so, where it is in scope; NULL: there is none. */
struct tn_checked_form *tn_check_form_named(const tn_check *check, size_t unit, const char *name);
/* What everything else needs to know of a rule: which form or schema it is for. */
void tn_check_find_schema(tn_check *check, tn_checked_rule *rule);
/* Numbers the rules and libraries that there are records of: those of plans, and those of houses. */
void tn_check_number_records(tn_check *check);

/* ---- library.c */
/* "require@12"; with ".2" and so on where these names have that already. */
const char *tn_clause_name(tn_check *check, const tn_names *names, const char *word, tn_span span);
void tn_check_libraries(tn_check *check);
void tn_check_asked(tn_check *check); /* adds what the command line asks to the library that it is about */

/* The expression of a clause; calls in it make rules, which are checked first. */
void tn_check_clause_expr(tn_check *check, tn_ast_clause *clause);
/* The rule whose name and text a clause has that is this expression; NULL: there is none. */
tn_checked_rule *tn_clause_rule(const tn_ast_expr *expr);

/* ---- leaning.c: preferences and weights */
void tn_check_preference(tn_check *check, tn_checked_library *library, tn_ast_clause *ast);
/* Those of a library that this one is made from. newer: by another schema. */
void tn_check_preferences_of(tn_check *check, tn_checked_library *library, const tn_checked_library *from, bool newer);
void tn_check_preferred(tn_check *check, tn_checked_library *library); /* makes the sum of all of them */
/* While the command line's expressions are checked: `preference` is what the library's preferences add up to. */
void tn_check_name_preference(tn_check *check, tn_checked_library *library);

void tn_check_weight(tn_check *check, tn_checked_library *library, tn_ast_clause *ast);
/* Those of a library that this one is made from. newer: by another schema. */
void tn_check_weights_of(tn_check *check, tn_checked_library *library, const tn_checked_library *from, bool newer);
/* A number above 0 without a unit, as "p/q"; NULL: reported, with what 0 would mean. what: "a weight". */
const char *tn_check_positive(tn_check *check, const tn_ast_word *word, const char *what, const char *none);

/* ---- form.c */
void tn_check_forms(tn_check *check);

/* ---- test.c */
void tn_check_tests(tn_check *check);
/* The values of a plan's trays, field by field; NULL where reported or empty. */
const uint8_t *tn_check_plan(tn_check *check, const tn_checked_schema *schema, tn_ast_list trays, size_t *length);

#endif
