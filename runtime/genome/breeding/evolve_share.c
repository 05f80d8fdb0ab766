/* Work that several processes do together: each takes items from a counter that all share, and tells the others what it
 * found. All have the same items, in the same order. Scores of sentences are found so.
 *
 * Ranks meet here alone while they breed: one begins as soon as it can, and hears at the end of the work that another
 * failed before it. Where a rank has something else to do, as the one that stores the run, the others work meanwhile.
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/genome/breeding/evolve_state.h"

/* A thread takes a part of what is left: this many times as many takes as there are threads, were they all equal. So
 * few takes do for many items, and the last ones are single items, which nobody waits for long. What is left is
 * guessed: since a thread's last take, the others have each taken as much. */
#define SPREAD 4

typedef struct sharing {
    tn_evolution *evolution;
    const tn_shared_work *work;
    const tn_ranks *ranks;
    size_t workers; /* threads of all ranks */
    bool *mine;     /* [items]: done here */
} sharing;

/* Nobody begins any more: one that failed makes the others wait for nothing. It may not know how many items they have.
 */
static void take_the_rest(const sharing *s)
{
    s->ranks->take(s->ranks->context, TN_POPULATION_MAX);
}

static tn_status do_items(sharing *s, unsigned thread, uint64_t from, uint64_t to, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint64_t item = from; status == TN_OK && item < to; item++) {
        status = tn_watch_check(s->evolution->settings.watch, error);
        if (status == TN_OK)
            status = s->work->work(s->work->context, thread, (size_t)item, error);
        s->mine[item] = status == TN_OK;
    }
    return status;
}

/* One thread's part. */
static tn_status take_part(void *context, unsigned thread, size_t place, tn_error *error)
{
    (void)place;
    sharing *s = context;
    uint64_t items = s->work->items, next = 0; /* those before have been taken, as far as is known */
    tn_status status = TN_OK;
    while (status == TN_OK && !s->ranks->spare) {
        uint64_t left = next < items ? items - next : 0, amount = left / (s->workers * SPREAD) + 1;
        uint64_t from = s->ranks->take(s->ranks->context, amount);
        if (from >= items)
            return TN_OK;
        next = from + amount * s->workers;
        status = do_items(s, thread, from, from + amount < items ? from + amount : items, error);
    }
    if (status != TN_OK)
        take_the_rest(s);
    return status;
}

/* ---- what ranks tell each other */

/* The first byte of what a rank tells. */
enum { FOUND, FAILED };

/* What was found here. NULL: out of memory. */
static uint8_t *write_mine(const sharing *s, size_t *size)
{
    const tn_shared_work *work = s->work;
    size_t room = 1;
    for (size_t item = 0; item < work->items; item++)
        room += s->mine[item] ? work->size(work->context, item) : 0;
    uint8_t *bytes = malloc(room), *end = bytes;
    if (bytes)
        *end++ = FOUND;
    for (size_t item = 0; bytes && item < work->items; item++)
        if (s->mine[item])
            end = work->write(work->context, item, end);
    *size = bytes ? (size_t)(end - bytes) : 0;
    return bytes;
}

typedef struct failure {
    uint8_t kind; /* FAILED */
    tn_error error;
} failure;

/* Together: everybody's findings or failures. */
static void tell(const sharing *s, tn_status status, const tn_error *error, tn_gathered *all)
{
    const tn_ranks *ranks = s->ranks;
    size_t size = 0;
    uint8_t *bytes = status == TN_OK ? write_mine(s, &size) : NULL;
    if (bytes) {
        ranks->gather(ranks->context, bytes, size, all);
        free(bytes);
        return;
    }
    failure f;
    memset(&f, 0, sizeof f);
    f.kind = FAILED;
    if (status == TN_OK)
        status = tn_fail_memory(&f.error);
    else
        f.error = *error;
    f.error.status = status;
    ranks->gather(ranks->context, &f, sizeof f, all);
}

/* The failure of the first rank that has one. */
static tn_status hear_failure(const sharing *s, const tn_gathered *all, tn_error *error)
{
    failure f;
    for (unsigned r = 0; r < s->ranks->count; r++) {
        const uint8_t *told = all->bytes + all->begins[r];
        if (*told != FAILED)
            continue;
        memcpy(&f, told, sizeof f);
        *error = f.error;
        return f.error.status;
    }
    return TN_OK;
}

static tn_status exchange(const sharing *s, tn_status status, tn_error *error)
{
    tn_gathered all;
    tell(s, status, error, &all);
    status = hear_failure(s, &all, error);
    for (unsigned r = 0; status == TN_OK && r < s->ranks->count; r++) {
        const uint8_t *bytes = all.bytes + all.begins[r] + 1, *end = all.bytes + all.begins[r + 1];
        while (r != s->ranks->rank && bytes < end)
            bytes = s->work->read(s->work->context, bytes);
    }
    tn_gathered_clear(&all);
    return status;
}

tn_status tn_evolution_share(tn_evolution *e, tn_status status, const tn_shared_work *work, tn_error *error)
{
    const tn_ranks *ranks = e->settings.ranks;
    sharing s = {.evolution = e,
                 .work = work,
                 .ranks = ranks,
                 .workers = (size_t)ranks->count * e->threads,
                 .mine = status == TN_OK ? calloc(work->items + 1, sizeof *s.mine) : NULL};
    ranks->restart(ranks->context);
    if (status == TN_OK && !s.mine)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_crew_run(e->crew, e->threads, 1, take_part, &s, error);
    if (status != TN_OK)
        take_the_rest(&s);
    status = exchange(&s, status, error);
    free(s.mine);
    return status;
}

/* ---- scores: of each individual its place, score and message */

typedef struct entry {
    uint32_t place; /* among those to do */
    uint32_t message_size;
    tn_score score;
} entry;

static tn_individual *individual_at(const tn_scoring *scoring, size_t place)
{
    return scoring->individuals[scoring->evolution->todo[place]];
}

static size_t batch_of(const tn_scoring *scoring, size_t item)
{
    size_t left = scoring->todo - item * scoring->batch;
    return left < scoring->batch ? left : scoring->batch;
}

static size_t scores_size(const void *context, size_t item)
{
    const tn_scoring *scoring = context;
    return batch_of(scoring, item) * (sizeof(entry) + sizeof individual_at(scoring, 0)->message);
}

static uint8_t *write_scores(const void *context, size_t item, uint8_t *end)
{
    const tn_scoring *scoring = context;
    for (size_t i = 0; i < batch_of(scoring, item); i++) {
        size_t place = item * scoring->batch + i;
        const tn_individual *individual = individual_at(scoring, place);
        entry e;
        memset(&e, 0, sizeof e);
        e.place = (uint32_t)place;
        e.message_size = (uint32_t)strlen(individual->message);
        e.score = individual->score;
        memcpy(end, &e, sizeof e);
        memcpy(end + sizeof e, individual->message, e.message_size);
        end += sizeof e + e.message_size;
    }
    return end;
}

static const uint8_t *read_score(void *context, const uint8_t *bytes)
{
    const tn_scoring *scoring = context;
    entry e;
    memcpy(&e, bytes, sizeof e);
    tn_individual *individual = individual_at(scoring, e.place);
    individual->score = e.score;
    memcpy(individual->message, bytes + sizeof e, e.message_size);
    individual->message[e.message_size] = '\0';
    return bytes + sizeof e + e.message_size;
}

tn_status tn_scoring_share(tn_scoring *scoring, tn_status status, tn_error *error)
{
    const tn_shared_work work = {.context = scoring,
                                 .items = (scoring->todo + scoring->batch - 1) / scoring->batch,
                                 .work = tn_scoring_item,
                                 .size = scores_size,
                                 .write = write_scores,
                                 .read = read_score};
    return tn_evolution_share(scoring->evolution, status, &work, error);
}
