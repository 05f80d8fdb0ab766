/* Slices of a tray and outcomes of a plane in the order of houses, by the functions of their cells. They are kept, as
 * ranks ask for the same ones again and again. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

void tn_strip_orders_clear(tn_strip_orders *orders)
{
    for (uint32_t i = 0; i < orders->keys.count; i++) {
        free(orders->of[i].kinds);
        free(orders->of[i].items);
    }
    free(orders->of);
    tn_interner_clear(&orders->keys);
    *orders = (tn_strip_orders){0};
}

void tn_strip_orders_trim(tn_strip *strip)
{
    enum { ITEMS_MOST = 1 << 20 }; /* 4 MB */
    tn_strip_orders *const both[] = {&strip->slice_orders, &strip->outcome_orders};
    for (size_t i = 0; i < 2; i++)
        if (both[i]->items > ITEMS_MOST)
            tn_strip_orders_clear(both[i]);
}

/* ---- what is in a sequence */

/* kinds := what is in the items, once each. */
static void find_kinds(tn_strip_sequence *s)
{
    memcpy(s->kinds, s->items, s->count * sizeof *s->kinds);
    qsort(s->kinds, s->count, sizeof *s->kinds, tn_words_compare);
    for (size_t i = 0; i < s->count; i++)
        if (i == 0 || s->kinds[i] != s->kinds[s->kind_count - 1])
            s->kinds[s->kind_count++] = s->kinds[i];
}

/* Takes the items over; each becomes the place of what it is. */
static tn_status make_sequence(const tn_strip_ordered *ordered, tn_strip_sequence *s, tn_error *error)
{
    uint32_t *kinds = malloc((ordered->count + 1) * sizeof *kinds);
    if (!kinds)
        return tn_fail_memory(error);
    *s = (tn_strip_sequence){.kinds = kinds, .items = ordered->items, .count = ordered->count};
    if (s->count > 0)
        find_kinds(s);
    for (size_t i = 0; i < s->count; i++) {
        const uint32_t *kind = bsearch(&s->items[i], s->kinds, s->kind_count, sizeof *kind, tn_words_compare);
        s->items[i] = (uint32_t)(kind - s->kinds);
    }
    return TN_OK;
}

/* ---- what is asked for */

/* *at: the place of what the key asks for, to which the functions of so many cells are added. */
static tn_status place_of(tn_strip_orders *orders, tn_key *key, const tn_cell *cells, size_t count, uint32_t *at,
                          tn_error *error)
{
    bool ok = true;
    for (size_t i = 0; ok && i < count; i++)
        ok = tn_key_push(key, cells[i].function);
    uint32_t before = orders->keys.count;
    if (!ok || !tn_array_reserve(&orders->of, &orders->room, before, 1, sizeof *orders->of))
        return tn_fail_memory(error);
    *at = tn_intern(&orders->keys, key->data, key->size);
    if (*at == UINT32_MAX)
        return tn_fail_memory(error);
    if (*at == before)
        orders->of[before] = (tn_strip_sequence){0};
    return TN_OK;
}

/* Keeps what was found, if it was; owns the items. */
static tn_status keep(tn_strip_orders *orders, uint32_t at, tn_status status, const tn_strip_ordered *found,
                      tn_error *error)
{
    if (status == TN_OK)
        status = make_sequence(found, &orders->of[at], error);
    if (status == TN_OK)
        orders->items += found->count;
    else
        free(found->items);
    return status;
}

tn_status tn_strip_slices_ordered(tn_strip *strip, tn_tray tray, const tn_cell *like, size_t cells,
                                  tn_strip_sequence *slices, tn_error *error)
{
    tn_strip_orders *orders = &strip->slice_orders;
    uint32_t at;
    strip->joined.size = 0;
    if (!tn_key_push(&strip->joined, tray))
        return tn_fail_memory(error);
    tn_status status = place_of(orders, &strip->joined, like, cells, &at, error);
    if (status == TN_OK && !orders->of[at].kinds) {
        tn_strip_ordered found = {0};
        status = tn_strip_order_slices(strip, tray, like, &found, error);
        status = keep(orders, at, status, &found, error);
    }
    if (status == TN_OK)
        *slices = orders->of[at];
    return status;
}

static size_t cells_of(const tn_strip *strip, uint32_t edge)
{
    return edge == TN_STRIP_NONE ? 0 : strip->edges[edge].count;
}

tn_status tn_strip_outcomes_ordered(tn_strip *strip, uint32_t left, uint32_t right, const tn_cell *like,
                                    tn_strip_sequence *outcomes, tn_error *error)
{
    tn_strip_orders *orders = &strip->outcome_orders;
    size_t cells = cells_of(strip, left) + cells_of(strip, right);
    uint32_t at;
    strip->joined.size = 0;
    if (!tn_key_push(&strip->joined, left) || !tn_key_push(&strip->joined, right))
        return tn_fail_memory(error);
    tn_status status = place_of(orders, &strip->joined, like, cells, &at, error);
    if (status == TN_OK && !orders->of[at].kinds) {
        tn_strip_ordered found = {0};
        status = tn_strip_order_outcomes(strip, left, right, like, &found, error);
        status = keep(orders, at, status, &found, error);
    }
    if (status == TN_OK)
        *outcomes = orders->of[at];
    return status;
}
