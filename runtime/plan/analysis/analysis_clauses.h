/* The clauses of one library while they are analysed, for the files that do it (analysis_library.c,
 * analysis_needed.c). */
#ifndef TARTAN_PLAN_ANALYSIS_ANALYSIS_CLAUSES_H
#define TARTAN_PLAN_ANALYSIS_ANALYSIS_CLAUSES_H

#include "runtime/plan/analysis/analysis_data.h"

typedef struct tn_analysed_clauses {
    const tn_plan_analysis *analysis;
    tn_plan_analysis *findings; /* the same, to add to */
    uint32_t index;
    const tn_library_record *record;
    const tn_clause_record *clauses;
    size_t count;
    tn_search_part *parts; /* [count]: what each clause has to answer of a kept plan */
    tn_dfa **dfas;         /* [count] */
    tn_lowering *within;   /* of the clauses that compare sums, for plans of the library's lengths; or NULL */
    tn_library *made;      /* the library, where a search took too much and the caller has none; or NULL */
} tn_analysed_clauses;

/* What became of one clause. */
typedef struct tn_clause_verdict {
    tn_status status; /* TN_OK or TN_LIMIT */
    bool needed;      /* it alone keeps out some plan */
    tn_error error;
} tn_clause_verdict;

static inline bool tn_clause_prunes(const tn_analysed_clauses *c, size_t i)
{
    return c->clauses[i].kind == TN_CLAUSE_PRUNE;
}

/* Are its automata of plans of any length? Then plans longer than the library's can be asked about too. */
static inline bool tn_clauses_unbounded(const tn_analysed_clauses *c)
{
    return c->within == NULL;
}

/* Trays of the shortest and the longest plan asked about: of the library, or any. */
static inline uint32_t tn_clauses_shortest(const tn_analysed_clauses *c, bool lengths)
{
    return lengths || c->record->trays_min == 0 ? c->record->trays_min : 1;
}

static inline uint32_t tn_clauses_longest(const tn_analysed_clauses *c, bool lengths)
{
    return lengths ? c->record->trays_max : UINT32_MAX;
}

/* The library itself, made by the first who asks where the analysis was not given it. TN_LIMIT (E0802). */
tn_status tn_clauses_library(tn_analysed_clauses *c, const tn_library **library, tn_error *error);

/* Is there a plan of the library's lengths that answers all parts ([count], reordered) as wanted? Asks about `first`
 * alone to begin with, and about another part when a plan fails it: few of them are ever looked at together. Where
 * there is no such plan, the first `*asked` are reason enough. *word: the shortest such plan; the caller frees its
 * data, also after a failure. TN_LIMIT past max_work steps, and past max_asked parts. */
tn_status tn_clauses_exists(const tn_analysed_clauses *c, tn_search_part *parts, size_t first, uint64_t max_work,
                            size_t max_asked, size_t *asked, tn_key *word, bool *found, tn_error *error);

/* Finds for each clause written in the library itself whether it is needed; of others it says so. verdicts: [count],
 * zeroed. */
tn_status tn_clauses_needed(tn_analysed_clauses *c, tn_clause_verdict *verdicts, tn_error *error);

#endif
