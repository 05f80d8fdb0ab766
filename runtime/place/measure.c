/* Measures placed models. */
#include "runtime/place/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/number/run.h"
#include "runtime/place/balance.h"
#include "runtime/place/space.h"
#include "runtime/place/write.h"

/* ---- boxes */

typedef struct extent {
    tn_cell_box all;
    uint64_t cells;
} extent;

static void widen(tn_cell_box *all, const tn_cell_box *box)
{
    for (int k = 0; k < 3; k++) {
        all->low[k] = box->low[k] < all->low[k] ? box->low[k] : all->low[k];
        all->high[k] = box->high[k] > all->high[k] ? box->high[k] : all->high[k];
    }
}

/* Fills the cells of one part after those before it. */
static tn_status fill_part(const tn_module *module, const tn_placed_model *model, tn_placed_measures *m, size_t i,
                           tn_cells *cells, extent *e, tn_error *error)
{
    const tn_kit_part_record *kind = m->joints.kinds[i];
    tn_status status = TN_OK;
    for (uint32_t b = 0; kind && b < kind->box_count; b++) {
        tn_cell_box box = tn_part_box_at(&module->PART_BOX_records[kind->box_first + b], &model->parts[i].frame);
        m->overlaps[i] |= tn_cells_any(cells, &box);
        widen(&e->all, &box);
    }
    for (uint32_t b = 0; kind && b < kind->box_count && status == TN_OK; b++) {
        tn_cell_box box = tn_part_box_at(&module->PART_BOX_records[kind->box_first + b], &model->parts[i].frame);
        status = tn_cells_fill(cells, &box, error);
    }
    return status;
}

static tn_status fill_cells(const tn_module *module, const tn_placed_model *model, tn_watch *watch,
                            tn_placed_measures *m, extent *e, tn_error *error)
{
    tn_cells *cells = tn_cells_new(watch);
    tn_status status = cells ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < model->count && status == TN_OK; i++)
        status = fill_part(module, model, m, i, cells, e, error);
    if (status == TN_OK)
        e->cells = tn_cells_count(cells);
    tn_cells_free(cells);
    return status;
}

/* ---- the ground */

static bool touches_ground(const tn_module *module, const tn_placed_model *model, const tn_placed_measures *m, size_t i,
                           int32_t ground)
{
    const tn_kit_part_record *kind = m->joints.kinds[i];
    for (uint32_t b = 0; kind && b < kind->box_count; b++)
        if (tn_part_box_at(&module->PART_BOX_records[kind->box_first + b], &model->parts[i].frame).high[1] == ground)
            return true;
    return false;
}

/* Parts of pieces that do not reach the lowest height. A piece is marked at its lowest part first. */
static uint32_t find_floating(const tn_module *module, const tn_placed_model *model, tn_placed_measures *m,
                              int32_t ground)
{
    uint32_t count = 0;
    for (size_t i = 0; i < model->count; i++)
        m->floating[i] = true;
    for (size_t i = 0; i < model->count; i++)
        if (touches_ground(module, model, m, i, ground))
            m->floating[m->joints.component[i]] = false;
    for (size_t i = 0; i < model->count; i++) {
        m->floating[i] = m->floating[m->joints.component[i]];
        count += m->floating[i];
    }
    return count;
}

/* ---- sums */

static tn_status count_kinds(const tn_module *module, const tn_placed_model *model, tn_placed_measures *m,
                             tn_error *error)
{
    tn_part_count *counts;
    size_t kinds, colours = 0;
    tn_status status = tn_place_count_parts(model, &counts, &kinds, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < kinds; i++) {
        bool seen = false;
        for (size_t j = 0; j < i; j++)
            seen |= counts[j].colour == counts[i].colour;
        colours += !seen;
        const tn_kit_part_record *kind = tn_kit_part_named(module, counts[i].name);
        m->terms[TN_PLACED_MASS] += kind ? kind->mass * (double)counts[i].count : 0;
        m->terms[TN_PLACED_PRICE] += kind ? kind->price * (double)counts[i].count : 0;
        for (uint32_t c = 0; c < module->COUNTED_count && c < TN_KIT_COUNTED_MAX; c++)
            if (strcmp(tn_text(module, module->COUNTED_records[c].part), counts[i].name) == 0)
                m->terms[TN_PLACED_COUNTED + c] += (double)counts[i].count;
    }
    m->terms[TN_PLACED_COLOURS] = (double)colours;
    free(counts);
    return TN_OK;
}

/* The share of the space's cells that is filled. */
static tn_status find_fill(const tn_module *module, const tn_kit_model_record *space, tn_watch *watch, double cells,
                           double *fill, tn_error *error)
{
    tn_place_rules rules = {.module = module, .space = space};
    tn_space *made;
    uint64_t inside = 0;
    *fill = 0;
    if (!space)
        return TN_OK;
    tn_status status = tn_space_new(&rules, &made, error);
    if (status == TN_OK)
        status = tn_space_count(made, watch, &inside, error);
    if (status == TN_OK && inside > 0)
        *fill = cells / (double)inside;
    tn_space_free(made);
    return status;
}

static void set_terms(const tn_module *module, const tn_placed_model *model, tn_placed_measures *m, const extent *e)
{
    double unit[3];
    bool any = e->cells > 0;
    const tn_placed_joints *joints = &m->joints;
    tn_place_unit(module, unit);
    m->terms[TN_PLACED_ELEMENTS] = (double)model->count;
    m->terms[TN_PLACED_CELLS] = (double)e->cells;
    m->terms[TN_PLACED_JOINTS] = (double)joints->joint_count;
    m->terms[TN_PLACED_COMPONENTS] = joints->component_count;
    m->terms[TN_PLACED_CUTS] = joints->cut_count;
    m->terms[TN_PLACED_OPEN] = (double)joints->open_count;
    m->terms[TN_PLACED_FLOATING] = find_floating(module, model, m, e->all.high[1]);
    m->terms[TN_PLACED_WIDTH] = any ? ((double)e->all.high[0] - e->all.low[0]) * unit[0] : 0;
    m->terms[TN_PLACED_HEIGHT] = any ? ((double)e->all.high[1] - e->all.low[1]) * unit[1] : 0;
    m->terms[TN_PLACED_DEPTH] = any ? ((double)e->all.high[2] - e->all.low[2]) * unit[2] : 0;
    for (size_t i = 0; i < model->count; i++)
        m->terms[TN_PLACED_OVERLAPS] += m->overlaps[i];
}

tn_status tn_placed_measure(const tn_module *module, const tn_kit_model_record *space, const tn_placed_model *model,
                            tn_watch *watch, tn_placed_measures *measured, tn_error *error)
{
    extent e = {.all = {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}}};
    *measured = (tn_placed_measures){0};
    measured->floating = calloc(model->count + 1, sizeof *measured->floating);
    measured->overlaps = calloc(model->count + 1, sizeof *measured->overlaps);
    if (!measured->floating || !measured->overlaps)
        return tn_fail_memory(error);
    tn_status status = tn_placed_joints_find(module, model, watch, &measured->joints, error);
    if (status == TN_OK)
        status = fill_cells(module, model, watch, measured, &e, error);
    if (status == TN_OK)
        status = count_kinds(module, model, measured, error);
    if (status == TN_OK)
        status = find_fill(module, space, watch, (double)e.cells, &measured->terms[TN_PLACED_FILL], error);
    if (status != TN_OK)
        return status;
    set_terms(module, model, measured, &e);
    return tn_balance(module, model, &measured->joints, e.all.high[1], &measured->terms[TN_PLACED_BALANCE], error);
}

void tn_placed_measures_clear(tn_placed_measures *measured)
{
    tn_placed_joints_clear(&measured->joints);
    free(measured->floating);
    free(measured->overlaps);
    *measured = (tn_placed_measures){0};
}

bool tn_kit_condition_holds(const tn_module *module, uint32_t function, const tn_placed_measures *measured)
{
    double value = tn_number_run(module->code, module->FUNCTION_records[function].code_begin, measured->terms);
    return value != 0 && !isnan(value);
}
