/* Numbers of the houses on one plan: gone through one by one where that is quick, else counted tray by tray. */
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"

void tn_numbered_forget_ranks(tn_numbered *n)
{
    tn_house_ranks_free(n->ranked.ranks);
    tn_houses_free(n->ranked.counted);
    free(n->ranked.trays);
    n->ranked = (tn_numbered_ranked){0};
}

tn_status tn_numbered_on_plan(tn_numbered *n, const tn_tray *trays, uint32_t length, tn_houses **houses,
                              tn_error *error)
{
    const tn_houses_what what = {.only = trays, .length = length};
    return tn_numbered_of(n, &what, houses, error);
}

/* among: NULL for those on this plan alone. */
static bool is_ranked(const tn_numbered_ranked *ranked, const tn_houses *among, const tn_tray *trays, uint32_t length)
{
    bool same = ranked->ranks && ranked->among == among;
    return same && (among || (ranked->length == length && memcmp(ranked->trays, trays, length * sizeof *trays) == 0));
}

static tn_status count_alone(tn_numbered *n, const tn_tray *trays, uint32_t length, tn_error *error)
{
    tn_numbered_ranked *ranked = &n->ranked;
    ranked->length = length;
    ranked->trays = malloc(((size_t)length + 1) * sizeof *trays);
    if (!ranked->trays)
        return tn_fail_memory(error);
    memcpy(ranked->trays, trays, length * sizeof *trays);
    return tn_numbered_on_plan(n, ranked->trays, length, &ranked->counted, error);
}

static tn_status rank(tn_numbered *n, tn_houses *among, const tn_tray *trays, uint32_t length, tn_error *error)
{
    if (is_ranked(&n->ranked, among, trays, length))
        return TN_OK;
    tn_numbered_forget_ranks(n);
    n->ranked.among = among;
    tn_status status = among ? TN_OK : count_alone(n, trays, length, error);
    if (status == TN_OK)
        status = tn_house_ranks_new(among ? among : n->ranked.counted, n->variants, &n->ranked.ranks, error);
    if (status != TN_OK)
        tn_numbered_forget_ranks(n);
    return status;
}

tn_status tn_numbered_among(tn_numbered *n, tn_houses *among, const tn_tray *trays, uint32_t length,
                            tn_plan_houses **houses, tn_error *error)
{
    *houses = NULL;
    tn_status status = rank(n, among, trays, length, error);
    return status == TN_OK ? tn_house_ranks_plan(n->ranked.ranks, trays, length, houses, error) : status;
}

tn_status tn_numbered_find(tn_numbered *n, tn_houses *among, mpz_t number, tn_tray *trays, uint32_t *length,
                           tn_error *error)
{
    tn_status status = rank(n, among, NULL, 0, error);
    if (status != TN_OK)
        return status;
    tn_session_begins(n->session, "looking for the plan");
    status = tn_house_ranks_find(n->ranked.ranks, number, trays, length, error);
    tn_session_ends(n->session);
    return status;
}

/* Goes through the houses one by one with few steps, where they are not counted yet. */
static bool try_quick(const tn_numbered *n, const tn_tray *trays, uint32_t length)
{
    return !n->all && !is_ranked(&n->ranked, NULL, trays, length);
}

static tn_status make_quick(tn_numbered *n, tn_error *error)
{
    enum { STEPS = 20000 };
    return n->quick ? TN_OK : tn_house_variants_new(&n->form, n->record, STEPS, &n->quick, error);
}

static tn_status find_at(tn_numbered *n, const tn_tray *trays, uint32_t length, const mpz_t variant, tn_house *house,
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

tn_status tn_numbered_at(tn_numbered *n, const tn_tray *trays, uint32_t length, const mpz_t variant, tn_house *house,
                         tn_error *error)
{
    tn_status status = find_at(n, trays, length, variant, house, error);
    return status == TN_OK ? tn_numbered_judge(n, house, error) : status;
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
