/* Scores that several processes find together: each takes sentences from a counter that all share, and tells the others
 * what they scored. All have the same sentences to do, in the same order. */
#include <stdlib.h>
#include <string.h>

#include "runtime/genome/breeding/evolve_state.h"

#define TAKES 16 /* times that a thread goes to the counter, where sentences take equally long */

typedef struct sharing {
    tn_scoring *scoring;
    const tn_ranks *ranks;
    size_t items, amount; /* batches, and how many are taken at once */
    bool *mine;           /* [items]: evaluated here */
} sharing;

/* Nobody begins any more: one that failed makes the others wait for nothing. */
static void take_the_rest(const sharing *s)
{
    s->ranks->take(s->ranks->context, s->items);
}

static tn_status do_items(sharing *s, unsigned thread, uint64_t from, uint64_t to, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint64_t item = from; status == TN_OK && item < to; item++) {
        status = tn_watch_check(s->scoring->evolution->settings.watch, error);
        if (status == TN_OK)
            status = tn_scoring_item(s->scoring, thread, (size_t)item, error);
        s->mine[item] = status == TN_OK;
    }
    return status;
}

/* One thread's part. */
static tn_status take_part(void *context, unsigned thread, size_t place, tn_error *error)
{
    (void)place;
    sharing *s = context;
    tn_status status = TN_OK;
    while (status == TN_OK) {
        uint64_t from = s->ranks->take(s->ranks->context, s->amount);
        if (from >= s->items)
            return TN_OK;
        status = do_items(s, thread, from, from + s->amount < s->items ? from + s->amount : s->items, error);
    }
    take_the_rest(s);
    return status;
}

/* ---- what ranks tell each other: an item's number, then score and message of each individual of it */

typedef struct entry {
    uint32_t place; /* among those to do */
    uint32_t message_size;
    tn_score score;
} entry;

static size_t items_size(const sharing *s, size_t item, size_t *begin)
{
    *begin = item * s->scoring->batch;
    size_t left = s->scoring->todo - *begin;
    return left < s->scoring->batch ? left : s->scoring->batch;
}

static tn_individual *individual_at(const sharing *s, size_t place)
{
    return s->scoring->individuals[s->scoring->evolution->todo[place]];
}

/* What was scored here. NULL: out of memory. */
static uint8_t *write_mine(const sharing *s, size_t *size)
{
    size_t begin, room = 1;
    for (size_t item = 0; item < s->items; item++)
        room += s->mine[item] ? items_size(s, item, &begin) * (sizeof(entry) + sizeof individual_at(s, 0)->message) : 0;
    uint8_t *bytes = malloc(room), *end = bytes;
    for (size_t item = 0; bytes && item < s->items; item++) {
        size_t count = s->mine[item] ? items_size(s, item, &begin) : 0;
        for (size_t i = 0; i < count; i++) {
            const tn_individual *individual = individual_at(s, begin + i);
            entry e;
            memset(&e, 0, sizeof e);
            e.place = (uint32_t)(begin + i);
            e.message_size = (uint32_t)strlen(individual->message);
            e.score = individual->score;
            memcpy(end, &e, sizeof e);
            memcpy(end + sizeof e, individual->message, e.message_size);
            end += sizeof e + e.message_size;
        }
    }
    *size = bytes ? (size_t)(end - bytes) : 0;
    return bytes;
}

static void read_theirs(const sharing *s, const uint8_t *bytes, const uint8_t *end)
{
    while (bytes < end) {
        entry e;
        memcpy(&e, bytes, sizeof e);
        tn_individual *individual = individual_at(s, e.place);
        individual->score = e.score;
        memcpy(individual->message, bytes + sizeof e, e.message_size);
        individual->message[e.message_size] = '\0';
        bytes += sizeof e + e.message_size;
    }
}

static tn_status exchange(const sharing *s, tn_status status, tn_error *error)
{
    tn_gathered all;
    size_t size = 0;
    uint8_t *bytes = status == TN_OK ? write_mine(s, &size) : NULL;
    if (status == TN_OK && !bytes)
        status = tn_fail_memory(error);
    status = tn_ranks_agree(s->ranks, status, error);
    if (status == TN_OK) {
        s->ranks->gather(s->ranks->context, bytes, size, &all);
        for (unsigned r = 0; r < s->ranks->count; r++)
            if (r != s->ranks->rank)
                read_theirs(s, all.bytes + all.begins[r], all.bytes + all.begins[r + 1]);
        tn_gathered_clear(&all);
    }
    free(bytes);
    return status;
}

tn_status tn_scoring_share(tn_scoring *scoring, tn_error *error)
{
    tn_evolution *e = scoring->evolution;
    const tn_ranks *ranks = e->settings.ranks;
    sharing s = {.scoring = scoring, .ranks = ranks, .items = (scoring->todo + scoring->batch - 1) / scoring->batch};
    s.amount = s.items / ((size_t)ranks->count * e->threads * TAKES) + 1;
    s.mine = calloc(s.items + 1, sizeof *s.mine);
    ranks->restart(ranks->context);
    tn_status status = s.mine ? tn_crew_run(e->crew, e->threads, 1, take_part, &s, error) : tn_fail_memory(error);
    if (status != TN_OK)
        take_the_rest(&s);
    status = exchange(&s, status, error);
    free(s.mine);
    return status;
}
