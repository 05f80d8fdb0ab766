/* Listing plans on threads where memory runs out at each allocation in turn: an error, and nothing is lost; else the
 * same plans as a cursor gives. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/library/listing.h"
#include "tests/support/fail_each.h"
#include "tests/support/load_plan.h"

static const char text[] = "schema s { use = hall | room | stair }\n"
                           "library rows using s { trays 0..6  prune tray(hall) beside tray(hall) }\n";

static tn_module *module;
static tn_schema *schema;
static tn_library *library;

typedef struct listed {
    tn_buffer text;
    uint64_t plans;
    bool stops;
} listed;

/* A digit a tray, and a blank. */
static bool append(void *context, const mpz_t rank, const tn_tray *trays, uint32_t length, tn_buffer *out,
                   tn_buffer *room)
{
    (void)context;
    bool done = tn_buffer_printf(room, "%lu:", mpz_get_ui(rank)) && tn_buffer_append(out, room->data, room->size);
    for (uint32_t i = 0; done && i < length; i++)
        done = tn_buffer_printf(out, "%u", (unsigned)trays[i]);
    return done && tn_buffer_append(out, " ", 1);
}

static tn_status put(void *context, const tn_buffer *plans, uint64_t count, tn_error *error)
{
    listed *to = context;
    if (to->stops)
        return tn_fail(error, TN_IO, TN_CODE_NONE, "full");
    to->plans += count;
    return tn_buffer_append(&to->text, plans->data, plans->size) ? TN_OK : tn_fail_memory(error);
}

static tn_status list(unsigned threads, listed *to, tn_error *error)
{
    mpz_t from, end;
    mpz_init_set_ui(from, 5);
    mpz_init_set_ui(end, 600);
    const tn_plan_listing listing = {
        .library = library, .from = from, .to = end, .threads = threads, .append = append, .put = put, .context = to};
    tn_status status = tn_library_list(&listing, error);
    mpz_clears(from, end, NULL);
    return status;
}

static tn_status one_thread(void)
{
    listed to = {0};
    tn_error error;
    tn_status status = list(1, &to, &error);
    assert_true(status != TN_OK || to.plans == 595);
    free(to.text.data);
    return status;
}

static void test_memory(void **state)
{
    (void)state;
    fail_each(one_thread, false);
}

static void test_listed(void **state)
{
    (void)state;
    listed expected = {0};
    tn_error error;
    const tn_tray *trays;
    uint32_t length;
    tn_cursor *cursor;
    tn_buffer room = {0};
    mpz_t rank, end;
    mpz_init_set_ui(rank, 5);
    mpz_init_set_ui(end, 600);
    assert_int_equal(tn_cursor_new(library, rank, end, &cursor, &error), TN_OK);
    for (; tn_cursor_next(cursor, &trays, &length); mpz_add_ui(rank, rank, 1)) {
        room.size = 0;
        assert_true(append(NULL, rank, trays, length, &expected.text, &room));
    }
    for (unsigned threads = 1; threads <= 4; threads++) {
        listed to = {0};
        assert_int_equal(list(threads, &to, &error), TN_OK);
        assert_int_equal(to.text.size, expected.text.size);
        assert_memory_equal(to.text.data, expected.text.data, expected.text.size);
        free(to.text.data);
    }
    listed full = {.stops = true};
    assert_int_equal(list(2, &full, &error), TN_IO);
    tn_cursor_free(cursor);
    free(expected.text.data);
    free(room.data);
    mpz_clears(rank, end, NULL);
}

static int setup(void **state)
{
    static tn_compilation compilation;
    module = load_plan(text, &compilation);
    assert_int_equal(tn_schema_new(module, 0, 0, &schema, NULL), TN_OK);
    assert_int_equal(tn_library_new(schema, 0, NULL, &library, NULL), TN_OK);
    *state = &compilation;
    return 0;
}

static int teardown(void **state)
{
    tn_library_free(library);
    tn_schema_free(schema);
    tn_module_free(module);
    tn_compilation_clear(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_listed),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
