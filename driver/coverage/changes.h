/* Small changes of a file's rules about plans: what its author may have written by mistake. Each is made in the syntax
 * tree, so that the changed file is compiled as any other.
 *
 * - A part of a rule never matches, or always does; where that is the same as a change of what it stands in, it is not
 *   a change of its own. A specifier that always matches stands for any tray.
 * - An item or an alternative of a specifier, `beginning` or `end`, or a clause of a library is left out.
 * - A bound (of a condition, a comparison, a specifier, `total`, `trays`, a `let`) is a step lower or higher; a value
 *   or a fill is the next one of its field; a flag is the opposite; a comparison without a bound takes its bound in or
 *   leaves it out.
 * - The greatest number becomes the least, and the other way round.
 * - A symmetric matches only as it is written, or only mirrored.
 *
 * They are numbered in the order of the text, the files in the order in which they are used, so that a number means the
 * same change each time.
 */
#ifndef TARTAN_DRIVER_COVERAGE_CHANGES_H
#define TARTAN_DRIVER_COVERAGE_CHANGES_H

#include "driver/open/open.h"

typedef enum tn_rule_change_kind {
    TN_CHANGE_NEVER,
    TN_CHANGE_ALWAYS,
    TN_CHANGE_ANY_TRAY, /* of a specifier of several items: all are left out */
    TN_CHANGE_LEFT_OUT,
    TN_CHANGE_REPLACED, /* by `to` */
    TN_CHANGE_COMPARED, /* by the sign `to` */
    TN_CHANGE_WRITTEN,  /* a symmetric only as it is written */
    TN_CHANGE_MIRRORED, /* only mirrored */
    TN_CHANGE_CLAUSE,   /* a clause is left out */
} tn_rule_change_kind;

typedef struct tn_change {
    tn_rule_change_kind kind;
    tn_span span;     /* what is changed */
    tn_span around;   /* the specifier or neighbour that it is part of; of other kinds the same as `span` */
    char *to;         /* owned; NULL where there is none */
    char *name;       /* of the rule, clause or `let` in which it is; owned */
    uint32_t rule;    /* its RULE record, or TN_NO_RECORD */
    uint32_t clause;  /* its CLAUSE record, or TN_NO_RECORD */
    unsigned depth;   /* 0: the whole of the rule or clause */
    const char *what; /* is changed, in a word: "neighbour", "item", "value" */
} tn_change;

typedef struct tn_changes {
    tn_change *items;
    size_t count, capacity;
    size_t more; /* that there are beyond the most that may be listed */
} tn_changes;

/* Which changes: of rules with this schema, and of the clauses of a library (or NULL). */
typedef struct tn_change_scope {
    const tn_opened *opened;
    uint32_t schema;
    const tn_library_record *library;
    bool imported; /* also of rules of used files that the library's clauses name */
    size_t most;
} tn_change_scope;

/* Clear in any case. */
tn_status tn_changes_list(const tn_change_scope *scope, tn_changes *changes, tn_error *error);
void tn_changes_clear(tn_changes *changes);

/* Opens the file with the change of this number. test: the params have the values that the file's test of this number,
 * from 1, says; 0: their own. TN_INVALID where it does not compile so, or its trays are others: such a change is none.
 * Close it in any case. */
tn_status tn_change_open(const tn_change_scope *scope, size_t number, size_t test, tn_opened *changed);

#endif
