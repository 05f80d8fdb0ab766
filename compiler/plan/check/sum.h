/* Sums while they are worked out: a constant and terms. Internal to sum.c and sum_compared.c. */
#ifndef TARTAN_COMPILER_PLAN_CHECK_SUM_H
#define TARTAN_COMPILER_PLAN_CHECK_SUM_H

#include "compiler/plan/check/amount.h"

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

#endif
