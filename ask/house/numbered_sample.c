/* Draws houses of a library at random: ranks, and then the houses of these, plan by plan. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/house/diverse.h"
#include "ask/house/numbered.h"
#include "ask/house/tried.h"
#include "runtime/base/array.h"
#include "runtime/base/integers.h"
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

/* ---- tried, as the library asks for walks */

static tn_status house_of_rank(tn_tried_houses *t, const mpz_t rank, tn_tray *trays, tn_house *house, tn_error *error)
{
    tn_house_sample among = {.houses = t->without.all};
    uint32_t length = 0;
    mpz_t variant;
    *house = (tn_house){0};
    mpz_init_set(variant, rank);
    tn_status status = tn_numbered_find(&t->without, t->without.all, variant, trays, &length, error);
    if (status == TN_OK)
        status = find_house(&t->without, &among, trays, length, variant, house, error);
    mpz_clear(variant);
    return status;
}

/* Ranks that are drawn as a set come in an order in which each is as likely as each to be the next. */
static void shuffle(mpz_t *ranks, size_t count, uint64_t seed)
{
    enum { STREAM = 2 };
    for (size_t i = count; i > 1; i--)
        mpz_swap(ranks[i - 1], ranks[tn_random64(seed, STREAM, i) % i]);
}

/* Tries the houses of the ranks, in their order, until so many are kept, whose ranks are put first, ascending. */
static tn_status try_ranks(tn_tried_houses *t, tn_house_sample *s, size_t wanted, tn_tray *trays, tn_error *error)
{
    tn_status status = TN_OK;
    size_t kept = 0;
    for (size_t i = 0; status == TN_OK && i < s->count && kept < wanted; i++) {
        tn_house house;
        bool keeps = false;
        status = house_of_rank(t, s->ranks[i], trays, &house, error);
        if (status == TN_OK)
            status = tn_tried_try(t, &house, &keeps, error);
        if (keeps)
            mpz_swap(s->ranks[kept++], s->ranks[i]);
        tn_house_clear(&house);
    }
    s->count = kept;
    if (kept > 0)
        qsort(s->ranks, kept, sizeof *s->ranks, tn_integers_compare);
    return status;
}

static tn_status use_kept(tn_tried_houses *t, const tn_house_sample *s, tn_tray *trays, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < s->count; i++) {
        tn_house house;
        status = house_of_rank(t, s->ranks[i], trays, &house, error);
        if (status == TN_OK) {
            house.form = &t->n->form;
            status = s->use(s->context, &house, NULL, NULL, error);
        }
        tn_house_clear(&house);
    }
    return status;
}

static void say_likely(const tn_tried_houses *t)
{
    tn_session_note(
        t->n->session,
        "%" PRIu64 " house%s %s tried until %" PRIu64 " %s kept by the clauses that ask for walks; each house "
        "that they keep is as likely as each",
        t->tried, t->tried == 1 ? "" : "s", t->tried == 1 ? "was" : "were", t->kept, t->kept == 1 ? "was" : "were");
}

static tn_status sample_from(tn_tried_houses *t, tn_house_sample *s, size_t wanted, uint64_t seed, tn_error *error)
{
    size_t most = t->most < TN_DRAWN_HOUSES_MAX ? (size_t)t->most : TN_DRAWN_HOUSES_MAX;
    tn_tray *trays = tn_numbered_tray_room(t->n, error);
    tn_status status = trays ? tn_numbered_all(&t->without, error) : TN_MEMORY;
    if (status == TN_OK) {
        tn_houses_count(t->without.all, TN_ALL_LENGTHS, s->before);
        most = mpz_cmp_ui(s->before, most) < 0 ? (size_t)mpz_get_ui(s->before) : most;
        status = tn_watch_room(t->n->form.module->watch, (uint64_t)most * 2 * sizeof *s->ranks,
                               "drawing houses to be tried", error);
    }
    if (status == TN_OK)
        status = sample_draw(s, seed, s->before, most, error);
    if (status == TN_OK) {
        shuffle(s->ranks, s->count, seed);
        tn_session_begins(t->n->session, "trying houses");
        status = try_ranks(t, s, wanted, trays, error);
        tn_session_ends(t->n->session);
    }
    t->n->not_all = s->count < wanted && mpz_cmp_ui(s->before, most) > 0;
    if (status == TN_OK && t->n->not_all)
        status = tn_tried_end(t, wanted, error);
    else if (status == TN_OK && t->tried > 0)
        say_likely(t);
    if (status == TN_OK)
        status = use_kept(t, s, trays, error);
    free(trays);
    return status;
}

static tn_status sample_tried(tn_numbered *n, size_t wanted, uint64_t seed, tn_sampled_house *use, void *context,
                              tn_error *error)
{
    tn_tried_houses tried;
    tn_house_sample s = {.use = use, .context = context};
    mpz_init(s.before);
    tn_status status = tn_tried_begin(n, TN_DRAWN_HOUSES_DEFAULT, &tried, error);
    if (status == TN_OK)
        status = sample_from(&tried, &s, wanted, seed, error);
    sample_clear(&s);
    tn_tried_clear(&tried);
    return status;
}

/* ---- in one of these ways */

static tn_status sample(tn_numbered *n, const tn_plan *plan, size_t wanted, uint64_t seed, tn_sampled_house *use,
                        void *context, tn_error *error)
{
    tn_houses *houses;
    if (!plan && tn_numbered_walks(n) && !tn_numbered_countable(n))
        return sample_tried(n, wanted, seed, use, context, error);
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
    bool ranked;
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
    mpz_inits(to->rank, to->variant, NULL);
    to->ranked = rank != NULL;
    if (rank) {
        mpz_set(to->rank, rank);
        mpz_set(to->variant, variant);
    }
    return TN_OK;
}

static tn_status use_drawn(tn_numbered *n, const drawn_house *drawn, tn_sampled_house *use, void *context,
                           tn_error *error)
{
    tn_house house = {0};
    tn_status status = tn_house_read(&n->form, drawn->line, strlen(drawn->line), TN_HOUSE_TRAYS_DEFAULT, &house, error);
    if (status == TN_OK)
        status = use(context, &house, drawn->ranked ? drawn->rank : NULL, drawn->ranked ? drawn->variant : NULL, error);
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
