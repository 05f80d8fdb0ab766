/* Constants of sums: an exact rational with a dimension, a length to some power. Values are texts ("p/q" in nanometres
 * to that power) in the arena, so that nothing has to be freed. */
#ifndef TARTAN_COMPILER_PLAN_CHECK_AMOUNT_H
#define TARTAN_COMPILER_PLAN_CHECK_AMOUNT_H

#include "compiler/plan/check/check.h"

/* What a NUMBER expression says; value NULL where that was reported. */
tn_sum_amount tn_amount_read(tn_check *check, const tn_ast_word *word);

/* What an AREA says in square micrometres, as cells of houses are measured. false: reported. */
bool tn_amount_read_cell(tn_check *check, const tn_ast_word *word, int64_t *square_micrometres);

/* kind: TN_EXPR_PLUS, MINUS, TIMES, OVER (right is not 0), LEAST, MOST. NULL where the result has too many digits. */
const char *tn_amount_apply(tn_check *check, tn_expr_kind kind, const char *left, const char *right);

bool tn_amount_is_zero(const char *value);
const char *tn_power_name(int power, char *text, size_t size); /* "an area" */

/* Do both have one dimension? Where not, says so at the second; *power is then that of both. */
bool tn_same_power(tn_check *check, tn_sum_amount left, tn_span left_span, tn_sum_amount right, tn_span right_span,
                   const char *verb, tn_sum_amount *both);

/* The dimension and, where it has one, the constant value of arithmetic over one tray. false: reported. */
bool tn_check_figure(tn_check *check, const tn_checked_schema *schema, tn_ast_expr *figure, tn_sum_amount *amount);

#endif
