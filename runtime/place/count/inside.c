/* Counts buildings where they stand: the slots of the lattice whose cells are inside of a model's space are allowed. */
#include <stdlib.h>

#include "runtime/place/count/count.h"
#include "runtime/place/space.h"

/* The lowest corner of the first wanted part that the model's rules place where it starts: the lattice goes through it.
 */
static tn_status find_anchor(const tn_place_rules *rules, const bool *wanted, int32_t anchor[3], tn_error *error)
{
    tn_site_choices c;
    bool found = false;
    tn_status status = tn_site_choices_make(rules, &c, error);
    for (size_t s = c.start_first; status == TN_OK && s < c.site_count && !found; s++) {
        const tn_choice_symbol *symbol = &c.symbols[c.sites[s].symbol];
        for (uint32_t i = 0; i < symbol->count && !found; i++) {
            const tn_site_choice *choice = &c.choices[symbol->first + i];
            const tn_chosen_part *part = &c.parts[choice->part_first];
            if (choice->part_count == 0 || (wanted && !wanted[part->kind]))
                continue;
            tn_frame frame = tn_frame_from(&c.sites[s].frame, &part->frame);
            tn_cell_box all = tn_kind_all(&c.kinds[part->kind], frame.heading);
            for (int k = 0; k < 3; k++)
                anchor[k] = frame.at[k] + all.low[k];
            found = true;
        }
    }
    tn_site_choices_clear(&c);
    if (status != TN_OK || found)
        return status;
    tn_fail(error, TN_INVALID, E_COUNT_START, "model %.100s starts with none of the parts that are counted",
            tn_text(rules->module, rules->space->name));
    tn_error_help(error, "where it starts says where parts may lie: name a part that its rule places there by --part");
    return TN_INVALID;
}

/* Is the part of a slot inside of the space, whose cells are those that are free? */
static bool is_inside(const tn_lattice *l, size_t slot, const int32_t anchor[3], tn_cells *cells)
{
    int32_t corner[3];
    const tn_look *look = &l->looks[tn_slot_look(l, slot, corner)];
    const tn_kind_of_part *kind = &l->kinds.kinds[look->kind];
    tn_cell_box all = tn_kind_all(kind, look->heading);
    for (int k = 0; k < 3; k++)
        corner[k] += anchor[k] - all.low[k];
    for (uint32_t b = 0; b < kind->record->box_count; b++) {
        tn_cell_box turned = tn_kind_box(kind, look->heading, b), box = tn_box_from(&turned, corner);
        if (tn_cells_any(cells, &box))
            return false;
    }
    return true;
}

/* forbidden: [slot], zeros. */
static tn_status find_forbidden(const tn_place_rules *rules, const tn_lattice *l, const int32_t anchor[3],
                                uint8_t *forbidden, tn_watch *watch, tn_error *error)
{
    tn_space *space = NULL;
    tn_cells *cells = tn_cells_new(watch);
    tn_status status = cells ? tn_space_new(rules, &space, error) : tn_fail_memory(error);
    if (status == TN_OK)
        tn_cells_bound(cells, tn_space_cells(space));
    for (size_t slot = 0; slot < l->slot_count && status == TN_OK; slot++) {
        if (tn_watch_stopped_at(watch, slot))
            status = tn_fail_stopped(watch, error);
        forbidden[slot] = !is_inside(l, slot, anchor, cells);
    }
    if (status == TN_OK)
        status = tn_cells_status(cells, error);
    tn_cells_free(cells);
    tn_space_free(space);
    return status;
}

static tn_status cover_space(const tn_place_rules *rules, tn_lattice *l, const int32_t anchor[3], tn_error *error)
{
    const tn_kit_model_record *model = rules->space;
    const int64_t low[3] = {model->low_x, model->low_y, model->low_z},
                  high[3] = {model->high_x, model->high_y, model->high_z};
    tn_cell_box box;
    for (int k = 0; k < 3; k++) {
        box.low[k] = (int32_t)(low[k] - anchor[k]);
        box.high[k] = (int32_t)(high[k] - anchor[k]);
    }
    return tn_lattice_cover(l, &box, error);
}

tn_status tn_lattice_inside(const tn_place_rules *rules, const bool *wanted, tn_watch *watch, tn_lattice *lattice,
                            int32_t anchor[3], uint8_t **forbidden, tn_error *error)
{
    *forbidden = NULL;
    *lattice = (tn_lattice){0};
    tn_status status = find_anchor(rules, wanted, anchor, error);
    if (status == TN_OK)
        status = tn_lattice_make(rules, wanted, lattice, error);
    if (status == TN_OK)
        status = cover_space(rules, lattice, anchor, error);
    if (status != TN_OK)
        return status;
    *forbidden = calloc(lattice->slot_count, sizeof **forbidden);
    return *forbidden ? find_forbidden(rules, lattice, anchor, *forbidden, watch, error) : tn_fail_memory(error);
}

tn_status tn_count_inside(const tn_place_rules *rules, const bool *wanted, uint32_t parts, unsigned threads,
                          tn_watch *watch, uint64_t *count, tn_error *error)
{
    tn_lattice lattice;
    int32_t anchor[3];
    uint8_t *forbidden;
    *count = 0;
    tn_status status = tn_lattice_inside(rules, wanted, watch, &lattice, anchor, &forbidden, error);
    if (status == TN_OK)
        status = tn_count_allowed(&lattice, forbidden, parts, threads, watch, count, error);
    free(forbidden);
    tn_lattice_clear(&lattice);
    return status;
}
