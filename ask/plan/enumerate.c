/* enumerate: plans, or houses, in the order of their ranks; buildings of kits elsewhere. */
#include <stdlib.h>

#include "ask/place/kit.h"
#include "ask/plan/enumerate.h"
#include "ask/session/questions.h"
#include "driver/open/digits.h"

void tn_asked_rank(const char *digits, const mpz_t otherwise, mpz_t rank)
{
    if (!digits || !*digits || mpz_set_str(rank, digits, 10) != 0)
        mpz_set(rank, otherwise);
}

tn_status tn_refuse_range(tn_session *session, const char *from, const char *to)
{
    return tn_session_refuse(session, "write the smaller rank after --from",
                             "no rank is from %.60s on and before %.60s", from, to);
}

static void note_end(tn_session *session, const mpz_t kept, const char *from)
{
    char *digits = tn_digits(kept, false);
    tn_session_note(session, "the library holds %.400s plans, none of them from rank %.40s on", digits ? digits : "?",
                    from);
    free(digits);
}

tn_status tn_asked_range(tn_session *session, const tn_library *library, const char *from, const char *to, mpz_t begin,
                         mpz_t end)
{
    mpz_t kept, zero;
    mpz_inits(kept, zero, NULL);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    tn_asked_rank(from, zero, begin);
    tn_asked_rank(to, kept, end);
    bool backwards = to && mpz_cmp(begin, end) > 0;
    if (!backwards && mpz_sgn(kept) > 0 && mpz_cmp(begin, kept) >= 0)
        note_end(session, kept, from);
    if (mpz_cmp(end, kept) > 0)
        mpz_set(end, kept);
    if (mpz_cmp(begin, end) > 0)
        mpz_set(begin, end);
    mpz_clears(kept, zero, NULL);
    return backwards ? tn_refuse_range(session, from, to) : TN_OK;
}

uint64_t tn_enumerate_limit(const tn_session *session, const tn_enumerate_request *request)
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

static tn_status give_plans(enumeration *e, tn_finds *finds, tn_cursor *cursor, tn_error *error)
{
    tn_watch *watch = e->session->opened->module->watch;
    const tn_tray *trays;
    uint32_t length;
    tn_status status = TN_OK;
    for (size_t seen = 1; status == TN_OK && !is_done(e) && tn_cursor_next(cursor, &trays, &length); seen++) {
        if (is_wanted(e, trays, length)) {
            status = tn_finds_give(finds, &(tn_found_one){.rank = e->rank, .trays = trays, .length = length}, error);
            e->given++;
        }
        mpz_add_ui(e->rank, e->rank, 1);
        if (status == TN_OK && tn_watch_stopped_at(watch, seen))
            status = tn_fail_stopped(watch, error);
    }
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
    tn_cursor *cursor;
    tn_error error;
    tn_found_of of = {.plans = e->ready, .from = e->rank, .to = e->to};
    tn_finds finds = {.session = e->session, .of = &of, .answer = answer, .lines = e->request->lines};
    tn_status status = tn_finds_begin(&finds, &error);
    if (status != TN_OK || finds.ended)
        return tn_finds_end(&finds, status, &error);
    e->given = of.before;
    status = tn_cursor_new(e->ready->library, e->rank, e->to, &cursor, &error);
    if (status == TN_OK) {
        status = give_plans(e, &finds, cursor, &error);
        tn_cursor_free(cursor);
    }
    if (status == TN_OK)
        tell_next(e, answer);
    return tn_finds_end(&finds, status, &error);
}

static tn_status enumerate_plans(tn_session *session, const tn_enumerate_request *request, tn_reply *answer)
{
    enumeration e = {.session = session, .request = request, .limit = tn_enumerate_limit(session, request)};
    tn_status status = tn_session_library(session, &request->subject, &e.ready);
    if (status != TN_OK)
        return status;
    mpz_inits(e.rank, e.to, NULL);
    status = tn_asked_range(session, e.ready->library, request->from, request->to, e.rank, e.to);
    if (status == TN_OK)
        status = enumerate(&e, answer);
    mpz_clears(e.rank, e.to, NULL);
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
    return is_backwards(request->from, request->to) ? tn_refuse_range(session, request->from, request->to)
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
    if (!request->plan && !tn_session_of_houses(session, &request->subject))
        return enumerate_plans(session, request, answer);
    return request->mirror ? tn_session_refuse(session, NULL, "--mirror is about plans: of houses all are written")
                           : tn_enumerate_houses(session, request, answer);
}
