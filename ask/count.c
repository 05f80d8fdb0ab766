/* count: how many plans, houses or buildings there are. */
#include "ask/count.h"

#include "ask/questions.h"

/* What only libraries of plans and houses are asked, or NULL. */
static const char *asks_library(const tn_count_request *r)
{
    return r->subject.library       ? "library"
           : r->subject.where.count ? "where"
           : r->subject.has_trays   ? "trays"
           : r->by                  ? "by"
           : r->step                ? "step"
           : r->has_bins            ? "bins"
           : r->plan                ? "plan"
           : r->clauses             ? "clauses"
           : r->mirror              ? "mirror"
           : r->no_effects          ? "no-effects"
                                    : NULL;
}

/* With a plan or clauses, or if the library named is one of houses. */
static bool counts_houses(const tn_session *session, const tn_count_request *r)
{
    return r->plan || r->clauses || tn_session_of_houses(session, &r->subject);
}

tn_status tn_ask_count(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    const tn_kit_asked kit = tn_count_kit_asked(request);
    *answer = (tn_reply){0};
    if (session->opened->module->KIT_count > 0) {
        const char *option = asks_library(request);
        return option ? tn_session_refuse(session, NULL, "--%s is about a library of plans, and %.200s is a kit",
                                          option, session->opened->path)
                      : tn_count_kit(session, request, answer);
    }
    tn_status status = tn_kit_none_asked(session, &kit);
    if (status != TN_OK)
        return status;
    if (counts_houses(session, request))
        return tn_count_houses(session, request, answer);
    return request->by ? tn_count_plans_by(session, request, answer) : tn_count_plans(session, request, answer);
}
