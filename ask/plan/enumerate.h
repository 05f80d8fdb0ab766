/* What enumerating is made of. */
#ifndef TARTAN_ASK_PLAN_ENUMERATE_H
#define TARTAN_ASK_PLAN_ENUMERATE_H

#include "ask/house/numbered.h"
#include "ask/plan/found.h"

/* The ranks [begin, end) that are asked for, no further than the library goes; initialised. TN_INVALID, and said, if
 * they are the wrong way round; a note says if the library has no such rank. */
tn_status tn_asked_range(tn_session *session, const tn_library *library, const char *from, const char *to, mpz_t begin,
                         mpz_t end);

#endif
