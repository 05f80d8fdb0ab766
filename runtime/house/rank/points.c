/* Goes to the houses that have a value: by the states that lead to it, tray by tray; then, on a plan, by their numbers
 * among the houses of a section that have it. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/rank/path.h"

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
    tn_tray *trays;        /* [high] of the plan so far */
    uint32_t *plans;       /* [high + 1] its states */
    tn_house_gain *gains;  /* [high] what each tray adds to the plan's part */
    mpz_t given;           /* houses, of those that are counted */
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
    const tn_path_aim aim = {a->s->houses, a->kind, &a->s->wanted, a->s->plans, a->s->gains};
    return tn_aim_leads_on(&aim, a->layer, a->s->length, mark->state, &mark->value);
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
        status = tn_frontier_step(kind->frontier, layer, marks->items[i].state, slice, reach, &a, error);
    }
    return status;
}

static bool mark_start(const tn_seeking *s, tn_leads *marks)
{
    if (!tn_array_reserve_from(&marks->items, &marks->room, 4, 0, 1, sizeof *marks->items))
        return false;
    marks->items[0] = (tn_lead){TN_FRONTIER_NONE, tn_houses_plan_start(s->houses)};
    marks->count = 1;
    return true;
}

/* ---- houses */

static tn_status give(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    tn_seeking *s = context;
    if (!tn_house_variants_keep_tiles(s->variants, house))
        return TN_OK;
    mpz_add_ui(s->given, s->given, 1);
    tn_status status = s->each(s->context, house, &s->stop, error);
    *stop = s->stop;
    return status;
}

static tn_status give_tiles(void *context, tn_house *house, const size_t *tiles, tn_error *error)
{
    tn_seeking *s = context;
    const tn_houses_wanted wanted = {s->houses, s->rules, &s->wanted};
    bool stop = false;
    return tn_houses_furnish(&wanted, house, tiles, give, s, &stop, error);
}

/* The houses that have the functions and faces of the one of this number, which is of the first of them. */
static tn_status give_faced(tn_seeking *s, tn_plan_path *path, const mpz_t number, tn_error *error)
{
    tn_house house;
    bool found = false;
    mpz_t left;
    mpz_init_set(left, number);
    const tn_choosing choosing = {.number = left};
    tn_status status = tn_house_stand(s->houses->form, s->trays, s->length, s->section.shapes, &house, error);
    if (status == TN_OK)
        status = tn_path_choose(path, &choosing, &house, &found, error);
    if (status == TN_OK && found)
        status = tn_house_variants_faced(s->variants, &house, give_tiles, s, error);
    tn_house_clear(&house);
    mpz_clear(left);
    return status;
}

/* A number of which no house is found would be gone to for ever. */
static tn_status give_section(tn_seeking *s, tn_plan_path *path, tn_error *error)
{
    tn_status status = TN_OK;
    mpz_t number;
    mpz_init(number);
    while (status == TN_OK && !s->stop && mpz_cmp(number, tn_path_layer(path, 0)->ahead[0]) < 0) {
        mpz_set_ui(s->given, 0);
        status = give_faced(s, path, number, error);
        mpz_add(number, number, s->given);
        if (status == TN_OK && mpz_sgn(s->given) == 0)
            status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a house that was counted is not found");
    }
    mpz_clear(number);
    return status;
}

/* marks: [kinds] what leads to the end of the plan. */
static tn_status seek_sections(tn_seeking *s, const tn_leads *marks, tn_error *error)
{
    tn_houses *h = s->houses;
    tn_status status = TN_OK;
    s->section = (tn_house){.form = h->form};
    for (bool more = true; status == TN_OK && !s->stop && more;
         more = tn_form_next_section(h->form, s->section.shapes)) {
        if (!tn_house_section_stands(&s->section))
            continue;
        const tn_houses_kind *kind = tn_houses_kind_of(h, &s->section);
        if (marks[kind - h->kinds].count == 0)
            continue;
        const tn_path_aim aim = {h, kind, &s->wanted, s->plans, s->gains};
        tn_plan_path path;
        status = tn_path_find_valued(&path, &aim, s->trays, s->length, error);
        if (status == TN_OK)
            status = give_section(s, &path, error);
        tn_path_clear(&path);
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
        const tn_frontier_list *list = &h->kinds[i].frontier->slices.of_tray[tray];
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
        return seek_sections(s, marks, error);
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
    mpz_init(s.given);
    tn_status status = s.trays && s.plans && s.gains ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && values_need_faces(h->measures))
        status = tn_house_rules_new(h->form, 0, &s.rules, error);
    for (s.length = h->low; status == TN_OK && !s.stop && s.length <= h->high; s.length++)
        status = seek_length(&s, error);
    tn_house_rules_free(s.rules);
    free(s.trays);
    free(s.plans);
    free(s.gains);
    mpz_clear(s.given);
    return status;
}
