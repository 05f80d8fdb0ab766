/* Lists plans, block by block. */
#include "runtime/plan/library/listing.h"

#include <stdlib.h>

enum {
    BLOCKS_PER_THREAD = 4, /* of a round: that threads end it at nearly the same time */
    PLANS_FIRST = 64,      /* of a block; then as many as have a text of this size: */
    BLOCK_BYTES = 1 << 18,
    PLANS_MOST = 1 << 16
};

typedef struct block {
    mpz_t from, to;
    uint64_t plans;
    tn_buffer text, room;
    char apart[128]; /* threads that append to neighbouring blocks share no line of the cache */
} block;

/* The blocks of one round, and those of the round before, which are put meanwhile. */
typedef struct lister {
    const tn_plan_listing *listing;
    block *blocks[2]; /* [count] */
    size_t count, filled[2];
    int now;
    mpz_t next; /* rank */
    uint64_t plans_each;
} lister;

static tn_status fill_block(const lister *l, block *b, tn_error *error)
{
    const tn_plan_listing *listing = l->listing;
    const tn_tray *trays;
    uint32_t length;
    tn_cursor *cursor;
    mpz_t rank;
    b->text.size = 0;
    b->plans = 0;
    tn_status status = tn_cursor_new(listing->library, b->from, b->to, &cursor, error);
    if (status != TN_OK)
        return status;
    mpz_init_set(rank, b->from);
    while (status == TN_OK && tn_cursor_next(cursor, &trays, &length)) {
        b->room.size = 0;
        if (!listing->append(listing->context, rank, trays, length, &b->text, &b->room))
            status = tn_fail_memory(error);
        mpz_add_ui(rank, rank, 1);
        b->plans++;
        if (status == TN_OK && tn_watch_stopped_at(listing->watch, (size_t)b->plans))
            status = tn_fail_stopped(listing->watch, error);
    }
    mpz_clear(rank);
    tn_cursor_free(cursor);
    return status;
}

static tn_status put_blocks(const lister *l, int which, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < l->filled[which]; i++) {
        const block *b = &l->blocks[which][i];
        status = l->listing->put(l->listing->context, &b->text, b->plans, error);
    }
    return status;
}

/* Item 0 puts the round before: it takes longest, and so begins first. */
static tn_status work(void *context, unsigned thread, size_t item, tn_error *error)
{
    const lister *l = context;
    (void)thread;
    return item == 0 ? put_blocks(l, !l->now, error) : fill_block(l, &l->blocks[l->now][item - 1], error);
}

/* Deals out the next ranks. */
static void deal(lister *l)
{
    size_t i = 0;
    for (; i < l->count && mpz_cmp(l->next, l->listing->to) < 0; i++) {
        block *b = &l->blocks[l->now][i];
        mpz_set(b->from, l->next);
        mpz_add_ui(l->next, l->next, (unsigned long)l->plans_each);
        if (mpz_cmp(l->next, l->listing->to) > 0)
            mpz_set(l->next, l->listing->to);
        mpz_set(b->to, l->next);
    }
    l->filled[l->now] = i;
}

/* As many plans of a block as have a text of about the size, but not so many more than in the round before. */
static void choose_plans(lister *l)
{
    uint64_t bytes = 0, plans = 0, most = 4 * l->plans_each;
    for (size_t i = 0; i < l->filled[l->now]; i++) {
        bytes += l->blocks[l->now][i].text.size;
        plans += l->blocks[l->now][i].plans;
    }
    l->plans_each = bytes > plans ? BLOCK_BYTES / (bytes / plans) + 1 : PLANS_MOST;
    l->plans_each = l->plans_each < most ? l->plans_each : most;
    l->plans_each = l->plans_each < PLANS_MOST ? l->plans_each : PLANS_MOST;
}

static tn_status list(lister *l, tn_crew *crew, tn_error *error)
{
    tn_status status = TN_OK;
    do {
        deal(l);
        status = tn_crew_run(crew, l->filled[l->now] + 1, 1, work, l, error);
        choose_plans(l);
        l->now = !l->now;
    } while (status == TN_OK && l->filled[!l->now] > 0);
    return status;
}

tn_status tn_library_list(const tn_plan_listing *listing, tn_error *error)
{
    lister l = {.listing = listing, .plans_each = PLANS_FIRST};
    tn_crew *crew = tn_crew_new(listing->threads, listing->watch);
    tn_status status = crew ? TN_OK : tn_fail_memory(error);
    l.count = crew ? (size_t)BLOCKS_PER_THREAD * tn_crew_threads(crew) : 0;
    mpz_init_set(l.next, listing->from);
    for (int k = 0; k < 2; k++) {
        l.blocks[k] = calloc(l.count + 1, sizeof *l.blocks[k]);
        for (size_t i = 0; l.blocks[k] && i < l.count; i++)
            mpz_inits(l.blocks[k][i].from, l.blocks[k][i].to, NULL);
    }
    if (status == TN_OK)
        status = l.blocks[0] && l.blocks[1] ? list(&l, crew, error) : tn_fail_memory(error);
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; l.blocks[k] && i < l.count; i++) {
            mpz_clears(l.blocks[k][i].from, l.blocks[k][i].to, NULL);
            free(l.blocks[k][i].text.data);
            free(l.blocks[k][i].room.data);
        }
        free(l.blocks[k]);
    }
    mpz_clear(l.next);
    tn_crew_free(crew);
    return status;
}
