/* Runs of evolution live in folders and databases, of which a page has none, and the desk refuses these questions
 * before they are asked. That they are here keeps all that would answer them out of what a page loads. */
#include "ask/session/questions.h"
#include "runtime/base/part.h"

static tn_status refuse(tn_session *session, tn_reply *answer)
{
    tn_error error;
    *answer = (tn_reply){0};
    tn_part_absent(TN_WITH_STORE, "a run of evolution", &error);
    return tn_session_fail(session, &error);
}

#define TN_RUN_QUESTION(NAME, REQUEST, ANSWERS, DOC)                                                                   \
    tn_status tn_ask_##NAME(tn_session *session, const tn_##REQUEST *request, tn_reply *answer)                        \
    {                                                                                                                  \
        (void)request;                                                                                                 \
        return refuse(session, answer);                                                                                \
    }
#include "ask/session/requests.def"
