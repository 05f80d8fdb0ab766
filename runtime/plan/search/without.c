/* Plans that one library keeps and another does not: the gates of both over the same trays, as circuits are held to be
 * equivalent (Brand: Verification of large synthesized designs, 1993). */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/plan/search/search_data.h"

tn_status tn_search_without(tn_plan_search *search, const tn_search_other *other, tn_signal *gate, tn_error *error)
{
    tn_plan_search *from = other->search;
    uint32_t clauses = from->record->clause_count, trays = search->at.trays;
    *gate = TN_SIGNAL_TRUE;
    if (trays < from->options.trays_min || trays > from->options.trays_max)
        return TN_OK;
    tn_circuit_go_on(search->at.circuit);
    tn_status status = tn_search_open_on(from, &search->at.letters, other, error);
    if (status != TN_OK)
        return status;
    bool judged = false;
    for (uint32_t i = 0; i < clauses; i++)
        judged |= from->at.judged[i];
    if (!judged)
        *gate = tn_signal_not(tn_circuit_all(search->at.circuit, from->at.keeps, clauses)); /* sorts them */
    return tn_circuit_status(search->at.circuit, error);
}

tn_status tn_search_other_keeps(tn_plan_search *search, const tn_search_other *other, bool *keeps, tn_error *error)
{
    uint32_t trays = search->at.trays;
    tn_tray *mapped = tn_array_new((uint64_t)trays + 1, sizeof *mapped);
    if (!mapped)
        return tn_fail_memory(error);
    for (uint32_t k = 0; k < trays; k++)
        mapped[k] = other->trays ? other->trays[search->plan[k]] : search->plan[k];
    tn_status status = tn_plan_search_keeps(other->search, mapped, trays, keeps, error);
    free(mapped);
    return status;
}
