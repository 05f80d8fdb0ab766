/* Asks whoever waits for long work whether it shall go on. */
#include "runtime/base/watch.h"

#include <time.h>

#include "runtime/base/memory.h"

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
    tn_watch_measure(watch);
    if (watch->go_on && !watch->go_on(watch->context, watch->done, watch->total))
        watch->stop = true;
}

bool tn_watch_stopped(tn_watch *watch)
{
    if (!watch)
        return false;
    if ((watch->go_on || watch->memory_limit) && !watch->stop && pthread_equal(watch->caller, pthread_self()))
        ask(watch);
    return watch->stop;
}

/* ---- memory */

void tn_watch_measure(tn_watch *watch)
{
    if (!watch->memory_limit || tn_memory_used() <= watch->memory_limit)
        return;
    watch->full = true;
    watch->stop = true;
}

tn_status tn_watch_room(const tn_watch *watch, uint64_t bytes, const char *what, tn_error *error)
{
    if (watch && watch->memory_limit) {
        uint64_t used = tn_memory_used(), left = watch->memory_limit > used ? watch->memory_limit - used : 0;
        char needed[32], limit[32];
        tn_memory_write(bytes, needed);
        tn_memory_write(watch->memory_limit, limit);
        if (bytes > left) {
            tn_fail(error, TN_LIMIT, E_MEMORY_LIMIT, "%s would need about %s more memory; the limit is %s in all", what,
                    needed, limit);
            tn_error_help(error, "ask for less, or raise the limit with --memory-limit");
            return TN_LIMIT;
        }
    }
    if (!tn_memory_can_have(bytes))
        return tn_fail_memory(error);
    if (watch && watch->large && bytes >= TN_ROOM_LARGE)
        watch->large(what, bytes);
    return TN_OK;
}

tn_status tn_fail_stopped(const tn_watch *watch, tn_error *error)
{
    if (!watch || !watch->full)
        return tn_fail(error, TN_STOPPED, TN_CODE_NONE, "stopped before it was done");
    char limit[32];
    tn_memory_write(watch->memory_limit, limit);
    tn_fail(error, TN_STOPPED, E_MEMORY_LIMIT, "stopped at the limit of %s of memory", limit);
    tn_error_help(error, "ask for less, or raise the limit with --memory-limit");
    return TN_STOPPED;
}

tn_status tn_watch_check(tn_watch *watch, tn_error *error)
{
    return tn_watch_stopped(watch) ? tn_fail_stopped(watch, error) : TN_OK;
}

void tn_watch_tell(tn_watch *watch, double done, double total)
{
    if (!watch || !pthread_equal(watch->caller, pthread_self()))
        return;
    watch->done = done;
    watch->total = total;
}
