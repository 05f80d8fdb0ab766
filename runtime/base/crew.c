/* Threads that share a loop: they wait for work, and take parts of it in turn. */
#include "runtime/base/crew.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

#include "runtime/base/watch.h"

struct tn_crew {
    pthread_mutex_t lock;
    pthread_cond_t wake, done;
    pthread_t *helpers;
    unsigned helper_count, helpers_wanted;
    uint64_t job;    /* number of the current one */
    bool open;       /* may helpers join it? */
    bool stopping;   /* no more jobs */
    unsigned active; /* helpers at work on it */
    tn_watch *watch;
    /* the job */
    tn_crew_work *work;
    void *context;
    size_t count, chunk;
    atomic_size_t next;
    size_t failed_item;
    tn_status status;
    tn_error error;
};

typedef struct helper {
    tn_crew *crew;
    unsigned number;
} helper;

static void keep_failure(tn_crew *crew, size_t item, tn_status status, const tn_error *error)
{
    pthread_mutex_lock(&crew->lock);
    if (crew->status == TN_OK || item < crew->failed_item) {
        crew->status = status;
        crew->failed_item = item;
        crew->error = *error;
    }
    pthread_mutex_unlock(&crew->lock);
}

static void take_part(tn_crew *crew, unsigned thread)
{
    for (;;) {
        size_t from = atomic_fetch_add(&crew->next, crew->chunk);
        if (from >= crew->count)
            return;
        size_t to = crew->count - from < crew->chunk ? crew->count : from + crew->chunk;
        for (size_t item = from; item < to; item++) {
            tn_error error;
            tn_status status = tn_watch_stopped(crew->watch) ? tn_fail_stopped(crew->watch, &error)
                                                             : crew->work(crew->context, thread, item, &error);
            if (status != TN_OK)
                keep_failure(crew, item, status, &error);
        }
    }
}

static void *help(void *argument)
{
    helper own = *(helper *)argument;
    tn_crew *crew = own.crew;
    uint64_t seen = 0;
    free(argument);
    pthread_mutex_lock(&crew->lock);
    while (!crew->stopping) {
        if (!crew->open || crew->job == seen) {
            pthread_cond_wait(&crew->wake, &crew->lock);
            continue;
        }
        seen = crew->job;
        crew->active++;
        pthread_mutex_unlock(&crew->lock);
        take_part(crew, own.number);
        pthread_mutex_lock(&crew->lock);
        if (--crew->active == 0)
            pthread_cond_signal(&crew->done);
    }
    pthread_mutex_unlock(&crew->lock);
    return NULL;
}

static bool add_helper(tn_crew *crew)
{
    helper *argument = malloc(sizeof *argument);
    if (!argument)
        return false;
    *argument = (helper){crew, crew->helper_count + 1};
    if (pthread_create(&crew->helpers[crew->helper_count], NULL, help, argument) != 0) {
        free(argument);
        return false;
    }
    crew->helper_count++;
    return true;
}

/* Makes the threads that so many parts of work can use. Those that cannot be had are done without, for good. */
static void add_helpers(tn_crew *crew, size_t parts)
{
    while (crew->helper_count < crew->helpers_wanted && crew->helper_count + 1 < parts)
        if (!add_helper(crew))
            crew->helpers_wanted = crew->helper_count;
}

tn_crew *tn_crew_new(unsigned threads, tn_watch *watch)
{
    tn_crew *crew = calloc(1, sizeof *crew);
    if (!crew)
        return NULL;
    crew->helpers_wanted = (threads ? threads : tn_crew_default()) - 1;
    crew->helpers = calloc(crew->helpers_wanted + 1, sizeof *crew->helpers);
    if (!crew->helpers) {
        free(crew);
        return NULL;
    }
    crew->watch = watch;
    pthread_mutex_init(&crew->lock, NULL);
    pthread_cond_init(&crew->wake, NULL);
    pthread_cond_init(&crew->done, NULL);
    return crew;
}

void tn_crew_watch(tn_crew *crew, tn_watch *watch)
{
    crew->watch = watch;
}

unsigned tn_crew_threads(const tn_crew *crew)
{
    return crew->helpers_wanted + 1;
}

void tn_crew_free(tn_crew *crew)
{
    if (!crew)
        return;
    pthread_mutex_lock(&crew->lock);
    crew->stopping = true;
    pthread_cond_broadcast(&crew->wake);
    pthread_mutex_unlock(&crew->lock);
    for (unsigned i = 0; i < crew->helper_count; i++)
        pthread_join(crew->helpers[i], NULL);
    pthread_mutex_destroy(&crew->lock);
    pthread_cond_destroy(&crew->wake);
    pthread_cond_destroy(&crew->done);
    free(crew->helpers);
    free(crew);
}

tn_status tn_crew_run(tn_crew *crew, size_t count, size_t chunk, tn_crew_work *work, void *context, tn_error *error)
{
    chunk = chunk ? chunk : 1;
    add_helpers(crew, count / chunk + (count % chunk > 0));
    bool alone = crew->helper_count == 0 || count <= chunk;
    pthread_mutex_lock(&crew->lock);
    crew->work = work;
    crew->context = context;
    crew->count = count;
    crew->chunk = chunk;
    crew->status = TN_OK;
    atomic_store(&crew->next, 0);
    crew->job++;
    crew->open = !alone;
    if (!alone)
        pthread_cond_broadcast(&crew->wake);
    pthread_mutex_unlock(&crew->lock);
    take_part(crew, 0);
    pthread_mutex_lock(&crew->lock);
    crew->open = false;
    while (crew->active)
        pthread_cond_wait(&crew->done, &crew->lock);
    tn_status status = crew->status;
    if (status != TN_OK && error)
        *error = crew->error;
    pthread_mutex_unlock(&crew->lock);
    return status;
}

typedef struct sharing {
    tn_crew_piece *work;
    void *context;
} sharing;

static tn_status do_piece(void *context, unsigned thread, size_t item, tn_error *error)
{
    const sharing *s = context;
    (void)thread, (void)error;
    s->work(s->context, (uint32_t)item);
    return TN_OK;
}

tn_status tn_crew_share(tn_crew *crew, uint32_t count, tn_crew_piece *work, void *context, tn_error *error)
{
    sharing s = {work, context};
    return tn_crew_run(crew, count, 1, do_piece, &s, error);
}

unsigned tn_crew_default(void)
{
#ifdef __linux__
    cpu_set_t usable;
    if (sched_getaffinity(0, sizeof usable, &usable) == 0 && CPU_COUNT(&usable) > 0)
        return (unsigned)CPU_COUNT(&usable);
#endif
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (unsigned)online : 1;
}
