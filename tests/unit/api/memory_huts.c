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

static void fail_each_cleanly(const huts *h, operation *const *operations, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        size_t failures = 0;
        for (int all_after = 0; all_after < 2; all_after++) {
            for (size_t number = 0;; number += 1 + number / 32) {
                tartan_error error = {0};
                fail_allocation(number, all_after);
                tartan_status status = operations[i](h, &error);
                if (stop_failing() <= number) {
                    assert_int_equal(status, TARTAN_OK);
                    break;
                }
                if (status == TARTAN_OK)
                    continue; /* GMP's and OpenMP's own allocations, and what can do without */
                if (status != TARTAN_MEMORY || !error.message[0])
                    fail_msg("operation %zu, allocation %zu: status %d, %s", i, number, (int)status, error.message);
                failures++;
                assert_int_equal(operations[i](h, &error), TARTAN_OK);
            }
        }
        assert_true(failures > 0);
    }
}

static void fails_cleanly(void **state)
{
    static operation *const operations[] = {open_and_count, count_on,   number,     sample, best,
                                            vary,           read_house, read_typed, mesh,   files};
    fail_each_cleanly(*state, operations, sizeof operations / sizeof *operations);
}

static int make_of(void **state, const char *rules, const char *line)
{
    static huts h;
    tartan_status status = tartan_compile_text("hut.plan", rules, strlen(rules), NULL, &h.module, NULL);
    if (status == TARTAN_OK)
        status = tartan_house_library_open(h.module, NULL, NULL, &h.library, NULL);
    if (status == TARTAN_OK)
        status = tartan_house_read(h.library, line, strlen(line), &h.house, NULL);
    *state = &h;
    return status != TARTAN_OK;
}

static int make(void **state)
{
    return make_of(state, text, hut);
}

/* ---- houses whose library and measures ask for walks */

static const char walked_text[] = "schema row { width role length = 3m | 4m  zone house role band = space(4m) }\n"
                                  "form f of row {\n"
                                  "  storey ground 2.7m wall 200mm partition 100mm deck 300mm roof 200mm way 800mm\n"
                                  "  function bed at cell(any)\n"
                                  "  opening door wide 900mm high 2m passage sliding\n"
                                  "  face cell(any) beside cell(any) = door | wall\n"
                                  "  face cell(any) outside left = door\n"
                                  "  face cell(any) outside = wall\n"
                                  "  tile tables for bed { item table left 500mm..1.2m, back 500mm..1.2m }\n"
                                  "  tile bare for bed { }\n"
                                  "  material pine \"#c0a080\" price 100 per m2 for table\n"
                                  "}\n"
                                  "library rows using row { trays 1..2 }\n"
                                  "library near from rows in f { require walk(cell(any), to outside) <= 4m }\n"
                                  "measure far = walk(cell(any), to outside)\n"
                                  "measure mixed = far / 1m + sum(cost) / 100 - exits(cell(any))\n";
static const char walked_house[] = "3m space:4m | 3m space:4m ; - ; bed | bed ; door ; tables.back bare.back";
static const uint32_t walked_trays[] = {0, 0};
static const tartan_on_plan walked_plan = {walked_trays, 2};

static tartan_status count_walked(const huts *h, tartan_error *error)
{
    char *count = NULL;
    tartan_status status = tartan_house_library_count_on(h->library, &walked_plan, NULL, &count, error);
    if (status == TARTAN_OK)
        assert_string_equal(count, "25");
    tartan_text_free(count);
    return status;
}

static tartan_status sample_walked(const huts *h, tartan_error *error)
{
    tartan_houses *tried = NULL, *on_plan = NULL;
    tartan_status status = tartan_house_sample(h->library, NULL, 1, 4, NULL, &tried, error);
    if (status == TARTAN_OK)
        status = tartan_house_sample(h->library, &walked_plan, 1, 3, NULL, &on_plan, error);
    if (status == TARTAN_OK) {
        assert_int_equal(tartan_houses_count(tried), 4);
        assert_int_equal(tartan_houses_count(on_plan), 3);
    }
    tartan_houses_free(tried);
    tartan_houses_free(on_plan);
    return status;
}

static tartan_status best_walked(const huts *h, tartan_error *error)
{
    tartan_houses *houses = NULL;
    const tartan_wish wishes[] = {{"far", false}, {"mixed", true}};
    tartan_status status = tartan_house_best(h->library, &walked_plan, wishes, 2, 3, NULL, &houses, error);
    if (status == TARTAN_OK)
        assert_int_equal(tartan_houses_count(houses), 3);
    tartan_houses_free(houses);
    return status;
}

static tartan_status number_walked(const huts *h, tartan_error *error)
{
    char *number = NULL;
    tartan_status status = tartan_house_number(h->house, NULL, &number, error);
    tartan_text_free(number);
    return status;
}

static tartan_status read_walked(const huts *h, tartan_error *error)
{
    static const char open[] = "3m space:4m | 3m space:4m ; - ; _ | _ ; door ; _ bare.back";
    tartan_house *house = NULL;
    tartan_status status = tartan_house_read(h->library, open, sizeof open - 1, &house, error);
    tartan_house_free(house);
    return status;
}

/* With what its measures are worth. */
static tartan_status describe_walked(const huts *h, tartan_error *error)
{
    void *bytes = NULL;
    size_t size = 0;
    tartan_status status = tartan_house_file(h->house, TARTAN_HOUSE_JSON, NULL, NULL, &bytes, &size, error);
    if (status == TARTAN_OK)
        assert_true(memmem(bytes, size, "\"mixed\"", 7) != NULL);
    tartan_bytes_free(bytes);
    return status;
}

static void fails_cleanly_by_walks(void **state)
{
    static operation *const operations[] = {count_walked,  sample_walked, best_walked,
                                            number_walked, read_walked,   describe_walked};
    fail_each_cleanly(*state, operations, sizeof operations / sizeof *operations);
}

static int make_walked(void **state)
{
    return make_of(state, walked_text, walked_house);
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
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(fails_cleanly, make, unmake),
                                       cmocka_unit_test_setup_teardown(fails_cleanly_by_walks, make_walked, unmake)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
