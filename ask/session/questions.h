/* The questions as functions: what requests.def lists. */
#ifndef TARTAN_ASK_SESSION_QUESTIONS_H
#define TARTAN_ASK_SESSION_QUESTIONS_H

#include "ask/session/session.h"

/* tn_ask_count and so on: each question as a function. What is wrong is said as session.h tells. Clear the answer in
 * any case. */
#define TN_QUESTION(NAME, REQUEST, ANSWERS, DOC)                                                                       \
    tn_status tn_ask_##NAME(tn_session *session, const tn_##REQUEST *request, tn_reply *answer);
#include "ask/session/requests.def"

/* The same for whoever has a question's name. */
typedef struct tn_request_kind {
    const char *name;
    const tn_message *request;
    const char *answers; /* the names of their types, with blanks between them */
    const char *doc;
    bool runs; /* it is about runs of evolution, which live in folders and databases, and may start programs */
    tn_status (*ask)(tn_session *session, const void *request, tn_reply *answer);
} tn_request_kind;

extern const tn_request_kind tn_request_kinds[];
extern const size_t tn_request_kind_count;

/* The question of that name; TN_INVALID (E_USAGE) with what may have been meant if there is none. */
tn_status tn_request_kind_named(const char *name, const tn_request_kind **question, tn_error *error);

#endif
