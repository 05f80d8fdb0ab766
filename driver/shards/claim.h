/* Claims: a small file beside a shard that says who is writing it, so that no two workers do.
 *
 * Nothing relies on claims but the sparing of work: a shard that two workers write has the same bytes twice, and the
 * last rename wins. So a claim that is in doubt is taken over: where its process is gone from this machine, and where
 * nobody has touched it for some time. Times are those that the file system itself gives to files, so the clocks of
 * machines do not matter.
 */
#ifndef TARTAN_DRIVER_SHARDS_CLAIM_H
#define TARTAN_DRIVER_SHARDS_CLAIM_H

#include "runtime/base/error.h"

/* Who holds a claim; what is not known is empty or 0. */
typedef struct tn_claimant {
    char host[80], boot[40], space[40]; /* the machine, its start, and which processes see each other there */
    int64_t process;
    char since[24]; /* by its own clock, for people; set where it claims */
    double age;     /* seconds since it was touched, negative where it was touched in the future */
} tn_claimant;

typedef struct tn_claim {
    char *path; /* owned; NULL: nothing is claimed */
    double touched;
} tn_claim;

/* This process. */
tn_claimant tn_claimant_self(void);

/* Claims the path for this process, `self`: *taken is false where another worker has, and is not known to be gone.
 * `stale`: seconds. TN_IO where the folder cannot be written to. */
tn_status tn_claim_take(const char *path, const tn_claimant *self, double stale, tn_claim *claim, bool *taken,
                        tn_error *error);

/* Says that the worker is still there, where it was last said long enough ago. */
void tn_claim_touch(tn_claim *claim, double stale);

/* Gives the claim up. Harmless for one that was not taken. */
void tn_claim_release(tn_claim *claim);

/* Reads who holds a claim; false where there is none. */
bool tn_claim_read(const char *path, tn_claimant *claimant);

#endif
