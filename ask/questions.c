/* The table of questions: what requests.def lists. */
#include "ask/session/questions.h"

#include <string.h>

#include "runtime/base/nearest.h"

#define TN_QUESTION(NAME, REQUEST, ANSWERS, DOC)                                                                       \
    static tn_status ask_##NAME(tn_session *session, const void *request, tn_reply *answer)                            \
    {                                                                                                                  \
        return tn_ask_##NAME(session, request, answer);                                                                \
    }
#include "ask/session/requests.def"

const tn_request_kind tn_request_kinds[] = {
#define KIND(NAME, REQUEST, ANSWERS, DOC, RUNS) {#NAME, &tn_message_##REQUEST, ANSWERS, DOC, RUNS, ask_##NAME},
#define TN_QUESTION(NAME, REQUEST, ANSWERS, DOC) KIND(NAME, REQUEST, ANSWERS, DOC, false)
#define TN_RUN_QUESTION(NAME, REQUEST, ANSWERS, DOC) KIND(NAME, REQUEST, ANSWERS, DOC, true)
#include "ask/session/requests.def"
};
const size_t tn_request_kind_count = sizeof tn_request_kinds / sizeof *tn_request_kinds;

tn_status tn_request_kind_named(const char *name, const tn_request_kind **question, tn_error *error)
{
    const char *names[sizeof tn_request_kinds / sizeof *tn_request_kinds];
    for (size_t i = 0; i < tn_request_kind_count; i++) {
        names[i] = tn_request_kinds[i].name;
        *question = &tn_request_kinds[i];
        if (strcmp(names[i], name) == 0)
            return TN_OK;
    }
    const char *near = tn_nearest(name, names, tn_request_kind_count);
    tn_fail(error, TN_INVALID, E_USAGE, "there is no question `%.80s`", name);
    if (near)
        tn_error_help(error, "did you mean `%s`?", near);
    return TN_INVALID;
}
