/* Numbers of the houses on one plan: gone through one by one where that is quick, else counted tray by tray. */
#include <stdlib.h>
#include <string.h>

#include "cli/house/numbered_parts.h"

void tn_numbered_forget_plan(tn_numbered *n)
{
    tn_plan_houses_free(n->on_plan.houses);
    tn_houses_free(n->on_plan.counted);
    free(n->on_plan.trays);
    n->on_plan = (tn_numbered_plan_found){0};
}

tn_status tn_numbered_on_plan(tn_numbered *n, const tn_tray *trays, uint32_t length, tn_houses **houses,
                              tn_error *error)
{
    const tn_houses_what what = {.only = trays, .length = length};
    return tn_numbered_of(n, &what, houses, error);
}

static bool is_found(const tn_numbered_plan_found *found, const tn_houses *among, const tn_tray *trays, uint32_t length)
{
    return found->houses && found->among == among && found->length == length &&
           memcmp(found->trays, trays, length * sizeof *trays) == 0;
}

static tn_status find(tn_numbered *n, tn_houses *among, const tn_tray *trays, uint32_t length, tn_error *error)
{
    tn_numbered_plan_found *found = &n->on_plan;
    *found = (tn_numbered_plan_found){.among = among, .length = length};
    found->trays = malloc(((size_t)length + 1) * sizeof *trays);
    if (!found->trays)
        return tn_fail_memory(error);
    memcpy(found->trays, trays, length * sizeof *trays);
    tn_status status = among ? TN_OK : tn_numbered_on_plan(n, found->trays, length, &found->counted, error);
    return status == TN_OK ? tn_plan_houses_new(among ? among : found->counted, n->variants, found->trays, length,
                                                &found->houses, error)
                           : status;
}

tn_status tn_numbered_among(tn_numbered *n, tn_houses *among, const tn_tray *trays, uint32_t length,
                            tn_plan_houses **houses, tn_error *error)
{
    tn_status status = TN_OK;
    if (!is_found(&n->on_plan, among, trays, length)) {
        tn_numbered_forget_plan(n);
        status = find(n, among, trays, length, error);
    }
    if (status != TN_OK)
        tn_numbered_forget_plan(n);
    *houses = n->on_plan.houses;
    return status;
}

/* Goes through the houses one by one with few steps, where they are not counted yet. */
static bool try_quick(const tn_numbered *n, const tn_tray *trays, uint32_t length)
{
    return !n->all && !is_found(&n->on_plan, NULL, trays, length);
}

static tn_status make_quick(tn_numbered *n, tn_error *error)
{
    enum { STEPS = 20000 };
    return n->quick ? TN_OK : tn_house_variants_new(&n->form, n->record, STEPS, &n->quick, error);
}

tn_status tn_numbered_at(tn_numbered *n, const tn_tray *trays, uint32_t length, const mpz_t variant, tn_house *house,
                         tn_error *error)
{
    tn_plan_houses *houses;
    tn_status status = make_quick(n, error);
    *house = (tn_house){0};
    if (status == TN_OK)
        status = try_quick(n, trays, length) ? tn_house_variants_at(n->quick, trays, length, variant, house, error)
                                             : TN_LIMIT;
    if (status != TN_LIMIT)
        return status;
    tn_house_clear(house);
    status = tn_numbered_among(n, n->all, trays, length, &houses, error);
    if (status == TN_OK)
        status = tn_plan_houses_at(houses, variant, house, error);
    return status == TN_LIMIT ? tn_house_variants_at(n->variants, trays, length, variant, house, error) : status;
}

tn_status tn_numbered_number(tn_numbered *n, const tn_house *house, mpz_t variant, tn_error *error)
{
    tn_plan_houses *houses;
    uint32_t length = (uint32_t)house->length;
    tn_status status = make_quick(n, error);
    if (status == TN_OK)
        status =
            try_quick(n, house->trays, length) ? tn_house_variants_rank(n->quick, house, variant, error) : TN_LIMIT;
    if (status != TN_LIMIT)
        return status;
    status = tn_numbered_among(n, n->all, house->trays, length, &houses, error);
    if (status == TN_OK)
        status = tn_plan_houses_number(houses, house, variant, error);
    return status == TN_LIMIT ? tn_house_variants_rank(n->variants, house, variant, error) : status;
}
