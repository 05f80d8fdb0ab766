/* Follows the trays of a plan through the layers of a kind of section. */
#include "runtime/house/rank/along.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"

tn_status tn_plan_along_begin(const tn_houses *houses, tn_houses_kind *kind, tn_plan_along *a, tn_error *error)
{
    *a = (tn_plan_along){.view = *houses, .kind = kind};
    a->view.keep_trays = true;
    a->trays = malloc(((size_t)houses->high + 1) * sizeof *a->trays);
    a->here = tn_integers_new(1);
    a->by_tray = tn_integers_new(houses->form->schema->tray_count);
    if (!a->trays || !a->here || !a->by_tray)
        return tn_fail_memory(error);
    mpz_set_ui(a->here[0], 1);
    return TN_OK;
}

void tn_plan_along_end(tn_plan_along *a)
{
    tn_integers_free(a->here, a->kind ? a->kind->layers[a->layer].nodes.count : 0);
    tn_integers_free(a->by_tray, a->kind ? a->view.form->schema->tray_count : 0);
    free(a->trays);
    *a = (tn_plan_along){0};
}

void tn_plan_along_take(tn_plan_along *a, tn_tray tray)
{
    a->trays[a->count++] = tray;
    a->summed = false;
}

/* ---- from layer to layer */

typedef struct tn_plan_along_push {
    const tn_plan_along *along;
    const tn_tray *only; /* NULL: all */
    mpz_t *next;
    mpz_t one;
} tn_plan_along_push;

static tn_status push(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_plan_along_push *p = context;
    const tn_numbering *to = &p->along->kind->layers[p->along->layer + 1].nodes;
    (void)error;
    if (p->only && edge->tray != *p->only)
        return TN_OK;
    uint32_t at = tn_number_find(to, (uint64_t)edge->plan << 32 | edge->state);
    mpz_mul_ui(p->one, p->along->here[edge->from], edge->ways);
    mpz_addmul_ui(p->next[at], p->one, edge->times);
    return TN_OK;
}

/* only: the tray, where the step ends with one. */
static tn_status push_on(tn_plan_along *a, const tn_tray *only, tn_error *error)
{
    const tn_houses_layer *layers = a->kind->layers;
    tn_plan_along_push p = {.along = a, .only = only, .next = tn_integers_new(layers[a->layer + 1].nodes.count)};
    if (!p.next)
        return tn_fail_memory(error);
    mpz_init(p.one);
    tn_status status = tn_houses_expand_from(&a->view, a->kind, a->layer, a->here, push, &p, error);
    mpz_clear(p.one);
    tn_integers_free(a->here, layers[a->layer].nodes.count);
    a->here = p.next;
    a->layer++;
    return status;
}

/* To the last layer before the states after so many trays and one more. */
static tn_status push_to(tn_plan_along *a, uint32_t trays, tn_error *error)
{
    uint32_t stages = tn_houses_stages(&a->view, a->kind);
    tn_status status = TN_OK;
    while (status == TN_OK && a->layer + 1 < (trays + 1) * stages) {
        bool ends = (a->layer + 1) % stages == 0;
        status = push_on(a, ends ? &a->trays[a->layer / stages] : NULL, error);
    }
    return status;
}

/* ---- houses by tray */

typedef struct tn_plan_along_sum {
    const tn_plan_along *along;
    uint32_t length;
    mpz_t one;
} tn_plan_along_sum;

static tn_status sum_up(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_plan_along_sum *s = context;
    const tn_plan_along *a = s->along;
    const tn_houses_layer *next = &a->kind->layers[a->layer + 1];
    uint32_t at = tn_number_find(&next->nodes, (uint64_t)edge->plan << 32 | edge->state);
    (void)error;
    mpz_mul_ui(s->one, next->ahead[(size_t)at * tn_houses_lengths(&a->view) + s->length - a->view.low], edge->ways);
    mpz_mul_ui(s->one, s->one, edge->times);
    mpz_addmul(a->by_tray[edge->tray], s->one, a->here[edge->from]);
    return TN_OK;
}

static tn_status find_by_tray(tn_plan_along *a, uint32_t length, tn_error *error)
{
    tn_plan_along_sum s = {.along = a, .length = length};
    if (a->summed)
        return TN_OK;
    for (tn_tray t = 0; t < a->view.form->schema->tray_count; t++)
        mpz_set_ui(a->by_tray[t], 0);
    tn_status status = push_to(a, a->count, error);
    mpz_init(s.one);
    if (status == TN_OK)
        status = tn_houses_expand_from(&a->view, a->kind, a->layer, a->here, sum_up, &s, error);
    mpz_clear(s.one);
    a->summed = status == TN_OK;
    return status;
}

/* ---- what is kept */

/* *place: where the numbers of this beginning are kept: NULL if they are not known yet; NULL: too many are. */
static tn_status place_of(const tn_plan_along *a, uint32_t length, mpz_t ***place, tn_error *error)
{
    enum { MOST = 1000000 }; /* numbers */
    tn_houses_kind *kind = a->kind;
    tn_key *key = &kind->frontier->key;
    uint32_t before = kind->beginnings.count;
    *place = NULL;
    if ((uint64_t)before * a->view.form->schema->tray_count > MOST)
        return TN_OK;
    key->size = 0;
    bool ok = tn_key_push(key, length);
    for (uint32_t i = 0; ok && i < a->count; i++)
        ok = tn_key_push(key, (uint32_t)a->trays[i]);
    if (!ok || !tn_array_reserve(&kind->by_beginning, &kind->beginning_room, before, 1, sizeof *kind->by_beginning))
        return tn_fail_memory(error);
    uint32_t at = tn_intern(&kind->beginnings, key->data, key->size);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    if (at == before)
        kind->by_beginning[at] = NULL;
    *place = &kind->by_beginning[at];
    return TN_OK;
}

tn_status tn_plan_along_houses(tn_plan_along *a, uint32_t length, tn_tray tray, mpz_ptr *houses, tn_error *error)
{
    uint32_t trays = a->view.form->schema->tray_count;
    mpz_t **place;
    tn_status status = place_of(a, length, &place, error);
    *houses = a->by_tray[tray];
    if (status == TN_OK && place && *place)
        *houses = (*place)[tray];
    else if (status == TN_OK)
        status = find_by_tray(a, length, error);
    if (status != TN_OK || !place || *place)
        return status;
    *place = tn_integers_new(trays);
    for (tn_tray t = 0; *place && t < trays; t++)
        mpz_set((*place)[t], a->by_tray[t]);
    return *place ? TN_OK : tn_fail_memory(error);
}
