/* What questions about the buildings of a kit have in common. */
#ifndef TARTAN_ASK_PLACE_KIT_H
#define TARTAN_ASK_PLACE_KIT_H

#include "ask/session/session.h"
#include "runtime/place/count/count.h"
#include "runtime/place/model/rules.h"

/* TN_INVALID, and says it, if something is asked that only kits answer: the file is none. */
tn_status tn_kit_none_asked(tn_session *session, const tn_kit_asked *asked);

/* Checks what is asked of a kit and finds which of its parts are wanted: *wanted is [part of the kit], or NULL for all;
 * the caller frees it. */
tn_status tn_kit_asked_parts(tn_session *session, const tn_kit_asked *asked, bool **wanted);

/* The rules of the model whose space is named, to be cleared after TN_OK. */
tn_status tn_kit_asked_space(tn_session *session, const char *model, tn_place_rules *rules);

/* count: the buildings of a kit's parts. */
tn_status tn_count_kit(tn_session *session, const tn_count_request *request, tn_reply *answer);

/* enumerate: the buildings themselves. Its ranks are digits, and in order. */
tn_status tn_enumerate_kit(tn_session *session, const tn_enumerate_request *request, tn_reply *answer);

#endif
