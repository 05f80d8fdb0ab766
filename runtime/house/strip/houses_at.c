/* The house of a number among those on one plan: section by section, then the functions of one tray after another,
 * counted as a whole library is; then its faces and tiles, of which there are few (runtime/house/variant).
 *
 * The states that the plan reaches are found forwards, and how many houses go on from each backwards. A walk along the
 * plan then has, for each state that the functions so far reach, the number of choices that lead there. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/strip/houses_data.h"

/* The states after so many trays of the plan. */
typedef struct tn_plan_states {
    tn_numbering of;
    mpz_t *ahead, *here; /* [of] houses that go on from there; choices that lead there */
} tn_plan_states;

typedef struct tn_on_plan {
    tn_strip *strip;
    const tn_tray *trays;
    uint32_t length;
    tn_plan_states *layers; /* [length + 1] */
    mpz_t one;
} tn_on_plan;

/* ---- how many houses go on from each state */

static tn_status reach(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                       tn_error *error)
{
    tn_plan_states *next = context;
    (void)times;
    (void)faced;
    (void)gain;
    return tn_number(&next->of, state) != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static tn_status find_states(tn_on_plan *p, tn_error *error)
{
    tn_status status = tn_number(&p->layers[0].of, TN_STRIP_NONE) != UINT32_MAX ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < p->length; i++) {
        const tn_strip_list *list = &p->strip->of_tray[p->trays[i]];
        for (uint32_t s = 0; status == TN_OK && s < p->layers[i].of.count; s++) {
            uint32_t state = (uint32_t)p->layers[i].of.keys[s];
            status = tn_watch_check(p->strip->watch, error);
            for (size_t k = 0; status == TN_OK && k < list->count; k++)
                status = tn_strip_step(p->strip, i, state, list->items[k].slice, reach, &p->layers[i + 1], error);
        }
    }
    return status;
}

/* sum: of the houses that go on from where steps lead. next: NULL behind the last tray. */
typedef struct tn_plan_summing {
    const tn_plan_states *next;
    mpz_t sum;
} tn_plan_summing;

static tn_status add_ahead(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                           tn_error *error)
{
    tn_plan_summing *s = context;
    (void)faced;
    (void)gain;
    (void)error;
    if (!s->next)
        mpz_add_ui(s->sum, s->sum, times);
    else
        mpz_addmul_ui(s->sum, s->next->ahead[tn_number_find(&s->next->of, state)], times);
    return TN_OK;
}

static tn_status count_ahead(tn_on_plan *p, uint32_t layer, uint32_t at, tn_plan_summing *s, tn_error *error)
{
    uint32_t state = (uint32_t)p->layers[layer].of.keys[at];
    mpz_ptr ahead = p->layers[layer].ahead[at];
    s->next = layer < p->length ? &p->layers[layer + 1] : NULL;
    mpz_set_ui(s->sum, 0);
    if (!s->next) {
        tn_status status = tn_strip_step(p->strip, layer, state, TN_STRIP_NONE, add_ahead, s, error);
        mpz_set(ahead, s->sum);
        return status;
    }
    const tn_strip_list *list = &p->strip->of_tray[p->trays[layer]];
    tn_status status = tn_watch_check(p->strip->watch, error);
    for (size_t k = 0; status == TN_OK && k < list->count; k++) {
        mpz_set_ui(s->sum, 0);
        status = tn_strip_step(p->strip, layer, state, list->items[k].slice, add_ahead, s, error);
        mpz_addmul_ui(ahead, s->sum, list->items[k].times);
    }
    return status;
}

static tn_status look_ahead(tn_on_plan *p, tn_error *error)
{
    tn_plan_summing s = {0};
    tn_status status = TN_OK;
    mpz_init(s.sum);
    for (uint32_t layer = p->length + 1; status == TN_OK && layer-- > 0;) {
        tn_plan_states *states = &p->layers[layer];
        states->ahead = tn_integers_new(states->of.count);
        states->here = tn_integers_new(states->of.count);
        status = states->ahead && states->here ? TN_OK : tn_fail_memory(error);
        for (uint32_t i = 0; status == TN_OK && i < states->of.count; i++)
            status = count_ahead(p, layer, i, &s, error);
    }
    mpz_clear(s.sum);
    return status;
}

static tn_status begin(tn_on_plan *p, tn_error *error)
{
    p->layers = calloc((size_t)p->length + 1, sizeof *p->layers);
    tn_status status = p->layers ? find_states(p, error) : tn_fail_memory(error);
    return status == TN_OK ? look_ahead(p, error) : status;
}

static void end(tn_on_plan *p)
{
    for (uint32_t i = 0; p->layers && i <= p->length; i++) {
        tn_plan_states *states = &p->layers[i];
        if (states->ahead)
            tn_integers_free(states->ahead, states->of.count);
        if (states->here)
            tn_integers_free(states->here, states->of.count);
        tn_numbering_clear(&states->of);
    }
    free(p->layers);
    mpz_clear(p->one);
}

/* ---- functions, tray by tray */

/* houses += those that have this slice in this place, with the functions so far. */
static tn_status add_slice(tn_on_plan *p, uint32_t layer, const tn_strip_functioned *slice, mpz_t houses,
                           tn_error *error)
{
    const tn_plan_states *states = &p->layers[layer];
    tn_plan_summing s = {.next = &p->layers[layer + 1]};
    tn_status status = TN_OK;
    mpz_init(s.sum);
    for (uint32_t i = 0; status == TN_OK && i < states->of.count; i++) {
        if (mpz_sgn(states->here[i]) == 0)
            continue;
        mpz_set_ui(s.sum, 0);
        status = tn_strip_step(p->strip, layer, (uint32_t)states->of.keys[i], slice->slice, add_ahead, &s, error);
        mpz_mul(s.sum, s.sum, states->here[i]);
        mpz_addmul_ui(houses, s.sum, slice->times);
    }
    mpz_clear(s.sum);
    return status;
}

typedef struct tn_leading {
    tn_plan_states *next;
    mpz_ptr choices;
} tn_leading;

static tn_status lead_to(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                         tn_error *error)
{
    tn_leading *l = context;
    (void)faced;
    (void)gain;
    (void)error;
    mpz_addmul_ui(l->next->here[tn_number_find(&l->next->of, state)], l->choices, times);
    return TN_OK;
}

static tn_status take_slice(tn_on_plan *p, uint32_t layer, const tn_strip_functioned *slice, tn_error *error)
{
    const tn_plan_states *states = &p->layers[layer];
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < states->of.count; i++) {
        tn_leading l = {&p->layers[layer + 1], p->one};
        mpz_mul_ui(p->one, states->here[i], slice->times);
        if (mpz_sgn(p->one) != 0)
            status = tn_strip_step(p->strip, layer, (uint32_t)states->of.keys[i], slice->slice, lead_to, &l, error);
    }
    return status;
}

/* The slices [first, *end) have the functions with which the house of that number goes on. variant becomes its number
 * among the houses with these. */
static tn_status choose(tn_on_plan *p, uint32_t layer, const tn_strip_functioned *slices, size_t count, mpz_t variant,
                        size_t *first, size_t *end, tn_error *error)
{
    mpz_t houses;
    mpz_init(houses);
    tn_status status = TN_OK;
    for (*first = 0; status == TN_OK && *first < count; *first = *end) {
        mpz_set_ui(houses, 0);
        for (*end = *first;
             status == TN_OK && *end < count && tn_strip_functioned_compare(&slices[*first], &slices[*end]) == 0;
             ++*end)
            status = add_slice(p, layer, &slices[*end], houses, error);
        if (status != TN_OK || mpz_cmp(variant, houses) < 0)
            break;
        mpz_sub(variant, variant, houses);
    }
    mpz_clear(houses);
    return status;
}

/* house: on the plan in the section. The number is less than that of its houses. */
static tn_status set_functions(tn_on_plan *p, mpz_t variant, tn_house *house, tn_error *error)
{
    tn_status status = TN_OK;
    uint32_t cell = 0;
    mpz_set_ui(p->layers[0].here[0], 1);
    for (uint32_t i = 0; status == TN_OK && i < p->length; i++) {
        size_t count, first = 0, last = 0;
        tn_strip_functioned *slices = tn_strip_functioned_of(p->strip, p->trays[i], &count);
        status = slices ? choose(p, i, slices, count, variant, &first, &last, error) : tn_fail_memory(error);
        for (size_t k = 0; status == TN_OK && k < slices[first].cells; k++)
            house->cells[cell++].function = slices[first].functions[k];
        for (size_t k = first; status == TN_OK && k < last; k++)
            status = take_slice(p, i, &slices[k], error);
        free(slices);
    }
    return status;
}

/* ---- houses */

/* The house with those functions of a number among those in the section; or the number less all of these. */
static tn_status try_section(tn_houses *h, tn_house_variants *variants, tn_on_plan *p, const uint32_t *shapes,
                             mpz_t variant, bool *found, tn_house *house, tn_error *error)
{
    tn_house like;
    mpz_ptr all = p->layers[0].ahead[0];
    *found = mpz_cmp(variant, all) < 0;
    if (!*found) {
        mpz_sub(variant, variant, all);
        return TN_OK;
    }
    tn_status status = tn_house_stand(h->form, p->trays, p->length, shapes, &like, error);
    if (status == TN_OK)
        status = set_functions(p, variant, &like, error);
    if (status == TN_OK)
        status = tn_house_variants_like_at(variants, &like, variant, house, error);
    tn_house_clear(&like);
    return status;
}

/* What is ahead on the plan in a section, found once for all that nothing tells apart from it. */
static tn_status on_plan(tn_on_plan *plans, const tn_houses *h, const tn_house *section, tn_on_plan **plan,
                         tn_error *error)
{
    const tn_houses_kind *kind = tn_houses_kind_of(h, section);
    *plan = &plans[kind - h->kinds];
    if ((*plan)->layers)
        return TN_OK;
    (*plan)->strip = kind->strip;
    return begin(*plan, error);
}

/* left: of the number, when all houses on the plan have been passed over. */
static tn_status too_few(const mpz_t variant, mpz_t left, tn_error *error)
{
    mpz_sub(left, variant, left);
    return tn_house_variants_too_few(left, error);
}

tn_status tn_houses_at(tn_houses *h, tn_house_variants *variants, const tn_tray *trays, uint32_t length,
                       const mpz_t variant, tn_house *house, tn_error *error)
{
    tn_house section = {.form = h->form};
    tn_on_plan *plans = calloc(h->kind_count + 1, sizeof *plans), *plan;
    bool found = false;
    mpz_t left;
    mpz_init_set(left, variant);
    *house = (tn_house){0};
    tn_status status = plans ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; plans && i < h->kind_count; i++) {
        plans[i] = (tn_on_plan){.trays = trays, .length = length};
        mpz_init(plans[i].one);
    }
    for (bool more = true; status == TN_OK && !found && more; more = tn_form_next_section(h->form, section.shapes)) {
        if (!tn_house_section_stands(&section))
            continue;
        status = on_plan(plans, h, &section, &plan, error);
        if (status == TN_OK)
            status = try_section(h, variants, plan, section.shapes, left, &found, house, error);
    }
    for (size_t i = 0; plans && i < h->kind_count; i++)
        end(&plans[i]);
    free(plans);
    if (status == TN_OK && !found)
        status = too_few(variant, left, error);
    mpz_clear(left);
    return status;
}
