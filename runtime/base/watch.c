/* Asks whoever waits for long work whether it shall go on. */
#include "runtime/base/watch.h"

#include <time.h>

#define PAUSE_NS UINT64_C(30000000) /* between two calls: a person sees no more */

void tn_watch_begin(tn_watch *watch, tn_go_on *go_on, void *context)
{
    *watch = (tn_watch){.go_on = go_on, .context = context, .caller = pthread_self()};
}

static uint64_t now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (uint64_t)time.tv_sec * UINT64_C(1000000000) + (uint64_t)time.tv_nsec;
}

static void ask(tn_watch *watch)
{
    uint64_t time = now();
    if (time < watch->due)
        return;
    watch->due = time + PAUSE_NS;
    if (!watch->go_on(watch->context, watch->done, watch->total))
        watch->stop = true;
}

bool tn_watch_stopped(tn_watch *watch)
{
    if (!watch)
        return false;
    if (watch->go_on && !watch->stop && pthread_equal(watch->caller, pthread_self()))
        ask(watch);
    return watch->stop;
}

tn_status tn_fail_stopped(tn_error *error)
{
    return tn_fail(error, TN_STOPPED, TN_CODE_NONE, "stopped before it was done");
}

tn_status tn_watch_check(tn_watch *watch, tn_error *error)
{
    return tn_watch_stopped(watch) ? tn_fail_stopped(error) : TN_OK;
}

void tn_watch_tell(tn_watch *watch, double done, double total)
{
    if (!watch)
        return;
    watch->done = done;
    watch->total = total;
}
