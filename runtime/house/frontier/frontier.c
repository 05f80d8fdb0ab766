/* Makes a strip ready: its questions, the slices of its trays, the automata of its clauses. */
#include <stdlib.h>
#include <string.h>

#include "runtime/house/frontier/parts.h"

static void find_tiled(tn_strip *strip)
{
    const tn_house_form *form = strip->form;
    for (uint32_t t = 0; t < form->record->tile_count; t++) {
        const tn_tile_record *tile = &form->module->TILE_records[form->record->tile_first + t];
        for (uint32_t i = 0; i < tile->purpose_count; i++)
            strip->tiled[form->module->HOUSE_ITEM_records[tile->purpose_first + i].number] = strip->any_tiled = true;
    }
}

static tn_status begin(tn_strip *strip, tn_error *error)
{
    const tn_house_form *form = strip->form;
    strip->of_tray = calloc((size_t)form->schema->tray_count + 1, sizeof *strip->of_tray);
    strip->furnished = calloc((size_t)form->schema->tray_count + 1, sizeof *strip->furnished);
    strip->tiled = calloc((size_t)tn_form_functions(form) + 1, sizeof *strip->tiled);
    strip->asked_function = calloc((size_t)tn_form_functions(form) + 1, sizeof *strip->asked_function);
    strip->scratch = calloc(2 * (size_t)strip->library->clause_count + 1, sizeof *strip->scratch);
    strip->after_slice = calloc((size_t)strip->trays_most + 1, sizeof *strip->after_slice);
    strip->after_plane = calloc((size_t)strip->trays_most + 1, sizeof *strip->after_plane);
    if (!strip->of_tray || !strip->furnished || !strip->tiled || !strip->asked_function || !strip->scratch ||
        !strip->after_slice || !strip->after_plane)
        return tn_fail_memory(error);
    for (uint32_t k = 0; k < strip->added->count; k++) {
        strip->weighed_rooms[k] = calloc((size_t)strip->added->of[k]->count + 1, sizeof(uint32_t));
        if (!strip->weighed_rooms[k])
            return tn_fail_memory(error);
    }
    find_tiled(strip);
    tn_status status = tn_strip_clauses_new(strip, error);
    return status == TN_OK ? tn_strip_ask(strip, error) : status;
}

tn_status tn_strip_new(const tn_house_form *form, const tn_house_library_record *library, const uint32_t *shapes,
                       const tn_strip_trays *trays, uint32_t trays_least, uint32_t trays_most,
                       const tn_house_measures *measures, const tn_house_added *added, const tn_strip_without *without,
                       tn_strip **out, tn_error *error)
{
    tn_strip *strip = *out = calloc(1, sizeof *strip);
    if (!strip)
        return tn_fail_memory(error);
    *strip = (tn_strip){.form = form,
                        .library = library,
                        .trays_least = trays_least,
                        .trays_most = trays_most,
                        .watch = form->module->watch,
                        .measures = measures,
                        .added = added,
                        .without = without};
    memcpy(strip->shapes, shapes, form->record->choice_count * sizeof *shapes);
    tn_status status = begin(strip, error);
    if (status == TN_OK)
        status = tn_strip_prices_begin(strip, error);
    if (status == TN_OK)
        status = tn_strip_borders_find(strip, trays, error);
    for (tn_tray t = 0; status == TN_OK && t < form->schema->tray_count; t++)
        if (trays->stand[t])
            status = tn_strip_slices(strip, t, error);
    if (status == TN_OK)
        status = tn_strip_lower(strip, error);
    strip->without = NULL;
    return status;
}

static void clear_known(tn_strip *strip)
{
    for (uint32_t k = 0; strip->after_slice && strip->after_plane && k <= strip->trays_most; k++) {
        tn_strip_known_clear(&strip->after_slice[k]);
        tn_strip_known_clear(&strip->after_plane[k]);
    }
    free(strip->after_slice);
    free(strip->after_plane);
    tn_strip_known_clear(&strip->tiles);
    tn_strip_sums_clear(&strip->sums);
    tn_strip_known_clear(&strip->waits);
    tn_strip_known_clear(&strip->crossed_rooms);
    for (uint32_t w = 0; w < TN_STRIP_MEETINGS_MAX; w++)
        tn_strip_known_clear(&strip->crossed_walks[w]);
}

static void free_lists(tn_strip_list *lists, size_t count)
{
    for (size_t i = 0; lists && i < count; i++)
        free(lists[i].items);
    free(lists);
}

void tn_strip_free(tn_strip *strip)
{
    if (!strip)
        return;
    tn_interner *const interners[] = {&strip->edge_keys, &strip->slice_keys, &strip->outcome_keys, &strip->areas,
                                      &strip->bases,     &strip->sides,      &strip->waiting,      &strip->rooms,
                                      &strip->walks,     &strip->states,     &strip->letters,      &strip->fit_lists,
                                      &strip->insides,   &strip->throughs,   &strip->readings,     &strip->between,
                                      &strip->values,    &strip->asked,      &strip->mets,         &strip->totals,
                                      &strip->functions, &strip->plain_keys, &strip->parts,        &strip->combined};
    for (uint32_t i = 0; i < strip->edge_keys.count; i++) {
        free(strip->edges[i].cells);
        free(strip->edges[i].answers);
        free(strip->edges[i].inner);
    }
    free_lists(strip->of_tray, strip->form->schema->tray_count);
    for (size_t t = 0; strip->furnished && t < strip->form->schema->tray_count; t++)
        free(strip->furnished[t].items);
    free(strip->furnished);
    tn_strip_borders_clear(&strip->borders);
    free_lists(strip->planes, strip->plane_keys.count);
    for (size_t i = 0; i < sizeof interners / sizeof *interners; i++)
        tn_interner_clear(interners[i]);
    tn_numbering_clear(&strip->plane_keys);
    tn_numbering_clear(&strip->fit_keys[0]);
    tn_numbering_clear(&strip->fit_keys[1]);
    tn_strip_row_clear(&strip->row);
    tn_strip_stages_clear(&strip->stages);
    tn_numbering_clear(&strip->befores);
    tn_numbering_clear(&strip->moves);
    clear_known(strip);
    tn_strip_ways_forget(strip);
    tn_strip_orders_clear(&strip->slice_orders);
    tn_strip_orders_clear(&strip->outcome_orders);
    tn_strip_clauses_free(strip);
    tn_strip_merged_clear(&strip->merged);
    tn_strip_prices_clear(&strip->prices);
    free(strip->questions.decisions);
    free(strip->edges);
    free(strip->slices);
    free(strip->plains);
    free(strip->outcomes);
    free(strip->of_combined);
    free(strip->tiled);
    free(strip->asked_function);
    free(strip->scratch);
    free(strip->ends);
    for (uint32_t k = 0; k < TN_ADDED_MAX; k++)
        free(strip->weighed_rooms[k]);
    tn_plan_vm_free(strip->plan_vm);
    free(strip->ahead);
    tn_numbering_clear(&strip->fails);
    free(strip->open_rooms);
    free(strip->fits);
    free(strip->key.data);
    free(strip->joined.data);
    free(strip);
}

/* How many different things a clause keeps apart: its own states, and the rooms and walks that it asks for. */
static uint64_t kept_apart(const tn_strip *strip, const tn_strip_clause *clause)
{
    uint64_t states = clause->dfa ? clause->dfa->states : 0;
    for (size_t i = 0; i < clause->atom_count; i++) {
        tn_opcode opcode = clause->atoms[i].op.opcode;
        states += opcode == TN_OP_APART                                ? strip->walks.count
                  : opcode == TN_OP_SOME_ROOM || opcode == TN_OP_ROOMS ? strip->rooms.count
                  : tn_code_compares_house(opcode)                     ? strip->totals.count
                                                                       : 0;
    }
    return states;
}

const char *tn_strip_dearest(const tn_strip *strip)
{
    const tn_module *module = strip->form->module;
    const char *name = NULL;
    uint64_t most = 0;
    for (uint32_t i = 0; i < strip->clause_count; i++) {
        uint64_t states = kept_apart(strip, &strip->clauses[i]);
        if (states > most)
            name = tn_text(module, module->HOUSE_CLAUSE_records[strip->library->clause_first + i].name);
        most = states > most ? states : most;
    }
    return name;
}
