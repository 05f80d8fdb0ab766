/* Functions of a house of a number, tray by tray: houses that go on from the states so far by slices with functions. */
#include <stdlib.h>

#include "runtime/house/rank/path.h"

/* houses += those that have this slice in this place, with the functions so far. */
static tn_status add_slice(tn_plan_path *a, uint32_t layer, const tn_strip_functioned *slice, mpz_t houses,
                           tn_error *error)
{
    const tn_path_states *states = &a->layers[layer];
    tn_path_sum sum = {.next = &a->layers[layer + 1].of, .ahead = a->layers[layer + 1].ahead};
    tn_status status = TN_OK;
    mpz_init(sum.houses);
    for (uint32_t i = 0; status == TN_OK && i < states->of.count; i++) {
        if (mpz_sgn(states->here[i]) == 0)
            continue;
        mpz_set_ui(sum.houses, 0);
        status = tn_strip_step(a->strip, layer, (uint32_t)states->of.keys[i], slice->slice, tn_path_add, &sum, error);
        mpz_mul(sum.houses, sum.houses, states->here[i]);
        mpz_addmul_ui(houses, sum.houses, slice->times);
    }
    mpz_clear(sum.houses);
    return status;
}

/* What leads on: to states of the next layer, by so many choices. */
typedef struct tn_leading {
    tn_path_states *next;
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

static tn_status take_slice(tn_plan_path *a, uint32_t layer, const tn_strip_choice *slice, tn_error *error)
{
    const tn_path_states *states = &a->layers[layer];
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < states->of.count; i++) {
        tn_leading l = {&a->layers[layer + 1], a->one};
        mpz_mul_ui(a->one, states->here[i], slice->times);
        if (mpz_sgn(a->one) != 0)
            status = tn_strip_step(a->strip, layer, (uint32_t)states->of.keys[i], slice->slice, lead_to, &l, error);
    }
    return status;
}

/* The slices of a tray, by functions in order. */
typedef struct tn_functioned {
    const tn_strip_functioned *items;
    size_t count;
} tn_functioned;

static bool has_functions(const tn_strip_functioned *slice, const tn_house *house, uint32_t tray)
{
    bool same = house != NULL;
    for (size_t i = 0; same && i < slice->cells; i++)
        same = house->cells[house->tray_first[tray] + i].function == slice->functions[i];
    return same;
}

/* The slices [*first, *end) have the functions of the house. *found: does one? */
static tn_status choose(tn_plan_path *a, const tn_choosing *choosing, uint32_t layer, const tn_functioned *slices,
                        size_t *first, size_t *end, bool *found, tn_error *error)
{
    mpz_t houses;
    mpz_init(houses);
    tn_status status = TN_OK;
    *found = false;
    for (*first = *end = 0; status == TN_OK && !*found && *end < slices->count;) {
        *first = *end;
        mpz_set_ui(houses, 0);
        for (; status == TN_OK && *end < slices->count &&
               tn_strip_functioned_compare(&slices->items[*first], &slices->items[*end]) == 0;
             ++*end)
            status = add_slice(a, layer, &slices->items[*end], houses, error);
        *found = status == TN_OK &&
                 !tn_choosing_passes(choosing, houses, has_functions(&slices->items[*first], choosing->wanted, layer));
    }
    mpz_clear(houses);
    return status;
}

/* The tray has the functions of these slices. */
static tn_status take(tn_plan_path *a, uint32_t layer, const tn_strip_functioned *slices, size_t count, tn_house *house,
                      tn_path_slices *taken, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < slices->cells; i++)
        house->cells[house->tray_first[layer] + i].function = slices->functions[i];
    taken->items = malloc((count + 1) * sizeof *taken->items);
    if (!taken->items)
        return tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        taken->items[taken->count++] = (tn_strip_choice){slices[i].slice, slices[i].times};
        status = take_slice(a, layer, &taken->items[i], error);
    }
    return status;
}

static void begin(tn_plan_path *a)
{
    for (uint32_t layer = 0; layer <= a->length; layer++)
        for (uint32_t i = 0; i < a->layers[layer].of.count; i++)
            mpz_set_ui(a->layers[layer].here[i], 0);
    mpz_set_ui(a->layers[0].here[0], 1);
}

tn_status tn_path_functions(tn_plan_path *a, const tn_choosing *choosing, tn_house *house, tn_path_slices *of_tray,
                            bool *found, tn_error *error)
{
    tn_status status = TN_OK;
    *found = true;
    begin(a);
    for (uint32_t i = 0; status == TN_OK && *found && i < a->length; i++) {
        tn_functioned slices = {0};
        size_t first = 0, end = 0;
        tn_strip_functioned *items = tn_strip_functioned_of(a->strip, a->trays[i], &slices.count);
        slices.items = items;
        status = items ? choose(a, choosing, i, &slices, &first, &end, found, error) : tn_fail_memory(error);
        if (status == TN_OK && *found)
            status = take(a, i, items + first, end - first, house, &of_tray[i], error);
        free(items);
    }
    return status;
}
