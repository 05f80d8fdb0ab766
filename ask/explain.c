/* explain: why a plan or a house is kept or dropped. */
#include "ask/explain.h"

#include "ask/questions.h"

#include <string.h>

/* #P: is the plan of rank P, and what keeps houses off it. */
static bool is_for_houses(const tn_explain_request *request)
{
    const char *plan = request->plan;
    return plan && plan[0] == '#' && plan[strlen(plan) - 1] == ':';
}

static tn_status explain_of_houses(tn_session *session, const tn_explain_request *request, tn_reply *answer)
{
    if (request->has_nearest)
        return tn_session_refuse(session, NULL, "--nearest is about plans that a library of plans drops");
    return request->house ? tn_explain_house(session, request, answer) : tn_explain_cells(session, request, answer);
}

tn_status tn_ask_explain(tn_session *session, const tn_explain_request *request, tn_reply *answer)
{
    const char *library = request->subject.library;
    *answer = (tn_reply){0};
    if (!request->plan == !request->house)
        return tn_session_refuse(session, NULL, "say which plan or which house is explained: one of them");
    if (request->subject.has_trays)
        return tn_session_refuse(session, "leave it out",
                                 "--trays is for all plans of a library, and one is explained");
    bool of_houses =
        library && request->rules.count == 0 && tn_house_library_find(session->opened->module, library) != TN_NO_RECORD;
    return request->house || of_houses || is_for_houses(request) ? explain_of_houses(session, request, answer)
                                                                 : tn_explain_plan(session, request, answer);
}
