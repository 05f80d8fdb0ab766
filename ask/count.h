/* What counting is made of: each kind of thing that is counted has a file of its own. */
#ifndef TARTAN_ASK_COUNT_H
#define TARTAN_ASK_COUNT_H

#include "ask/requests.h"

/* What a request says of a library's plans and of the work that it may take. */
tn_library_options tn_asked_options(const tn_library_asked *asked);

/* The longest plan that it accepts. */
size_t tn_asked_length(const tn_library_asked *asked);

/* The plans of a library, and how they are spread over the values of a measure. */
tn_status tn_count_plans(tn_session *session, const tn_count_request *request, tn_reply *answer);
tn_status tn_count_plans_by(tn_session *session, const tn_count_request *request, tn_reply *answer);

/* The houses of a library, all of them or by a measure. */
tn_status tn_count_houses(tn_session *session, const tn_count_request *request, tn_reply *answer);

/* The buildings of a kit's parts. */
tn_status tn_count_kit(tn_session *session, const tn_count_request *request, tn_reply *answer);

/* The distribution as the answer, which takes over the spread (malloc) in any case; `step` and `bins` of the request
 * say how its values are put together. */
tn_status tn_reply_spread(tn_session *session, const tn_count_request *request, tn_spread *spread, tn_reply *answer);

#endif
