/* Measures placed models, and holds them to what their kit requires. */
#include "runtime/place/measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/hash_table.h"
#include "runtime/base/random.h"
#include "runtime/module/code.h"
#include "runtime/number/run.h"
#include "runtime/place/joints.h"
#include "runtime/place/space.h"

/* ==== measures placed models */

/* ---- the centre of mass, and its distance to the edge of the hull of what stands on the ground (Andrew's  */

typedef struct point {
    double x, z;
} point;

static int compare(const void *a, const void *b)
{
    const point *one = a, *other = b;
    if (one->x != other->x)
        return one->x < other->x ? -1 : 1;
    return (one->z > other->z) - (one->z < other->z);
}

static double side(const point *a, const point *b, const point *c)
{
    return (b->x - a->x) * (c->z - a->z) - (b->z - a->z) * (c->x - a->x);
}

/* Points in order around the hull; `hull` has room for one more than there are points. */
static size_t make_hull(point *points, size_t count, point *hull)
{
    size_t n = 0;
    qsort(points, count, sizeof *points, compare);
    for (int half = 0; half < 2; half++) {
        size_t start = n + 1;
        for (size_t k = 0; k < count; k++) {
            const point *p = half == 0 ? &points[k] : &points[count - 1 - k];
            while (n > start && side(&hull[n - 2], &hull[n - 1], p) <= 0)
                n--;
            hull[n++] = *p;
        }
        n--; /* the last is the first of the other half */
    }
    return n;
}

static double box_cells(const tn_cell_box *box)
{
    return ((double)box->high[0] - box->low[0]) * ((double)box->high[1] - box->low[1]) *
           ((double)box->high[2] - box->low[2]);
}

typedef struct weighing {
    const tn_module *module;
    const tn_placed_model *model;
    const tn_placed_joints *joints;
    double unit[3];
    bool by_cells;
} weighing;

static double part_cells(const weighing *w, const tn_kit_part_record *kind, const tn_frame *frame)
{
    double cells = 0;
    for (uint32_t b = 0; b < kind->box_count; b++) {
        tn_cell_box box = tn_part_box_at(&w->module->PART_BOX_records[kind->box_first + b], frame);
        cells += box_cells(&box);
    }
    return cells;
}

/* Adds a part's mass at the middles of its boxes. */
static void weigh(const weighing *w, size_t i, point *sum, double *total)
{
    const tn_kit_part_record *kind = w->joints->kinds[i];
    const tn_frame *frame = &w->model->parts[i].frame;
    double cells = kind ? part_cells(w, kind, frame) : 0;
    for (uint32_t b = 0; cells > 0 && b < kind->box_count; b++) {
        tn_cell_box box = tn_part_box_at(&w->module->PART_BOX_records[kind->box_first + b], frame);
        double mass = box_cells(&box) * (w->by_cells ? 1 : kind->mass / cells);
        sum->x += mass * w->unit[0] * ((double)box.low[0] + box.high[0]) / 2;
        sum->z += mass * w->unit[2] * ((double)box.low[2] + box.high[2]) / 2;
        *total += mass;
    }
}

static bool find_centre(weighing *w, point *centre)
{
    double total = 0;
    for (int by_cells = 0; by_cells < 2 && !(total > 0); by_cells++) {
        w->by_cells = by_cells;
        *centre = (point){0};
        for (size_t i = 0; i < w->model->count; i++)
            weigh(w, i, centre, &total);
    }
    centre->x /= total;
    centre->z /= total;
    return total > 0;
}

static size_t list_feet(const weighing *w, int32_t ground, point *points)
{
    size_t count = 0;
    for (size_t i = 0; i < w->model->count; i++) {
        const tn_kit_part_record *kind = w->joints->kinds[i];
        for (uint32_t b = 0; kind && b < kind->box_count; b++) {
            tn_cell_box box =
                tn_part_box_at(&w->module->PART_BOX_records[kind->box_first + b], &w->model->parts[i].frame);
            if (box.high[1] != ground)
                continue;
            for (int corner = 0; points && corner < 4; corner++)
                points[count + (size_t)corner] = (point){w->unit[0] * (corner & 1 ? box.high[0] : box.low[0]),
                                                         w->unit[2] * (corner & 2 ? box.high[2] : box.low[2])};
            count += 4;
        }
    }
    return count;
}

/* To the nearest edge; below 0 outside of one. */
static double distance(const point *hull, size_t count, const point *p)
{
    double least = INFINITY;
    for (size_t i = 0; i < count; i++) {
        const point *a = &hull[i], *b = &hull[(i + 1) % count];
        double length = sqrt((b->x - a->x) * (b->x - a->x) + (b->z - a->z) * (b->z - a->z));
        double away = length > 0 ? side(a, b, p) / length : INFINITY;
        least = away < least ? away : least;
    }
    return least;
}

/* How far the centre of mass is from the edge of the support polygon, in LDU: the convex hull of what lies at the
 * height `ground` (a cell's lower face). Below 0: outside, so that the model falls over. Parts weigh what the kit says;
 * where all of them weigh nothing, they weigh their cells. 0 for a model without known parts. */
static tn_status find_balance(const tn_module *module, const tn_placed_model *model, const tn_placed_joints *joints,
                              int32_t ground, double *balance, tn_error *error)
{
    weighing w = {.module = module, .model = model, .joints = joints};
    point centre;
    *balance = 0;
    tn_place_unit(module, w.unit);
    size_t count = list_feet(&w, ground, NULL);
    if (count == 0 || !find_centre(&w, &centre))
        return TN_OK;
    point *points = calloc(3 * count + 1, sizeof *points);
    if (!points)
        return tn_fail_memory(error);
    list_feet(&w, ground, points);
    point *hull = points + count;
    *balance = distance(hull, make_hull(points, count, hull), &centre);
    free(points);
    return TN_OK;
}

/* ---- boxes */

typedef struct extent {
    tn_cell_box all;
    uint64_t cells;
} extent;

/* Fills the cells of one part after those before it. */
static tn_status fill_part(const tn_module *module, const tn_placed_model *model, tn_placed_measures *m, size_t i,
                           tn_cells *cells, extent *e, tn_error *error)
{
    const tn_kit_part_record *kind = m->joints.kinds[i];
    tn_status status = TN_OK;
    for (uint32_t b = 0; kind && b < kind->box_count; b++) {
        tn_cell_box box = tn_part_box_at(&module->PART_BOX_records[kind->box_first + b], &model->parts[i].frame);
        m->overlaps[i] |= tn_cells_any(cells, &box);
        tn_cell_box_widen(&e->all, &box);
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

void tn_placed_sums(const tn_module *module, const uint64_t *used, double terms[TN_PLACED_TERM_COUNT])
{
    terms[TN_PLACED_MASS] = terms[TN_PLACED_PRICE] = 0;
    for (uint32_t i = 0; i < module->KIT_PART_count; i++) {
        terms[TN_PLACED_MASS] += module->KIT_PART_records[i].mass * (double)used[i];
        terms[TN_PLACED_PRICE] += module->KIT_PART_records[i].price * (double)used[i];
    }
    for (uint32_t c = 0; c < module->COUNTED_count && c < TN_KIT_COUNTED_MAX; c++) {
        const tn_kit_part_record *part = tn_kit_part_named(module, tn_text(module, module->COUNTED_records[c].part));
        terms[TN_PLACED_COUNTED + c] = part ? (double)used[part - module->KIT_PART_records] : 0;
    }
}

/* ---- counts of parts */

typedef struct wanted_part {
    const tn_part_count *counts;
    const char *name;
    int32_t colour;
} wanted_part;

static bool is_wanted(const void *context, uint32_t number)
{
    const wanted_part *w = context;
    const tn_part_count *found = &w->counts[number];
    return found->colour == w->colour && strcmp(found->name, w->name) == 0;
}

/* Texts of one name are one text of the module. */
static uint64_t hash_of(const char *name, int32_t colour)
{
    return tn_mix64((uint64_t)(uintptr_t)name ^ tn_mix64((uint32_t)colour));
}

tn_status tn_place_count_parts(const tn_placed_model *model, tn_part_count **counts, size_t *kinds, tn_error *error)
{
    tn_hash_table index = {0};
    *kinds = 0;
    *counts = calloc(model->count + 1, sizeof **counts);
    tn_status status = *counts ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < model->count && status == TN_OK; i++) {
        const tn_placed_part *part = &model->parts[i];
        wanted_part wanted = {*counts, part->name, part->frame.colour};
        uint32_t number = (uint32_t)*kinds;
        status = tn_hash_enter(&index, hash_of(wanted.name, wanted.colour), is_wanted, &wanted, &number, error);
        if (status != TN_OK)
            break;
        if (number == *kinds)
            (*counts)[(*kinds)++] = (tn_part_count){wanted.name, wanted.colour, 0};
        (*counts)[number].count++;
    }
    tn_hash_clear(&index);
    if (status == TN_OK)
        return TN_OK;
    free(*counts);
    *counts = NULL;
    return status;
}

static tn_status count_kinds(const tn_module *module, const tn_placed_model *model, tn_placed_measures *m,
                             tn_error *error)
{
    tn_part_count *counts;
    size_t kinds, colours = 0;
    uint64_t *used = calloc((size_t)module->KIT_PART_count + 1, sizeof *used);
    if (!used)
        return tn_fail_memory(error);
    for (size_t i = 0; i < model->count; i++)
        if (m->joints.kinds[i])
            used[m->joints.kinds[i] - module->KIT_PART_records]++;
    tn_placed_sums(module, used, m->terms);
    free(used);
    tn_status status = tn_place_count_parts(model, &counts, &kinds, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < kinds; i++) {
        bool seen = false;
        for (size_t j = 0; j < i; j++)
            seen |= counts[j].colour == counts[i].colour;
        colours += !seen;
    }
    m->terms[TN_PLACED_COLOURS] = (double)colours;
    free(counts);
    return TN_OK;
}

/* The cells of a space; 0 if none is known. */
static tn_status count_inside(const tn_module *module, const tn_kit_model_record *space, tn_watch *watch,
                              uint64_t *inside, tn_error *error)
{
    tn_place_rules rules = {.module = module, .space = space};
    tn_space *made;
    *inside = 0;
    if (!space)
        return TN_OK;
    tn_status status = tn_space_new(&rules, &made, error);
    if (status == TN_OK)
        status = tn_space_count(made, watch, inside, error);
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

tn_status tn_placed_measure_inside(const tn_module *module, uint64_t inside, const tn_placed_model *model,
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
    if (status != TN_OK)
        return status;
    measured->terms[TN_PLACED_FILL] = inside ? (double)e.cells / (double)inside : 0;
    set_terms(module, model, measured, &e);
    return find_balance(module, model, &measured->joints, e.all.high[1], &measured->terms[TN_PLACED_BALANCE], error);
}

tn_status tn_placed_measure(const tn_module *module, const tn_kit_model_record *space, const tn_placed_model *model,
                            tn_watch *watch, tn_placed_measures *measured, tn_error *error)
{
    uint64_t inside;
    *measured = (tn_placed_measures){0};
    tn_status status = count_inside(module, space, watch, &inside, error);
    return status == TN_OK ? tn_placed_measure_inside(module, inside, model, watch, measured, error) : status;
}

void tn_placed_measures_clear(tn_placed_measures *measured)
{
    tn_placed_joints_clear(&measured->joints);
    free(measured->floating);
    free(measured->overlaps);
    *measured = (tn_placed_measures){0};
}

/* ==== holds what was placed to what its model requires */

bool tn_kit_condition_holds(const tn_module *module, uint32_t function, const tn_placed_measures *measured)
{
    double value = tn_number_run(module->code, module->FUNCTION_records[function].code_begin, measured->terms);
    return value != 0 && !isnan(value);
}

const tn_kit_condition_record *tn_kit_next_unmet(const tn_module *module, const tn_kit_model_record *model,
                                                 const tn_placed_measures *measured, bool tests, uint32_t *i,
                                                 tn_kit_tally *tally)
{
    while (*i < model->condition_count) {
        const tn_kit_condition_record *condition = &module->KIT_CONDITION_records[model->condition_first + (*i)++];
        if (condition->flags & TN_CONDITION_TEST && !tests)
            continue;
        bool holds = tn_kit_condition_holds(module, condition->holds, measured);
        tally->passed += holds;
        tally->failed += !holds;
        if (!holds)
            return condition;
    }
    return NULL;
}

/* ---- words */

/* What was found of each term that a condition names: "components is 3, fill is 0.8". */
static void write_found(const tn_module *module, uint32_t function, const tn_placed_measures *measured, char *text,
                        size_t size)
{
    const tn_function_record *f = &module->FUNCTION_records[function];
    bool seen[TN_PLACED_TERM_COUNT] = {false};
    size_t used = 0;
    text[0] = '\0';
    tn_instruction i;
    for (uint32_t offset = f->code_begin; offset < f->code_end && used < size; offset += i.length) {
        i = tn_code_read(module->code, offset);
        if (i.opcode != TN_OP_TERM || seen[i.first])
            continue;
        seen[i.first] = true;
        double value = measured->terms[i.first];
        size_t slot = (size_t)i.first - TN_PLACED_COUNTED;
        const char *comma = used ? ", " : "";
        if (i.first >= TN_PLACED_COUNTED && slot < module->COUNTED_count)
            used += (size_t)snprintf(text + used, size - used, "%scount(%.60s) is %.10g", comma,
                                     tn_text(module, module->COUNTED_records[slot].part), value);
        else
            used += (size_t)snprintf(text + used, size - used, "%s%s is %.10g", comma, tn_placed_terms[i.first], value);
    }
}

/* Is the condition about the part of the space that is filled? A larger space does not raise that. */
static bool asks_fill(const tn_module *module, uint32_t function)
{
    const tn_function_record *f = &module->FUNCTION_records[function];
    tn_instruction i;
    for (uint32_t offset = f->code_begin; offset < f->code_end; offset += i.length) {
        i = tn_code_read(module->code, offset);
        if (i.opcode == TN_OP_TERM && i.first == TN_PLACED_FILL)
            return true;
    }
    return false;
}

tn_status tn_kit_fail_condition(const tn_module *module, const tn_kit_condition_record *condition,
                                const tn_kit_model_record *model, const tn_placed_measures *measured, bool placed,
                                tn_error *error)
{
    char found[300];
    write_found(module, condition->holds, measured, found, sizeof found);
    tn_fail(error, TN_INVALID, E_PLACE_CONDITION, "%s %.100s does not meet this: %s", model ? "model" : "the",
            model ? tn_text(module, model->name) : "model", found);
    if (placed)
        tn_error_help(error, "another --seed%s may help",
                      asks_fill(module, condition->holds) ? " or another order of alternatives"
                                                          : ", another order of alternatives, or a larger space");
    return TN_INVALID;
}

/* ---- measuring */

static bool requires_something(const tn_place_rules *rules)
{
    const tn_kit_model_record *model = rules->space;
    for (uint32_t i = 0; model && i < model->condition_count; i++)
        if (!(rules->module->KIT_CONDITION_records[model->condition_first + i].flags & TN_CONDITION_TEST))
            return true;
    return false;
}

tn_status tn_kit_measure_required(const tn_place_rules *rules, const tn_placed_model *model, tn_watch *watch,
                                  bool *required, tn_placed_measures *measured, tn_error *error)
{
    *required = requires_something(rules);
    *measured = (tn_placed_measures){0};
    return *required ? tn_placed_measure(rules->module, rules->space, model, watch, measured, error) : TN_OK;
}
