/* What checking finds in a file that compiles; and where something stands in a text, as answers say it. */
#ifndef TARTAN_ASK_SOURCE_CHECK_H
#define TARTAN_ASK_SOURCE_CHECK_H

#include "ask/session/requests.h"
#include "ask/session/session.h"
#include "compiler/common/source.h"

/* ---- where something stands in a text, as answers say it */

/* Fills the place, which starts as zeros; without a span it stays so. False where out of memory. */
bool tn_text_place_of(tn_sources *sources, bool has_span, tn_span span, tn_text_place *to);

/* tn_ask_check for whoever counts a library of the file, too: what its clauses do is then taken from it. library: one
 * of the session's file with its own lengths, or NULL. Errors that are found are an answer. All that is found is in the
 * diagnostics of the session's file, too. */
tn_status tn_check_beside(tn_session *session, const tn_check_request *request, const tn_library *library,
                          tn_reply *answer);

#endif
