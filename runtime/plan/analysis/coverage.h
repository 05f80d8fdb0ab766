/* How many plans are decided otherwise once rules say something else: exactly, and which is the shortest of them.
 *
 * The rules as they are, and as they are changed, are two modules with the same trays and the same rules and libraries.
 * Only what is other code there is lowered, and the plans of the difference are counted on automata. Where that is
 * about a library, they are counted from automata that it keeps: what a clause alone keeps out, and the kept plans. All
 * automata are over the same classes of trays, which must be fine enough for every changed rule.
 *
 * A tn_coverage belongs to one thread, and borrows the schema, the classes and the library.
 */
#ifndef TARTAN_PLAN_ANALYSIS_COVERAGE_H
#define TARTAN_PLAN_ANALYSIS_COVERAGE_H

#include <gmp.h>

#include "runtime/plan/library/library.h"

typedef struct tn_coverage tn_coverage;

/* The plans that are decided otherwise. */
typedef struct tn_otherwise {
    mpz_t plans;    /* how many */
    bool found;     /* is there a shortest one? */
    bool now;       /* of that: does the rule match it as it is, does the library keep it as it is? */
    tn_tray *trays; /* owned */
    size_t length;
    size_t rule; /* the number of the first function that says otherwise of it, or of the first changed clause that
                    drops it; SIZE_MAX: its length alone does */
} tn_otherwise;

void tn_otherwise_init(tn_otherwise *otherwise);
void tn_otherwise_clear(tn_otherwise *otherwise);

/* library: made with these classes (tn_library_options), or NULL where only rules are asked about. max: the most trays
 * of their plans. max_states: 0 is the default. */
tn_status tn_coverage_new(const tn_schema *schema, const tn_library *library, const tn_classes *classes, uint32_t max,
                          uint32_t max_states, tn_coverage **coverage, tn_error *error);
void tn_coverage_free(tn_coverage *coverage);

/* Of some functions (HOLDS) and what they are changed into: the plans of 1 to max trays of which at least one says
 * otherwise. changed: the schema of the other module. shortest: is the shortest plan wanted? TN_LIMIT (E0802) where an
 * automaton passes the limit. */
tn_status tn_coverage_rules(tn_coverage *coverage, const uint32_t *functions, const tn_schema *changed,
                            const uint32_t *changed_functions, size_t count, bool shortest, tn_otherwise *otherwise,
                            tn_error *error);

/* Of the library, and the one of the same number in the other module: the plans that only one of them keeps. *same: are
 * their lengths and the code of their clauses the same, so that there is none? TN_LIMIT as above. */
tn_status tn_coverage_library(tn_coverage *coverage, const tn_schema *changed, bool shortest, bool *same,
                              tn_otherwise *otherwise, tn_error *error);

#endif
