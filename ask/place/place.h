/* What is asked of the question `place` before a file is open. */
#ifndef TARTAN_ASK_PLACE_PLACE_H
#define TARTAN_ASK_PLACE_PLACE_H

#include "ask/session/session.h"

/* TN_INVALID, and says it, if the request makes no sense whatever the file is. The question asks this, too. */
tn_status tn_place_check(tn_session *session, const tn_place_request *request);

#endif
