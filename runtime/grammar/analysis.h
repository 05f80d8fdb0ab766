/* What can be said of a grammar without mapping anything: how deep its sentences must be, how many there are, and
 * whether they tend to grow without end. Rules are supposed to be able to end, which compiling has checked. */
#ifndef TARTAN_GRAMMAR_ANALYSIS_H
#define TARTAN_GRAMMAR_ANALYSIS_H

#include <gmp.h>

#include "runtime/grammar/grammar.h"

#define TN_DEPTH_ENDLESS UINT32_MAX

typedef struct tn_analysis {
    uint32_t *rule_depth; /* by rule: depth of its shallowest sentence, counted as its dialect counts (ge: terminals
                             too), 1 for the rule itself; TN_DEPTH_ENDLESS if it has none */
    uint32_t *production_depth; /* by production: the same when it is chosen */
    uint8_t *recursive;         /* by rule: may it expand to itself? */
    uint8_t *endless;           /* by production: can it lead back to its own rule? */
    double growth; /* by how much the number of pending recursive non-terminals is multiplied by one round of expansion
                      on average, all choices alike: above 1, sentences tend to grow without end */
    uint32_t growing_rule; /* the rule that has the largest share in it; TN_NO_RECORD if there is no recursion */
} tn_analysis;

/* TN_MEMORY, or TN_OK. Free with tn_analysis_clear in any case. */
tn_status tn_analyse(const tn_grammar *grammar, tn_analysis *analysis, tn_error *error);
void tn_analysis_clear(tn_analysis *analysis);

/* How many derivations there are: of at most `depth` levels where the grammar has no loops (by_codons false), else of
 * exactly `depth` codons; edge types are not told apart. `total` is initialised by the caller. TN_LIMIT if the
 * numbers would pass TN_DERIVATION_BITS bits. */
tn_status tn_count_derivations(const tn_grammar *grammar, uint32_t depth, bool *by_codons, mpz_t total,
                               tn_error *error);

#define TN_DERIVATION_BITS (1u << 20)

/* Has it { } groups, which make the number of derivations of a depth endless? */
bool tn_grammar_has_loops(const tn_grammar *grammar);

/* How deep the derivations of each rule can be: not every depth that a limit allows is one that a grammar has. Rules
 * `<a> ::= <b>x`, `<b> ::= <a>y | z` derive only even or only odd depths.
 *
 * Depths are counted as in the analysis: 1 for the rule itself, terminals too in ge. A depth is one that a rule has
 * where some production leads to it: one of its non-terminals has the depth below, and what else the production must
 * write ends by there. Memory: a bit for each rule and depth. */

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
