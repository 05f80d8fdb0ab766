/* Checking: from syntax trees to what the emitter needs, with every name resolved. Internal to check_*.c and emit_*.c.
 *
 * Everything lives in the compilation's arena and borrows the syntax trees.
 */
#ifndef TARTAN_COMPILER_PLAN_CHECK_H
#define TARTAN_COMPILER_PLAN_CHECK_H

#include "compiler/common/import.h"
#include "compiler/common/names.h"
#include "compiler/plan/ast.h"
#include "runtime/module/module.h"
#include "runtime/module/opcodes.h"

#define TN_NONE UINT32_MAX

typedef struct tn_checked_value {
    const char *name, *spelling, *measure, *doc; /* as in a VALUE record; doc may be NULL */
    tn_fill_role role;
    int64_t length;
    bool has_depth; /* of a zone's fill */
    tn_span span;
} tn_checked_value;

typedef struct tn_checked_field {
    const tn_ast_field *ast;
    const char *name, *doc;
    tn_field_kind kind;
    tn_field_role role;
    tn_checked_value *values;
    uint32_t value_count;
    uint32_t first_bit; /* of its values in the schema's masks */
} tn_checked_field;

typedef struct tn_checked_spec {
    struct tn_checked_schema *schema;
    uint64_t *mask; /* schema->words; a bit per value */
    tn_span span;
    const char *key; /* equal for equal masks of one schema */
    uint32_t index;  /* emitted: of its record */
    bool broken;     /* already reported */
} tn_checked_spec;

typedef struct tn_checked_schema {
    const tn_ast_schema *ast;
    const char *name, *doc;
    size_t unit;
    tn_checked_field *fields;
    uint32_t field_count;
    uint32_t value_count, words; /* over all fields; 64-bit words of a mask */
    uint32_t length_field;       /* the first of kind length, or TN_NONE */
    tn_checked_spec **forbids;
    uint32_t forbid_count;
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

typedef struct tn_checked_rule {
    const tn_ast_rule *ast;
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
    uint32_t index, whole, holds; /* emitted: of its record and functions */
} tn_checked_rule;

typedef struct tn_checked_clause {
    const tn_ast_clause *ast;
    tn_clause_kind kind;
    const char *name, *doc;
    tn_ast_expr *expr;
    tn_checked_rule *rule;           /* the clause is this rule's */
    tn_checked_condition *condition; /* total */
    tn_checked_spec *any;            /* total */
    uint32_t field;                  /* total */
    tn_span span;
    uint32_t function; /* emitted: plus one; 0: not yet */
} tn_checked_clause;

typedef struct tn_checked_library {
    const tn_ast_library *ast;
    const char *name;
    size_t unit;
    tn_checked_schema *schema; /* NULL: already reported */
    struct tn_checked_library *from;
    tn_checked_clause **clauses;
    size_t clause_count, clause_capacity;
    tn_names clause_names;      /* name -> tn_checked_clause */
    const tn_ast_clause *trays; /* its own, or taken over */
    uint32_t trays_min, trays_max;
    tn_ast_list allow;
    int state;
    bool broken; /* what it is made from is not known */
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
    tn_checked_rule **rules; /* in file order, imported files first */
    tn_checked_rule **order; /* callees first */
    size_t rule_count;
    tn_checked_library **libraries;
    size_t library_count;
    struct tn_checked_form **forms;
    size_t form_count;
    tn_program *program;
} tn_checked;

typedef struct tn_check {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    const tn_imports *imports;
    tn_checked *result;
    tn_names schemas;     /* name -> tn_checked_schema */
    tn_names names;       /* name -> tn_checked_name */
    tn_names specs;       /* key -> tn_checked_spec */
    tn_names conditions;  /* key -> tn_checked_condition */
    bool incomplete;      /* names may be missing because of errors already reported */
    bool skipped;         /* clauses may be missing because of errors already reported */
    bool *no_schema_said; /* per unit */
    bool too_many_said;

    /* of the rule or library being checked */
    size_t unit;
    tn_checked_schema *schema;
    tn_checked_rule *rule; /* NULL in a library */
    tn_ast_list allow;
} tn_check;

/* Checks everything. TN_MEMORY, else TN_OK: errors are in the diagnostics. */
tn_status tn_check_program(tn_arena *arena, tn_diagnostics *diagnostics, const tn_imports *imports, tn_checked *result);

/* ---- check_names.c */
typedef enum tn_want { TN_WANT_RULE, TN_WANT_LIBRARY, TN_WANT_EITHER } tn_want;
void tn_check_collect(tn_check *check); /* makes the lists and tables of schemas, rules, libraries */
/* Is there room for one more than `count`? The first time that there is none is reported (E0831). */
bool tn_check_room(tn_check *check, size_t count, size_t limit, const char *what, tn_span span, const char *help);
tn_checked_schema *tn_check_schema_for(tn_check *check, size_t unit, const tn_ast_word *using,
                                       tn_span place);                                        /* NULL: reported */
const tn_checked_name *tn_check_name(tn_check *check, const tn_ast_word *word, tn_want want); /* NULL: reported */
void tn_check_allow(tn_check *check,
                    tn_ast_list codes);    /* resolves the words of an `allow`: value is the tn_code, 0 where wrong */
void tn_check_allowances(tn_check *check); /* collects all of them for the program */
bool tn_check_wanted(const tn_check *check, tn_code warning); /* is it not allowed in what is being checked? */

/* ---- check_schema.c */
void tn_check_schema(tn_check *check, tn_checked_schema *schema);
void tn_check_forbids(tn_check *check, tn_checked_schema *schema);

/* ---- check_values.c: fields and values by name, and in words */
uint32_t tn_field_find(const tn_checked_schema *schema, const char *name);
bool tn_field_has(const tn_checked_field *field, const char *name); /* a choice's value or a zone's fill of that name */
/* The one field that has the value; TN_NONE where none or several have: then reported, unless the schema is broken. */
uint32_t tn_value_field(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word);
void tn_say_values(const tn_checked_field *field, const char *fill, char *text, size_t size); /* "4', 8' or 12'" */
/* A value that the field does not have: E0303. */
void tn_report_value(tn_check *check, const tn_checked_schema *schema, uint32_t field, const tn_ast_word *word);
void tn_report_unit(tn_check *check, const tn_ast_word *number); /* E0008 */
bool tn_word_is(const tn_ast_word *word, const char *text);      /* case does not count */

/* ---- check_spec.c */
tn_checked_spec *tn_check_spec(tn_check *check, tn_checked_schema *schema, const tn_ast_expr *tray);
/* One alternative of an item, from `first` on, for whoever puts items together in another way: the trays that meet it. `context`:
 * the field and fill of the alternatives before it in the item (field TN_NONE: none). NULL: reported. */
typedef struct tn_item_context {
    uint32_t field;
    const char *fill;
} tn_item_context;
tn_checked_spec *tn_check_alternative(tn_check *check, tn_checked_schema *schema, const tn_ast_word *first, tn_span span,
                                      tn_item_context *context);
tn_checked_spec *tn_check_any(tn_check *check, tn_checked_schema *schema, tn_span span);

/* ---- check_condition.c */
/* `field`: whose lengths are added, or TN_NONE for a count. */
tn_checked_condition *tn_check_condition(tn_check *check, const tn_ast_cond *cond, uint32_t field);
/* The condition of a `total`. */
tn_checked_condition *tn_check_total(tn_check *check, const tn_ast_clause *clause, uint32_t field);
bool tn_check_range(tn_check *check, const tn_ast_range *range, bool lengths); /* false: reported */

/* ---- check_analysis.c: always, never, remainders that cannot be */
void tn_check_truth(tn_check *check, const tn_checked_condition *condition, const char *variable, uint32_t field);

/* ---- check_rule.c */
/* Is the word after the field of a sum or total `depth`, and the field a zone? NULL is good. */
bool tn_check_detail(tn_check *check, const tn_checked_field *field, const tn_ast_word *detail);
void tn_check_expr(tn_check *check, tn_ast_expr *expr);    /* names, specifiers, conditions, what may stand where */
void tn_check_meaning(tn_check *check, tn_ast_expr *expr); /* what needs the rules that it names to be in order */
uint32_t tn_min_trays(const tn_ast_expr *expr);            /* a lower bound of what it fits */

/* ---- check_warnings.c */
void tn_check_warnings(tn_check *check, const tn_ast_expr *expr);

/* ---- check_order.c */
void tn_check_order(tn_check *check); /* orders the rules, callees first; reports circles */

/* ---- check_library.c */
void tn_check_libraries(tn_check *check);

/* ---- form_check.c */
void tn_check_forms(tn_check *check);

/* ---- check_test.c, check_literal.c */
void tn_check_tests(tn_check *check);
/* The values of a plan's trays, field by field; NULL where reported or empty. */
const uint8_t *tn_check_plan(tn_check *check, const tn_checked_schema *schema, tn_ast_list trays, size_t *length);

#endif
