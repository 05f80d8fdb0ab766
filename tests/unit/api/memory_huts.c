/* Out of memory in what is asked of libraries of houses: allocations fail once, and then all from there on; each of the
 * first, later ones at growing distances. Every call must say so, leave nothing behind, and answer the next time. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "include/tartan/tartan.h"
#include "tests/support/failing_memory.h"
#include "tests/support/huts.h"

static const char text[] = TEST_HUTS "library all from rows in huts { prune room(bed, not by window) as dark }\n"
                                     "measure price = sum(cost)\n";
static const char hut[] = "8' room:10' ; vault(3') ; bed ; window";

typedef struct huts {
    tartan_module *module;
    tartan_house_library *library;
    tartan_house *house;
} huts;

typedef tartan_status operation(const huts *h, tartan_error *error);

static tartan_status open_and_count(const huts *h, tartan_error *error)
{
    tartan_house_library *library = NULL;
    char *count = NULL;
    tartan_status status = tartan_house_library_open(h->module, NULL, NULL, &library, error);
    if (status == TARTAN_OK)
        status = tartan_house_library_count(library, TARTAN_ANY_LENGTH, NULL, &count, error);
    if (status == TARTAN_OK)
        assert_string_equal(count, "12");
    tartan_text_free(count);
    tartan_house_library_free(library);
    return status;
}

static tartan_status count_on(const huts *h, tartan_error *error)
{
    const uint32_t trays[] = {1, 0};
    const tartan_on_plan plan = {trays, 2};
    char *count = NULL;
    tartan_status status = tartan_house_library_count_on(h->library, &plan, NULL, &count, error);
    if (status == TARTAN_OK)
        assert_string_equal(count, "2");
    tartan_text_free(count);
    return status;
}

static tartan_status number(const huts *h, tartan_error *error)
{
    tartan_house *house = NULL;
    char *rank = NULL, *named = NULL, *line = NULL;
    tartan_status status = tartan_house_unrank(h->library, "7", NULL, &house, error);
    if (status == TARTAN_OK)
        status = tartan_house_rank(house, NULL, &rank, error);
    if (status == TARTAN_OK)
        status = tartan_house_number(house, NULL, &named, error);
    if (status == TARTAN_OK)
        status = tartan_house_write(house, &line, error);
    if (status == TARTAN_OK)
        assert_string_equal(rank, "7");
    tartan_text_free(line);
    tartan_text_free(named);
    tartan_text_free(rank);
    tartan_house_free(house);
    return status;
}

static tartan_status sample(const huts *h, tartan_error *error)
{
    tartan_houses *houses = NULL;
    tartan_status status = tartan_house_sample(h->library, NULL, 1, 3, NULL, &houses, error);
    if (status == TARTAN_OK)
        assert_int_equal(tartan_houses_count(houses), 3);
    tartan_houses_free(houses);
    return status;
}

static tartan_status best(const huts *h, tartan_error *error)
{
    tartan_houses *houses = NULL;
    const tartan_wish wish = {"price", true};
    tartan_status status = tartan_house_best(h->library, NULL, &wish, 1, 3, NULL, &houses, error);
    if (status == TARTAN_OK)
        assert_int_equal(tartan_houses_count(houses), 3);
    tartan_houses_free(houses);
    return status;
}

static tartan_status vary(const huts *h, tartan_error *error)
{
    tartan_houses *houses = NULL;
    tartan_status status = tartan_house_variants(h->house, NULL, NULL, &houses, error);
    if (status == TARTAN_OK)
        assert_int_equal(tartan_houses_count(houses), 1);
    tartan_houses_free(houses);
    return status;
}

static tartan_status read_house(const huts *h, tartan_error *error)
{
    tartan_house *house = NULL;
    tartan_status status = tartan_house_read(h->library, hut, sizeof hut - 1, &house, error);
    tartan_house_free(house);
    return status;
}

/* With values left out; one that no house has. */
static tartan_status read_typed(const huts *h, tartan_error *error)
{
    static const char open[] = "8' room:10' ; _ ; - ; window", none[] = "8' room:10' ; vault(3') ; _ ; wall";
    tartan_house *house = NULL;
    tartan_status status = tartan_house_read(h->library, open, sizeof open - 1, &house, error);
    tartan_house_free(house);
    if (status == TARTAN_OK) {
        status = tartan_house_read(h->library, none, sizeof none - 1, &house, error);
        assert_true(status == TARTAN_INVALID || status == TARTAN_MEMORY);
        status = status == TARTAN_INVALID ? TARTAN_OK : status;
    }
    return status;
}

static tartan_status mesh(const huts *h, tartan_error *error)
{
    tartan_mesh *made = NULL;
    tartan_status status = tartan_house_mesh(h->house, NULL, &made, error);
    tartan_mesh_free(made);
    return status;
}

/* Cairo's allocations are its own: pictures are not among them. */
static tartan_status files(const huts *h, tartan_error *error)
{
    tartan_status status = TARTAN_OK;
    tartan_house_drawing drawing = tartan_house_drawing_init();
    const char *view = "plan:ground";
    drawing.views = &view;
    drawing.view_count = 1;
    for (int format = TARTAN_HOUSE_JSON; status == TARTAN_OK && format <= TARTAN_HOUSE_DXF; format++) {
        void *bytes = NULL;
        size_t size;
        status = tartan_house_file(h->house, (tartan_house_format)format, &drawing, NULL, &bytes, &size, error);
        tartan_bytes_free(bytes);
    }
    return status;
}

static void fails_cleanly(void **state)
{
    static operation *const operations[] = {open_and_count, count_on,   number,     sample, best,
                                            vary,           read_house, read_typed, mesh,   files};
    for (size_t i = 0; i < sizeof operations / sizeof *operations; i++) {
        size_t failures = 0;
        for (int all_after = 0; all_after < 2; all_after++) {
            for (size_t number = 0;; number += 1 + number / 32) {
                tartan_error error = {0};
                fail_allocation(number, all_after);
                tartan_status status = operations[i](*state, &error);
                if (stop_failing() <= number) {
                    assert_int_equal(status, TARTAN_OK);
                    break;
                }
                if (status == TARTAN_OK)
                    continue; /* GMP's and OpenMP's own allocations, and what can do without */
                if (status != TARTAN_MEMORY || !error.message[0])
                    fail_msg("operation %zu, allocation %zu: status %d, %s", i, number, (int)status, error.message);
                failures++;
                assert_int_equal(operations[i](*state, &error), TARTAN_OK);
            }
        }
        assert_true(failures > 0);
    }
}

static int make(void **state)
{
    static huts h;
    tartan_status status = tartan_compile_text("hut.plan", text, sizeof text - 1, NULL, &h.module, NULL);
    if (status == TARTAN_OK)
        status = tartan_house_library_open(h.module, NULL, NULL, &h.library, NULL);
    if (status == TARTAN_OK)
        status = tartan_house_read(h.library, hut, sizeof hut - 1, &h.house, NULL);
    *state = &h;
    return status != TARTAN_OK;
}

static int unmake(void **state)
{
    huts *h = *state;
    tartan_house_free(h->house);
    tartan_house_library_free(h->library);
    tartan_module_free(h->module);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(fails_cleanly, make, unmake)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
