/* What drawing is made of: each kind of thing that is drawn has a file of its own. */
#ifndef TARTAN_ASK_PLAN_DRAW_H
#define TARTAN_ASK_PLAN_DRAW_H

#include "ask/form/draw.h"
#include "ask/session/requests.h"

/* Does all that is asked for go together, and is it about the file? Otherwise TN_INVALID, which is said. For whoever has
 * plans to read first. */
tn_status tn_draw_check(tn_session *session, const tn_draw_request *request);

/* Plans that the request has, or that the library is asked for: its best ones, or a sample. */
tn_status tn_draw_plans(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made);

/* Rules in one picture, which are about the same trays. */
tn_status tn_draw_rules(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made);

/* Houses in space: a sample, the best, or the first of each of the best trade-offs. */
tn_status tn_draw_houses(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made);

#endif
