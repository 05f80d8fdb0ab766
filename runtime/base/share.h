/* Work in pieces that threads share. Which thread does which piece never matters to results. */
#ifndef TARTAN_BASE_SHARE_H
#define TARTAN_BASE_SHARE_H

#include "runtime/base/watch.h"

typedef enum tn_share_how {
    TN_SHARE_EVENLY, /* pieces in turn: a thread meets the same pieces again where the same number is shared again */
    TN_SHARE_UNEVEN, /* whoever is free takes the next: for pieces of different size */
} tn_share_how;

typedef void tn_share_work(void *context, uint32_t piece);

/* Does pieces 0 to count - 1 with up to `threads` threads, fewer where they cannot be had. False where `watch` (or
 * NULL) said so before the end: then some pieces are not done. */
bool tn_share(tn_watch *watch, int threads, uint32_t count, tn_share_how how, tn_share_work *work, void *context);

/* How many threads there are to use, and how many are to be from now on. Without OpenMP it is one. */
int tn_thread_count(void);
void tn_threads_limit(int threads);

/* Which thread this is, inside of work that is shared, from 0. */
int tn_thread_number(void);

#endif
