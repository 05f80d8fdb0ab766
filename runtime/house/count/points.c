/* Goes to the houses that have a value: by the states that lead to it, first tray by tray, then, on a plan, section by
 * section and the functions of one tray after another. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/count/best.h"
#include "runtime/house/count/data.h"

/* States that the row so far leads to, each with a value, from which the wanted value is reached. */
typedef struct tn_lead {
    uint32_t state;
    tn_house_gain value;
} tn_lead;

typedef struct tn_leads {
    tn_lead *items;
    size_t count, room;
} tn_leads;

typedef struct tn_seeking {
    tn_houses *houses;
    tn_house_variants *variants;
    tn_house_gain wanted;
    uint32_t length;
    tn_tray *trays;       /* [high] of the plan so far */
    uint32_t *plans;      /* [high + 1] its states */
    tn_house_gain *gains; /* [high] what each tray adds to the plan's part */
    uint32_t *functions;  /* of the cells of the trays so far */
    size_t function_count, function_room;
    tn_house section;      /* its shapes only */
    tn_house_rules *rules; /* NULL: the functions say what the value is */
    bool stop;
    tn_house_each *each;
    void *context;
} tn_seeking;

/* ---- from tray to tray */

typedef struct tn_advancing {
    const tn_seeking *s;
    const tn_houses_kind *kind;
    uint32_t layer; /* behind the step */
    tn_house_gain before;
    tn_leads *next;
} tn_advancing;

/* Is the wanted value reached from here? */
static bool leads_on(const tn_advancing *a, const tn_lead *mark)
{
    const tn_houses *h = a->s->houses;
    const tn_houses_layer *layer = &a->kind->layers[a->layer];
    uint32_t node = tn_number_find(&layer->nodes, (uint64_t)a->s->plans[a->layer] << 32 | mark->state);
    tn_house_gain left;
    if (node == UINT32_MAX)
        return false;
    for (size_t k = 0; k < TN_WEIGHED_MAX; k++)
        left.by[k] = a->s->wanted.by[k] - mark->value.by[k];
    return tn_value_counts_has(&layer->best[(size_t)node * tn_houses_lengths(h) + a->s->length - h->low], &left);
}

static tn_status reach(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                       tn_error *error)
{
    const tn_advancing *a = context;
    const tn_lead mark = {state, tn_house_gain_sum(&a->before, gain)};
    tn_leads *next = a->next;
    (void)times;
    (void)faced;
    if (!leads_on(a, &mark))
        return TN_OK;
    for (size_t i = 0; i < next->count; i++)
        if (next->items[i].state == state && tn_house_gain_compare(&next->items[i].value, &mark.value) == 0)
            return TN_OK;
    if (!tn_array_reserve_from(&next->items, &next->room, 4, next->count, 1, sizeof *next->items))
        return tn_fail_memory(error);
    next->items[next->count++] = mark;
    return TN_OK;
}

/* next := where a slice leads from the marks; layer: before it. */
static tn_status advance(const tn_seeking *s, const tn_houses_kind *kind, uint32_t layer, const tn_leads *marks,
                         uint32_t slice, tn_leads *next, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < marks->count; i++) {
        tn_advancing a = {s, kind, layer + 1, tn_house_gain_sum(&marks->items[i].value, &s->gains[layer]), next};
        status = tn_strip_step(kind->strip, layer, marks->items[i].state, slice, reach, &a, error);
    }
    return status;
}

static bool mark_start(const tn_seeking *s, tn_leads *marks)
{
    if (!tn_array_reserve_from(&marks->items, &marks->room, 4, 0, 1, sizeof *marks->items))
        return false;
    marks->items[0] = (tn_lead){TN_STRIP_NONE, tn_houses_plan_start(s->houses)};
    marks->count = 1;
    return true;
}

/* ---- houses */

static tn_status give(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    tn_seeking *s = context;
    if (!tn_house_variants_keep_tiles(s->variants, house))
        return TN_OK;
    tn_status status = s->each(s->context, house, &s->stop, error);
    *stop = s->stop;
    return status;
}

static tn_status give_faced(void *context, tn_house *house, const size_t *tiles, bool *stop, tn_error *error)
{
    tn_seeking *s = context;
    const tn_houses_wanted wanted = {s->houses, s->rules, &s->wanted};
    return tn_houses_furnish(&wanted, house, tiles, give, s, stop, error);
}

static tn_status give_houses(tn_seeking *s, tn_error *error)
{
    tn_house house;
    tn_status status = tn_house_stand(s->houses->form, s->trays, s->length, s->section.shapes, &house, error);
    for (size_t i = 0; status == TN_OK && i < house.cell_count; i++)
        house.cells[i].function = s->functions[i];
    if (status == TN_OK)
        status = tn_house_variants_like(s->variants, &house, give_faced, s, error);
    tn_house_clear(&house);
    return status;
}

/* ---- functions */

static bool take_functions(tn_seeking *s, size_t first, const tn_strip_functioned *furnished)
{
    s->function_count = first;
    if (!tn_array_reserve(&s->functions, &s->function_room, first, furnished->cells + 1, sizeof *s->functions))
        return false;
    for (size_t i = 0; i < furnished->cells; i++)
        s->functions[s->function_count++] = furnished->functions[i];
    return true;
}

static tn_status seek_functions(tn_seeking *s, const tn_houses_kind *kind, uint32_t layer, const tn_leads *marks,
                                tn_error *error);

/* The slices in order, those of the same functions together. */
static tn_status seek_furnished(tn_seeking *s, const tn_houses_kind *kind, uint32_t layer, const tn_leads *marks,
                                const tn_strip_functioned *slices, size_t count, tn_error *error)
{
    tn_status status = TN_OK;
    size_t first = s->function_count;
    for (size_t i = 0, end; status == TN_OK && !s->stop && i < count; i = end) {
        tn_leads next = {0};
        for (end = i; status == TN_OK && end < count && tn_strip_functioned_compare(&slices[i], &slices[end]) == 0;
             end++)
            status = advance(s, kind, layer, marks, slices[end].slice, &next, error);
        if (status == TN_OK && next.count > 0)
            status = take_functions(s, first, &slices[i]) ? seek_functions(s, kind, layer + 1, &next, error)
                                                          : tn_fail_memory(error);
        free(next.items);
    }
    s->function_count = first;
    return status;
}

static tn_status seek_functions(tn_seeking *s, const tn_houses_kind *kind, uint32_t layer, const tn_leads *marks,
                                tn_error *error)
{
    if (layer == s->length)
        return give_houses(s, error);
    size_t count;
    tn_strip_functioned *slices = tn_strip_functioned_of(kind->strip, s->trays[layer], &count);
    if (!slices)
        return tn_fail_memory(error);
    tn_status status = seek_furnished(s, kind, layer, marks, slices, count, error);
    free(slices);
    return status;
}

static tn_status seek_sections(tn_seeking *s, tn_error *error)
{
    tn_status status = TN_OK;
    s->section = (tn_house){.form = s->houses->form};
    for (bool more = true; status == TN_OK && !s->stop && more;
         more = tn_form_next_section(s->houses->form, s->section.shapes)) {
        tn_leads marks = {0};
        if (!tn_house_section_stands(&s->section))
            continue;
        s->function_count = 0;
        status = mark_start(s, &marks) ? TN_OK : tn_fail_memory(error);
        if (status == TN_OK)
            status = seek_functions(s, tn_houses_kind_of(s->houses, &s->section), 0, &marks, error);
        free(marks.items);
    }
    return status;
}

/* ---- plans */

static void free_marks(const tn_houses *h, tn_leads *marks)
{
    for (size_t i = 0; marks && i < h->kind_count; i++)
        free(marks[i].items);
    free(marks);
}

static tn_status seek_trays(tn_seeking *s, uint32_t layer, const tn_leads *marks, tn_error *error);

/* marks: [kinds]. */
static tn_status seek_tray(tn_seeking *s, uint32_t layer, const tn_leads *marks, tn_tray tray, tn_error *error)
{
    const tn_houses *h = s->houses;
    bool any = false;
    tn_status status =
        tn_houses_plan_next(h, layer, s->plans[layer], tray, &s->plans[layer + 1], &s->gains[layer], error);
    if (status != TN_OK || !tn_houses_plan_alive(h, s->length - layer - 1, s->plans[layer + 1]))
        return status;
    tn_leads *next = calloc(h->kind_count + 1, sizeof *next);
    if (!next)
        return tn_fail_memory(error);
    s->trays[layer] = tray;
    for (size_t i = 0; status == TN_OK && i < h->kind_count; i++) {
        const tn_strip_list *list = &h->kinds[i].strip->of_tray[tray];
        for (size_t k = 0; status == TN_OK && k < list->count; k++)
            status = advance(s, &h->kinds[i], layer, &marks[i], list->items[k].slice, &next[i], error);
        any = any || next[i].count > 0;
    }
    if (status == TN_OK && any)
        status = seek_trays(s, layer + 1, next, error);
    free_marks(h, next);
    return status;
}

static tn_status seek_trays(tn_seeking *s, uint32_t layer, const tn_leads *marks, tn_error *error)
{
    tn_status status = tn_watch_check(s->houses->form->module->watch, error);
    if (status == TN_OK && layer == s->length)
        return seek_sections(s, error);
    for (tn_tray t = 0; status == TN_OK && !s->stop && t < s->houses->form->schema->tray_count; t++)
        status = seek_tray(s, layer, marks, t, error);
    return status;
}

/* ---- all lengths */

static bool values_need_faces(const tn_house_measures *measures)
{
    for (uint32_t k = 0; k < measures->count; k++)
        for (uint32_t i = 0; i < measures->of[k]->count; i++)
            if (measures->of[k]->terms[i].kind != TN_HOUSE_CELLS && measures->of[k]->terms[i].kind != TN_HOUSE_AREAS)
                return true;
    return false;
}

static tn_status seek_length(tn_seeking *s, tn_error *error)
{
    const tn_houses *h = s->houses;
    tn_leads *marks = calloc(h->kind_count + 1, sizeof *marks);
    bool ok = marks != NULL;
    for (size_t i = 0; ok && i < h->kind_count; i++) {
        const tn_advancing start = {.s = s, .kind = &h->kinds[i]};
        ok = mark_start(s, &marks[i]);
        marks[i].count = ok && leads_on(&start, &marks[i].items[0]);
    }
    tn_status status = ok ? seek_trays(s, 0, marks, error) : tn_fail_memory(error);
    free_marks(h, marks);
    return status;
}

tn_status tn_houses_point_each(tn_houses *h, size_t point, tn_house_variants *variants, tn_house_each *each,
                               void *context, tn_error *error)
{
    tn_seeking s = {
        .houses = h, .variants = variants, .wanted = h->best.items[point].value, .each = each, .context = context};
    s.trays = malloc(((size_t)h->high + 1) * sizeof *s.trays);
    s.plans = calloc((size_t)h->high + 1, sizeof *s.plans);
    s.gains = malloc(((size_t)h->high + 1) * sizeof *s.gains);
    tn_status status = s.trays && s.plans && s.gains ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && values_need_faces(h->measures))
        status = tn_house_rules_new(h->form, 0, &s.rules, error);
    for (s.length = h->low; status == TN_OK && !s.stop && s.length <= h->high; s.length++)
        status = seek_length(&s, error);
    tn_house_rules_free(s.rules);
    free(s.trays);
    free(s.plans);
    free(s.gains);
    free(s.functions);
    return status;
}
