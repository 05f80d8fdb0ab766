/* enumerate: plans, or houses, in the order of their ranks; buildings of kits elsewhere. */
#include "ask/plan/enumerate.h"

#include <inttypes.h>
#include <stdlib.h>

#include "ask/house/tried.h"
#include "ask/place/kit.h"
#include "ask/plan/plan_rows.h"
#include "ask/plan/searched.h"
#include "ask/session/questions.h"
#include "driver/open/digits.h"
#include "runtime/house/house.h"

static tn_status enumerate_houses(tn_session *session, const tn_enumerate_request *request, tn_reply *answer);

/* A rank in digits ("" or NULL: `otherwise`). `rank` is initialised. */
static void asked_rank(const char *digits, const mpz_t otherwise, mpz_t rank)
{
    if (!digits || !*digits || mpz_set_str(rank, digits, 10) != 0)
        mpz_set(rank, otherwise);
}

/* Says that these ranks are the wrong way round. */
static tn_status refuse_range(tn_session *session, const char *from, const char *to)
{
    return tn_session_refuse(session, "write the smaller rank after --from",
                             "no rank is from %.60s on and before %.60s", from, to);
}

static void note_end(tn_session *session, const mpz_t kept, const char *what, const char *from)
{
    char *digits = tn_digits(kept, false);
    tn_session_note(session, "the library holds %.400s %s, none of them from rank %.40s on", digits ? digits : "?",
                    what, from);
    free(digits);
}

tn_status tn_asked_range(tn_session *session, const mpz_t kept, const char *what, const char *from, const char *to,
                         mpz_t begin, mpz_t end)
{
    mpz_t zero;
    mpz_init(zero);
    asked_rank(from, zero, begin);
    asked_rank(to, kept, end);
    bool backwards = to && mpz_cmp(begin, end) > 0;
    if (!backwards && mpz_sgn(kept) > 0 && mpz_cmp(begin, kept) >= 0)
        note_end(session, kept, what, from);
    if (mpz_cmp(end, kept) > 0)
        mpz_set(end, kept);
    if (mpz_cmp(begin, end) > 0)
        mpz_set(begin, end);
    mpz_clear(zero);
    return backwards ? refuse_range(session, from, to) : TN_OK;
}

/* How many are given at most. */
static uint64_t enumerate_limit(const tn_session *session, const tn_enumerate_request *request)
{
    return request->has_limit ? request->limit : session->taker ? UINT64_MAX : TN_ROWS_DEFAULT;
}

/* ---- plans */

typedef struct enumeration {
    tn_session *session;
    const tn_ready_library *ready;
    const tn_enumerate_request *request;
    mpz_t rank, to; /* of the next plan; one past the last */
    uint64_t given, limit;
} enumeration;

static bool is_done(const enumeration *e)
{
    return e->given >= e->limit;
}

/* One of each pair, or any. */
static bool is_wanted(const enumeration *e, const tn_tray *trays, uint32_t length)
{
    return !e->request->mirror || tn_library_mirror_first(e->ready->library, trays, length);
}

static tn_status give_each(enumeration *e, tn_finds *finds, tn_error *error)
{
    tn_watch *watch = e->session->opened->module->watch;
    const tn_tray *trays;
    uint32_t length;
    tn_cursor *cursor;
    tn_status status = tn_cursor_new(e->ready->library, e->rank, e->to, &cursor, error);
    if (status != TN_OK)
        return status;
    for (size_t seen = 1; status == TN_OK && !is_done(e) && tn_cursor_next(cursor, &trays, &length); seen++) {
        if (is_wanted(e, trays, length)) {
            status = tn_finds_give(finds, &(tn_found_one){.rank = e->rank, .trays = trays, .length = length}, error);
            e->given++;
        }
        mpz_add_ui(e->rank, e->rank, 1);
        if (status == TN_OK && tn_watch_stopped_at(watch, seen))
            status = tn_fail_stopped(watch, error);
    }
    tn_cursor_free(cursor);
    return status;
}

/* The same by a taker who lists plans: as many ranks as are wanted. */
static tn_status list_plans(enumeration *e, tn_finds *finds, tn_error *error)
{
    uint64_t wanted = e->limit > e->given ? e->limit - e->given : 0;
    mpz_t end;
    mpz_init_set_ui(end, (unsigned long)(wanted >> 32));
    mpz_mul_2exp(end, end, 32);
    mpz_add_ui(end, end, (unsigned long)(wanted & UINT32_MAX));
    mpz_add(end, end, e->rank);
    if (mpz_cmp(end, e->to) > 0)
        mpz_set(end, e->to);
    tn_status status = tn_finds_list(finds, e->rank, end, tn_asked_threads(&e->request->subject), error);
    if (status == TN_OK)
        mpz_set(e->rank, end);
    mpz_clear(end);
    return status;
}

/* In an answer, whether there may be more. */
static void tell_next(const enumeration *e, tn_reply *answer)
{
    tn_found_plans *plans = TN_REPLY(found_plans, answer);
    plans->has_next = mpz_cmp(e->rank, e->to) < 0;
    mpz_set(plans->next, e->rank);
}

static tn_status enumerate(enumeration *e, tn_reply *answer)
{
    tn_error error;
    tn_found_of of = {.plans = e->ready, .from = e->rank, .to = e->to, .ways = e->request->ways};
    tn_finds finds = {.session = e->session, .of = &of, .answer = answer, .lines = e->request->lines};
    tn_status status = tn_finds_begin(&finds, &error);
    if (status != TN_OK || finds.ended)
        return tn_finds_end(&finds, status, &error);
    e->given = of.before;
    bool lists = tn_finds_lists(&finds) && !e->request->mirror;
    status = lists ? list_plans(e, &finds, &error) : give_each(e, &finds, &error);
    if (status == TN_OK)
        tell_next(e, answer);
    return tn_finds_end(&finds, status, &error);
}

/* ---- plans that are searched: how many there are is not known, so ranks are counted on the way */

typedef struct searching {
    enumeration *e;
    tn_plan_search *search;
    bool bounded; /* by a rank after the last */
    bool ended;   /* there is no plan any more */
} searching;

static tn_status give_searched(const searching *s, tn_finds *finds, const mpz_t rank, const tn_tray *trays,
                               uint32_t length, tn_error *error)
{
    enumeration *e = s->e;
    bool wanted = true;
    tn_status status = e->request->mirror ? tn_searched_mirror_first(s->search, trays, length, &wanted, error) : TN_OK;
    if (status != TN_OK || !wanted)
        return status;
    e->given++;
    return tn_finds_give(finds, &(tn_found_one){.rank = rank, .trays = trays, .length = length}, error);
}

/* Plans before the first rank that is asked for are found, too, and not given. */
static tn_status search_plans(searching *s, tn_finds *finds, tn_error *error)
{
    enumeration *e = s->e;
    mpz_t rank;
    mpz_init(rank);
    tn_status status = TN_OK;
    while (status == TN_OK && !is_done(e) && !(s->bounded && mpz_cmp(rank, e->to) >= 0)) {
        const tn_tray *trays;
        uint32_t length;
        status = tn_plan_search_next(s->search, &trays, &length, error);
        s->ended = status == TN_OK && !trays;
        if (status != TN_OK || s->ended)
            break;
        if (mpz_cmp(rank, e->rank) >= 0)
            status = give_searched(s, finds, rank, trays, length, error);
        mpz_add_ui(rank, rank, 1);
    }
    if (s->ended && mpz_sgn(rank) > 0 && mpz_cmp(rank, e->rank) <= 0)
        note_end(e->session, rank, "plans", e->request->from);
    if (mpz_cmp(rank, e->rank) > 0)
        mpz_set(e->rank, rank);
    mpz_clear(rank);
    return status;
}

static tn_status list_searched(searching *s, tn_reply *answer, tn_error *error)
{
    enumeration *e = s->e;
    tn_found_of of = {.plans = e->ready, .from = e->rank, .to = s->bounded ? e->to : NULL};
    tn_finds finds = {.session = e->session, .of = &of, .answer = answer, .lines = e->request->lines};
    tn_status status = tn_finds_begin(&finds, error);
    if (status == TN_OK && !finds.ended) {
        e->given = of.before;
        status = search_plans(s, &finds, error);
    }
    tn_found_plans *plans = TN_REPLY(found_plans, answer);
    if (status == TN_OK && plans) {
        plans->has_next = !s->ended && !(s->bounded && mpz_cmp(e->rank, e->to) >= 0);
        mpz_set(plans->next, e->rank);
    }
    return tn_finds_end(&finds, status, error);
}

static tn_status enumerate_searched(enumeration *e, const tn_error *limit, tn_reply *answer)
{
    const tn_enumerate_request *request = e->request;
    const tn_search_options options = tn_asked_search(&request->subject, &request->search);
    searching s = {.e = e, .bounded = request->to && *request->to};
    tn_error error;
    asked_rank(request->from, e->to, e->rank); /* `to` is 0 yet */
    asked_rank(request->to, e->to, e->to);
    if (s.bounded && mpz_cmp(e->rank, e->to) > 0)
        return refuse_range(e->session, request->from, request->to);
    tn_searched_note(e->session, limit);
    tn_status status = tn_plan_search_new(e->ready->schema, e->ready->index, &options, &s.search, &error);
    if (status != TN_OK)
        return tn_session_fail(e->session, &error);
    status = list_searched(&s, answer, &error);
    tn_plan_search_free(s.search);
    return status;
}

/* In how many ways plans are derived is found by the library's automaton alone. */
static tn_status enumerate_plans(tn_session *session, const tn_enumerate_request *request, tn_reply *answer)
{
    enumeration e = {.session = session, .request = request, .limit = enumerate_limit(session, request)};
    tn_error limit;
    tn_status status = request->ways ? tn_session_library(session, &request->subject, &e.ready)
                                     : tn_session_searched(session, &request->subject, false, &e.ready, &limit);
    if (status != TN_OK)
        return status;
    mpz_t kept;
    mpz_inits(e.rank, e.to, kept, NULL);
    if (e.ready->library) {
        tn_library_kept(e.ready->library, TN_ALL_LENGTHS, kept);
        status = tn_asked_range(session, kept, "plans", request->from, request->to, e.rank, e.to);
    }
    if (status == TN_OK)
        status = e.ready->library ? enumerate(&e, answer) : enumerate_searched(&e, &limit, answer);
    mpz_clears(e.rank, e.to, kept, NULL);
    return status;
}

/* ---- rows of plans */

static tn_status give_rows(enumeration *e, tn_finds *finds, tn_rows_of_plans *rows, tn_error *error)
{
    tn_watch *watch = e->session->opened->module->watch;
    tn_status status = TN_OK;
    while (status == TN_OK && !is_done(e) && mpz_cmp(e->rank, e->to) < 0) {
        status = tn_rows_give(rows, e->rank, finds, error);
        e->given++;
        mpz_add_ui(e->rank, e->rank, 1);
        if (status == TN_OK)
            status = tn_watch_check(watch, error);
    }
    return status;
}

static tn_status list_rows(enumeration *e, tn_rows_of_plans *rows, mpz_srcptr all, tn_reply *answer)
{
    tn_error error;
    tn_found_of of = {.plans = e->ready, .from = e->rank, .to = e->to, .rows = all};
    tn_finds finds = {.session = e->session, .of = &of, .answer = answer, .lines = e->request->lines};
    tn_status status = tn_finds_begin(&finds, &error);
    if (status != TN_OK || finds.ended)
        return tn_finds_end(&finds, status, &error);
    e->given = of.before;
    status = give_rows(e, &finds, rows, &error);
    if (status == TN_OK)
        tell_next(e, answer);
    return tn_finds_end(&finds, status, &error);
}

static tn_status enumerate_rows(tn_session *session, const tn_enumerate_request *request, tn_reply *answer)
{
    enumeration e = {.session = session, .request = request, .limit = enumerate_limit(session, request)};
    tn_rows_of_plans rows = {0};
    mpz_t all;
    mpz_inits(e.rank, e.to, all, NULL);
    tn_status status = tn_session_library(session, &request->subject, &e.ready);
    if (status == TN_OK)
        status = tn_rows_open(&rows, session, e.ready, &request->subject);
    if (status == TN_OK) {
        tn_plan_rows_count(rows.rows, TN_ALL_LENGTHS, all);
        status = tn_asked_range(session, all, "rows of plans", request->from, request->to, e.rank, e.to);
    }
    if (status == TN_OK)
        status = list_rows(&e, &rows, all, answer);
    tn_rows_close(&rows);
    mpz_clears(e.rank, e.to, all, NULL);
    return status;
}

/* ---- asked */

/* What only libraries of plans and houses are asked, or NULL. */
static const char *asks_library(const tn_enumerate_request *r)
{
    return r->subject.library       ? "library"
           : r->subject.where.count ? "where"
           : r->subject.has_trays   ? "trays"
           : r->plan                ? "plan"
           : r->mirror              ? "mirror"
           : r->lines               ? "lines"
           : r->ways                ? "ways"
           : r->plans               ? "plans"
                                    : NULL;
}

static bool is_backwards(const char *from, const char *to)
{
    mpz_t ranks[2];
    bool backwards = false;
    mpz_inits(ranks[0], ranks[1], NULL);
    if (to && *to && from && *from && mpz_set_str(ranks[0], from, 10) == 0 && mpz_set_str(ranks[1], to, 10) == 0)
        backwards = mpz_cmp(ranks[0], ranks[1]) > 0;
    mpz_clears(ranks[0], ranks[1], NULL);
    return backwards;
}

static tn_status enumerate_kit(tn_session *session, const tn_enumerate_request *request, tn_reply *answer)
{
    const char *option = asks_library(request);
    if (option)
        return tn_session_refuse(session, NULL, "--%s is about a library of plans, and %.200s is a kit", option,
                                 session->opened->path);
    return is_backwards(request->from, request->to) ? refuse_range(session, request->from, request->to)
                                                    : tn_enumerate_kit(session, request, answer);
}

static bool is_number(const char *text)
{
    return !text || !*text || tn_is_rank(text);
}

tn_status tn_ask_enumerate(tn_session *session, const tn_enumerate_request *request, tn_reply *answer)
{
    *answer = (tn_reply){0};
    if (!is_number(request->from) || !is_number(request->to))
        return tn_session_refuse(session, NULL, "a rank is a whole number from 0, not `%.60s`",
                                 is_number(request->from) ? request->to : request->from);
    if (session->opened->module->KIT_count > 0)
        return enumerate_kit(session, request, answer);
    tn_status status = tn_kit_none_asked(session, &request->kit);
    if (status != TN_OK)
        return status;
    bool houses = request->plan || tn_session_of_houses(session, &request->subject);
    if (request->plans && (houses || request->ways || request->mirror))
        return tn_rows_refuse_with(session, houses ? "houses" : request->ways ? "--ways" : "--mirror");
    if (!houses)
        return (request->plans ? enumerate_rows : enumerate_plans)(session, request, answer);
    if (request->ways)
        return tn_ways_refuse_houses(session);
    return request->mirror ? tn_session_refuse(session, NULL, "--mirror is about plans: of houses all are written")
                           : enumerate_houses(session, request, answer);
}

/* ---- gives the houses of a library in the order of their ranks */

typedef struct house_list {
    tn_session *session;
    tn_finds *finds;
    mpz_t next;    /* the rank of the next house to be given */
    mpz_t to;      /* one past the last, if `bounded` */
    mpz_t before;  /* houses on the plans before */
    mpz_t variant; /* of the next house on the plan in hand */
    bool bounded;
    uint64_t given, limit;  /* those before the first are counted */
    tn_tried_houses *tried; /* NULL: they are not */
    bool untried;           /* some are left */
} house_list;

static bool is_list_done(const house_list *list)
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
    *stop = is_list_done(list);
    return *stop ? TN_OK : tn_watch_check(watch, error);
}

/* Gives the houses on a plan that are asked for. */
static tn_status list_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                           tn_error *error)
{
    house_list *list = context;
    tn_status status = TN_OK;
    mpz_sub(list->variant, list->next, list->before);
    if (!is_list_done(list))
        status = tn_numbered_each_from(n, trays, length, list->next, list->before, give_house, list, error);
    *stop = is_list_done(list);
    return status;
}

static void say_none(const tn_numbered *n, bool on_plan, const house_list *list)
{
    bool past = list->given == 0 && mpz_cmp(list->next, list->before) >= 0;
    if (!past || list->untried || list->bounded || list->limit == 0)
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

/* Tries a house of the library without the clauses that ask for walks; those that are kept are in the same order. */
static tn_status try_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    house_list *list = context;
    tn_house same = *house;
    bool kept = false;
    same.form = &list->tried->n->form;
    *stop = list->untried = !tn_tried_more(list->tried);
    tn_status status = *stop ? TN_OK : tn_tried_try(list->tried, &same, &kept, error);
    if (status != TN_OK || !kept)
        return status;
    if (mpz_cmp(list->before, list->next) >= 0)
        status = give_house(list, &same, stop, error);
    else
        mpz_add_ui(list->variant, list->variant, 1);
    mpz_add_ui(list->before, list->before, 1);
    return status;
}

static tn_status try_plan(tn_numbered *without, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                          tn_error *error)
{
    house_list *list = context;
    mpz_t first;
    mpz_init(first);
    mpz_set_ui(list->variant, 0);
    tn_status status = tn_numbered_each(without, trays, length, first, try_house, list, error);
    *stop = list->untried || is_list_done(list);
    mpz_clear(first);
    return status;
}

static tn_status list_tried(tn_numbered *n, house_list *list, tn_error *error)
{
    tn_tried_houses tried;
    list->tried = &tried;
    tn_status status = tn_tried_begin(n, TN_LISTED_HOUSES_DEFAULT, &tried, error);
    if (status == TN_OK && !is_list_done(list))
        status = tn_numbered_plans_until(&tried.without, try_plan, list, error);
    if (status == TN_OK && list->untried)
        status = tn_tried_end(&tried, 0, error);
    tn_tried_clear(&tried);
    list->tried = NULL;
    return status;
}

static tn_status list_from(tn_numbered *n, house_list *list, tn_error *error)
{
    mpz_t plan;
    if (tn_numbered_walks(n))
        return list_tried(n, list, error);
    mpz_init(plan);
    tn_status status = find_plan(n, list, plan, error);
    if (status == TN_OK)
        status = tn_numbered_plans_from(n, plan, list_plan, list, error);
    mpz_clear(plan);
    return status;
}

/* In an answer, whether there may be more. */
static void tell_next_house(const house_list *list, tn_reply *answer)
{
    tn_found_houses *houses = TN_REPLY(found_houses, answer);
    houses->has_next =
        (list->untried || list->given >= list->limit) && !(list->bounded && mpz_cmp(list->next, list->to) >= 0);
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
        tell_next_house(list, answer);
    }
    return tn_finds_end(&finds, status, &error);
}

static tn_status read_range(tn_session *session, const tn_enumerate_request *request, house_list *list)
{
    mpz_t zero;
    mpz_init(zero);
    list->bounded = request->to && *request->to;
    asked_rank(request->from, zero, list->next);
    asked_rank(request->to, zero, list->to);
    mpz_clear(zero);
    return !list->bounded || mpz_cmp(list->next, list->to) <= 0 ? TN_OK
                                                                : refuse_range(session, request->from, request->to);
}

/* The houses of a library, or on one plan. */
static tn_status enumerate_houses(tn_session *session, const tn_enumerate_request *request, tn_reply *answer)
{
    house_list list = {.session = session, .limit = enumerate_limit(session, request)};
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
