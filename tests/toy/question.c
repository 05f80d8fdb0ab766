/* A toy question: twice a number. */
#include "ask/session/questions.h"
#include "ask/session/requests.h"
#include "ask/session/session.h"

tn_status tn_ask_twice(tn_session *session, const tn_twice_request *request, tn_reply *answer)
{
    tn_error error;
    *answer = (tn_reply){0};
    if (tn_reply_new(&tn_message_doubled, answer, &error) != TN_OK)
        return tn_session_fail(session, &error);
    TN_REPLY(doubled, answer)->number = 2 * request->number;
    return TN_OK;
}
