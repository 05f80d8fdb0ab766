/* Encodings of Parquet: what is written is read back, at the edges too, and what is cut off is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/parquet/encoding.h"
#include "driver/parquet/writer.h"
#include "runtime/base/bytes.h"
#include "tests/support/test_rule.h"

enum { MOST = 1000 };

static void write_deltas(tn_buffer *out, const int64_t *values, size_t count)
{
    tn_delta_writer writer = {0};
    for (size_t i = 0; i < count; i++)
        assert_true(tn_delta_add(&writer, values[i]));
    tn_delta_end(&writer, out);
    assert_false(out->failed);
    free(writer.blocks.data);
}

/* Are these the numbers that were written, and does each shorter text end too soon? */
static void expect_deltas(const int64_t *values, size_t count)
{
    tn_buffer out = {0};
    tn_deltas deltas;
    int64_t value;
    write_deltas(&out, values, count);
    assert_true(tn_deltas_begin(&deltas, (const uint8_t *)out.data, out.size));
    for (size_t i = 0; i < count; i++) {
        assert_true(tn_deltas_next(&deltas, &value));
        assert_true(value == values[i]);
    }
    assert_false(tn_deltas_next(&deltas, &value));
    size_t read = 0;
    if (count > 1 && tn_deltas_begin(&deltas, (const uint8_t *)out.data, out.size - 1))
        while (read < count && tn_deltas_next(&deltas, &value))
            read++;
    assert_true(count <= 1 || read < count);
    free(out.data);
}

static void test_deltas(void **state)
{
    (void)state;
    test_random random = {.seed = 17};
    int64_t values[MOST];
    const int64_t extremes[] = {INT64_MIN, INT64_MAX, 0, -1, INT64_MIN, INT64_MIN, INT64_MAX, 1};
    expect_deltas(extremes, sizeof extremes / sizeof *extremes);
    for (unsigned bits = 1; bits <= 64; bits++) {
        size_t count = test_random_below(&random, MOST);
        for (size_t i = 0; i < count; i++)
            values[i] = (int64_t)(test_random_next(&random) >> (64 - bits));
        expect_deltas(values, count);
    }
    for (size_t i = 0; i < MOST; i++) /* ranks in a row take next to no room */
        values[i] = INT64_C(10000000000) + (int64_t)i;
    tn_buffer out = {0};
    write_deltas(&out, values, MOST);
    assert_in_range(out.size, 1, 60);
    free(out.data);
}

static void expect_runs(unsigned width, const tn_buffer *out, const uint32_t *values, size_t count)
{
    tn_runs runs;
    uint32_t value;
    tn_runs_begin(&runs, width, (const uint8_t *)out->data, out->size);
    for (size_t i = 0; i < count; i++) {
        assert_true(tn_runs_next(&runs, &value));
        assert_int_equal(value, values[i]);
    }
    size_t read = 0;
    tn_runs_begin(&runs, width, (const uint8_t *)out->data, out->size - 1);
    while (read < count && tn_runs_next(&runs, &value))
        read++;
    assert_true(read < count);
}

static void test_runs(void **state)
{
    (void)state;
    test_random random = {.seed = 18};
    for (size_t count = 1; count < MOST; count += 7) {
        uint32_t values[MOST], most = count % 3 ? 256 : 1;
        uint8_t bytes[MOST];
        uint16_t shorts[MOST];
        for (size_t i = 0; i < count; i++)
            shorts[i] = bytes[i] = (uint8_t)(values[i] = test_random_below(&random, most));
        tn_buffer out = {0};
        memcpy(tn_bytes_begin(&out, count), bytes, count);
        tn_bytes_end(&out, 0, count);
        expect_runs(8, &out, values, count);
        out.size = 0;
        tn_shorts_write(&out, shorts, count);
        expect_runs(16, &out, values, count);
        free(out.data);
    }
}

/* Packed numbers of any width, as other programs write them. */
static void test_widths(void **state)
{
    (void)state;
    static const uint8_t three[] = {0x03, 0x88, 0xc6, 0xfa}; /* 0 to 7 in three bits: the specification's example */
    const uint32_t values[] = {0, 1, 2, 3, 4, 5, 6, 7};
    const tn_buffer out = {.data = (char *)(uintptr_t)three, .size = sizeof three};
    expect_runs(3, &out, values, 8);
    tn_runs runs;
    uint32_t value;
    tn_runs_begin(&runs, 3, (const uint8_t[]){0x04, 0x08}, 2); /* a run of a number that has more bits */
    assert_false(tn_runs_next(&runs, &value));
    tn_runs_begin(&runs, 1, (const uint8_t[]){0x00, 0x01}, 2); /* a run of none */
    assert_false(tn_runs_next(&runs, &value));
}

/* A column with more different numbers than a dictionary holds has the later ones as they are. */
static void test_numbers(void **state)
{
    (void)state;
    tn_numbers numbers;
    tn_error error;
    tn_buffer body = {0};
    assert_int_equal(tn_numbers_new(&numbers, 8, 65536, &error), TN_OK);
    for (int64_t n = 0; n < 65536; n++)
        tn_numbers_add(&numbers, n * n - 5);
    assert_int_equal(tn_numbers_page(&numbers, &body), TN_ENCODING_RLE_DICTIONARY);
    assert_int_equal(numbers.known, 65536);
    body.size = 0;
    tn_numbers_add(&numbers, 4); /* in the dictionary */
    tn_numbers_add(&numbers, -7);
    assert_int_equal(tn_numbers_page(&numbers, &body), TN_ENCODING_PLAIN);
    assert_int_equal(body.size, 16);
    assert_memory_equal(body.data, "\4\0\0\0\0\0\0\0\xf9\xff\xff\xff\xff\xff\xff\xff", 16);
    assert_true(numbers.least == -7 && numbers.most == INT64_C(65535) * 65535 - 5);
    tn_numbers_clear(&numbers);
    body.size = 0;
    for (int64_t n = 0; n < 65535; n++)
        assert_true(tn_numbers_add(&numbers, n));
    assert_int_equal(tn_numbers_page(&numbers, &body), TN_ENCODING_RLE_DICTIONARY);
    body.size = 0;
    const int64_t last[] = {3, 65535, 3, 65536, 4}; /* the fourth finds no place, in the middle of a page */
    for (size_t i = 0; i < sizeof last / sizeof *last; i++)
        assert_true(tn_numbers_add(&numbers, last[i]));
    assert_int_equal(tn_numbers_page(&numbers, &body), TN_ENCODING_PLAIN);
    assert_int_equal(body.size, 8 * sizeof last / sizeof *last);
    for (size_t i = 0; i < sizeof last / sizeof *last; i++)
        assert_true(tn_get_i64((const uint8_t *)body.data + 8 * i) == last[i]);
    tn_numbers_clear(&numbers);
    tn_numbers_add(&numbers, 9);
    assert_int_equal(tn_numbers_page(&numbers, &body), TN_ENCODING_RLE_DICTIONARY);
    assert_int_equal(numbers.known, 1);
    tn_numbers_free(&numbers);
    free(body.data);
}

/* Structs within structs, and what is passed over. */
static void test_thrift(void **state)
{
    (void)state;
    tn_buffer out = {0};
    tn_thrift_out t = tn_thrift_to(&out);
    tn_thrift_list(&t, 1, TN_THRIFT_I32, 20);
    for (int i = 0; i < 20; i++)
        tn_thrift_element_number(&t, i - 10);
    tn_thrift_begin(&t, 2);
    tn_thrift_flag(&t, 1, true);
    tn_thrift_text(&t, 14, "inside");
    tn_thrift_end(&t);
    tn_thrift_number(&t, 3, TN_THRIFT_I64, INT64_MIN);
    tn_thrift_end(&t);
    for (size_t size = 0; size <= out.size; size++) {
        tn_thrift_in in = {(const uint8_t *)out.data, (const uint8_t *)out.data + size, false};
        tn_thrift_field field = {0};
        int64_t last = 0;
        while (tn_thrift_next(&in, &field)) {
            if (field.number == 3)
                last = tn_thrift_read_number(&in, field.type);
            else
                tn_thrift_skip(&in, field.type);
        }
        assert_int_equal(in.bad, size < out.size);
        assert_true(size < out.size || last == INT64_MIN);
    }
    free(out.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_deltas), cmocka_unit_test(test_runs),
                                       cmocka_unit_test(test_widths), cmocka_unit_test(test_numbers),
                                       cmocka_unit_test(test_thrift)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
