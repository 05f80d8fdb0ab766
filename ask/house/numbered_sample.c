/* Draws houses of a library at random: ranks, and then the houses of these, plan by plan. */
#include <stdlib.h>

#include "ask/house/numbered.h"

/* The ranks that are drawn, ascending, and how far the plans have come. */
typedef struct tn_house_sample {
    mpz_t *ranks;
    size_t room, count, next;
    mpz_t before;      /* houses on the plans before */
    tn_houses *houses; /* where they are counted tray by tray, or NULL */
    tn_sampled_house *use;
    void *context;
} tn_house_sample;

static void sample_clear(tn_house_sample *s)
{
    for (size_t i = 0; s->ranks && i < s->room; i++)
        mpz_clear(s->ranks[i]);
    free(s->ranks);
    mpz_clear(s->before);
}

static tn_status sample_draw(tn_house_sample *s, uint64_t seed, const mpz_t bound, size_t wanted, tn_error *error)
{
    s->ranks = malloc((wanted + 1) * sizeof *s->ranks);
    if (!s->ranks)
        return tn_fail_memory(error);
    for (s->room = 0; s->room < wanted; s->room++)
        mpz_init(s->ranks[s->room]);
    return tn_ranks_sample(seed, 0, bound, wanted, s->ranks, &s->count, error);
}

/* Adds the houses of a plan to the number of all. */
static tn_status add_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                          tn_error *error)
{
    (void)stop;
    return tn_house_variants_count(n->variants, trays, length, context, error);
}

static tn_status use_house(tn_numbered *n, tn_house_sample *s, const tn_tray *trays, uint32_t length,
                           const mpz_t variant, const mpz_t rank, tn_error *error)
{
    tn_house house = {0};
    tn_plan_houses *houses = NULL;
    tn_status status = s->houses ? tn_numbered_among(n, s->houses, trays, length, &houses, error) : TN_OK;
    if (status == TN_OK)
        status = houses ? tn_plan_houses_at(houses, variant, &house, error)
                        : tn_house_variants_at(n->variants, trays, length, variant, &house, error);
    if (status == TN_OK)
        status = tn_numbered_judge(n, &house, error);
    if (status == TN_OK)
        status = s->use(s->context, &house, rank, variant, error);
    tn_house_clear(&house);
    return status;
}

/* Uses the houses on a plan that are drawn. */
static tn_status use_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                          tn_error *error)
{
    tn_house_sample *s = context;
    tn_house_counts counts;
    mpz_t variant;
    mpz_init(variant);
    tn_house_counts_init(&counts);
    tn_status status = tn_house_variants_count(n->variants, trays, length, &counts, error);
    mpz_add(counts.houses, counts.houses, s->before);
    while (status == TN_OK && s->next < s->count && mpz_cmp(s->ranks[s->next], counts.houses) < 0) {
        mpz_sub(variant, s->ranks[s->next], s->before);
        status = use_house(n, s, trays, length, variant, s->ranks[s->next], error);
        s->next++;
    }
    mpz_set(s->before, counts.houses);
    *stop = s->next == s->count;
    tn_house_counts_clear(&counts);
    mpz_clear(variant);
    return status;
}

/* Calls `visit` for the one plan, or for all. */
static tn_status visit_plans(tn_numbered *n, const tn_plan *plan, tn_plan_visit *visit, void *context, tn_error *error)
{
    bool stop = false;
    return plan ? visit(n, context, plan->trays, (uint32_t)plan->length, &stop, error)
                : tn_numbered_plans(n, visit, context, error);
}

/* Draws among houses that are counted tray by tray, and finds the plan of each. */
static tn_status sample_together(tn_numbered *n, tn_houses *houses, size_t wanted, uint64_t seed, tn_sampled_house *use,
                                 void *context, tn_error *error)
{
    tn_house_sample s = {.use = use, .context = context, .houses = houses};
    uint32_t length = 0;
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(n->plans) + 1));
    mpz_t rank;
    mpz_inits(rank, s.before, NULL);
    tn_houses_count(houses, TN_ALL_LENGTHS, rank);
    tn_status status = trays ? sample_draw(&s, seed, rank, wanted, error) : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < s.count; i++) {
        mpz_set(rank, s.ranks[i]);
        status = tn_numbered_find(n, houses, rank, trays, &length, error);
        if (status == TN_OK)
            status = use_house(n, &s, trays, length, rank, s.ranks[i], error);
    }
    mpz_clear(rank);
    sample_clear(&s);
    free(trays);
    return status;
}

/* Are the houses on the plan counted in few steps? */
static tn_status is_quick(const tn_numbered *n, const tn_plan *plan, bool *quick, tn_error *error)
{
    enum { QUICK = 20000 };
    tn_house_variants *variants = NULL;
    tn_house_counts counts;
    tn_house_counts_init(&counts);
    tn_status status = tn_house_variants_new(&n->form, n->record, QUICK, &variants, error);
    if (status == TN_OK)
        status = tn_house_variants_count(variants, plan->trays, plan->length, &counts, error);
    *quick = status == TN_OK;
    tn_house_variants_free(variants);
    tn_house_counts_clear(&counts);
    return status == TN_LIMIT ? TN_OK : status;
}

/* The houses that are counted tray by tray: all, or those on a plan that are not counted quickly. NULL: they cannot be,
 * or are few. */
static tn_status count_together(tn_numbered *n, const tn_plan *plan, tn_houses **houses, tn_error *error)
{
    bool quick;
    *houses = NULL;
    if (!plan) {
        tn_status status = tn_numbered_all(n, error);
        *houses = status == TN_OK ? n->all : NULL;
        return status == TN_LIMIT && tn_numbered_countable(n) ? TN_OK : status;
    }
    tn_status status = is_quick(n, plan, &quick, error);
    if (status == TN_OK && !quick)
        status = tn_numbered_on_plan(n, plan->trays, (uint32_t)plan->length, houses, error);
    return status == TN_LIMIT ? TN_OK : status;
}

static tn_status sample_one_by_one(tn_numbered *n, const tn_plan *plan, size_t wanted, uint64_t seed,
                                   tn_sampled_house *use, void *context, tn_error *error)
{
    tn_house_sample s = {.use = use, .context = context};
    tn_house_counts all;
    mpz_init(s.before);
    tn_house_counts_init(&all);
    tn_status status = visit_plans(n, plan, add_plan, &all, error);
    if (status == TN_OK)
        status = sample_draw(&s, seed, all.houses, wanted, error);
    if (status == TN_OK && s.count > 0)
        status = visit_plans(n, plan, use_plan, &s, error);
    tn_house_counts_clear(&all);
    sample_clear(&s);
    return status;
}

tn_status tn_numbered_sample(tn_numbered *n, const tn_plan *plan, size_t wanted, uint64_t seed, tn_sampled_house *use,
                             void *context, tn_error *error)
{
    tn_houses *houses;
    tn_status status = count_together(n, plan, &houses, error);
    if (status == TN_OK && houses)
        status = sample_together(n, houses, wanted, seed, use, context, error);
    else if (status == TN_OK)
        status = sample_one_by_one(n, plan, wanted, seed, use, context, error);
    tn_numbered_forget_ranks(n);
    if (houses != n->all)
        tn_houses_free(houses);
    return status;
}
