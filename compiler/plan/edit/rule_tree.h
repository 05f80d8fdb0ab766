/* A rule as the tree that its picture shows: each part with its place in the text.
 *
 * Parts are numbered from the root, 0, each before its own parts. The syntax tree leaves out the parentheses that an
 * author wrote; here a part has its own place and its place with the parentheses around it. What has no picture of its
 * parts (sums, plans in brackets, what is asked of houses) is one part of kind TEXT. */
#ifndef TARTAN_COMPILER_PLAN_EDIT_RULE_TREE_H
#define TARTAN_COMPILER_PLAN_EDIT_RULE_TREE_H

#include "compiler/plan/edit/rule_text.h"

#define TN_NO_RULE_PART UINT32_MAX

/* From what needs parentheses nearly everywhere to what needs them nowhere. */
typedef enum tn_binding {
    TN_BINDS_NOTHING, /* `implies`, `where` */
    TN_BINDS_OR,
    TN_BINDS_AND,
    TN_BINDS_NOT, /* and comparisons, relations */
    TN_BINDS_SUM, /* arithmetic */
    TN_BINDS_PRIMARY
} tn_binding;

typedef enum tn_rule_part_form { TN_RULE_PART_LEAF, TN_RULE_PART_ROW, TN_RULE_PART_PLACES } tn_rule_part_form;

typedef enum tn_rule_part_kind {
#define RULE_PART(ID, ...) TN_RULE_PART_##ID,
#include "compiler/plan/edit/rule_parts.def"
    TN_RULE_PART_KINDS
} tn_rule_part_kind;

/* Bytes of the text. */
typedef struct tn_text_stretch {
    uint32_t begin, end;
} tn_text_stretch;

typedef struct tn_rule_part {
    tn_rule_part_kind kind;
    const tn_ast_expr *expr;    /* borrowed from the text */
    tn_text_stretch own, outer; /* outer: with the parentheses around it */
    tn_binding binds;
    uint32_t parent, first, last, next; /* parts; TN_NO_RULE_PART */
    uint32_t index, count;              /* which of its parent's parts it is; how many it has */
} tn_rule_part;

typedef struct tn_rule_tree {
    const tn_rule_text *text;
    const tn_ast_rule *rule;
    tn_rule_part *parts;
    uint32_t count;
    size_t capacity;
} tn_rule_tree;

/* Makes the tree of a rule of the text, which has to outlive it. TN_MEMORY. Clear in any case. */
tn_status tn_rule_tree_make(const tn_rule_text *text, const tn_ast_rule *rule, tn_rule_tree *tree, tn_error *error);
void tn_rule_tree_clear(tn_rule_tree *tree);

/* "neighbour" */
const char *tn_rule_part_word(tn_rule_part_kind kind);
tn_rule_part_form tn_rule_part_form_of(tn_rule_part_kind kind);

/* How tightly what stands at the place of the part has to hold together, to need no parentheses there. */
tn_binding tn_rule_part_needs(const tn_rule_tree *tree, uint32_t part);
tn_binding tn_rule_part_holds(tn_rule_part_kind kind); /* the same of a part's own parts */
tn_binding tn_expr_binds(const tn_ast_expr *expr);

/* The kind of part that an expression is. */
tn_rule_part_kind tn_rule_part_kind_of(const tn_ast_expr *expr, const char *text);

/* The index-th of its parts, or TN_NO_RULE_PART. */
uint32_t tn_rule_part_child(const tn_rule_tree *tree, uint32_t part, uint32_t index);

/* Is `part` the other part or inside it? */
bool tn_rule_part_within(const tn_rule_tree *tree, uint32_t part, uint32_t other);

/* Of what is counted: where its condition stands, with the parentheses that the syntax tree leaves out; empty of
 * others. */
tn_text_stretch tn_rule_part_condition(const tn_rule_tree *tree, uint32_t part);

/* The part with this own place, or TN_NO_RULE_PART. */
uint32_t tn_rule_part_placed(const tn_rule_tree *tree, tn_text_stretch own);

/* The smallest part that holds the place, or TN_NO_RULE_PART. */
uint32_t tn_rule_part_around(const tn_rule_tree *tree, tn_text_stretch place);

#endif
