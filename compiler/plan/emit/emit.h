/* Emitting: from the checked program to a module's bytes. Internal to emit_*.c and compile.c.
 *
 * Functions are emitted callees first. A rule has two: WHOLE (judgement M of docs/plan-language.md: the stretch taken
 * whole) and HOLDS (judgement H: somewhere in the region).
 */
#ifndef TARTAN_COMPILER_PLAN_EMIT_EMIT_H
#define TARTAN_COMPILER_PLAN_EMIT_EMIT_H

#include "compiler/plan/check/check.h"
#include "runtime/module/builder.h"

typedef struct tn_emit {
    tn_arena *arena;
    tn_builder *builder;
    const tn_checked *checked;
    const tn_imports *imports;
    uint32_t schema; /* of what is emitted: while a function's code is written, the function's */
    uint32_t around; /* the schema before that, which comes back at the function's end */
    uint32_t begin;  /* of its code */
    uint32_t depth, stack_max;
    bool in_circle;      /* the function is one of a circle of rules */
    bool derives;        /* `generate` is made of it: in how many ways it holds may be asked */
    size_t instructions; /* of the module so far */
} tn_emit;

/* The module's bytes, which the caller frees with free(). E0810 where it would be too large to load. */
tn_status tn_emit_module(tn_arena *arena, const tn_checked *checked, const tn_imports *imports,
                         tn_diagnostics *diagnostics, uint8_t **bytes, size_t *size, tn_error *error);

/* ---- emit.c */
void tn_emit_begin(tn_emit *emit, uint32_t schema); /* a function's code begins */
void tn_emit_op(tn_emit *emit, tn_span span, tn_opcode opcode, int64_t first, int64_t second);
uint32_t tn_emit_end(tn_emit *emit, const char *name, tn_function_kind kind); /* its index */

/* ---- schema.c */
void tn_emit_schemas(tn_emit *emit);
uint32_t tn_emit_spec(tn_emit *emit, tn_checked_spec *spec);

/* ---- rule.c */
void tn_emit_rules(tn_emit *emit);
uint32_t tn_emit_condition(tn_emit *emit, tn_checked_condition *condition);
/* The functions that an expression needs (conditions, what is mirrored). `name` is for people. */
void tn_emit_needs(tn_emit *emit, tn_ast_expr *expr, const char *name);
void tn_emit_holds(tn_emit *emit, const tn_ast_expr *expr);

void tn_emit_whole(tn_emit *emit, const tn_ast_expr *expr);

/* ---- extreme.c */
const char *tn_emit_added(tn_emit *emit, const char *left, const char *right); /* of constants of sums */
const char *tn_emit_times(tn_emit *emit, const char *left, const char *right);
void tn_emit_extreme_needs(tn_emit *emit, tn_ast_expr *extreme, const char *name); /* or of a gap */
/* The stretches with nothing to choose from, if that holds; else none. */
void tn_emit_extreme_none(tn_emit *emit, tn_span span, const tn_checked_extreme *numbers, bool holds);
/* The stretches on which it is one of the numbers first to last. */
void tn_emit_extreme_is(tn_emit *emit, tn_span span, const tn_checked_extreme *numbers, size_t first, size_t last);
/* Adds TERM records of a measure; the constant of its sum with what belongs to it. */
void tn_emit_needed(tn_emit *emit, uint32_t function); /* without which a measure has no value */
const char *tn_emit_extreme_terms(tn_emit *emit, const tn_checked_term *term, const char *constant);
void tn_emit_gap_term(tn_emit *emit, const tn_checked_term *term);

/* ---- sum.c */
/* The function of what a term counts, and of what a tray counts in it. `name` is for people. */
uint32_t tn_emit_part(tn_emit *emit, const tn_checked_term *term, const char *name);
uint32_t tn_emit_tally(tn_emit *emit, tn_ast_expr *figure, const char *name);
void tn_emit_sum_needs(tn_emit *emit, tn_checked_sum *sum, const char *name); /* the functions that its terms name */
/* The relation of the stretches on which the sum compares so with 0. */
void tn_emit_remainder(tn_emit *emit, const tn_ast_expr *expr); /* a comparison of one */
void tn_emit_comparison(tn_emit *emit, tn_span span, tn_checked_sum *sum, tn_operator op);
void tn_emit_quotient(tn_emit *emit, const tn_ast_expr *expr); /* a comparison of one */
void tn_emit_number(tn_emit *emit, const tn_checked_number *number, tn_span span);
void tn_emit_house_measure(tn_emit *emit, const tn_checked_rule *measure);
uint32_t tn_emit_house_sum(tn_emit *emit, const tn_checked_sum *sum, uint32_t of_plan); /* of_plan: a SUM */
/* The SUM record of a number of whole plans, with what it names; once, also where several have it. */
uint32_t tn_emit_sum(tn_emit *emit, tn_checked_sum *sum, const char *name);
void tn_emit_plan_measure(tn_emit *emit, tn_checked_rule *measure);
void tn_emit_measures(tn_emit *emit); /* their records */
void tn_emit_said(tn_emit *emit);     /* what fields of schemas of libraries are of a plan */

/* ---- library.c */
void tn_emit_libraries(tn_emit *emit);
/* The clause's function of H; once, also where several libraries have the clause. */
uint32_t tn_emit_clause(tn_emit *emit, tn_checked_clause *clause, uint32_t schema);

/* ---- form.c */
struct tn_decision;
void tn_emit_forms(tn_emit *emit); /* before what asks for their houses */
uint32_t tn_emit_decision(tn_emit *emit, const struct tn_checked_form *form, struct tn_decision *decision,
                          const char *name, tn_function_kind kind);             /* the function */
uint32_t tn_emit_items(tn_emit *emit, const uint32_t *numbers, uint32_t count); /* the first HOUSE_ITEM record */

/* ---- house.c */
void tn_emit_ask_needs(tn_emit *emit, tn_ast_expr *expr); /* the functions of what is asked of houses */
void tn_emit_ask(tn_emit *emit, const tn_ast_expr *expr); /* its relation */
/* `quantity` of cells or rooms; false: it counts trays. */
bool tn_emit_quantity(tn_emit *emit, const tn_ast_expr *quantity);
void tn_emit_house_rule(tn_emit *emit, const tn_checked_rule *rule);
void tn_emit_house_library(tn_emit *emit, const tn_checked_library *library);

#endif
