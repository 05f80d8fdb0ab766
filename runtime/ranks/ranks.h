/* Ranks: processes that do one piece of work together, on one machine or on many. Each has a number from 0 on.
 *
 * What they need of each other is little: a counter that deals out work, and to hear what all have to say. Whoever
 * starts the processes supplies both (the program tartan-mpi by MPI; the tests by threads). Code that works with ranks
 * takes a pointer, and NULL stands for one process alone.
 *
 * "Together" below means: every rank calls it, in the same order among all such calls. A rank that has failed still
 * takes part, and says so to the others. A rank that cannot take part ends all of them. */
#ifndef TARTAN_RANKS_RANKS_H
#define TARTAN_RANKS_RANKS_H

#include "runtime/base/error.h"

/* What all ranks gave: that of rank r is the bytes from begins[r] on, before begins[r + 1]. */
typedef struct tn_gathered {
    uint8_t *bytes;
    size_t *begins; /* [ranks + 1] */
} tn_gathered;

typedef struct tn_ranks {
    void *context;
    unsigned rank, count; /* this one's number, and how many there are */
    const char *host;     /* the name of this one's machine */
    bool spare;           /* its machine has no processor for it: it leaves what is dealt out to the others */
    /* Takes the next `amount` numbers of the counter that all ranks share; the first of them. By any thread. */
    uint64_t (*take)(void *context, uint64_t amount);
    /* Together: the counter is 0 from here on, for all. */
    void (*restart)(void *context);
    /* Together: each gives bytes (all of them at most 2 GB), and gets those of all. tn_gathered_clear frees them. */
    void (*gather)(void *context, const void *bytes, size_t size, tn_gathered *all);
} tn_ranks;

void tn_gathered_clear(tn_gathered *all);

/* Is there more than this process? */
static inline bool tn_ranks_several(const tn_ranks *ranks)
{
    return ranks && ranks->count > 1;
}

/* Is this the one that writes results and speaks? */
static inline bool tn_ranks_lead(const tn_ranks *ranks)
{
    return !ranks || ranks->rank == 0;
}

/* Together: is it so for any rank? */
bool tn_ranks_any(const tn_ranks *ranks, bool so);

/* Together: the failure of the first rank that has one, or TN_OK. `error` is filled with it. */
tn_status tn_ranks_agree(const tn_ranks *ranks, tn_status status, tn_error *error);

/* Together: every rank's bytes become those of rank 0: *bytes is freed and allocated anew on the others. TN_MEMORY (on
 * all of them, and then nothing has changed). */
tn_status tn_ranks_tell(const tn_ranks *ranks, uint8_t **bytes, size_t *size, tn_error *error);

/* Together: is the text the same everywhere? TN_INVALID (E1730) names a rank where it is not. `what` begins a sentence:
 * "the version of Tartan". */
tn_status tn_ranks_same(const tn_ranks *ranks, const char *what, const char *text, tn_error *error);

#endif
