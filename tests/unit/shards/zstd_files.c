/* Files that are compressed by zstd: what was written reads back, whatever the sizes of the pieces; what is cut or
 * changed is refused. */
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "driver/zstd/zstd.h"
#include "runtime/base/error.h"

enum { MOST = 300000 };

/* Writes bytes in pieces of changing sizes, as one frame. */
static void compress(const char *bytes, size_t size, size_t piece, FILE *out)
{
    const tn_plan_compression *zstd = tn_plan_zstd();
    void *state = NULL;
    tn_error error;
    assert_int_equal(zstd->begin_writing(&state, &error), TN_OK);
    for (size_t at = 0; at < size; at += piece)
        assert_true(zstd->write(state, bytes + at, size - at < piece ? size - at : piece, false, out));
    assert_true(zstd->write(state, NULL, 0, true, out));
    zstd->end_writing(state);
}

/* Reads a whole file; the status of the last call. */
static tn_status expand(const char *path, size_t room, char *bytes, size_t *size)
{
    const tn_plan_compression *zstd = tn_plan_zstd();
    void *state = NULL;
    tn_error error;
    char head[8];
    int file = open(path, O_RDONLY);
    assert_true(file >= 0);
    ssize_t got = read(file, head, sizeof head);
    assert_true(got >= 0);
    assert_int_equal(zstd->begin_reading(head, (size_t)got, &state, &error), TN_OK);
    tn_status status;
    size_t some = 1;
    for (*size = 0; (status = zstd->read(state, file, path, bytes + *size, room, &some, &error)) == TN_OK && some;) {
        *size += some;
        assert_true(*size <= 2 * MOST);
    }
    zstd->end_reading(state);
    close(file);
    if (status != TN_OK)
        assert_int_equal(error.code, E_PLAN_FILE);
    return status;
}

typedef struct trial {
    char path[40];
    char bytes[MOST], read[2 * MOST + 70000];
} trial;

static trial *trial_new(void)
{
    trial *t = calloc(1, sizeof *t);
    assert_non_null(t);
    strcpy(t->path, "/tmp/tartan-zstd-XXXXXX");
    close(mkstemp(t->path));
    uint32_t noise = 1;
    for (size_t i = 0; i < MOST; i++) {
        noise = noise * 1664525u + 1013904223u;
        t->bytes[i] = (char)(i % 1000 < 500 ? i / 7 : noise >> 24);
    }
    return t;
}

static void trial_free(trial *t)
{
    unlink(t->path);
    free(t);
}

static void test_round_trip(void **state)
{
    (void)state;
    trial *t = trial_new();
    const size_t sizes[] = {0, 1, 3, 4, 1000, 131072, 131073, MOST}, pieces[] = {1, 1000, 70000, MOST};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        for (size_t p = sizes[s] > 1000; p < 4; p++) { /* single bytes only of small ones */
            FILE *out = fopen(t->path, "wb");
            compress(t->bytes, sizes[s], pieces[p], out);
            compress(t->bytes, 5, 5, out); /* a second frame behind it */
            fclose(out);
            size_t size;
            assert_int_equal(expand(t->path, p % 2 ? 333 : 65536, t->read, &size), TN_OK);
            assert_int_equal(size, sizes[s] + 5);
            assert_memory_equal(t->read, t->bytes, sizes[s]);
            assert_memory_equal(t->read + sizes[s], t->bytes, 5);
        }
    }
    trial_free(t);
}

static void test_damage(void **state)
{
    (void)state;
    trial *t = trial_new();
    char whole[2048];
    FILE *out = fopen(t->path, "wb");
    compress(t->bytes, 1500, 1500, out);
    fclose(out);
    FILE *in = fopen(t->path, "rb");
    size_t length = fread(whole, 1, sizeof whole, in), size;
    fclose(in);
    assert_in_range(length, 100, 2047);
    for (size_t i = 4; i < length; i++) { /* ends there: refused, wherever it is */
        assert_int_equal(truncate(t->path, 0), 0);
        out = fopen(t->path, "wb");
        fwrite(whole, 1, i, out);
        fclose(out);
        assert_int_equal(expand(t->path, 65536, t->read, &size), TN_INVALID);
    }
    for (size_t i = 4; i < length; i++) { /* a byte is another: refused, or the same plans (bits that mean nothing) */
        whole[i] ^= 0x55;
        out = fopen(t->path, "wb");
        fwrite(whole, 1, length, out);
        fclose(out);
        whole[i] ^= 0x55;
        if (expand(t->path, 65536, t->read, &size) == TN_OK) {
            assert_int_equal(size, 1500);
            assert_memory_equal(t->read, t->bytes, size);
        }
    }
    trial_free(t);
}

static void test_knows(void **state)
{
    (void)state;
    const tn_plan_compression *zstd = tn_plan_zstd();
    assert_true(zstd->knows("\x28\xb5\x2f\xfd....", 8));
    assert_false(zstd->knows("\x28\xb5\x2f", 3));
    assert_false(zstd->knows("3:single", 8));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_round_trip), cmocka_unit_test(test_damage),
                                       cmocka_unit_test(test_knows)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
