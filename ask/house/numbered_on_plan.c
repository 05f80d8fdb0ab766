/* Numbers of the houses on one plan, which are counted tray by tray; beyond the limits of that they are gone through.
 */
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"
#include "runtime/house/house.h"

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
        status = tn_house_ranks_new(among ? among : n->ranked.counted, &n->ranked.ranks, error);
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

tn_status tn_numbered_listing(tn_numbered *n, tn_house_listing **listing, tn_error *error)
{
    tn_status status = n->listing ? TN_OK : tn_house_listing_new(&n->form, n->record, 0, &n->listing, error);
    *listing = n->listing;
    return status;
}

/* *plan: the houses by their numbers; or NULL, and *listing is what goes through them. */
static tn_status find_on(tn_numbered *n, tn_houses *among, const tn_tray *trays, uint32_t length, tn_plan_houses **plan,
                         tn_house_listing **listing, tn_error *error)
{
    tn_status status = tn_numbered_among(n, among, trays, length, plan, error);
    *listing = NULL;
    return status == TN_LIMIT ? tn_numbered_listing(n, listing, error) : status;
}

/* To make ready what counts a plan takes longer than to count many plans with it. Once some were counted by themselves,
 * all are counted together, if that takes few states. */
static tn_status count_all_if_quick(tn_numbered *n, tn_error *error)
{
    enum { PLANS = 8, STATES = 100000 };
    const tn_houses_what all = {0};
    if (n->all || n->plans_alone++ != PLANS || tn_numbered_walks(n))
        return TN_OK;
    uint32_t states = n->max_states > 0 && n->max_states < STATES ? n->max_states : STATES;
    tn_status status = tn_houses_of(&n->form, n->record, n->plans, &all, states, &n->all, error);
    return status == TN_LIMIT ? TN_OK : status;
}

tn_status tn_numbered_houses_on(tn_numbered *n, const tn_tray *trays, uint32_t length, mpz_t houses, tn_error *error)
{
    tn_plan_houses *plan;
    tn_house_listing *listing = NULL;
    tn_status status = count_all_if_quick(n, error);
    if (status == TN_OK)
        status = find_on(n, n->all, trays, length, &plan, &listing, error);
    if (status != TN_OK)
        return status;
    if (!listing)
        return tn_plan_houses_count(plan, houses, error);
    tn_house_counts counts;
    tn_house_counts_init(&counts);
    status = tn_house_listing_count(listing, trays, length, &counts, error);
    mpz_set(houses, counts.houses);
    tn_house_counts_clear(&counts);
    return status;
}

tn_status tn_numbered_each(tn_numbered *n, const tn_tray *trays, uint32_t length, const mpz_t from, tn_house_each *each,
                           void *context, tn_error *error)
{
    tn_plan_houses *plan;
    tn_house_listing *listing = NULL;
    tn_status status = count_all_if_quick(n, error);
    if (status == TN_OK)
        status = find_on(n, n->all, trays, length, &plan, &listing, error);
    if (status != TN_OK)
        return status;
    return listing ? tn_house_listing_each(listing, trays, length, from, each, context, error)
                   : tn_plan_houses_each(plan, from, each, context, error);
}

tn_status tn_numbered_each_from(tn_numbered *n, const tn_tray *trays, uint32_t length, const mpz_t rank, mpz_t before,
                                tn_house_each *each, void *context, tn_error *error)
{
    mpz_t houses, first;
    mpz_inits(houses, first, NULL);
    tn_status status = tn_numbered_houses_on(n, trays, length, houses, error);
    mpz_sub(first, rank, before);
    if (status == TN_OK && mpz_cmp(first, houses) < 0)
        status = tn_numbered_each(n, trays, length, first, each, context, error);
    mpz_add(before, before, houses);
    mpz_clears(houses, first, NULL);
    return status;
}

tn_status tn_numbered_at(tn_numbered *n, const tn_tray *trays, uint32_t length, const mpz_t variant, tn_house *house,
                         tn_error *error)
{
    tn_plan_houses *plan;
    tn_house_listing *listing;
    *house = (tn_house){0};
    tn_status status = find_on(n, n->all, trays, length, &plan, &listing, error);
    if (status == TN_OK)
        status = listing ? tn_house_listing_at(listing, trays, length, variant, house, error)
                         : tn_plan_houses_at(plan, variant, house, error);
    return status == TN_OK ? tn_numbered_judge(n, house, error) : status;
}

tn_status tn_numbered_number(tn_numbered *n, const tn_house *house, mpz_t variant, tn_error *error)
{
    tn_plan_houses *plan;
    tn_house_listing *listing;
    tn_status status = find_on(n, n->all, house->trays, (uint32_t)house->length, &plan, &listing, error);
    if (status != TN_OK)
        return status;
    return listing ? tn_house_listing_number(listing, house, variant, error)
                   : tn_plan_houses_number(plan, house, variant, error);
}
