/* What a tn_plan_search is made of: for the files that answer its questions. */
#ifndef TARTAN_PLAN_SEARCH_SEARCH_DATA_H
#define TARTAN_PLAN_SEARCH_SEARCH_DATA_H

#include "runtime/plan/match/vm.h"
#include "runtime/plan/search/search.h"
#include "runtime/plan/search/unroll.h"

/* Plans of one length. */
typedef struct tn_search_length {
    bool open;
    uint32_t trays;
    tn_circuit *circuit;
    tn_letters letters;
    tn_unrolled *unrolled;
    tn_signal *keeps;   /* [clauses]: that the clause keeps the plan; true where it is judged alone */
    bool *judged;       /* [clauses]: by the interpreter alone */
    tn_signal *assumed; /* [digits + 1]: room */
} tn_search_length;

struct tn_plan_search {
    const tn_schema *schema;
    const tn_library_record *record;
    tn_search_options options;
    tn_plan_vm *vm;
    tn_search_length at;
    uint32_t next_trays; /* the length to look at next */
    tn_tray *plan;       /* [trays_max + 1]: the last one, if there is one of this length */
    bool has_plan;
    uint32_t rejected; /* plans by the interpreter, since the last one that was kept */
};

static inline const tn_clause_record *tn_search_clause(const tn_plan_search *search, uint32_t i)
{
    return &search->schema->module->CLAUSE_records[search->record->clause_first + i];
}

/* Makes the gates of the plans of so many trays; keep: and asserts that all clauses keep them. */
tn_status tn_search_open(tn_plan_search *search, uint32_t trays, bool keep, tn_error *error);
void tn_search_close(tn_plan_search *search);

/* Is there a plan, with the first `count` of at.assumed? TN_LIMIT (E0833) if that is not found out. */
tn_status tn_search_solve(tn_plan_search *search, size_t count, bool *found, tn_error *error);

/* TN_LIMIT (E0833), of the length that is open. */
tn_status tn_search_undecided(const tn_plan_search *search, tn_error *error);

/* No other plan is like this one, from now on. */
void tn_search_exclude(tn_plan_search *search, const tn_tray *trays);

/* Keeps a copy of a plan. */
tn_status tn_searched_add(tn_searched_plans *plans, const tn_tray *trays, uint32_t length, tn_error *error);

/* Does the interpreter keep the plan? TN_INTERNAL if it does not, and every clause has its gate; TN_LIMIT (E0833) if
 * that was so of too many in a row. */
tn_status tn_search_judge(tn_plan_search *search, const tn_tray *trays, bool *keeps, tn_error *error);

#endif
