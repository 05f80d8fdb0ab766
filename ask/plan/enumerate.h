/* What enumerating is made of. */
#ifndef TARTAN_ASK_PLAN_ENUMERATE_H
#define TARTAN_ASK_PLAN_ENUMERATE_H

#include "ask/house/numbered.h"
#include "ask/plan/found.h"

/* A rank in digits ("" or NULL: `otherwise`). `rank` is initialised. */
void tn_asked_rank(const char *digits, const mpz_t otherwise, mpz_t rank);

/* The ranks [begin, end) that are asked for, no further than the library goes; initialised. TN_INVALID, and said, if
 * they are the wrong way round; a note says if the library has no such rank. */
tn_status tn_asked_range(tn_session *session, const tn_library *library, const char *from, const char *to, mpz_t begin,
                         mpz_t end);

/* Says that these ranks are the wrong way round. */
tn_status tn_refuse_range(tn_session *session, const char *from, const char *to);

/* How many are given at most. */
uint64_t tn_enumerate_limit(const tn_session *session, const tn_enumerate_request *request);

/* The houses of a library, or on one plan. */
tn_status tn_enumerate_houses(tn_session *session, const tn_enumerate_request *request, tn_reply *answer);

#endif
