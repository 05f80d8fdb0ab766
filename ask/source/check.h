/* What checking finds in a file that compiles. */
#ifndef TARTAN_ASK_SOURCE_CHECK_H
#define TARTAN_ASK_SOURCE_CHECK_H

#include "ask/session/session.h"

/* tn_ask_check for whoever counts a library of the file, too: what its clauses do is then taken from it. library: one
 * of the session's file with its own lengths, or NULL. Errors that are found are an answer. All that is found is in the
 * diagnostics of the session's file, too. */
tn_status tn_check_beside(tn_session *session, const tn_check_request *request, const tn_library *library,
                          tn_reply *answer);

#endif
