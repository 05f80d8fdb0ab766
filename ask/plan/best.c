/* best: the best plans, or houses, by measures, in their order. */
#include "ask/plan/best.h"

#include <stdlib.h>

#include "ask/session/questions.h"
#include "driver/open/digits.h"
#include "runtime/plan/library/rank.h"
#include "runtime/plan/measure/best.h"
#include "runtime/plan/measure/moments.h"
#include "runtime/plan/measure/named.h"

/* ---- measures */

tn_status tn_wishes_take(tn_session *session, const tn_wish *items, size_t count, uint32_t least, tn_wishes *wishes)
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
    tn_status status = tn_wishes_take(session, items, count, least, wishes);
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

char *tn_wish_text(const tn_wishes *wishes, uint32_t k, const mpq_t value)
{
    tn_buffer text = {0};
    if (tn_amount_write(wishes->units[k], value, &text))
        return text.data;
    free(text.data);
    return NULL;
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

static tn_status give_plans(searching *s, tn_finds *finds, tn_error *error)
{
    const tn_best_request *r = s->request;
    uint64_t count = r->has_count ? r->count : TN_BEST_DEFAULT;
    bool found = true;
    tn_status status = TN_OK;
    for (uint64_t given = 0; status == TN_OK && found && given < count;) {
        int64_t values[TN_WEIGHED_MAX];
        uint32_t length;
        if (given == 0) /* the first takes longest; from then on plans are given */
            tn_session_begins(s->session, "looking for the best");
        status = tn_best_next(s->best, s->trays, &length, values, &found, error);
        if (given == 0)
            tn_session_ends(s->session);
        if (status != TN_OK || !found || (r->mirror && !tn_library_mirror_first(s->ready->library, s->trays, length)))
            continue;
        status = give_plan(s, finds, length, values, error);
        given++;
    }
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

static tn_status best_plans(tn_session *session, const tn_best_request *request, tn_reply *answer)
{
    searching s = {.session = session, .request = request};
    tn_error error;
    tn_status status = tn_session_library(session, &request->subject, &s.ready);
    if (status == TN_OK)
        status = take_wishes(&s);
    if (status != TN_OK)
        return status;
    tn_found_of of = {.plans = s.ready, .wishes = &s.wishes};
    tn_finds finds = {.session = session, .of = &of, .answer = answer, .lines = request->lines};
    tn_wishes_room(s.values);
    status = prepare(&s, &error);
    if (status == TN_OK)
        status = tn_finds_begin(&finds, &error);
    if (status == TN_OK && !finds.ended)
        status = give_plans(&s, &finds, &error);
    clear(&s);
    return tn_finds_end(&finds, status, &error);
}

tn_status tn_ask_best(tn_session *session, const tn_best_request *request, tn_reply *answer)
{
    *answer = (tn_reply){0};
    if (!request->plan && !tn_session_of_houses(session, &request->subject))
        return best_plans(session, request, answer);
    return request->mirror ? tn_session_refuse(session, NULL, "--mirror is about plans, not about houses")
                           : tn_find_best_houses(session, request, answer);
}
