/* Somebody who waits for long work: told now and then how far it is, and free to end it.
 *
 * Work that may take long asks tn_watch_stopped() where it can end, and then fails with TN_STOPPED. Any thread may ask,
 * and any thread may set `stop`; the callback is called by the one thread that made the watch. The watch is the
 * owner's, who outlives the work. */
#ifndef TARTAN_BASE_WATCH_H
#define TARTAN_BASE_WATCH_H

#include <pthread.h>
#include <stdatomic.h>

#include "runtime/base/error.h"

typedef bool tn_go_on(void *context, double done, double total);

typedef struct tn_watch {
    atomic_bool stop;
    tn_go_on *go_on; /* NULL: nobody is told, and only `stop` counts */
    void *context;
    double done, total; /* what the callback is told; only its thread sets them */
    pthread_t caller;
    uint64_t due; /* nanoseconds: not called before then */
} tn_watch;

/* A watch whose callback this thread will call. */
void tn_watch_begin(tn_watch *watch, tn_go_on *go_on, void *context);

/* Is it over? On the watch's own thread the callback is asked first, some thirty times a second. NULL: never. */
bool tn_watch_stopped(tn_watch *watch);

/* The same as a status: TN_OK, or TN_STOPPED with a sentence. */
tn_status tn_watch_check(tn_watch *watch, tn_error *error);

/* TN_STOPPED with that sentence. */
tn_status tn_fail_stopped(tn_error *error);

/* Says how far the work is, on the watch's own thread. NULL is fine. */
void tn_watch_tell(tn_watch *watch, double done, double total);

#endif
