/* Counts the houses of a library, or those on one plan. */
#include <stdlib.h>

#include "ask/house/numbered_count.h"
#include "ask/plan/count.h"

static tn_status count_by(tn_numbered *n, const tn_count_request *request, const tn_plan *plan, tn_reply *answer)
{
    tn_session *session = n->session;
    tn_error error;
    uint32_t measure;
    tn_status status = tn_house_measure_choose(session->opened, request->by, n->record->form, &measure);
    if (status != TN_OK)
        return status;
    tn_spread *spread = tn_spread_room(session);
    if (!spread)
        return TN_MEMORY;
    tn_session_begins(session, "counting by the measure");
    status = tn_numbered_spread(n, plan, measure, spread, &error);
    tn_session_ends(session);
    if (status == TN_OK)
        return tn_reply_spread(session, request, spread, answer);
    tn_spread_clear(spread);
    free(spread);
    return tn_session_fail(session, &error);
}

static tn_status count_all(tn_numbered *n, const tn_count_request *request, const tn_plan *plan, tn_reply *answer)
{
    tn_error error;
    tn_status status = tn_reply_new(&tn_message_counted_houses, answer, &error);
    if (status == TN_OK)
        status = tn_numbered_count(n, plan, request->clauses, answer->value, &error);
    if (status != TN_OK)
        return tn_session_fail(n->session, &error);
    const tn_counted_houses *counted = answer->value;
    if (mpz_sgn(counted->houses) == 0 && !request->clauses)
        tn_numbered_say_few(n, plan != NULL, 0, 1);
    return TN_OK;
}

tn_status tn_count_houses(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    tn_numbered n;
    tn_plan on;
    tn_status status = tn_numbered_open_on(&n, session, &request->subject, request->plan, &on);
    if (status == TN_OK)
        status = (request->by ? count_by : count_all)(&n, request, request->plan ? &on : NULL, answer);
    free(on.trays);
    tn_numbered_close(&n);
    return status;
}
