/* Somebody who waits for long work: told now and then how far it is, and free to end it; and how much memory it may
 * take.
 *
 * Work that may take long asks tn_watch_stopped() where it can end, and then fails with TN_STOPPED. Any thread may ask,
 * and any thread may set `stop`; the callback is called by the one thread that made the watch. The watch is the
 * owner's, who outlives the work.
 *
 * Memory is measured, not counted: the limit is about what the process holds (memory.h), whoever allocated it. Work is
 * stopped soon after the limit is passed. What knows beforehand that it needs much asks tn_watch_room() first. */
#ifndef TARTAN_BASE_WATCH_H
#define TARTAN_BASE_WATCH_H

#include <pthread.h>
#include <stdatomic.h>
#include <time.h>

#include "runtime/base/error.h"

typedef bool tn_go_on(void *context, double done, double total);

/* Told of a piece of work that will need so many bytes more, TN_ROOM_LARGE or more, and has room for them. */
typedef void tn_large_need(const char *what, uint64_t bytes);
#define TN_ROOM_LARGE (UINT64_C(1) << 30)

typedef struct tn_watch {
    atomic_bool stop;
    atomic_bool full;      /* it was stopped because the limit of memory was passed */
    uint64_t memory_limit; /* the most bytes that the process may hold; 0: any number */
    tn_large_need *large;  /* or NULL */
    tn_go_on *go_on;       /* NULL: nobody is told, and only `stop` counts */
    void *context;
    double done, total; /* what the callback is told; only its thread sets them */
    pthread_t caller;
    uint64_t due; /* nanoseconds: not called before then */
} tn_watch;

/* A watch whose callback this thread will call, without a limit of memory. */
void tn_watch_begin(tn_watch *watch, tn_go_on *go_on, void *context);

/* Is it over? On the watch's own thread the callback is asked first, some thirty times a second. NULL: never. */
bool tn_watch_stopped(tn_watch *watch);

/* The same for long loops: asked at every so manieth item. */
static inline bool tn_watch_stopped_at(tn_watch *watch, size_t item)
{
    return item % 4096 == 0 && tn_watch_stopped(watch);
}

/* The same as a status: TN_OK, or TN_STOPPED with a sentence. */
tn_status tn_watch_check(tn_watch *watch, tn_error *error);

/* TN_STOPPED with that sentence; of a watch that is full with E0841 and what to do. */
tn_status tn_fail_stopped(const tn_watch *watch, tn_error *error);

/* Compares what the process holds with the limit; past it, the watch is full and work is stopped. */
void tn_watch_measure(tn_watch *watch);

/* For before a piece of work that needs so many bytes more: TN_LIMIT (E0841) if they pass the limit, TN_MEMORY where
 * the system does not have them. `what` begins a sentence. The watch may be NULL. */
tn_status tn_watch_room(const tn_watch *watch, uint64_t bytes, const char *what, tn_error *error);

/* Says how far the work is; on any other thread than the watch's own it says nothing. NULL is fine. */
void tn_watch_tell(tn_watch *watch, double done, double total);

/* Time that passes, for pauses and progress; never for results. */

/* Seconds since some moment before the program began; nobody sets this clock back. */
static inline double tn_seconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

#endif
