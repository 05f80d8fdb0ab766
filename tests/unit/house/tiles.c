/* Looks for the places of a tile without boxes, which no source has but a module may: it stands once, with no items. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/house/count/listing.h"
#include "tests/support/test_house.h"

/* The first house on a plan in whose first cell a tile is wanted; and that cell. */
static uint32_t wanting_cell(tn_house_listing *houses, const tn_plan *plan, tn_house *house, tn_variants *tiles)
{
    tn_error error = {0};
    mpz_t variant;
    mpz_init(variant);
    for (uint32_t cell = 0;; mpz_add_ui(variant, variant, 1)) {
        assert_int_equal(tn_house_listing_at(houses, plan->trays, plan->length, variant, house, &error), TN_OK);
        assert_int_equal(tn_tile_variants(house, cell, tiles, &error), TN_OK);
        if (tiles->count > 0) {
            mpz_clear(variant);
            return cell;
        }
        tn_variants_clear(tiles);
        tn_house_clear(house);
    }
}

static void test_no_boxes(void **state)
{
    test_house made;
    tn_house house;
    tn_variants tiles;
    tn_house_listing *houses;
    tn_error error = {0};
    (void)state;
    test_house_make(&made);
    tn_plan plan = test_house_plan(&made, "10' room:12' empty");
    assert_int_equal(tn_house_listing_new(&made.form, made.all, 0, &houses, &error), TN_OK);
    uint32_t cell = wanting_cell(houses, &plan, &house, &tiles);
    assert_true(tiles.item_count > 0);
    tn_variants_clear(&tiles);

    /* The form reads its records through the module: another that has only this tile changed. */
    tn_module without = *made.module;
    tn_tile_record tile = made.module->TILE_records[made.form.record->tile_first];
    tn_form_record form = *made.form.record;
    tile.box_count = 0;
    form.tile_first = 0;
    without.TILE_records = &tile;
    made.form.module = &without;
    made.form.record = &form;
    assert_int_equal(tn_tile_variants(&house, cell, &tiles, &error), TN_OK);
    assert_int_equal(tiles.count, 1); /* equal layouts count once: no item is as another */
    assert_int_equal(tiles.item_count, 0);
    assert_int_equal(tiles.variants[0].item_count, 0);
    assert_non_null(tiles.items); /* an array, though an empty one, as whoever adds an offset to it relies on */

    tn_variants_clear(&tiles);
    tn_house_listing_free(houses);
    tn_house_clear(&house);
    free(plan.trays);
    test_house_clear(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_no_boxes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
