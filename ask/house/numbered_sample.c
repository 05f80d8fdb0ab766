/* Draws houses of a library at random: ranks, and then the houses of these, plan by plan. */
#include <stdlib.h>
#include <string.h>

#include "ask/house/diverse.h"
#include "ask/house/numbered.h"
#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/house/house.h"

/* The ranks that are drawn, ascending, and how far the plans have come. */
typedef struct tn_house_sample {
    mpz_t *ranks;
    size_t room, count, next;
    mpz_t before;   /* houses on the plans before */
    mpz_t *on_plan; /* how many houses are on each plan, where they are counted plan by plan; owned */
    size_t plans, plan_room, plan;
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
    for (size_t i = 0; i < s->plans; i++)
        mpz_clear(s->on_plan[i]);
    free(s->on_plan);
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

/* Counts the houses on a plan, which are added to those before. */
static tn_status count_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                            tn_error *error)
{
    tn_house_sample *s = context;
    (void)stop;
    if (!tn_array_reserve(&s->on_plan, &s->plan_room, s->plans, 1, sizeof *s->on_plan))
        return tn_fail_memory(error);
    mpz_init(s->on_plan[s->plans]);
    tn_status status = tn_numbered_houses_on(n, trays, length, s->on_plan[s->plans++], error);
    mpz_add(s->before, s->before, s->on_plan[s->plans - 1]);
    return status;
}

static tn_status find_house(tn_numbered *n, tn_house_sample *s, const tn_tray *trays, uint32_t length,
                            const mpz_t variant, tn_house *house, tn_error *error)
{
    tn_plan_houses *houses;
    if (!s->houses)
        return tn_numbered_at(n, trays, length, variant, house, error);
    tn_status status = tn_numbered_among(n, s->houses, trays, length, &houses, error);
    if (status == TN_OK)
        status = tn_plan_houses_at(houses, variant, house, error);
    return status == TN_OK ? tn_numbered_judge(n, house, error) : status;
}

static tn_status use_house(tn_numbered *n, tn_house_sample *s, const tn_tray *trays, uint32_t length,
                           const mpz_t variant, const mpz_t rank, tn_error *error)
{
    tn_house house = {0};
    tn_status status = find_house(n, s, trays, length, variant, &house, error);
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
    mpz_t variant, end;
    tn_status status = TN_OK;
    mpz_inits(variant, end, NULL);
    mpz_add(end, s->before, s->on_plan[s->plan++]);
    while (status == TN_OK && s->next < s->count && mpz_cmp(s->ranks[s->next], end) < 0) {
        mpz_sub(variant, s->ranks[s->next], s->before);
        status = use_house(n, s, trays, length, variant, s->ranks[s->next], error);
        s->next++;
    }
    mpz_set(s->before, end);
    *stop = s->next == s->count;
    mpz_clears(variant, end, NULL);
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

/* The houses that are counted tray by tray: all, or those on a plan. NULL: they cannot be. */
static tn_status count_together(tn_numbered *n, const tn_plan *plan, tn_houses **houses, tn_error *error)
{
    *houses = NULL;
    tn_status status =
        plan ? tn_numbered_on_plan(n, plan->trays, (uint32_t)plan->length, houses, error) : tn_numbered_all(n, error);
    if (status == TN_OK && !plan)
        *houses = n->all;
    return status == TN_LIMIT && (plan || tn_numbered_countable(n)) ? TN_OK : status;
}

static tn_status sample_one_by_one(tn_numbered *n, const tn_plan *plan, size_t wanted, uint64_t seed,
                                   tn_sampled_house *use, void *context, tn_error *error)
{
    tn_house_sample s = {.use = use, .context = context};
    mpz_init(s.before);
    tn_status status = visit_plans(n, plan, count_plan, &s, error);
    if (status == TN_OK)
        status = sample_draw(&s, seed, s.before, wanted, error);
    mpz_set_ui(s.before, 0);
    if (status == TN_OK && s.count > 0)
        status = visit_plans(n, plan, use_plan, &s, error);
    sample_clear(&s);
    return status;
}

static tn_status sample(tn_numbered *n, const tn_plan *plan, size_t wanted, uint64_t seed, tn_sampled_house *use,
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

/* ---- those that differ */

typedef struct drawn_house {
    char *line;
    mpz_t rank, variant;
} drawn_house;

/* The houses that are drawn, among which some are chosen; owned. */
typedef struct drawn_houses {
    drawn_house *items;
    size_t count;
} drawn_houses;

static tn_status keep(void *context, tn_house *house, const mpz_t rank, const mpz_t variant, tn_error *error)
{
    drawn_houses *d = context;
    tn_buffer line = {0};
    tn_status status = tn_house_write(house, &line, error);
    if (status != TN_OK) {
        free(line.data);
        return status;
    }
    drawn_house *to = &d->items[d->count++];
    to->line = line.data;
    mpz_init_set(to->rank, rank);
    mpz_init_set(to->variant, variant);
    return TN_OK;
}

static tn_status use_drawn(tn_numbered *n, const drawn_house *drawn, tn_sampled_house *use, void *context,
                           tn_error *error)
{
    tn_house house = {0};
    tn_status status = tn_house_read(&n->form, drawn->line, strlen(drawn->line), TN_HOUSE_TRAYS_DEFAULT, &house, error);
    if (status == TN_OK)
        status = use(context, &house, drawn->rank, drawn->variant, error);
    tn_house_clear(&house);
    return status;
}

static tn_status choose(tn_numbered *n, const drawn_houses *d, size_t wanted, uint64_t seed, tn_sampled_house *use,
                        void *context, tn_error *error)
{
    const char **lines = malloc((d->count + 1) * sizeof *lines);
    bool *chosen = calloc(d->count + 1, sizeof *chosen);
    tn_status status = lines && chosen ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; lines && i < d->count; i++)
        lines[i] = d->items[i].line;
    if (status == TN_OK && d->count > 0)
        status = tn_lines_choose(lines, d->count, (size_t)(tn_random64(seed, 1, 0) % d->count), wanted, chosen, error);
    for (size_t i = 0; status == TN_OK && i < d->count; i++)
        if (chosen[i])
            status = use_drawn(n, &d->items[i], use, context, error);
    free(chosen);
    free(lines);
    return status;
}

static tn_status sample_diverse(tn_numbered *n, const tn_plan *plan, size_t wanted, uint64_t seed,
                                tn_sampled_house *use, void *context, tn_error *error)
{
    enum { TIMES = 20 };
    size_t draws = wanted * TIMES > TN_DIVERSE_DRAWS ? wanted * TIMES : TN_DIVERSE_DRAWS;
    drawn_houses drawn = {.items = calloc(draws + 1, sizeof *drawn.items)};
    tn_status status = drawn.items ? sample(n, plan, draws, seed, keep, &drawn, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = choose(n, &drawn, wanted, seed, use, context, error);
    for (size_t i = 0; i < drawn.count; i++) {
        free(drawn.items[i].line);
        mpz_clears(drawn.items[i].rank, drawn.items[i].variant, NULL);
    }
    free(drawn.items);
    return status;
}

static tn_status too_many(size_t wanted, tn_error *error)
{
    return tn_fail(error, TN_INVALID, E_USAGE, "--diverse chooses at most %u houses, not %zu", TN_DIVERSE_HOUSES_MAX,
                   wanted);
}

tn_status tn_numbered_sample(tn_numbered *n, const tn_plan *plan, size_t wanted, uint64_t seed, bool diverse,
                             tn_sampled_house *use, void *context, tn_error *error)
{
    if (!diverse)
        return sample(n, plan, wanted, seed, use, context, error);
    return wanted > TN_DIVERSE_HOUSES_MAX ? too_many(wanted, error)
                                          : sample_diverse(n, plan, wanted, seed, use, context, error);
}
