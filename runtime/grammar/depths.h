/* How deep the derivations of each rule can be: not every depth that a limit allows is one that a grammar has. Rules
 * `<a> ::= <b>x`, `<b> ::= <a>y | z` derive only even or only odd depths.
 *
 * Depths are counted as in the analysis: 1 for the rule itself, terminals too in ge. A depth is one that a rule has
 * where some production leads to it: one of its non-terminals has the depth below, and what else the production must
 * write ends by there. Memory: a bit for each rule and depth.
 */
#ifndef TARTAN_GRAMMAR_DEPTHS_H
#define TARTAN_GRAMMAR_DEPTHS_H

#include "runtime/grammar/analysis.h"

typedef struct tn_depths {
    uint32_t top;   /* the deepest that was looked at */
    uint64_t *bits; /* by rule, `row` words each: bit h is depth h; owned */
    size_t row;
} tn_depths;

/* The depths up to `top`. Borrows nothing. TN_MEMORY, or TN_OK. Free with tn_depths_clear in any case. */
tn_status tn_depths_find(const tn_grammar *grammar, const tn_analysis *analysis, uint32_t top, tn_depths *depths,
                         tn_error *error);
void tn_depths_clear(tn_depths *depths);

/* Has the rule derivations of a depth from `low` to `high`? */
bool tn_depths_within(const tn_depths *depths, uint32_t rule, uint32_t low, uint32_t high);

#endif
