/* The states that a plan reaches are found forwards, and how many houses go on from each backwards. */
#include "runtime/house/rank/path.h"

#include <stdlib.h>

#include "runtime/base/integers.h"

bool tn_choosing_passes(const tn_choosing *c, const mpz_t houses, bool is_wanted)
{
    if (c->wanted ? is_wanted : mpz_cmp(c->number, houses) < 0)
        return false;
    if (c->wanted)
        mpz_add(c->number, c->number, houses);
    else
        mpz_sub(c->number, c->number, houses);
    return true;
}

void tn_path_init(tn_plan_path *a, const tn_tray *trays, uint32_t length)
{
    *a = (tn_plan_path){.trays = trays, .length = length};
    mpz_init(a->one);
}

void tn_path_clear(tn_plan_path *a)
{
    for (uint32_t i = 0; a->layers && i <= a->length; i++) {
        tn_path_states *states = &a->layers[i];
        tn_integers_free(states->ahead, states->of.count);
        tn_integers_free(states->here, states->of.count);
        tn_integers_free(states->like, states->of.count);
        tn_numbering_clear(&states->of);
    }
    free(a->layers);
    mpz_clear(a->one);
}

/* ---- states */

static tn_status reach(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                       tn_error *error)
{
    tn_path_states *next = context;
    (void)times;
    (void)faced;
    (void)gain;
    return tn_number(&next->of, state) != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static tn_status find_states(tn_plan_path *a, tn_error *error)
{
    tn_status status = tn_number(&a->layers[0].of, TN_STRIP_NONE) != UINT32_MAX ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < a->length; i++) {
        const tn_strip_list *list = &a->strip->of_tray[a->trays[i]];
        for (uint32_t s = 0; status == TN_OK && s < a->layers[i].of.count; s++) {
            uint32_t state = (uint32_t)a->layers[i].of.keys[s];
            status = tn_watch_check(a->strip->watch, error);
            for (size_t k = 0; status == TN_OK && k < list->count; k++)
                status = tn_strip_step(a->strip, i, state, list->items[k].slice, reach, &a->layers[i + 1], error);
        }
    }
    return status;
}

/* ---- what is ahead */

tn_status tn_path_add(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                      tn_error *error)
{
    tn_path_sum *sum = context;
    (void)faced;
    (void)gain;
    uint32_t at = sum->next ? tn_number_find(sum->next, state) : 0;
    if (at == UINT32_MAX)
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a house goes on to a state that its plan does not reach");
    if (!sum->next)
        mpz_add_ui(sum->houses, sum->houses, times);
    else
        mpz_addmul_ui(sum->houses, sum->ahead[at], times);
    return TN_OK;
}

static tn_status count_ahead(tn_plan_path *a, uint32_t layer, uint32_t at, tn_path_sum *sum, tn_error *error)
{
    uint32_t state = (uint32_t)a->layers[layer].of.keys[at];
    mpz_ptr ahead = a->layers[layer].ahead[at];
    const tn_path_states *next = layer < a->length ? &a->layers[layer + 1] : NULL;
    sum->next = next ? &next->of : NULL;
    sum->ahead = next ? next->ahead : NULL;
    mpz_set_ui(sum->houses, 0);
    if (!next) {
        tn_status status = tn_strip_step(a->strip, layer, state, TN_STRIP_NONE, tn_path_add, sum, error);
        mpz_set(ahead, sum->houses);
        return status;
    }
    const tn_strip_list *list = &a->strip->of_tray[a->trays[layer]];
    tn_status status = tn_watch_check(a->strip->watch, error);
    for (size_t k = 0; status == TN_OK && k < list->count; k++) {
        mpz_set_ui(sum->houses, 0);
        status = tn_strip_step(a->strip, layer, state, list->items[k].slice, tn_path_add, sum, error);
        mpz_addmul_ui(ahead, sum->houses, list->items[k].times);
    }
    return status;
}

static tn_status look_ahead(tn_plan_path *a, tn_error *error)
{
    tn_path_sum sum = {0};
    tn_status status = TN_OK;
    mpz_init(sum.houses);
    for (uint32_t layer = a->length + 1; status == TN_OK && layer-- > 0;) {
        tn_path_states *states = &a->layers[layer];
        states->ahead = tn_integers_new(states->of.count);
        states->here = tn_integers_new(states->of.count);
        states->like = tn_integers_new(states->of.count);
        status = states->ahead && states->here && states->like ? TN_OK : tn_fail_memory(error);
        for (uint32_t i = 0; status == TN_OK && i < states->of.count; i++)
            status = count_ahead(a, layer, i, &sum, error);
    }
    mpz_clear(sum.houses);
    return status;
}

tn_status tn_path_find(tn_plan_path *a, tn_strip *strip, tn_error *error)
{
    a->strip = strip;
    a->layers = calloc((size_t)a->length + 1, sizeof *a->layers);
    tn_status status = a->layers ? find_states(a, error) : tn_fail_memory(error);
    return status == TN_OK ? look_ahead(a, error) : status;
}
