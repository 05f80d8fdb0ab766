/* Why plans have no house: on random forms, a plan with a bare cell has none, and something keeps
 * each tile out of its bare cells. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/house/bare.h"
#include "runtime/house/count/listing.h"
#include "tests/support/test_house.h"

enum { FORMS = 300, PLANS = 6 };

/* A form in which some cells have no function, and some tiles do not stand: what varies is drawn. */
static const char written[] =
    "schema s { width = 8' | 10' zone body = open(8') | dense(10') zone bay = open(4') | empty }\n"
    "form huts of s { storey ground 9' storey loft 8' wall 6\" partition 4\" floor 1' roof 10\"\n"
    "option body storeys = 1 | 2  option bay storeys = 1\n"
    "function hall at cell(body %s)  function room at cell(body%s)  function seat at cell(bay%s)\n"
    "opening door wide 3' high 6'8\" clear %u' passage  opening window wide 3' high 4' sill %u'\n"
    "face cell(hall) beside cell(any) = %s  face cell(any) beside cell(any) = door | open\n"
    "face cell(hall) outside = %s  face cell(any) outside = %s\n"
    "tile table for hall { item table left %u'..right %u', back %u'..front %u', up 0..3' }\n"
    "tile bed for room, hall { against wall item bed left 1'..%u', back 0..%u', up 0..2' }\n"
    "tile bench for %s { against window item bench left %u'..right 0, back 0..2' } %s }\n"
    "library plans using s { trays 1..2 }\n"
    "library all from plans in huts { }  library some from plans in huts { require cell(hall) }\n";

static uint32_t draw(uint64_t *state, uint32_t count)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(*state >> 33) % count;
}

static void write_form(uint64_t *s, char *text, size_t size)
{
    static const char *const bodies[] = {"open", "dense"}, *const rests[] = {"", ", not 8'", ", 10'", " open"},
                             *const between[] = {"wall", "open | door", "door"},
                             *const outside[] = {"wall", "window", "door", "window | wall"},
                             *const ways[] = {"", "", "way 2'6\"", "way 3'"};
    const char *body = bodies[draw(s, 2)], *room = rests[draw(s, 4)], *seat = rests[draw(s, 4)];
    const char *inner = between[draw(s, 3)], *first = outside[draw(s, 4)], *other = outside[draw(s, 4)];
    uint32_t n[9];
    for (int i = 0; i < 9; i++)
        n[i] = draw(s, 4);
    const char *sitting = draw(s, 2) ? "seat" : "hall", *way = ways[draw(s, 4)];
    snprintf(text, size, written, body, room, seat, 1 + draw(s, 4), draw(s, 3), inner, first, other, n[0], n[1], n[2],
             n[3], 4 + n[4] + n[5], 3 + n[6] + n[7], sitting, 2 * n[8], way);
}

typedef struct tally {
    size_t empty, explained, no_function, no_tile, no_way;
} tally;

/* Nobody can go about in a bare cell whose function has no tiles. */
static void check_ways(tn_bare_cells *bare, uint32_t cell, uint32_t function, tally *t)
{
    tn_way_fault fault;
    tn_error error = {0};
    assert_int_equal(tn_bare_fault(bare, cell, function, &fault, &error), TN_OK);
    assert_int_not_equal(fault.fault, TN_FLOOR_FITS);
    t->no_way++;
}

/* Each tile of each function that a bare cell may have is kept out by something. */
static void check_cell(test_house *made, tn_bare_cells *bare, uint32_t cell, tally *t)
{
    const tn_form_record *form = made->form.record;
    bool may = false;
    for (uint32_t f = 0; f < tn_form_functions(&made->form); f++) {
        if (!tn_cell_may(&bare->house, &bare->house.cells[cell], f))
            continue;
        may = true;
        bool tiles = false;
        for (uint32_t i = form->tile_first; i < form->tile_first + form->tile_count; i++) {
            tn_tile_failure failure;
            tn_error error = {0};
            bare->house.cells[cell].function = f;
            bool meant = tn_tile_is_for(&bare->house, cell, i);
            tiles |= meant;
            if (!meant)
                continue;
            assert_int_equal(tn_bare_why(bare, cell, f, i, &failure, &error), TN_OK);
            assert_int_not_equal(failure.obstacle, TN_TILE_STANDS);
        }
        bare->house.cells[cell].function = TN_NO_FUNCTION;
        if (!tiles)
            check_ways(bare, cell, f, t);
    }
    t->no_function += !may;
    t->no_tile += may;
}

static void check_plan(test_house *made, tn_house_listing *houses, const tn_tray *trays, size_t length, tally *t)
{
    tn_bare_cells bare;
    tn_house_counts counts;
    tn_error error = {0};
    tn_house_counts_init(&counts);
    tn_status counted = tn_house_listing_count(houses, trays, length, &counts, &error);
    tn_status status = tn_bare_find(&made->form, trays, length, &bare, &error);
    if (counted == TN_OK && status == TN_OK) {
        t->empty += mpz_sgn(counts.houses) == 0;
        t->explained += bare.count > 0;
        if (bare.count > 0)
            assert_int_equal(mpz_sgn(counts.houses), 0);
        for (size_t i = 0; i < bare.count; i++)
            check_cell(made, &bare, bare.cells[i], t);
    }
    tn_bare_clear(&bare);
    tn_house_counts_clear(&counts);
}

static void test_drawn(void **state)
{
    uint64_t drawing = 20261125;
    tally t = {0};
    (void)state;
    for (int i = 0; i < FORMS; i++) {
        test_house made;
        tn_house_listing *houses;
        tn_error error = {0};
        char text[4096];
        write_form(&drawing, text, sizeof text);
        test_house_compile(&made, text);
        assert_int_equal(tn_house_listing_new(&made.form, made.all, 200000, &houses, &error), TN_OK);
        for (uint32_t k = 0; k < PLANS; k++) {
            const tn_tray trays[] = {(uint32_t)(k * 7 + (uint32_t)i) % made.schema->tray_count,
                                     (k * 3 + 1) % made.schema->tray_count};
            check_plan(&made, houses, trays, 1 + k % 2, &t);
        }
        tn_house_listing_free(houses);
        test_house_clear(&made);
    }
    print_message("%zu plans without a house, %zu explained: %zu cells without a function, %zu without a tile, %zu "
                  "functions without a way\n",
                  t.empty, t.explained, t.no_function, t.no_tile, t.no_way);
    assert_true(t.no_function > 100 && t.no_tile > 100 && t.no_way > 20 && t.explained * 10 > t.empty * 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_drawn)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
