/* Texts that threads make side by side come out in order, with the lines before them, and no further ahead than
 * allowed. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/plan/sift.h"

enum { THREADS = 6, CHUNKS = 3000, ROOM = 9, WAITING_BYTES = 200 };

typedef struct game {
    tn_relay relay;
    pthread_mutex_t taking; /* holds next */
    uint64_t next;          /* chunk */
    tn_buffer out[TN_RELAY_TEXTS];
    uint64_t items;   /* written of */
    uint64_t stop_at; /* a chunk that ends it all */
    bool refuses;     /* the writer does, at that chunk */
    atomic_int wrong;
} game;

static bool write_texts(void *context, uint64_t items, const tn_buffer texts[TN_RELAY_TEXTS])
{
    game *g = context;
    g->items += items;
    char end[32];
    snprintf(end, sizeof end, "%d.", (int)g->stop_at);
    if (g->refuses && texts[0].size > 0 && strstr(texts[0].data, end))
        return false;
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++)
        if (texts[t].size > 0 && !tn_buffer_append(&g->out[t], texts[t].data, texts[t].size))
            return false;
    return true;
}

/* Chunk k has k % 5 lines; its text is its number, at length now and then. */
static void make(game *g, uint64_t chunk, tn_buffer texts[TN_RELAY_TEXTS])
{
    tn_relay_count(&g->relay, chunk, chunk % 5);
    for (uint64_t spin = chunk * 2654435761u % 512; spin > 0; spin--)
        atomic_thread_fence(memory_order_seq_cst);
    if (chunk % 3 == 0 && tn_relay_lines_before(&g->relay, chunk) != chunk / 5 * 10 + (chunk % 5) * (chunk % 5 - 1) / 2)
        g->wrong++;
    tn_buffer_printf(&texts[chunk % 2], "%d.", (int)chunk);
    if (chunk % 7 != 0)
        return;
    tn_relay_wait(&g->relay, chunk);
    tn_relay_now(&g->relay, 1, texts);
    if (chunk == g->stop_at && !g->refuses)
        tn_relay_stop(&g->relay);
    tn_buffer_printf(&texts[chunk % 2], "%*s.", (int)(chunk % 100), "");
}

/* Chunks are begun in order. */
static bool take(game *g, uint64_t *chunk)
{
    pthread_mutex_lock(&g->taking);
    bool taken = g->next < CHUNKS && tn_relay_admit(&g->relay, g->next);
    *chunk = g->next;
    g->next += taken;
    pthread_mutex_unlock(&g->taking);
    return taken;
}

static void *play(void *context)
{
    game *g = context;
    tn_buffer texts[TN_RELAY_TEXTS] = {0};
    for (uint64_t chunk; take(g, &chunk);) {
        make(g, chunk, texts);
        tn_relay_pass(&g->relay, chunk, 2, texts);
        if (texts[0].size + texts[1].size > 0)
            g->wrong++;
    }
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++)
        free(texts[t].data);
    return NULL;
}

/* What must come out, up to the end. */
static void expect(const game *g, uint64_t last, bool whole)
{
    tn_buffer wanted[TN_RELAY_TEXTS] = {0};
    for (uint64_t chunk = 0; chunk <= last; chunk++) {
        tn_buffer_printf(&wanted[chunk % 2], "%d.", (int)chunk);
        if (chunk % 7 == 0 && (whole || chunk < last))
            tn_buffer_printf(&wanted[chunk % 2], "%*s.", (int)(chunk % 100), "");
    }
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++) {
        assert_int_equal(g->out[t].size, wanted[t].size);
        assert_memory_equal(g->out[t].data, wanted[t].data, wanted[t].size);
        free(wanted[t].data);
    }
}

static void run(game *g)
{
    pthread_t threads[THREADS];
    pthread_mutex_init(&g->taking, NULL);
    tn_error error;
    assert_int_equal(tn_relay_start(&g->relay, ROOM, WAITING_BYTES, write_texts, g, &error), TN_OK);
    for (size_t i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, play, g), 0);
    for (size_t i = 0; i < THREADS; i++)
        pthread_join(threads[i], NULL);
    assert_int_equal(g->wrong, 0);
    tn_relay_clear(&g->relay);
    pthread_mutex_destroy(&g->taking);
}

static void clear(game *g)
{
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++)
        free(g->out[t].data);
}

static void test_order(void **state)
{
    (void)state;
    game g = {.stop_at = UINT64_MAX};
    run(&g);
    expect(&g, CHUNKS - 1, true);
    assert_int_equal(g.items, 2 * CHUNKS + (CHUNKS + 6) / 7);
    clear(&g);
}

static void test_stopped(void **state)
{
    (void)state;
    game g = {.stop_at = 700};
    run(&g);
    expect(&g, 700, false);
    clear(&g);
    game refused = {.stop_at = 1402, .refuses = true};
    run(&refused);
    expect(&refused, 1401, true);
    clear(&refused);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
