/* Gives the houses of a library in the order of their ranks: plan by plan, each plan's houses one after another. */
#include <inttypes.h>
#include <stdlib.h>

#include "ask/plan/enumerate.h"

typedef struct house_list {
    tn_session *session;
    tn_finds *finds;
    mpz_t next;    /* the rank of the next house to be given */
    mpz_t to;      /* one past the last, if `bounded` */
    mpz_t before;  /* houses on the plans before */
    mpz_t variant; /* of the next house on the plan in hand */
    bool bounded;
    uint64_t given, limit; /* those before the first are counted */
} house_list;

static bool is_done(const house_list *list)
{
    return list->given >= list->limit || (list->bounded && mpz_cmp(list->next, list->to) >= 0);
}

static tn_status give_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    house_list *list = context;
    tn_watch *watch = list->session->opened->module->watch;
    tn_house same = *house; /* it is not the taker's */
    const tn_found_one found = {.rank = list->next,
                                .trays = house->trays,
                                .length = (uint32_t)house->length,
                                .house = &same,
                                .variant = list->variant};
    tn_status status = tn_finds_give(list->finds, &found, error);
    if (status != TN_OK)
        return status;
    mpz_add_ui(list->next, list->next, 1);
    mpz_add_ui(list->variant, list->variant, 1);
    list->given++;
    *stop = is_done(list);
    return *stop ? TN_OK : tn_watch_check(watch, error);
}

/* The number on its plan of the next house; false: it is not one of the plan's. */
static bool find_variant(house_list *list, const mpz_t houses)
{
    if (is_done(list))
        return false;
    mpz_sub(list->variant, list->next, list->before);
    return mpz_cmp(list->variant, houses) < 0;
}

/* Gives the houses on a plan that are asked for. */
static tn_status list_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                           tn_error *error)
{
    house_list *list = context;
    mpz_t houses, first;
    mpz_inits(houses, first, NULL);
    tn_status status = tn_numbered_houses_on(n, trays, length, houses, error);
    if (status == TN_OK && find_variant(list, houses)) {
        mpz_set(first, list->variant);
        status = tn_numbered_each(n, trays, length, first, give_house, list, error);
    }
    mpz_add(list->before, list->before, houses); /* those up to the end of this plan */
    *stop = is_done(list);
    mpz_clears(houses, first, NULL);
    return status;
}

static void say_none(const tn_numbered *n, bool on_plan, const house_list *list)
{
    bool past = list->given == 0 && mpz_cmp(list->next, list->before) >= 0;
    if (!past || list->bounded || list->limit == 0)
        return;
    if (mpz_sgn(list->before) == 0) {
        tn_numbered_say_few(n, on_plan, 0, 1);
        return;
    }
    char *rank = mpz_get_str(NULL, 10, list->next), *houses = mpz_get_str(NULL, 10, list->before);
    tn_session_note(list->session, "there are %.400s houses, none of them from rank %.40s on", houses ? houses : "?",
                    rank ? rank : "?");
    free(houses);
    free(rank);
}

/* Finds the rank of the plan to begin with, and the houses before it: at once if all can be counted together; else
 * the plans before it are gone through. */
static tn_status find_plan(tn_numbered *n, house_list *list, mpz_t plan, tn_error *error)
{
    mpz_set_ui(plan, 0);
    if (mpz_sgn(list->next) == 0)
        return TN_OK;
    tn_status status = tn_numbered_all(n, error);
    if (status != TN_OK)
        return status == TN_LIMIT ? TN_OK : status;
    return tn_numbered_locate(n, list->next, plan, list->before, error);
}

static tn_status list_from(tn_numbered *n, house_list *list, tn_error *error)
{
    mpz_t plan;
    mpz_init(plan);
    tn_status status = find_plan(n, list, plan, error);
    if (status == TN_OK)
        status = tn_numbered_plans_from(n, plan, list_plan, list, error);
    mpz_clear(plan);
    return status;
}

/* In an answer, whether there may be more. */
static void tell_next(const house_list *list, tn_reply *answer)
{
    tn_found_houses *houses = TN_REPLY(found_houses, answer);
    houses->has_next = list->given >= list->limit && !(list->bounded && mpz_cmp(list->next, list->to) >= 0);
    mpz_set(houses->next, list->next);
}

static tn_status list_houses(tn_numbered *n, const tn_plan *plan, house_list *list, tn_reply *answer)
{
    bool stop = false;
    tn_error error;
    tn_found_of of = {.houses = n, .from = list->next, .to = list->bounded ? list->to : NULL};
    tn_finds finds = {.session = n->session, .of = &of, .answer = answer};
    list->finds = &finds;
    tn_status status = tn_finds_begin(&finds, &error);
    if (status != TN_OK || finds.ended)
        return tn_finds_end(&finds, status, &error);
    list->given = of.before;
    status = plan ? list_plan(n, list, plan->trays, (uint32_t)plan->length, &stop, &error) : list_from(n, list, &error);
    if (status == TN_OK) {
        say_none(n, plan != NULL, list);
        tell_next(list, answer);
    }
    return tn_finds_end(&finds, status, &error);
}

static tn_status read_range(tn_session *session, const tn_enumerate_request *request, house_list *list)
{
    mpz_t zero;
    mpz_init(zero);
    list->bounded = request->to && *request->to;
    tn_asked_rank(request->from, zero, list->next);
    tn_asked_rank(request->to, zero, list->to);
    mpz_clear(zero);
    return !list->bounded || mpz_cmp(list->next, list->to) <= 0 ? TN_OK
                                                                : tn_refuse_range(session, request->from, request->to);
}

tn_status tn_enumerate_houses(tn_session *session, const tn_enumerate_request *request, tn_reply *answer)
{
    house_list list = {.session = session, .limit = tn_enumerate_limit(session, request)};
    tn_numbered n = {0};
    tn_plan on = {0};
    mpz_inits(list.next, list.to, list.before, list.variant, NULL);
    tn_status status = read_range(session, request, &list);
    if (status == TN_OK)
        status = tn_numbered_open_on(&n, session, &request->subject, request->plan, &on);
    if (status == TN_OK)
        status = list_houses(&n, request->plan ? &on : NULL, &list, answer);
    free(on.trays);
    tn_numbered_close(&n);
    mpz_clears(list.next, list.to, list.before, list.variant, NULL);
    return status;
}
