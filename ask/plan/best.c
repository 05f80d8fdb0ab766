/* best: the best plans, or houses, by measures in their order. */
#include "ask/plan/best.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/plan/searched.h"
#include "ask/session/questions.h"
#include "driver/open/digits.h"
#include "driver/plan/library.h"
#include "runtime/house/house.h"
#include "runtime/house/rank/rank.h"
#include "runtime/plan/library/diverse.h"
#include "runtime/plan/library/rank.h"
#include "runtime/plan/measure/best.h"
#include "runtime/plan/measure/moments.h"
#include "runtime/plan/measure/named.h"

static tn_status find_best_houses(tn_session *session, const tn_best_request *request, tn_reply *answer);

/* ---- measures */

/* The names, and what is better; TN_INVALID, and said, if there are fewer than `least` or too many. */
static tn_status wishes_take(tn_session *session, const tn_wish *items, size_t count, uint32_t least, tn_wishes *wishes)
{
    *wishes = (tn_wishes){0};
    if (count < least || count > TN_WEIGHED_MAX)
        return tn_session_refuse(session, "name them with --least MEASURE or --most MEASURE",
                                 "%s measures to go by: %u to %d are needed", count < least ? "too few" : "too many",
                                 least, TN_WEIGHED_MAX);
    for (size_t k = 0; k < count; k++) {
        wishes->names[k] = items[k].measure;
        wishes->most[k] = items[k].most;
    }
    wishes->count = (uint32_t)count;
    return TN_OK;
}

tn_status tn_wishes_of_plans(tn_session *session, const tn_ready_library *ready, const tn_wish *items, size_t count,
                             uint32_t least, tn_wishes *wishes)
{
    const tn_module *module = session->opened->module;
    tn_status status = wishes_take(session, items, count, least, wishes);
    for (uint32_t k = 0; status == TN_OK && k < wishes->count; k++) {
        status = tn_measure_choose(session->opened, wishes->names[k], ready->record, &wishes->measures[k]);
        if (status != TN_OK)
            return status;
        wishes->names[k] = tn_named_measure(module, wishes->measures[k]);
        wishes->units[k] = tn_amount_unit_of(ready->schema, tn_named_measure_power(module, wishes->measures[k]));
    }
    return status;
}

tn_status tn_wishes_note_none(tn_session *session, const tn_wishes *wishes, tn_weighed *weighed, tn_error *error)
{
    const tn_library *library = tn_weighed_library(weighed);
    const tn_module *module = tn_library_schema(library)->module;
    bool partial = false;
    for (uint32_t k = 0; k < wishes->count; k++)
        partial |= tn_named_measure_partial(module, wishes->measures[k]);
    if (!partial)
        return TN_OK;
    mpz_t valued, none;
    mpz_inits(valued, none, NULL);
    tn_status status = tn_weighed_plans(weighed, valued, error);
    tn_library_kept(library, TN_ALL_LENGTHS, none);
    mpz_sub(none, none, valued);
    char *count = status == TN_OK && mpz_sgn(none) > 0 ? tn_digits(none, true) : NULL;
    if (count)
        tn_session_note(session, "%s plan%s without a value %s left out", count, mpz_cmp_ui(none, 1) ? "s" : "",
                        mpz_cmp_ui(none, 1) ? "are" : "is");
    free(count);
    mpz_clears(valued, none, NULL);
    return status;
}

void tn_wishes_room(mpq_t values[TN_WEIGHED_MAX])
{
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        mpq_init(values[k]);
}

void tn_wishes_clear(mpq_t values[TN_WEIGHED_MAX])
{
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        mpq_clear(values[k]);
}

static tn_status refuse_many(tn_session *session, uint64_t wanted, unsigned most, const char *what)
{
    char text[80];
    snprintf(text, sizeof text, "%" PRIu64, wanted);
    return tn_session_refuse(session, NULL, "--diverse chooses at most %u %s, not %s", most, what, text);
}

static char *write_value(tn_amount_unit unit, const mpq_t value)
{
    tn_buffer text = {0};
    if (tn_amount_write(unit, value, &text))
        return text.data;
    free(text.data);
    return NULL;
}

char *tn_wish_text(const tn_wishes *wishes, uint32_t k, const mpq_t value)
{
    return write_value(wishes->units[k], value);
}

char *tn_wish_caption(const tn_wishes *wishes, uint32_t k, const mpq_t value)
{
    return write_value(tn_amount_unit_shown(wishes->units[k]), value);
}

/* ---- plans */

typedef struct searching {
    tn_session *session;
    const tn_ready_library *ready;
    const tn_best_request *request;
    tn_wishes wishes;
    tn_weighed *weighed;
    tn_best *best;
    tn_ranking *ranking;
    tn_tray *trays;
    mpq_t values[TN_WEIGHED_MAX];
} searching;

static tn_status prepare(searching *s, tn_error *error)
{
    const tn_library *library = s->ready->library;
    tn_status status = tn_weighed_new(library, s->wishes.measures, s->wishes.count, &s->weighed, error);
    if (status == TN_OK)
        status = tn_wishes_note_none(s->session, &s->wishes, s->weighed, error);
    if (status == TN_OK)
        status = tn_best_new(s->weighed, s->wishes.most, &s->best, error);
    if (status == TN_OK)
        status = tn_ranking_new(library, &s->ranking, error);
    s->trays = malloc(sizeof *s->trays * ((size_t)tn_library_max(library) + 1));
    return status != TN_OK || s->trays ? status : tn_fail_memory(error);
}

static void clear(searching *s)
{
    tn_ranking_free(s->ranking);
    tn_best_free(s->best);
    tn_weighed_free(s->weighed);
    tn_wishes_clear(s->values);
    free(s->trays);
}

/* values: of the sums, in steps. */
static tn_status give_plan(searching *s, tn_finds *finds, uint32_t length, const int64_t *values, tn_error *error)
{
    for (uint32_t k = 0; k < s->wishes.count; k++)
        tn_weighed_value(s->weighed, k, values, s->values[k]);
    const tn_found_one found = {.rank = tn_ranking_next(s->ranking, s->trays, length),
                                .trays = s->trays,
                                .length = length,
                                .values = s->values};
    return tn_finds_give(finds, &found, error);
}

/* The next of the best plans that is asked for; the first takes longest. */
static tn_status find_next(searching *s, bool first, uint32_t *length, int64_t *values, bool *found, tn_error *error)
{
    tn_status status;
    if (first)
        tn_session_begins(s->session, "looking for the best");
    do
        status = tn_best_next(s->best, s->trays, length, values, found, error);
    while (status == TN_OK && *found && s->request->mirror &&
           !tn_library_mirror_first(s->ready->library, s->trays, *length));
    if (first)
        tn_session_ends(s->session);
    return status;
}

static tn_status give_plans(searching *s, uint64_t wanted, tn_finds *finds, tn_error *error)
{
    bool found = true;
    tn_status status = TN_OK;
    for (uint64_t given = 0; status == TN_OK && found && given < wanted; given++) {
        int64_t values[TN_WEIGHED_MAX];
        uint32_t length;
        status = find_next(s, given == 0, &length, values, &found, error);
        if (status == TN_OK && found)
            status = give_plan(s, finds, length, values, error);
    }
    return status;
}

/* ---- plans that differ: of the best, as `sample --diverse` chooses among those that it draws */

enum { DIVERSE_OF = 1000, DIVERSE_TIMES = 20 }; /* so many of the best are looked at, and for each one wanted */

typedef struct best_pool {
    tn_plan *plans;
    int64_t (*values)[TN_WEIGHED_MAX];
    size_t count, room;
} best_pool;

static tn_status pool_plan(best_pool *pool, const searching *s, uint32_t length, const int64_t *values, tn_error *error)
{
    tn_plan *plan = &pool->plans[pool->count];
    *plan = (tn_plan){.trays = malloc(((size_t)length + 1) * sizeof *plan->trays), .length = length};
    if (!plan->trays)
        return tn_fail_memory(error);
    memcpy(plan->trays, s->trays, length * sizeof *plan->trays);
    memcpy(pool->values[pool->count++], values, sizeof *pool->values);
    return TN_OK;
}

static tn_status fill_pool(best_pool *pool, searching *s, tn_error *error)
{
    bool found = true;
    tn_status status = TN_OK;
    while (status == TN_OK && found && pool->count < pool->room) {
        int64_t values[TN_WEIGHED_MAX] = {0};
        uint32_t length;
        status = find_next(s, pool->count == 0, &length, values, &found, error);
        if (status == TN_OK && found)
            status = pool_plan(pool, s, length, values, error);
    }
    return status;
}

/* Those chosen are given in their order: the best first. */
static tn_status give_chosen(const best_pool *pool, const bool *chosen, searching *s, tn_finds *finds, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < pool->count; i++) {
        if (!chosen[i])
            continue;
        memcpy(s->trays, pool->plans[i].trays, pool->plans[i].length * sizeof *s->trays);
        status = give_plan(s, finds, (uint32_t)pool->plans[i].length, pool->values[i], error);
    }
    return status;
}

static tn_status give_diverse(searching *s, uint64_t wanted, tn_finds *finds, tn_error *error)
{
    size_t count = (size_t)wanted, room = count * DIVERSE_TIMES > DIVERSE_OF ? count * DIVERSE_TIMES : DIVERSE_OF;
    best_pool pool = {calloc(room, sizeof *pool.plans), calloc(room, sizeof *pool.values), 0, room};
    bool *chosen = calloc(room, sizeof *chosen);
    tn_status status = pool.plans && pool.values && chosen ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = fill_pool(&pool, s, error);
    if (status == TN_OK)
        status = tn_plans_diverse(s->ready->schema, pool.plans, pool.count, count, chosen, error);
    if (status == TN_OK)
        status = give_chosen(&pool, chosen, s, finds, error);
    for (size_t i = 0; i < pool.count; i++)
        free(pool.plans[i].trays);
    free(pool.plans);
    free(pool.values);
    free(chosen);
    return status;
}

/* Without a wish, plans of a library that prefers are the best by that, which is said. */
static tn_status take_wishes(searching *s)
{
    static const tn_wish preferred = {.measure = TN_PREFERENCE_NAME, .most = true};
    const tn_best_request *r = s->request;
    if (r->by.count > 0)
        return tn_wishes_of_plans(s->session, s->ready, r->by.items, r->by.count, 1, &s->wishes);
    if (s->ready->record->preference_count == 0)
        return tn_session_refuse(s->session,
                                 "name it with --least MEASURE or --most MEASURE; or say in the library what is "
                                 "preferred: `prefer RULE worth 2`",
                                 "nothing says by which measure plans are the best");
    tn_session_note(s->session,
                    "the best by `%s`, most first: what the %u preferences of `%s` that a plan meets are "
                    "worth together",
                    TN_PREFERENCE_NAME, s->ready->record->preference_count,
                    tn_text(s->session->opened->module, s->ready->record->name));
    return tn_wishes_of_plans(s->session, s->ready, &preferred, 1, 1, &s->wishes);
}

/* ---- plans that are searched, by one measure */

static tn_status note_bound(const searching *s, mpq_t bound, tn_reply *answer, tn_error *error)
{
    tn_found_plans *plans = TN_REPLY(found_plans, answer);
    char *text = tn_wish_text(&s->wishes, 0, bound);
    if (!text)
        return tn_fail_memory(error);
    tn_session_note(s->session, "it is not proven that these are the best within %s: no plan has %s than %s",
                    "--max-conflicts", s->wishes.most[0] ? "more" : "less", text);
    free(text);
    if (plans) {
        plans->has_bound = true;
        mpq_set(plans->bound, bound);
        tn_amount_convert(s->wishes.units[0], plans->bound);
    }
    return TN_OK;
}

static tn_status give_searched(searching *s, const tn_searched_plans *plans, tn_finds *finds, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < plans->count; i++) {
        mpq_set(s->values[0], plans->items[i].value);
        const tn_found_one found = {
            .trays = plans->items[i].trays, .length = plans->items[i].length, .values = s->values};
        status = tn_finds_give(finds, &found, error);
    }
    return status;
}

static tn_status best_searched(searching *s, const tn_error *limit, tn_finds *finds, tn_error *error)
{
    const tn_module *module = s->session->opened->module;
    const tn_search_options options = tn_asked_search(&s->request->subject, &s->request->search);
    uint32_t sum = tn_named_measure_sum(module, s->ready->record, s->wishes.measures[0]);
    uint64_t wanted = s->request->has_count ? s->request->count : TN_BEST_DEFAULT;
    tn_searched_plans plans = {0};
    tn_search_proof proof = {.proven = true};
    tn_plan_search *search;
    mpq_init(proof.bound);
    tn_searched_note(s->session, limit);
    tn_status status = tn_plan_search_new(s->ready->schema, s->ready->index, &options, &search, error);
    if (status == TN_OK) {
        status = tn_plan_search_best(search, sum, s->wishes.most[0], (size_t)wanted, &plans, &proof, error);
        tn_plan_search_free(search);
    }
    if (status == TN_OK)
        status = tn_finds_begin(finds, error);
    if (status == TN_OK && !proof.proven)
        status = note_bound(s, proof.bound, finds->answer, error);
    if (status == TN_OK && !finds->ended)
        status = give_searched(s, &plans, finds, error);
    tn_searched_plans_clear(&plans);
    mpq_clear(proof.bound);
    return status;
}

static tn_status best_plans(tn_session *session, const tn_best_request *request, tn_reply *answer)
{
    searching s = {.session = session, .request = request};
    uint64_t wanted = request->has_count ? request->count : TN_BEST_DEFAULT;
    tn_error error;
    if (request->diverse && wanted > TN_DIVERSE_MAX)
        return refuse_many(session, wanted, TN_DIVERSE_MAX, "plans");
    bool simple = request->by.count <= 1 && !request->diverse && !request->mirror; /* enough to be searched */
    tn_error limit;
    tn_status status = simple
                           ? tn_session_searched(session, &request->subject, false, &s.ready, &limit)
                           : tn_searched_instead(session, tn_session_library(session, &request->subject, &s.ready),
                                                 "by one measure, without --diverse and --mirror, `best` finds plans "
                                                 "of such a library by search; by several, `pareto` does");
    if (status == TN_OK)
        status = take_wishes(&s);
    if (status != TN_OK)
        return status;
    bool searched = !s.ready->library;
    if (searched && tn_named_measure_over(session->opened->module, s.wishes.measures[0]) != TN_NO_RECORD)
        return tn_session_fail(session, &limit);
    tn_found_of of = {.plans = s.ready, .wishes = &s.wishes, .unranked = searched};
    tn_finds finds = {.session = session, .of = &of, .answer = answer, .lines = request->lines};
    tn_wishes_room(s.values);
    if (searched)
        status = best_searched(&s, &limit, &finds, &error);
    else
        status = prepare(&s, &error);
    if (status == TN_OK && !searched)
        status = tn_finds_begin(&finds, &error);
    if (status == TN_OK && !searched && !finds.ended)
        status = (request->diverse ? give_diverse : give_plans)(&s, wanted, &finds, &error);
    clear(&s);
    return tn_finds_end(&finds, status, &error);
}

tn_status tn_ask_best(tn_session *session, const tn_best_request *request, tn_reply *answer)
{
    *answer = (tn_reply){0};
    bool houses = request->plan || tn_session_of_houses(session, &request->subject);
    if (!houses)
        return best_plans(session, request, answer);
    return request->mirror ? tn_session_refuse(session, NULL, "--mirror is about plans, not about houses")
                           : find_best_houses(session, request, answer);
}

/* ---- the best houses */

/* Makes the measures ready, and takes their whole names. */
static tn_status find_measures(tn_houses_search *s)
{
    tn_ordered_wish wishes[TN_WEIGHED_MAX];
    for (uint32_t k = 0; k < s->found.count; k++)
        wishes[k] = (tn_ordered_wish){s->found.names[k], s->found.most[k]};
    tn_status status = tn_ordered_begin(&s->by, &s->n, s->plan.trays ? &s->plan : NULL, wishes, s->found.count);
    for (uint32_t k = 0; status == TN_OK && k < s->found.count; k++) {
        s->found.names[k] = tn_ordered_name(&s->by, k);
        s->found.units[k] = s->by.units[k];
    }
    return status;
}

static void note_without(const tn_houses_search *s)
{
    uint64_t without = s->by.walked.without;
    if (without > 0)
        tn_session_note(s->n.session, "%" PRIu64 " house%s without a value %s left out", without,
                        without > 1 ? "s" : "", without > 1 ? "are" : "is");
}

tn_status tn_houses_search_begin(tn_houses_search *s, tn_session *session, const tn_house_asked *asked)
{
    tn_error error;
    *s = (tn_houses_search){.wanted = asked->wanted, .diverse = asked->diverse, .reached = asked->wanted};
    if (asked->diverse && asked->wanted > TN_DIVERSE_HOUSES_MAX)
        return refuse_many(session, asked->wanted, TN_DIVERSE_HOUSES_MAX, "houses");
    tn_status status = wishes_take(session, asked->by, asked->by_count, asked->by_least, &s->found);
    if (status == TN_OK)
        status = tn_numbered_open_on(&s->n, session, asked->subject, asked->plan, &s->plan);
    if (status == TN_OK)
        status = find_measures(s);
    if (status != TN_OK)
        return status;
    status = tn_ordered_find(&s->by, asked->aim, asked->wanted, &error);
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    note_without(s);
    return TN_OK;
}

void tn_houses_search_end(tn_houses_search *s)
{
    tn_ordered_clear(&s->by);
    tn_lines_taken_clear(&s->taken);
    free(s->plan.trays);
    tn_numbered_close(&s->n);
}

tn_status tn_houses_search_give(tn_session *session, const tn_house_asked *asked,
                                tn_status (*give)(tn_houses_search *search, tn_reply *answer), tn_reply *answer)
{
    tn_houses_search search;
    tn_status status = tn_houses_search_begin(&search, session, asked);
    if (status == TN_OK)
        status = give(&search, answer);
    tn_houses_search_end(&search);
    return status;
}

/* ---- houses of the values */

/* Whoever gets the houses that were found gets them judged; diverse ones only if they differ so from those before. */
typedef struct judged {
    tn_houses_search *search;
    tn_house_alike alike;
    tn_house_each *each;
    void *context;
} judged;

static tn_status judge_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    judged *j = context;
    bool differs = true;
    tn_status status = TN_OK;
    if (j->search->diverse)
        status = tn_lines_take(&j->search->taken, house, j->alike, &differs, error);
    if (status == TN_OK && differs)
        status = tn_numbered_judge(&j->search->n, house, error);
    return status == TN_OK && differs ? j->each(j->context, house, stop, error) : status;
}

tn_status tn_houses_search_of_point(tn_houses_search *s, size_t point, tn_house_alike alike, tn_house_each *each,
                                    void *context, tn_error *error)
{
    judged j = {.search = s, .alike = alike, .each = each, .context = context};
    tn_ordered_come(&s->by, point);
    return tn_ordered_each(&s->by, alike, judge_house, &j, error);
}

static tn_status each_of_points(tn_houses_search *s, tn_house_alike alike, tn_house_each *each, void *context,
                                tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && s->given < s->wanted && i < tn_ordered_points(&s->by); i++)
        status = tn_houses_search_of_point(s, i, alike, each, context, error);
    return status;
}

/* ---- diverse ones */

/* May there be other plans among houses whose values are not known yet? */
static bool may_have_more(tn_houses_search *s)
{
    mpz_t known, plans;
    mpz_inits(known, plans, NULL);
    for (size_t i = 0; i < tn_ordered_points(&s->by); i++) {
        tn_ordered_come(&s->by, i);
        mpz_add(known, known, s->by.count);
    }
    tn_library_kept(s->n.plans, TN_ALL_LENGTHS, plans);
    bool more = mpz_cmp_ui(known, s->reached) >= 0 && mpz_cmp_ui(plans, s->taken.count) > 0 && !s->plan.trays;
    mpz_clears(known, plans, NULL);
    return more;
}

/* Finds the values of a thousand times as many houses. *more: there was none of the limits in the way. */
static tn_status reach_further(tn_houses_search *s, bool *more, tn_error *error)
{
    enum { FURTHER = 1000 };
    *more = s->reached <= INT64_MAX / FURTHER;
    if (!*more)
        return TN_OK;
    tn_status status = tn_ordered_find(&s->by, TN_HOUSES_LEAST, s->reached * FURTHER, error);
    *more = status == TN_OK;
    if (status == TN_LIMIT) {
        tn_session_note(s->n.session,
                        "only the best %" PRIu64 " houses are looked at for other plans: the values of more of them "
                        "are too many",
                        s->reached);
        return TN_OK;
    }
    if (status == TN_OK)
        s->reached *= FURTHER;
    return status;
}

static tn_status each_diverse(tn_houses_search *s, tn_house_each *each, void *context, tn_error *error)
{
    tn_status status = each_of_points(s, TN_ALIKE_PLAN, each, context, error);
    for (bool more = true; status == TN_OK && more && s->given < s->wanted && may_have_more(s);) {
        status = reach_further(s, &more, error);
        if (status == TN_OK && more)
            status = each_of_points(s, TN_ALIKE_PLAN, each, context, error);
    }
    for (int alike = TN_ALIKE_SECTION; status == TN_OK && alike <= TN_ALIKE_NOTHING; alike++)
        status = each_of_points(s, (tn_house_alike)alike, each, context, error);
    return status;
}

tn_status tn_houses_search_each(tn_houses_search *s, tn_house_each *each, void *context, tn_error *error)
{
    return s->diverse ? each_diverse(s, each, context, error)
                      : each_of_points(s, TN_ALIKE_NOTHING, each, context, error);
}

/* ---- asked */

typedef struct giving {
    tn_houses_search *search;
    tn_finds *finds;
    mpq_t values[TN_WEIGHED_MAX];
} giving;

static tn_status give_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    giving *g = context;
    tn_house same = *house; /* it is not the taker's */
    for (uint32_t k = 0; k < g->search->found.count; k++)
        tn_ordered_value(&g->search->by, k, g->values[k]);
    const tn_found_one found = {
        .trays = house->trays, .length = (uint32_t)house->length, .house = &same, .values = g->values};
    *stop = ++g->search->given == g->search->wanted;
    return tn_finds_give(g->finds, &found, error);
}

static tn_status give(tn_houses_search *search, tn_reply *answer)
{
    tn_session *session = search->n.session;
    tn_error error;
    tn_found_of of = {.houses = &search->n, .wishes = &search->found};
    tn_finds finds = {.session = session, .of = &of, .answer = answer};
    giving g = {.search = search, .finds = &finds};
    tn_wishes_room(g.values);
    tn_status status = tn_finds_begin(&finds, &error);
    if (status == TN_OK && !finds.ended)
        status = tn_houses_search_each(search, give_house, &g, &error);
    tn_wishes_clear(g.values);
    if (status == TN_OK && !finds.ended && search->by.walked.without == 0)
        tn_numbered_say_few(&search->n, search->plan.trays != NULL, search->given, search->wanted);
    return tn_finds_end(&finds, status, &error);
}

/* The best houses that are asked for. */
static tn_status find_best_houses(tn_session *session, const tn_best_request *request, tn_reply *answer)
{
    const tn_house_asked asked = {.subject = &request->subject,
                                  .plan = request->plan,
                                  .wanted = request->has_count ? request->count : TN_BEST_DEFAULT,
                                  .diverse = request->diverse,
                                  .aim = TN_HOUSES_LEAST,
                                  .by = request->by.items,
                                  .by_count = request->by.count,
                                  .by_least = 1};
    return tn_houses_search_give(session, &asked, give, answer);
}
