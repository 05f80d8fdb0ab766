/* What steps do for good: they place parts, and fill cells. */
#include "runtime/base/array.h"
#include "runtime/place/derivation.h"

tn_status tn_take_part(derivation *d, const tn_frame *frame, const char *name)
{
    tn_placed_model *m = d->model;
    if (m->count == d->options.part_limit)
        return tn_past_limit(d, "parts", d->options.part_limit, "part-limit");
    if (!tn_array_reserve(&m->parts, &m->capacity, m->count, 1, sizeof *m->parts))
        return tn_fail_memory(d->error);
    m->parts[m->count++] = (tn_placed_part){*frame, name};
    return TN_OK;
}

/* Keeps what was filled, where somebody asks what is in the way. */
static tn_status keep_box(derivation *d, const tn_cell_box *box, uint32_t step)
{
    filled_boxes *boxes = &d->boxes;
    if (!d->options.keep_filled)
        return TN_OK;
    if (!tn_array_reserve(&boxes->items, &boxes->capacity, boxes->count, 1, sizeof *boxes->items))
        return tn_fail_memory(d->error);
    boxes->items[boxes->count++] = (filled_box){*box, step, (uint32_t)d->model->count};
    return TN_OK;
}

static tn_status fill(derivation *d, tn_step_kind kind, const tn_cell_box *box, uint32_t step, uint32_t alternative)
{
    if (tn_step_may_fail(kind) && tn_cells_any(d->cells, box)) {
        tn_status looked = tn_cells_status(d->cells, d->error);
        if (looked != TN_OK)
            return looked;
        *d->fault = (tn_place_fault){true, step, alternative, tn_obstacle_find(d, box)};
        return tn_fail(d->error, TN_INVALID, E_PLACE_BLOCKED, "the place of this box is not free");
    }
    tn_status status = keep_box(d, box, step);
    return status == TN_OK ? tn_cells_fill(d->cells, box, d->error) : status;
}

/* Looks at the cells x, then y, then z ascending, and fills those before the first filled one, as the published program
 * does. */
static tn_status touch(derivation *d, const tn_cell_box *box, uint32_t step, uint32_t alternative)
{
    if (tn_cells_has(d->cells, box->low)) /* as mostly: the first */
        return TN_OK;
    if (!tn_cells_any(d->cells, box)) {
        *d->fault = (tn_place_fault){.has_step = true, .step = step, .alternative = alternative};
        return tn_fail(d->error, TN_INVALID, E_PLACE_BLOCKED, "there is nothing to touch here");
    }
    for (int32_t x = box->low[0]; x < box->high[0]; x++) {
        for (int32_t z = box->low[2]; z < box->high[2]; z++) {
            tn_cell_box one = {{x, box->low[1], z}, {x + 1, box->high[1], z + 1}};
            if (tn_cells_any(d->cells, &one))
                return TN_OK;
            tn_status status = tn_cells_fill(d->cells, &one, d->error);
            if (status != TN_OK)
                return status;
        }
    }
    return TN_OK;
}

tn_status tn_take_cells(derivation *d, tn_step_kind kind, const tn_cell_box *box, uint32_t step, uint32_t alternative)
{
    return kind == TN_STEP_TOUCH ? touch(d, box, step, alternative) : fill(d, kind, box, step, alternative);
}
