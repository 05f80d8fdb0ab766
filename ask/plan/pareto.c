/* pareto: the best trade-offs of two or three measures, of plans or houses. */
#include "ask/plan/best.h"

#include <stdlib.h>
#include <string.h>

#include "ask/plan/searched.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "runtime/plan/library/rank.h"
#include "runtime/plan/measure/named.h"

static void free_front(void *made)
{
    tn_plan_front *front = made;
    tn_pareto_clear(&front->front);
    tn_weighed_free(front->weighed);
    free(front);
}

static tn_status name_measures(const tn_wishes *wishes, tn_found_front *front, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < wishes->count; k++)
        status = tn_owneds_add(&front->measures, strdup(wishes->names[k]), error);
    return status;
}

/* The values, exact and for people. `values` are in nanometres to their power. */
static tn_status set_values(const tn_wishes *wishes, mpq_t *values, tn_front_point *point, tn_error *error)
{
    tn_status status = tn_exacts_room(&point->values, wishes->count, error);
    for (uint32_t k = 0; status == TN_OK && k < wishes->count; k++) {
        mpq_set(point->values.items[k], values[k]);
        tn_amount_convert(wishes->units[k], point->values.items[k]);
        status = tn_owneds_add(&point->shown, tn_wish_text(wishes, k, values[k]), error);
    }
    return status;
}

/* ---- plans */

static tn_status set_plan(const tn_plan_front *f, const tn_pareto_point *from, tn_front_point *point, tn_error *error)
{
    mpq_t values[TN_WEIGHED_MAX];
    tn_wishes_room(values);
    for (uint32_t k = 0; k < f->wishes.count; k++)
        tn_weighed_value(f->weighed, k, from->values, values[k]);
    tn_status status = set_values(&f->wishes, values, point, error);
    tn_wishes_clear(values);
    point->has_plans = point->has_rank = point->has_plan = true;
    mpz_set(point->plans, from->plans);
    if (status == TN_OK && !tn_library_rank(f->ready->library, from->trays, from->length, point->rank))
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a plan of the front is not in the library");
    return status == TN_OK ? tn_found_plan_texts(f->ready->schema, from->trays, from->length, &point->plan, NULL, error)
                           : status;
}

static tn_status find_plans(tn_session *session, tn_plan_front *f, tn_error *error)
{
    tn_session_begins(session, "looking for the front");
    tn_status status = tn_weighed_new(f->ready->library, f->wishes.measures, f->wishes.count, &f->weighed, error);
    if (status == TN_OK)
        status = tn_wishes_note_none(session, &f->wishes, f->weighed, error);
    if (status == TN_OK)
        status = tn_pareto_make(&f->front, f->weighed, f->wishes.most, error);
    tn_session_ends(session);
    return status;
}

static tn_status give_front(tn_session *session, tn_found_front *front, tn_error *error)
{
    tn_plan_front *f = front->shown.value;
    tn_status status = find_plans(session, f, error);
    if (status == TN_OK)
        status = name_measures(&f->wishes, front, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(front_point, front->points, f->front.count, error);
    for (size_t i = 0; status == TN_OK && i < f->front.count; i++)
        status = set_plan(f, &f->front.points[i], &front->points.items[i], error);
    return status;
}

/* ---- plans that are searched */

static tn_status set_searched(const tn_schema *schema, const tn_wishes *wishes, tn_searched_point *from,
                              tn_front_point *point, tn_error *error)
{
    tn_status status = set_values(wishes, from->values, point, error);
    point->has_plan = true;
    return status == TN_OK ? tn_found_plan_texts(schema, from->trays, from->length, &point->plan, NULL, error) : status;
}

static tn_status give_searched_front(const tn_ready_library *ready, const tn_wishes *wishes, tn_searched_front *found,
                                     tn_reply *answer, tn_error *error)
{
    tn_status status = tn_reply_new(&tn_message_found_front, answer, error);
    if (status != TN_OK)
        return status;
    tn_found_front *front = answer->value;
    front->has_proven = true;
    front->proven = found->proven;
    status = name_measures(wishes, front, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(front_point, front->points, found->count, error);
    for (size_t i = 0; status == TN_OK && i < found->count; i++)
        status = set_searched(ready->schema, wishes, &found->points[i], &front->points.items[i], error);
    return status;
}

/* A quotient's automaton alone has its values. */
static bool is_quotient(const tn_module *module, const tn_wishes *wishes)
{
    bool any = false;
    for (uint32_t k = 0; k < wishes->count; k++)
        any |= tn_named_measure_over(module, wishes->measures[k]) != TN_NO_RECORD;
    return any;
}

static tn_status search_front(tn_session *session, const tn_pareto_request *request, const tn_ready_library *ready,
                              const tn_wishes *wishes, const tn_error *limit, tn_reply *answer)
{
    const tn_module *module = session->opened->module;
    uint32_t sums[TN_WEIGHED_MAX];
    tn_searched_front found = {0};
    tn_plan_search *search;
    tn_error error;
    if (is_quotient(module, wishes))
        return tn_session_fail(session, limit);
    for (uint32_t k = 0; k < wishes->count; k++)
        sums[k] = tn_named_measure_sum(module, ready->record, wishes->measures[k]);
    tn_searched_note(session, limit);
    tn_status status = tn_searched_new(session, ready, &request->subject, &request->search, &search);
    if (status != TN_OK)
        return status;
    tn_session_begins(session, "looking for the front");
    status = tn_plan_search_front(search, sums, wishes->most, wishes->count, &found, &error);
    tn_session_ends(session);
    tn_plan_search_free(search);
    if (status == TN_OK && !found.proven)
        tn_session_note(session, "it is not proven within --max-conflicts that no plan betters one of these, and that "
                                 "none is missing");
    if (status == TN_OK)
        status = give_searched_front(ready, wishes, &found, answer, &error);
    tn_searched_front_clear(&found);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

static tn_status front_of_plans(tn_session *session, const tn_pareto_request *request, tn_reply *answer)
{
    const tn_ready_library *ready;
    tn_wishes wishes;
    tn_error error, limit;
    tn_status status = tn_session_searched(session, &request->subject, false, &ready, &limit);
    if (status == TN_OK)
        status = tn_wishes_of_plans(session, ready, request->by.items, request->by.count, 2, &wishes);
    if (status != TN_OK)
        return status;
    if (!ready->library)
        return search_front(session, request, ready, &wishes, &limit, answer);
    status = tn_reply_new(&tn_message_found_front, answer, &error);
    if (status == TN_OK) {
        tn_found_front *front = answer->value;
        tn_plan_front *f = calloc(1, sizeof *f);
        front->shown = (tn_boxed){f, free_front};
        if (f)
            *f = (tn_plan_front){.ready = ready, .wishes = wishes};
        status = f ? give_front(session, front, &error) : tn_fail_memory(&error);
    }
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* ---- houses */

static tn_status take_line(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    tn_front_point *point = context;
    *stop = true;
    return tn_found_house_texts(house, &point->house, NULL, error);
}

static tn_status set_house(tn_houses_search *search, size_t i, tn_front_point *point, tn_error *error)
{
    mpq_t values[TN_WEIGHED_MAX];
    tn_status status = tn_houses_search_of_point(search, i, TN_ALIKE_NOTHING, take_line, point, error);
    if (status != TN_OK)
        return status;
    tn_wishes_room(values);
    for (uint32_t k = 0; k < search->found.count; k++)
        tn_ordered_value(&search->by, k, values[k]);
    point->has_houses = point->has_house = true;
    mpz_set(point->houses, search->by.count);
    status = set_values(&search->found, values, point, error);
    tn_wishes_clear(values);
    return status;
}

static tn_status give_houses(tn_houses_search *search, tn_reply *answer)
{
    tn_error error;
    size_t count = tn_ordered_points(&search->by);
    tn_status status = tn_reply_new(&tn_message_found_front, answer, &error);
    tn_found_front *front = answer->value;
    if (status == TN_OK)
        status = name_measures(&search->found, front, &error);
    if (status == TN_OK)
        status = TN_NEW_LIST(front_point, front->points, count, &error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = set_house(search, i, &front->points.items[i], &error);
    return status == TN_OK ? TN_OK : tn_session_fail(search->n.session, &error);
}

static tn_status front_of_houses(tn_session *session, const tn_pareto_request *request, tn_reply *answer)
{
    const tn_house_asked asked = {.subject = &request->subject,
                                  .plan = request->plan,
                                  .wanted = UINT64_MAX,
                                  .aim = TN_HOUSES_FRONT,
                                  .by = request->by.items,
                                  .by_count = request->by.count,
                                  .by_least = 2};
    return tn_houses_search_give(session, &asked, give_houses, answer);
}

tn_status tn_ask_pareto(tn_session *session, const tn_pareto_request *request, tn_reply *answer)
{
    *answer = (tn_reply){0};
    bool houses = request->plan || tn_session_of_houses(session, &request->subject);
    return (houses ? front_of_houses : front_of_plans)(session, request, answer);
}
