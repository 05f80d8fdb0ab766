/* What the files that list and make changes share. Internal to driver/coverage. */
#ifndef TARTAN_DRIVER_COVERAGE_CHANGES_WALK_H
#define TARTAN_DRIVER_COVERAGE_CHANGES_WALK_H

#include "compiler/plan/syntax/ast.h"
#include "driver/coverage/changes.h"

/* A walk through the syntax trees. It lists all changes, or makes the one of a number. */
typedef struct tn_change_walk {
    const tn_change_scope *scope;
    const tn_module *module; /* of the file as it is */
    tn_arena *arena;
    tn_changes *list; /* NULL: the walk makes a change */
    size_t wanted;    /* then: its number */
    size_t number;    /* of the next change */
    size_t test;      /* the file's test whose values the params have; 0: none */
    bool made, failed;
    tn_change in;    /* what each change here has in common: name, rule, clause, depth */
    uint32_t schema; /* SCHEMA record that words are looked up in */
    tn_span around;  /* the innermost expression or clause */
    int64_t step;    /* of the lengths that are compared here; 0: not known */
} tn_change_walk;

/* Offers a change of what is at `span`. True: it is the one that is to be made, now. `to` may be NULL. */
bool tn_change_offer(tn_change_walk *walk, tn_rule_change_kind kind, tn_span span, const char *to);

/* Offers a bound a step lower and a step higher: what a NUMBER or LENGTH word says. */
void tn_change_bound(tn_change_walk *walk, const tn_ast_word **word);

/* The sign that differs where both sides are the same, `<=` for `<`, and its operator; NULL: no such sign. */
const char *tn_change_other_sign(tn_operator op, tn_operator *other);

/* Is it a word that tn_change_bound changes? */
static inline bool tn_change_is_bound(const tn_ast_word *word)
{
    return !word->broken && (word->kind == TN_WORD_NUMBER || word->kind == TN_WORD_LENGTH);
}

/* The same list without a node. */
tn_ast_list tn_change_without(tn_ast_list list, const void *node);

/* The changes of a specifier's items. */
void tn_change_items(tn_change_walk *walk, tn_ast_list *items);

/* The changes of a word that may be a value: the next one of its field. */
void tn_change_value(tn_change_walk *walk, tn_ast_word *word);

#endif
