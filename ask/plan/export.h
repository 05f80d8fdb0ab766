/* What is asked of the question `export` before a file is open. */
#ifndef TARTAN_ASK_PLAN_EXPORT_H
#define TARTAN_ASK_PLAN_EXPORT_H

#include "ask/session/session.h"

/* TN_INVALID, and says it, if the request makes no sense whatever the file is, which is called `path`. The question
 * asks this, too. */
tn_status tn_export_check(tn_session *session, const tn_export_request *request, const char *path);

#endif
