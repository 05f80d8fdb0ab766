/* Writes the shards of a set that are not there yet, together with whoever else does. */
#ifndef TARTAN_DRIVER_SHARDS_RUN_H
#define TARTAN_DRIVER_SHARDS_RUN_H

#include <stdatomic.h>

#include "driver/shards/set.h"
#include "runtime/base/error.h"
#include "runtime/ranks/ranks.h"

/* Claims: a small file beside a shard that says who is writing it, so that no two workers do.
 *
 * Nothing relies on claims but the sparing of work: a shard that two workers write has the same bytes twice, and the
 * last rename wins. So a claim that is in doubt is taken over: where its process is gone from this machine, and where
 * nobody has touched it for some time. Times are those that the file system itself gives to files, so the clocks of
 * machines do not matter.
 */

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

/* Gives the claim up. Harmless for one that was not taken. */
void tn_claim_release(tn_claim *claim);

/* Reads who holds a claim; false where there is none. */
bool tn_claim_read(const char *path, tn_claimant *claimant);

/* Called between two houses: whether to go on. */
typedef tn_status tn_shard_between(void *context, tn_error *error);

/* Writes the tables of the houses of a library: those from one rank on, before another. before: how many of the set's
 * stand before them. They go to PATH.houses.csv and so on. *written: how many there were. */
typedef struct tn_shard_houses {
    void *context;
    tn_status (*write)(void *context, const char *path, const mpz_t from, const mpz_t to, uint64_t before,
                       tn_shard_between *between, void *of, uint64_t *written, tn_error *error);
} tn_shard_houses;

typedef struct tn_shards_job {
    const tn_shard_set *set;
    const tn_opened *opened; /* the set's module and library, which agree with it */
    const tn_ready_library *ready;
    const tn_answering *answering; /* what is said of plans; NULL where they are enumerated */
    const tn_shard_houses *houses; /* of a set of houses; one thread calls it */
    uint32_t begin, end;           /* which shards */
    unsigned threads;
    double stale;   /* seconds after which a claim that nobody touches is taken over */
    double seconds; /* after which no shard is begun, nor one that would take longer; 0: any number */
    tn_watch *watch;
    const atomic_bool *last; /* or NULL: no shard is begun once it is true; those begun are finished */
    const tn_ranks *ranks;   /* or NULL: they take shards from one counter */
} tn_shards_job;

typedef struct tn_shards_done {
    uint32_t written; /* by this call, on all ranks */
    uint64_t unread;  /* plans that were skipped for them */
    uint32_t left;    /* of those asked for, as this rank sees them */
    bool out_of_time;
    bool ended; /* by `last` */
} tn_shards_done;

/* Returns when all those shards are there, time is up, the watch stops it (TN_STOPPED), or one could not be written:
 * then those that were begun are finished, and the error names the shard. Shards that others hold are waited for.
 * `done` is filled in any case.
 *
 * With several ranks it is called together. A rank that cannot write a shard ends, and the others write all that they
 * can; it fails for all of them alike. TN_IO (E1731) where shards were written in a folder that rank 0 does not see. */
tn_status tn_shards_run(const tn_shards_job *job, tn_shards_done *done, tn_error *error);

#endif
