/* Keeps the plans that were asked for last: their states, and where their houses begin among all. */
#include <stdlib.h>
#include <string.h>

#include "runtime/house/rank/path.h"

enum { PLANS_MOST = 64, NODES_MOST = 1 << 18 }; /* some 30 MB */

typedef struct tn_ranked_plan {
    tn_tray *trays;
    uint32_t length;
    tn_plan_houses *houses; /* or NULL: not asked for */
    bool located;
    mpz_t first, count; /* if it is known: the rank of the first of its houses, and how many there are */
    uint64_t used;      /* when it was asked for last */
} tn_ranked_plan;

struct tn_house_ranks {
    tn_houses *houses;
    tn_ranked_plan plans[PLANS_MOST];
    size_t count;
    uint64_t now;
};

tn_status tn_house_ranks_new(tn_houses *houses, tn_house_ranks **out, tn_error *error)
{
    tn_house_ranks *r = *out = calloc(1, sizeof *r);
    if (!r)
        return tn_fail_memory(error);
    r->houses = houses;
    return TN_OK;
}

static void clear_plan(tn_ranked_plan *plan)
{
    tn_plan_houses_free(plan->houses);
    free(plan->trays);
    mpz_clears(plan->first, plan->count, NULL);
}

void tn_house_ranks_free(tn_house_ranks *r)
{
    for (size_t i = 0; r && i < r->count; i++)
        clear_plan(&r->plans[i]);
    free(r);
}

/* ---- which are kept */

static void drop_oldest(tn_house_ranks *r)
{
    size_t oldest = 0;
    for (size_t i = 1; i < r->count; i++)
        oldest = r->plans[i].used < r->plans[oldest].used ? i : oldest;
    clear_plan(&r->plans[oldest]);
    r->plans[oldest] = r->plans[--r->count];
}

static size_t count_nodes(const tn_house_ranks *r)
{
    size_t nodes = 0;
    for (size_t i = 0; i < r->count; i++)
        nodes += r->plans[i].houses ? tn_plan_houses_nodes(r->plans[i].houses) : 0;
    return nodes;
}

/* The plan among those that are kept; if it is new, with nothing known of it. NULL: out of memory. */
static tn_ranked_plan *plan_of(tn_house_ranks *r, const tn_tray *trays, uint32_t length)
{
    size_t size = length * sizeof *trays;
    for (size_t i = 0; i < r->count; i++)
        if (r->plans[i].length == length && (length == 0 || memcmp(r->plans[i].trays, trays, size) == 0))
            return &r->plans[i];
    while (r->count == PLANS_MOST || (r->count > 0 && count_nodes(r) > NODES_MOST))
        drop_oldest(r);
    tn_ranked_plan *plan = &r->plans[r->count];
    *plan = (tn_ranked_plan){.trays = malloc(size + 1), .length = length};
    if (!plan->trays)
        return NULL;
    if (length > 0)
        memcpy(plan->trays, trays, size);
    mpz_inits(plan->first, plan->count, NULL);
    r->count++;
    return plan;
}

tn_status tn_house_ranks_plan(tn_house_ranks *r, const tn_tray *trays, uint32_t length, tn_plan_houses **houses,
                              tn_error *error)
{
    tn_ranked_plan *plan = plan_of(r, trays, length);
    tn_status status = plan ? TN_OK : tn_fail_memory(error);
    *houses = NULL;
    if (status == TN_OK && !plan->houses)
        status = tn_plan_houses_new(r->houses, trays, length, &plan->houses, error);
    if (status != TN_OK)
        return status;
    plan->used = ++r->now;
    *houses = plan->houses;
    return TN_OK;
}

/* ---- where their houses are */

/* Is the rank of one of its houses? */
static bool has_rank(const tn_ranked_plan *plan, const mpz_t rank, mpz_t number)
{
    if (!plan->located)
        return false;
    mpz_sub(number, rank, plan->first);
    return mpz_sgn(number) >= 0 && mpz_cmp(number, plan->count) < 0;
}

/* rank := the number of the house on the plan of that rank; NULL: it is not kept. */
static tn_ranked_plan *plan_of_rank(tn_house_ranks *r, mpz_t rank)
{
    tn_ranked_plan *found = NULL;
    mpz_t number;
    mpz_init(number);
    for (size_t i = 0; !found && i < r->count; i++)
        if (has_rank(&r->plans[i], rank, number))
            found = &r->plans[i];
    if (found)
        mpz_set(rank, number);
    mpz_clear(number);
    return found;
}

/* The plan's houses begin at this rank; it is as good as asked for. */
static tn_status locate(tn_house_ranks *r, const tn_tray *trays, uint32_t length, const mpz_t first, const mpz_t count,
                        tn_error *error)
{
    tn_ranked_plan *plan = plan_of(r, trays, length);
    if (!plan)
        return tn_fail_memory(error);
    mpz_set(plan->first, first);
    mpz_set(plan->count, count);
    plan->located = true;
    plan->used = ++r->now;
    return TN_OK;
}

tn_status tn_house_ranks_find(tn_house_ranks *r, mpz_t rank, tn_tray *trays, uint32_t *length, tn_error *error)
{
    const tn_ranked_plan *plan = plan_of_rank(r, rank);
    if (plan) {
        *length = plan->length;
        if (*length > 0)
            memcpy(trays, plan->trays, *length * sizeof *trays);
        return TN_OK;
    }
    mpz_t first, count;
    mpz_init_set(first, rank);
    mpz_init(count);
    tn_status status = tn_houses_find(r->houses, rank, trays, length, count, error);
    mpz_sub(first, first, rank);
    if (status == TN_OK)
        status = locate(r, trays, *length, first, count, error);
    mpz_clears(first, count, NULL);
    return status;
}
