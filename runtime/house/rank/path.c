/* The states of a plan are those of a library that has only this plan. */
#include "runtime/house/rank/path.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"

bool tn_choosing_passes(const tn_choosing *c, const mpz_t houses, bool is_wanted)
{
    if (c->typed)
        return mpz_sgn(houses) == 0;
    if (c->wanted ? is_wanted : mpz_cmp(c->number, houses) < 0)
        return false;
    if (c->wanted)
        mpz_add(c->number, c->number, houses);
    else
        mpz_sub(c->number, c->number, houses);
    return true;
}

void tn_path_clear(tn_plan_path *p)
{
    for (uint32_t i = 0; p->states && i <= p->length; i++) {
        tn_integers_free(p->states[i].here, tn_path_layer(p, i)->nodes.count);
        tn_integers_free(p->states[i].like, tn_path_layer(p, i)->nodes.count);
    }
    free(p->states);
    tn_path_forget_numbers(p);
    free(p->beginning.data);
    tn_interner_clear(&p->numbers);
    free(p->valued);
    tn_houses_layers_clear(&p->view, &p->kind);
    *p = (tn_plan_path){0};
}

/* ---- states */

static tn_status keep_step(void *context, void *sum, const void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_plan_path *p = context;
    (void)sum;
    (void)element;
    return tn_houses_keep_step(&p->view, &p->kind, at->layer, at->to, at->label, error);
}

static tn_status find_nodes(tn_plan_path *p, tn_error *error)
{
    static const tn_walk_algebra keeping = {.add = keep_step};
    const tn_key_question steps = {&keeping, NULL, p, 0};
    tn_houses_layers l;
    tn_status status = tn_houses_layers_begin(&l, &p->view, &p->kind, error);
    for (uint32_t k = 0; status == TN_OK && k < l.walk.last; k++)
        p->kind.layers[k].kept.all = true;
    if (status == TN_OK)
        status = tn_key_walk_forward(&l.walk, &steps, error);
    tn_key_walk_clear(&l.walk, NULL, NULL);
    return status;
}

tn_status tn_path_find(tn_plan_path *p, const tn_houses *houses, const tn_houses_kind *kind, const tn_tray *trays,
                       uint32_t length, tn_error *error)
{
    *p = (tn_plan_path){.view = *houses, .kind = {.frontier = kind->frontier}, .length = length};
    p->view.only = trays;
    p->view.low = p->view.high = length;
    p->view.whole_steps = kind->frontier->slices.keys.count < houses->many_slices;
    p->stages = tn_houses_stages(&p->view, &p->kind);
    tn_status status = tn_frontier_ways_want(kind->frontier, error);
    if (status == TN_OK)
        status = find_nodes(p, error);
    if (status == TN_OK)
        status = tn_houses_look_ahead(&p->view, &p->kind, error);
    return status == TN_OK ? tn_path_begin_states(p, error) : status;
}

tn_status tn_path_begin_states(tn_plan_path *p, tn_error *error)
{
    p->states = calloc((size_t)p->length + 1, sizeof *p->states);
    for (uint32_t i = 0; p->states && i <= p->length; i++) {
        p->states[i].here = tn_integers_new(tn_path_layer(p, i)->nodes.count);
        p->states[i].like = tn_integers_new(tn_path_layer(p, i)->nodes.count);
        if (!p->states[i].here || !p->states[i].like)
            return tn_fail_memory(error);
    }
    return p->states ? TN_OK : tn_fail_memory(error);
}

uint32_t tn_path_node(const tn_plan_path *p, uint32_t trays, uint32_t state)
{
    const tn_numbering *nodes = &tn_path_layer(p, trays)->nodes; /* of one plan, so of one state of it */
    return nodes->count > 0 ? tn_number_find(nodes, (nodes->keys[0] >> 32 << 32) | state) : UINT32_MAX;
}

/* A state in which the row cannot end is no node, if it would be the last. */
tn_status tn_path_add(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                      tn_error *error)
{
    tn_path_sum *sum = context;
    (void)faced;
    (void)gain;
    (void)error;
    uint32_t at = sum->ahead ? tn_path_node(sum->path, sum->trays, state) : 0;
    if (!sum->ahead)
        mpz_add_ui(sum->houses, sum->houses, times);
    else if (at != UINT32_MAX)
        mpz_addmul_ui(sum->houses, sum->ahead[at], times);
    return TN_OK;
}

tn_status tn_path_count_on(tn_plan_path *path, uint32_t trays, uint32_t state, const tn_frontier_choice *slices,
                           size_t count, tn_path_sum *sum, mpz_t houses, tn_error *error)
{
    tn_status status = TN_OK;
    mpz_set_ui(houses, 0);
    for (size_t k = 0; status == TN_OK && k < count; k++) {
        mpz_set_ui(sum->houses, 0);
        status = tn_path_step(path, trays, state, slices[k].slice, NULL, tn_path_add, sum, error);
        mpz_addmul_ui(houses, sum->houses, slices[k].times);
    }
    return status;
}
