/* What waits to be read: pieces, limits, and threads that wait for a page. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "studio/server/outbox.h"

static void note(void *context)
{
    (*(unsigned *)context)++;
}

static char *text_of(size_t size)
{
    char *text = malloc(size + 1);
    assert_non_null(text);
    memset(text, 'x', size);
    text[size] = '\0';
    return text;
}

static void sends_in_pieces(void **state)
{
    (void)state;
    unsigned woken = 0;
    static unsigned char bytes[TN_PIECE_MAX];
    tn_outbox *outbox = tn_outbox_new(note, &woken);
    assert_false(tn_outbox_waits(outbox));
    assert_int_equal(tn_outbox_take(outbox, bytes).size, 0);
    assert_true(tn_outbox_put(outbox, json_pack("{s:i}", "a", 1)));
    assert_true(tn_outbox_put_text(outbox, text_of(TN_PIECE_MAX)));
    assert_true(tn_outbox_put_text(outbox, text_of(2 * TN_PIECE_MAX + 1)));
    assert_true(tn_outbox_put(outbox, NULL) && tn_outbox_put_text(outbox, NULL));
    uint8_t *raw = (uint8_t *)text_of(3);
    raw[1] = 0;
    assert_true(tn_outbox_put_bytes(outbox, raw, 3));
    assert_int_equal(woken, 4);
    const tn_outbox_piece wanted[] = {{7, true, true, false},
                                      {TN_PIECE_MAX, true, true, false},
                                      {TN_PIECE_MAX, true, false, false},
                                      {TN_PIECE_MAX, false, false, false},
                                      {1, false, true, false},
                                      {3, true, true, true}};
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        assert_true(tn_outbox_waits(outbox));
        tn_outbox_piece piece = tn_outbox_take(outbox, bytes);
        assert_true(piece.size == wanted[i].size && piece.first == wanted[i].first && piece.last == wanted[i].last);
        assert_int_equal(piece.binary, wanted[i].binary);
        assert_true(i > 0 || memcmp(bytes, "{\"a\":1}", 7) == 0);
    }
    assert_false(tn_outbox_waits(outbox));
    tn_outbox_free(outbox);
}

static void *put_one_more(void *outbox)
{
    return tn_outbox_put_text(outbox, text_of(10)) ? outbox : NULL;
}

static void start_waiting(tn_outbox *outbox, pthread_t *thread)
{
    assert_true(tn_outbox_put_text(outbox, text_of(TN_UNREAD_MAX + 1)));
    assert_false(tn_outbox_put_now(outbox, json_object())); /* which does not wait */
    assert_false(tn_outbox_stuck(outbox));                  /* not yet */
    assert_int_equal(pthread_create(thread, NULL, put_one_more, outbox), 0);
}

static void waits_for_a_page_that_reads(void **state)
{
    (void)state;
    unsigned woken = 0;
    static unsigned char bytes[TN_PIECE_MAX];
    tn_outbox *outbox = tn_outbox_new(note, &woken);
    pthread_t thread;
    void *put;
    start_waiting(outbox, &thread);
    tn_outbox_take(outbox, bytes);
    assert_int_equal(pthread_join(thread, &put), 0);
    assert_non_null(put);
    tn_outbox_free(outbox);
}

static void waits_for_no_page_that_is_gone(void **state)
{
    (void)state;
    unsigned woken = 0;
    tn_outbox *outbox = tn_outbox_new(note, &woken);
    pthread_t thread;
    void *put;
    start_waiting(outbox, &thread);
    tn_outbox_close(outbox);
    assert_int_equal(pthread_join(thread, &put), 0);
    assert_null(put);
    assert_int_equal(woken, 1);
    tn_outbox_wake(outbox);
    assert_int_equal(woken, 1); /* nobody is there to be woken */
    tn_outbox_free(outbox);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sends_in_pieces), cmocka_unit_test(waits_for_a_page_that_reads),
                                       cmocka_unit_test(waits_for_no_page_that_is_gone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
