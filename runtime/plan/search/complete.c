/* Open plans, searched: a gate for each place of the plan and each part of the open plan, that the parts before the one
 * may be the trays before the other. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/plan/search/search_data.h"

/* meets: [trays of the plan]: the tray there fits the part. */
static tn_status meet_part(tn_plan_search *search, const tn_open_tray *part, tn_signal *meets, tn_error *error)
{
    const tn_schema *schema = search->schema;
    tn_tray_counts counts = {0};
    tn_signal gates[2];
    int64_t *of_tray = calloc((size_t)schema->tray_count + 1, sizeof *of_tray);
    tn_status status = of_tray ? TN_OK : tn_fail_memory(error);
    for (tn_tray t = 0; status == TN_OK && t < schema->tray_count; t++)
        of_tray[t] = !part->fits || part->fits[t];
    if (status == TN_OK)
        status = tn_tray_counts_make(&counts, schema, of_tray, error);
    for (uint32_t k = 0; status == TN_OK && k < search->at.trays; k++) {
        status = tn_letters_count(&search->at.letters, k, &counts, gates, error);
        meets[k] = counts.count == 2 ? gates[1] : counts.counts[0] == 1 ? TN_SIGNAL_TRUE : TN_SIGNAL_FALSE;
    }
    tn_tray_counts_clear(&counts);
    free(of_tray);
    return status;
}

tn_status tn_search_within(tn_plan_search *search, const tn_open_plan *open, tn_signal *begins, tn_signal *all,
                           tn_error *error)
{
    tn_circuit *circuit = search->at.circuit;
    uint32_t trays = search->at.trays;
    tn_signal *reach = tn_array_new(3 * ((uint64_t)trays + 1), sizeof *reach); /* [trays + 1]: so many trays taken */
    if (!reach)
        return tn_fail_memory(error);
    tn_signal *meets = reach + trays + 1, *room = meets + trays + 1;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i <= trays; i++)
        reach[i] = i == 0 ? TN_SIGNAL_TRUE : TN_SIGNAL_FALSE;
    begins[0] = TN_SIGNAL_TRUE;
    for (size_t p = 0; status == TN_OK && p < open->count; p++) {
        bool gap = open->trays[p].gap;
        if (!gap)
            status = meet_part(search, &open->trays[p], meets, error);
        for (uint32_t i = 1; gap && i <= trays; i++)
            reach[i] = tn_circuit_or(circuit, reach[i], reach[i - 1]);
        for (uint32_t i = trays; status == TN_OK && !gap && i > 0; i--)
            reach[i] = tn_circuit_and(circuit, reach[i - 1], meets[i - 1]);
        reach[0] = gap ? reach[0] : TN_SIGNAL_FALSE;
        for (uint32_t i = 0; i <= trays; i++)
            room[i] = reach[i];
        begins[p + 1] = tn_circuit_any(circuit, room, (size_t)trays + 1);
    }
    *all = reach[trays];
    free(reach);
    return status;
}

/* Goes on from `parts`, of plans of the length that is open. */
static tn_status begin_length(tn_plan_search *search, const tn_open_plan *open, tn_signal *begins, bool *any,
                              size_t *parts, tn_error *error)
{
    tn_signal all;
    bool found = true;
    tn_status status = tn_search_within(search, open, begins, &all, error);
    if (status == TN_OK && !*any) {
        status = tn_search_find(search, 0, any, error);
        found = *any;
    }
    while (status == TN_OK && found && *parts < open->count) {
        search->at.assumed[0] = begins[*parts + 1];
        status = tn_search_find(search, 1, &found, error);
        *parts += status == TN_OK && found;
    }
    return status;
}

tn_status tn_plan_search_beginning(tn_plan_search *search, const tn_open_plan *open, bool *any, size_t *parts,
                                   tn_error *error)
{
    const tn_search_options *o = &search->options;
    tn_signal *begins = tn_array_new(open->count + 1, sizeof *begins);
    tn_status status = begins ? TN_OK : tn_fail_memory(error);
    *any = false;
    *parts = 0;
    for (uint32_t l = o->trays_min; status == TN_OK && l <= o->trays_max && (!*any || *parts < open->count); l++) {
        status = tn_search_open(search, l, true, error);
        if (status == TN_OK)
            status = begin_length(search, open, begins, any, parts, error);
    }
    tn_search_close(search);
    free(begins);
    return status;
}
