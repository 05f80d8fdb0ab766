/* Writing out what is written shorter than it means: calls of rules with parameters, words that `let` or a quantifier
 * binds. Copies of the syntax tree, with the words replaced. Internal to expand*.c. */
#ifndef TARTAN_COMPILER_PLAN_CHECK_EXPAND_H
#define TARTAN_COMPILER_PLAN_CHECK_EXPAND_H

#include "compiler/plan/check/check.h"

/* A word and what it stands for: an expression; a NUMBER for a length; a FIGURE for a value that is a name (and a
 * depth). */
typedef struct tn_bound_name {
    const struct tn_bound_name *outer;
    const tn_ast_word *word;
    tn_ast_expr *value;
    const tn_checked_field *field; /* of a quantifier: the value's, else NULL */
    struct tn_checked_rule *let;   /* of a `let`, or NULL */
} tn_bound_name;

typedef struct tn_rule_expansion {
    tn_check *check;
    const tn_bound_name *bindings;  /* innermost first */
    size_t unit;                    /* the file whose words are being read */
    const tn_checked_schema *older; /* the schema that they are of; NULL: that in use */
    bool number;                    /* a number stands here: a value of an order is its place */
} tn_rule_expansion;

/* What a word stands for where it is read; value NULL where it stands for itself. */
tn_bound_name tn_bound(const tn_rule_expansion *expansion, const tn_ast_word *word);

/* expand_words.c: is a word bound there? And copies with the words replaced. */
bool tn_words_bound(const tn_rule_expansion *expansion, const tn_ast_item *item);
bool tn_condition_bound(const tn_rule_expansion *expansion, const tn_ast_cond *cond);
tn_ast_list tn_expand_items(tn_rule_expansion *expansion, tn_ast_list items);
tn_ast_cond *tn_expand_condition(tn_rule_expansion *expansion, const tn_ast_cond *cond);
/* The one number or length that an expression of constants comes to, as a word; NULL: reported at `place`. */
const tn_ast_word *tn_expand_constant(tn_rule_expansion *expansion, tn_ast_expr *value, tn_span place);

/* expand_values.c: what the name of a quantifier stands for as value number `value` of a field (NULL: no memory) ... */
tn_ast_expr *tn_value_expression(tn_rule_expansion *expansion, const tn_ast_expr *quantifier,
                                 const tn_checked_field *field, uint32_t value);
/* ... and a comparison of such a value with another, or with a word of its field: TRUE, FALSE, or BROKEN, which is
 * reported. false where neither side is one, or the other is no value: then it is a comparison of sums. */
bool tn_decide_values(tn_rule_expansion *expansion, const tn_ast_expr *comparison, tn_expr_kind *decided);

/* param.c: the same of a param of words and one of its words; false where neither side is such a param. */
bool tn_decide_words(tn_rule_expansion *expansion, const tn_ast_expr *comparison, tn_expr_kind *decided);
/* Is it a param of words, which stands only in comparisons and specifiers? Then that is reported. */
bool tn_refuse_words(tn_rule_expansion *expansion, tn_bound_name bound, tn_span place);

/* What a comparison is of a left side that is so much more than the right: TRUE or FALSE. */
tn_expr_kind tn_decided(tn_operator op, int64_t order);
/* The place of a value of a field whose values have an order, the first is 1, as a number. NULL: no memory. */
tn_ast_expr *tn_place_expression(tn_rule_expansion *expansion, const tn_checked_field *field, const tn_ast_expr *value);

/* expand_key.c: a text that is the same for equal expressions. */
const char *tn_expression_key(tn_check *check, const tn_checked_schema *schema, const char *name, tn_ast_list parts);

#endif
