/* Goes to the houses that have a value: by the states that lead to it, tray by tray; then, on a plan, by their numbers
 * among the houses of a section that have it. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/rank/path.h"
#include "runtime/house/rule/furnish.h"
#include "runtime/house/schedule/cost.h"

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
    tn_furnisher *furnisher; /* borrowed of the houses */
    tn_house_gain wanted;
    uint32_t length;
    tn_tray *trays;        /* [high] of the plan so far */
    uint32_t *plans;       /* [high + 1] its states */
    tn_house_gain *gains;  /* [high] what each tray adds to the plan's part */
    mpz_t tiles;           /* combinations of a house's tiles */
    tn_house section;      /* its shapes only */
    tn_house_rules *rules; /* NULL: the functions say what the value is */
    bool stop;
    tn_house_alike alike;
    bool next; /* of this plan nothing more is shown */
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

/* Does a measure add up costs? */
static bool adds_costs(const tn_houses *h)
{
    bool asks = false;
    for (uint32_t k = 0; h->measures && k < h->measures->count; k++)
        asks = asks || h->units.costs[k] != 0;
    return asks;
}

/* A measure's value of the house without its tiles, in steps. */
static tn_status value_of(const tn_seeking *s, uint32_t k, const mpq_t shell, tn_int128 *steps, tn_error *error)
{
    const tn_houses *h = s->houses;
    tn_worth worth; /* houses are counted by measures that all of them have */
    mpq_t value, cost;
    mpq_inits(value, cost, NULL);
    tn_status status = tn_house_rules_measure(s->rules, h->measures->of[k]->of, value, cost, &worth, error);
    mpq_mul(cost, cost, shell);
    mpq_add(value, value, cost);
    if (status == TN_OK && !tn_steps_of(value, h->units.measures[k], steps))
        status = tn_too_fine(error);
    mpq_clears(value, cost, NULL);
    return status;
}

/* *fits: can the house have the values? *left: what its tiles cost then, in steps. */
static tn_status find_left(const tn_seeking *s, const tn_house *house, bool *fits, tn_int128 *left, tn_error *error)
{
    const tn_houses *h = s->houses;
    bool known = false;
    mpq_t shell;
    *fits = true;
    *left = 0;
    if (!s->rules)
        return TN_OK;
    mpq_init(shell);
    tn_status status = tn_house_rules_start(s->rules, house, error);
    if (status == TN_OK && adds_costs(h))
        status = tn_house_exact_cost(house, tn_house_shell, shell, error);
    for (uint32_t k = 0; status == TN_OK && *fits && k < h->measures->count; k++) {
        tn_int128 value = 0, all = s->wanted.by[k] * (h->measures->most[k] ? -1 : 1);
        status = value_of(s, k, shell, &value, error);
        tn_int128 each = h->units.costs[k], rest = all - value;
        tn_int128 tiles = each ? rest / each : 0;
        *fits = tiles * each == rest && (!known || each == 0 || tiles == *left);
        *left = each ? tiles : *left;
        known = known || each;
    }
    mpq_clear(shell);
    return status;
}

/* The house without tiles has the functions and faces of the wanted ones; those of its tiles with which it has the
 * value are the same number of combinations as were counted. */
static tn_status give_faced(void *context, tn_house *house, const mpz_t before, bool *stop, tn_error *error)
{
    tn_seeking *s = context;
    tn_int128 left = 0;
    bool fits = false;
    mpq_t cost;
    (void)before;
    mpq_init(cost);
    tn_status status = find_left(s, house, &fits, &left, error);
    tn_steps_number(left, s->houses->units.cost, cost);
    mpz_set_ui(s->tiles, 0);
    if (status == TN_OK && fits)
        status = tn_furnish(s->furnisher, house, adds_costs(s->houses) ? cost : NULL, s->tiles, error);
    mpq_clear(cost);
    if (status == TN_OK && mpz_sgn(s->tiles) == 0)
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a house that was counted is not found");
    mpz_set_ui(s->tiles, 0);
    if (status == TN_OK)
        tn_furnish_at(s->furnisher, s->tiles);
    for (bool more = status == TN_OK; more && !s->stop;) {
        status = s->each(s->context, house, &s->stop, error);
        more = status == TN_OK && s->alike == TN_ALIKE_NOTHING && tn_furnish_next(s->furnisher);
    }
    s->next = s->alike == TN_ALIKE_PLAN;
    *stop = s->stop;
    return status;
}

/* All houses of the section that have the value. */
static tn_status give_section(tn_seeking *s, tn_plan_path *path, tn_error *error)
{
    tn_house house;
    mpz_t number;
    mpz_init(number);
    tn_choosing choosing = {.number = number, .alike = s->alike, .faced = give_faced, .context = s};
    tn_status status = tn_house_stand(s->houses->form, s->trays, s->length, s->section.shapes, &house, error);
    if (status == TN_OK && mpz_sgn(tn_path_layer(path, 0)->ahead[0]) > 0)
        status = tn_path_choose(path, &choosing, &house, error);
    tn_house_clear(&house);
    mpz_clear(number);
    return status;
}

/* marks: [kinds] what leads to the end of the plan. */
static tn_status seek_sections(tn_seeking *s, const tn_leads *marks, tn_error *error)
{
    tn_houses *h = s->houses;
    tn_status status = TN_OK;
    s->section = (tn_house){.form = h->form};
    s->next = false;
    for (bool more = true; status == TN_OK && !s->stop && !s->next && more;
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

tn_status tn_houses_point_each(tn_houses *h, size_t point, tn_house_alike alike, tn_house_each *each, void *context,
                               tn_error *error)
{
    tn_seeking s = {
        .houses = h, .wanted = h->best.items[point].value, .alike = alike, .each = each, .context = context};
    s.trays = malloc(((size_t)h->high + 1) * sizeof *s.trays);
    s.plans = calloc((size_t)h->high + 1, sizeof *s.plans);
    s.gains = malloc(((size_t)h->high + 1) * sizeof *s.gains);
    mpz_init(s.tiles);
    tn_status status = s.trays && s.plans && s.gains ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_houses_furnisher(h, &s.furnisher, error);
    if (status == TN_OK && values_need_faces(h->measures))
        status = tn_house_rules_new(h->form, 0, &s.rules, error);
    for (s.length = h->low; status == TN_OK && !s.stop && s.length <= h->high; s.length++)
        status = seek_length(&s, error);
    tn_house_rules_free(s.rules);
    free(s.trays);
    free(s.plans);
    free(s.gains);
    mpz_clear(s.tiles);
    return status;
}
