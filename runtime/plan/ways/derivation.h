/* How a rule derives a stretch of a plan: its tree of parts, as far as a stretch can be one in several ways.
 *
 * In how many ways a stretch is derived (D of docs/plan-language.md): of `or` the sum, of `and` the product, of
 * `neighbour` and `repeat` the sum over the cuts, of `symmetric` as it is and mirrored, of a name that of its body. All
 * else is a fact, true in one way or not at all.
 *
 * Rules stand in the order of their functions: what a rule calls comes before it, and the rules of a circle (again)
 * side by side. A tn_derivation is immutable once read and borrows the module.
 */
#ifndef TARTAN_PLAN_WAYS_DERIVATION_H
#define TARTAN_PLAN_WAYS_DERIVATION_H

#include "runtime/module/module.h"

typedef enum tn_derived_kind {
    TN_DERIVED_FACT,
    TN_DERIVED_CALL,
    TN_DERIVED_OR,
    TN_DERIVED_AND,
    TN_DERIVED_NEIGHBOUR,
    TN_DERIVED_REPEAT,
    TN_DERIVED_SYMMETRIC, /* a rule as it is, and the same on the plan turned round */
} tn_derived_kind;

#define TN_NOT_DERIVED UINT32_MAX

typedef struct tn_derived {
    tn_derived_kind kind;
    uint32_t first, next, count;   /* nodes, TN_NOT_DERIVED: none; children come after their parent */
    uint32_t rule;                 /* call, symmetric */
    bool again;                    /* call: within the circle that the rule is in */
    bool optional;                 /* in a neighbour: may be left out */
    bool beginning, end;           /* neighbour: tied to the plan's */
    uint32_t least, most;          /* repeat: how often; most 0: no matter how often */
    uint32_t code_begin, code_end; /* fact: the term that makes its relation */
} tn_derived;

typedef struct tn_derived_rule {
    uint32_t function;
    uint32_t first, end;               /* its nodes; the first is its root */
    bool circle;                       /* it uses itself, perhaps by way of others */
    uint32_t circle_first, circle_end; /* the rules of its circle, itself alone if it is in none */
} tn_derived_rule;

typedef struct tn_derivation {
    const tn_module *module;
    tn_derived *nodes;
    uint32_t node_count;
    size_t node_room;
    tn_derived_rule *rules;
    uint32_t rule_count;
    size_t rule_room;
    uint32_t root; /* rule */
} tn_derivation;

/* Reads what the function of a `generate` clause derives. TN_INVALID (E0703) for code that is not what the compiler
 * makes of a rule. Clear in any case. */
tn_status tn_derivation_read(const tn_module *module, uint32_t function, tn_derivation *derivation, tn_error *error);
void tn_derivation_clear(tn_derivation *derivation);

/* Marks from which sides, the plan as it is and turned round, each rule is asked: needed has [rules][TN_SIDES], all 0.
 */
enum { TN_SIDE_WRITTEN, TN_SIDE_TURNED, TN_SIDES };
void tn_derivation_needed(const tn_derivation *derivation, uint8_t *needed);

#endif
