/* What can be said of a grammar without mapping anything: how deep its sentences must be, how many there are, and
 * whether they tend to grow without end. Rules are supposed to be able to end, which compiling has checked. */
#ifndef TARTAN_GRAMMAR_ANALYSIS_H
#define TARTAN_GRAMMAR_ANALYSIS_H

#include <gmp.h>

#include "runtime/grammar/grammar.h"

#define TN_DEPTH_ENDLESS UINT32_MAX

typedef struct tn_analysis {
    uint32_t *rule_depth; /* by rule: depth of its shallowest sentence, counted as its dialect counts (ge: terminals
                             too), 1 for the rule itself; TN_DEPTH_ENDLESS where it has none */
    uint32_t *production_depth; /* by production: the same when it is chosen */
    uint8_t *recursive;         /* by rule: may it expand to itself? */
    uint8_t *endless;           /* by production: can it lead back to its own rule? */
    double growth; /* by how much the number of pending recursive non-terminals is multiplied by one round of expansion
                      on average, all choices alike: above 1, sentences tend to grow without end */
    uint32_t growing_rule; /* the rule that has the largest share in it; TN_NO_RECORD where there is no recursion */
} tn_analysis;

/* TN_MEMORY, or TN_OK. Free with tn_analysis_clear in any case. */
tn_status tn_analyse(const tn_grammar *grammar, tn_analysis *analysis, tn_error *error);
void tn_analysis_clear(tn_analysis *analysis);

/* How many derivations there are: of at most `depth` levels where the grammar has no loops (by_codons false), else of
 * exactly `depth` codons; edge types are not told apart. `total` is initialised by the caller. TN_LIMIT where the
 * numbers would pass TN_DERIVATION_BITS bits. */
tn_status tn_count_derivations(const tn_grammar *grammar, uint32_t depth, bool *by_codons, mpz_t total,
                               tn_error *error);

#define TN_DERIVATION_BITS (1u << 20)

/* Has it { } groups, which make the number of derivations of a depth endless? */
bool tn_grammar_has_loops(const tn_grammar *grammar);

#endif
