/* Proves that a library has no plan, and by which clauses: those that the solver used are made fewer by leaving each
 * out in turn (deletion of a minimal unsatisfiable core: Bakker, Dikker, Tempelman, Wognum: Diagnosing and solving
 * over-determined constraint satisfaction problems, 1993). */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/search/search_data.h"

void tn_search_conflict_clear(tn_search_conflict *conflict)
{
    free(conflict->clauses);
    tn_searched_plans_clear(&conflict->plans);
    *conflict = (tn_search_conflict){0};
}

/* Is there a plan of the length that is open which the chosen clauses keep? If not, those that were used are marked. */
static tn_status solve_length(tn_plan_search *search, const bool *chosen, bool *used, bool *found, tn_error *error)
{
    const tn_search_length *at = &search->at;
    size_t count = 0;
    for (uint32_t i = 0; i < search->record->clause_count; i++) {
        if (chosen[i] && at->judged[i])
            return tn_search_undecided(search, error);
        if (chosen[i])
            at->assumed[count++] = at->keeps[i];
    }
    tn_status status = tn_search_solve(search, count, found, error);
    if (status != TN_OK || *found)
        return status;
    for (uint32_t i = 0; i < search->record->clause_count; i++)
        used[i] |= chosen[i] && tn_circuit_failed(at->circuit, at->keeps[i]);
    return TN_OK;
}

/* Is there a plan that the chosen clauses keep? Then the search's plan is one, of the length that stays open. */
static tn_status solve(tn_plan_search *search, const bool *chosen, bool *used, bool *found, tn_error *error)
{
    tn_status status = TN_OK;
    *found = false;
    memset(used, 0, search->record->clause_count * sizeof *used);
    for (uint32_t l = search->options.trays_min; status == TN_OK && !*found && l <= search->options.trays_max; l++) {
        status = tn_search_open(search, l, false, error);
        if (status == TN_OK)
            status = solve_length(search, chosen, used, found, error);
    }
    if (status == TN_OK && *found)
        tn_letters_read(&search->at.letters, search->plan);
    return status;
}

/* Leaves out each of the chosen clauses that the others do without, and shows a plan for each that they do not. */
static tn_status leave_out(tn_plan_search *search, bool *chosen, bool *used, tn_search_conflict *conflict,
                           tn_error *error)
{
    uint32_t clauses = search->record->clause_count;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < clauses; i++) {
        bool found = false;
        if (!chosen[i])
            continue;
        chosen[i] = false;
        status = solve(search, chosen, used, &found, error);
        if (status == TN_OK && found) {
            chosen[i] = true;
            status = tn_searched_add(&conflict->plans, search->plan, search->at.trays, error);
        } else if (status == TN_OK) {
            memcpy(chosen, used, clauses * sizeof *chosen);
        }
    }
    for (uint32_t i = 0; i < clauses; i++)
        if (chosen[i])
            conflict->clauses[conflict->count++] = i;
    return status;
}

tn_status tn_plan_search_conflict(tn_plan_search *search, tn_search_conflict *conflict, tn_error *error)
{
    uint32_t clauses = search->record->clause_count;
    bool *chosen = calloc((size_t)clauses + 1, sizeof *chosen), *used = calloc((size_t)clauses + 1, sizeof *used);
    bool found = true;
    *conflict = (tn_search_conflict){.clauses = calloc((size_t)clauses + 1, sizeof *conflict->clauses)};
    tn_status status = chosen && used && conflict->clauses ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < clauses; i++)
        chosen[i] = true;
    if (status == TN_OK)
        status = solve(search, chosen, used, &found, error);
    conflict->empty = status == TN_OK && !found;
    if (conflict->empty) {
        memcpy(chosen, used, clauses * sizeof *chosen);
        status = leave_out(search, chosen, used, conflict, error);
    }
    tn_search_close(search);
    free(chosen);
    free(used);
    return status;
}
