/* Runs ranks as threads. */
#include "tests/support/test_ranks.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define RANKS_MAX 8u
#define COUNTERS 3u

typedef struct group {
    unsigned count;
    pthread_barrier_t barrier;
    atomic_ullong counters[COUNTERS];
    const void *bytes[RANKS_MAX];
    size_t sizes[RANKS_MAX];
    test_ranks_work *work;
    void *context;
} group;

typedef struct member {
    tn_ranks ranks;
    group *group;
    uint64_t restarts;
} member;

static uint64_t take(void *context, uint64_t amount)
{
    member *m = context;
    return atomic_fetch_add(&m->group->counters[m->restarts % COUNTERS], amount);
}

static void restart(void *context)
{
    member *m = context;
    m->restarts++;
    if (m->ranks.rank == 0)
        m->group->counters[(m->restarts + 1) % COUNTERS] = 0;
}

static void gather(void *context, const void *bytes, size_t size, tn_gathered *all)
{
    member *m = context;
    group *g = m->group;
    g->bytes[m->ranks.rank] = bytes;
    g->sizes[m->ranks.rank] = size;
    pthread_barrier_wait(&g->barrier);
    size_t sum = 0;
    all->begins = calloc(g->count + 1, sizeof *all->begins);
    for (unsigned r = 0; r < g->count; r++)
        all->begins[r + 1] = sum += g->sizes[r];
    all->bytes = malloc(sum + 1);
    for (unsigned r = 0; r < g->count; r++)
        if (g->sizes[r])
            memcpy(all->bytes + all->begins[r], g->bytes[r], g->sizes[r]);
    pthread_barrier_wait(&g->barrier);
}

static void *run(void *context)
{
    member *m = context;
    m->group->work(&m->ranks, m->group->context);
    return NULL;
}

void test_ranks_run(unsigned count, test_ranks_work *work, void *context)
{
    group g = {.count = count, .work = work, .context = context};
    member members[RANKS_MAX];
    pthread_t threads[RANKS_MAX];
    pthread_barrier_init(&g.barrier, NULL, count);
    for (unsigned r = 0; r < count; r++) {
        members[r] = (member){.group = &g};
        members[r].ranks = (tn_ranks){.context = &members[r],
                                      .rank = r,
                                      .count = count,
                                      .host = "here",
                                      .spare = r > 1 && r + 1 == count,
                                      .take = take,
                                      .restart = restart,
                                      .gather = gather};
        pthread_create(&threads[r], NULL, run, &members[r]);
    }
    for (unsigned r = 0; r < count; r++)
        pthread_join(threads[r], NULL);
    pthread_barrier_destroy(&g.barrier);
}
