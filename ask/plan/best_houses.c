/* The best houses of a library by measures: values, and the houses that have them. */
#include <stdlib.h>

#include "ask/plan/best.h"
#include "driver/plan/library.h"
#include "runtime/house/rank/rank.h"

static tn_status find_measures(tn_houses_search *s)
{
    const tn_module *module = s->n.form.module;
    tn_error error;
    for (uint32_t k = 0; k < s->found.count; k++) {
        uint32_t measure;
        tn_status status =
            tn_house_measure_choose(s->n.session->opened, s->found.names[k], s->n.record->form, &measure);
        if (status != TN_OK)
            return status;
        tn_house_measured of = tn_house_measured_of(module, measure);
        if (tn_house_weights_new(&s->n.form, of, &s->weights[k], &error) != TN_OK)
            return tn_session_fail(s->n.session, &error);
        s->found.names[k] = tn_text(module, s->weights[k]->of.name);
        s->found.units[k] = tn_amount_unit_of(s->n.schema, module->SUM_records[of.sum].power);
        s->measures.of[k] = s->weights[k];
        s->measures.most[k] = s->found.most[k];
    }
    s->measures.count = s->found.count;
    return TN_OK;
}

static tn_status find_values(tn_houses_search *s, const tn_house_asked *asked)
{
    tn_session *session = s->n.session;
    tn_houses_what what = {
        .measures = s->found.count ? &s->measures : NULL, .aim = asked->aim, .wanted = asked->wanted};
    tn_error error;
    if (asked->plan) {
        what.only = s->plan.trays;
        what.length = (uint32_t)s->plan.length;
    }
    tn_session_begins(session, "looking for the best");
    tn_status status = tn_houses_of(&s->n.form, s->n.record, s->n.plans, &what, s->n.max_states, &s->houses, &error);
    tn_session_ends(session);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

tn_status tn_houses_search_begin(tn_houses_search *s, tn_session *session, const tn_house_asked *asked)
{
    *s = (tn_houses_search){.wanted = asked->wanted};
    mpz_init(s->count);
    tn_status status = tn_wishes_take(session, asked->by, asked->by_count, asked->by_least, &s->found);
    if (status == TN_OK)
        status = tn_numbered_open_on(&s->n, session, asked->subject, asked->plan, &s->plan);
    if (status == TN_OK)
        status = find_measures(s);
    return status == TN_OK ? find_values(s, asked) : status;
}

void tn_houses_search_end(tn_houses_search *s)
{
    tn_houses_free(s->houses);
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        tn_house_weights_free(s->weights[k]);
    free(s->plan.trays);
    tn_numbered_close(&s->n);
    mpz_clear(s->count);
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

void tn_houses_search_value(const tn_houses_search *s, uint32_t k, mpq_t value)
{
    mpq_set_si(value, s->values[k], 1);
    mpq_mul(value, value, s->weights[k]->shown);
}

/* ---- houses of the values */

/* Whoever gets the houses that were found gets them judged. */
typedef struct judged {
    tn_numbered *n;
    tn_house_each *each;
    void *context;
} judged;

static tn_status judge_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    judged *j = context;
    tn_status status = tn_numbered_judge(j->n, house, error);
    return status == TN_OK ? j->each(j->context, house, stop, error) : status;
}

tn_status tn_houses_search_of_point(tn_houses_search *s, size_t point, tn_house_each *each, void *context,
                                    tn_error *error)
{
    tn_houses_point(s->houses, point, s->values, s->count);
    judged j = {.n = &s->n, .each = each, .context = context};
    return tn_houses_point_each(s->houses, point, judge_house, &j, error);
}

tn_status tn_houses_search_each(tn_houses_search *s, tn_house_each *each, void *context, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && s->given < s->wanted && i < tn_houses_points(s->houses); i++)
        status = tn_houses_search_of_point(s, i, each, context, error);
    return status;
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
        tn_houses_search_value(g->search, k, g->values[k]);
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
    if (status == TN_OK && !finds.ended)
        tn_numbered_say_few(&search->n, search->plan.trays != NULL, search->given, search->wanted);
    return tn_finds_end(&finds, status, &error);
}

tn_status tn_find_best_houses(tn_session *session, const tn_best_request *request, tn_reply *answer)
{
    const tn_house_asked asked = {.subject = &request->subject,
                                  .plan = request->plan,
                                  .wanted = request->has_count ? request->count : TN_BEST_DEFAULT,
                                  .aim = TN_HOUSES_LEAST,
                                  .by = request->by.items,
                                  .by_count = request->by.count,
                                  .by_least = 1};
    return tn_houses_search_give(session, &asked, give, answer);
}
