/* What counting is made of: each kind of thing that is counted has a file of its own. */
#ifndef TARTAN_ASK_PLAN_COUNT_H
#define TARTAN_ASK_PLAN_COUNT_H

#include "ask/place/kit.h"
#include "ask/session/requests.h"
#include "driver/measure/spread.h"

/* How the plans of a library are spread over the values of a measure. */
tn_status tn_count_plans_by(tn_session *session, const tn_count_request *request, tn_reply *answer);

/* The houses of a library, all of them or by a measure. */
tn_status tn_count_houses(tn_session *session, const tn_count_request *request, tn_reply *answer);

/* An empty spread (malloc); NULL: out of memory, which is said. */
tn_spread *tn_spread_room(tn_session *session);

/* The distribution as the answer, which takes over the spread (malloc) in any case; `step` and `bins` of the request
 * say how its values are put together. */
tn_status tn_reply_spread(tn_session *session, const tn_count_request *request, tn_spread *spread, tn_reply *answer);

#endif
