/* What enumerating is made of. */
#ifndef TARTAN_ASK_PLAN_ENUMERATE_H
#define TARTAN_ASK_PLAN_ENUMERATE_H

#include "ask/house/numbered.h"
#include "ask/plan/found.h"

/* The ranks [begin, end) that are asked for, of so many `what` ("plans", "houses") that a library keeps; initialised.
 * TN_INVALID, and said, if they are the wrong way round; a note says if the library has no such rank. */
tn_status tn_asked_range(tn_session *session, const mpz_t kept, const char *what, const char *from, const char *to,
                         mpz_t begin, mpz_t end);

#endif
