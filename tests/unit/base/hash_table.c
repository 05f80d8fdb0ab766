/* The hash table: numbers of items by what they are. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/base/hash_table.h"
#include "runtime/base/random.h"

enum { ITEMS = 5000 };

typedef struct look {
    const uint64_t *items;
    uint64_t wanted;
} look;

static bool is_wanted(const void *context, uint32_t number)
{
    const look *l = context;
    return l->items[number] == l->wanted;
}

/* Enters each value, with the hash that `hash_of` gives it, and finds all of them again. */
static void check_all(tn_hash_table *table, uint64_t (*hash_of)(uint64_t value))
{
    uint64_t *items = calloc(ITEMS, sizeof *items);
    uint32_t count = 0;
    tn_error error;
    assert_non_null(items);
    for (uint32_t i = 0; i < 2 * ITEMS; i++) {
        look l = {items, i % ITEMS * 3};
        uint32_t number = count;
        assert_int_equal(tn_hash_enter(table, hash_of(l.wanted), is_wanted, &l, &number, &error), TN_OK);
        assert_int_equal(number, i % ITEMS);
        if (number == count)
            items[count++] = l.wanted;
        assert_int_equal(table->count, count);
        assert_true(2 * table->count <= table->capacity);
    }
    for (uint64_t value = 0; value < 3 * ITEMS; value++) {
        look l = {items, value};
        uint32_t number = tn_hash_find(table, hash_of(value), is_wanted, &l);
        assert_int_equal(number, value % 3 == 0 ? value / 3 : TN_HASH_NONE);
    }
    free(items);
}

static uint64_t good(uint64_t value)
{
    return tn_mix64(value);
}

static uint64_t high_only(uint64_t value)
{
    return value << 32;
}

static uint64_t few(uint64_t value)
{
    return value % 7;
}

static void test_hashes(void **state)
{
    (void)state;
    uint64_t (*const hashes[])(uint64_t) = {good, few, high_only}; /* bad ones are slow, and right */
    for (size_t h = 0; h < sizeof hashes / sizeof *hashes; h++) {
        tn_hash_table index = {0};
        check_all(&index, hashes[h]);
        tn_hash_clear(&index);
        assert_null(index.slots);
    }
}

static void test_forgetting(void **state)
{
    (void)state;
    tn_hash_table index = {0};
    look l = {NULL, 1};
    tn_error error;
    tn_hash_forget(&index);
    assert_int_equal(tn_hash_find(&index, 1, is_wanted, &l), TN_HASH_NONE);
    assert_int_equal(tn_hash_reserve(&index, 1000, &error), TN_OK);
    size_t capacity = index.capacity;
    assert_true(capacity >= 2000);
    check_all(&index, good);
    tn_hash_forget(&index);
    assert_int_equal(index.count, 0);
    check_all(&index, good);
    tn_hash_clear(&index);
}

/* Slots of memory that somebody else frees. */
typedef struct blocks {
    void *items[32];
    size_t count;
} blocks;

static void *make(void *from, size_t bytes)
{
    blocks *b = from;
    assert_true(b->count < sizeof b->items / sizeof *b->items);
    return b->items[b->count++] = calloc(bytes, 1);
}

static void test_memory_of_others(void **state)
{
    (void)state;
    blocks b = {0};
    tn_hash_table index = {.make = make, .from = &b};
    check_all(&index, good);
    tn_hash_clear(&index);
    check_all(&index, good);
    for (size_t i = 0; i < b.count; i++)
        free(b.items[i]);
}

static void test_too_many(void **state)
{
    (void)state;
    tn_hash_table index = {0};
    tn_error error;
    assert_int_equal(tn_hash_reserve(&index, SIZE_MAX, &error), TN_MEMORY);
    assert_null(index.slots);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hashes),
        cmocka_unit_test(test_forgetting),
        cmocka_unit_test(test_memory_of_others),
        cmocka_unit_test(test_too_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
