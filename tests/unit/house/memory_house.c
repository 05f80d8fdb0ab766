/* Houses where memory runs out at each allocation in turn: counting, building, drawings and files say so, and nothing
 * is lost. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/house/bare.h"
#include "runtime/house/count/houses.h"
#include "runtime/house/count/listing.h"
#include "runtime/house/export/export.h"
#include "runtime/house/picture/draw.h"
#include "runtime/house/rank/rank.h"
#include "runtime/house/rule/change.h"
#include "runtime/house/schedule/describe.h"
#include "tests/support/failing_memory.h"
#include "tests/support/test_house.h"

static test_house made;
static tn_plan plan;
static tn_house house;
static tn_solids solids;
static FILE *sink;

typedef tn_status operation(tn_error *error);

/* Fails one allocation in so many; a third of these under AddressSanitizer, where it takes much longer. */
static void expect_robust_every(operation *operate, size_t step)
{
#ifdef __SANITIZE_ADDRESS__
    step *= 3;
#endif
    for (size_t number = 0;; number += step) {
        tn_error error = {0};
        fail_allocation(number, 0);
        tn_status status = operate(&error);
        if (stop_failing() <= number) {
            assert_int_equal(status, TN_OK);
            assert_true(number > 0);
            return;
        }
        assert_int_equal(status, TN_MEMORY);
        assert_int_equal(error.status, TN_MEMORY);
    }
}

static void expect_robust(operation *operate)
{
    expect_robust_every(operate, 1);
}

static tn_status count(tn_error *error)
{
    tn_house_listing *variants;
    tn_house_counts counts;
    tn_status status = tn_house_listing_new(&made.form, made.some, 0, &variants, error);
    tn_house_counts_init(&counts);
    if (status == TN_OK)
        status = tn_house_listing_count(variants, plan.trays, plan.length, &counts, error);
    tn_house_counts_clear(&counts);
    tn_house_listing_free(variants);
    return status;
}

static tn_library *plans; /* of one tray */

/* All houses, and the plan of the last of them. */
static tn_status count_together(tn_error *error)
{
    tn_houses *houses = NULL;
    tn_tray trays[2];
    uint32_t length;
    tn_houses_projected with;
    mpz_t rank, on_plan;
    mpz_inits(rank, on_plan, NULL);
    tn_houses_projected_init(&with);
    tn_status status = tn_houses_new(&made.form, made.some, plans, 0, &houses, error);
    if (status == TN_OK) {
        tn_houses_count(houses, TN_ALL_LENGTHS, rank);
        mpz_sub_ui(rank, rank, 1);
        status = tn_houses_project(houses, &with, error);
    }
    if (status == TN_OK)
        status = tn_houses_find(houses, rank, trays, &length, on_plan, error);
    tn_houses_projected_clear(&with);
    tn_houses_free(houses);
    mpz_clears(rank, on_plan, NULL);
    return status;
}

/* The last house on a plan of one tray. */
static tn_status find_together(tn_error *error)
{
    tn_houses *houses = NULL;
    tn_house_listing *variants = NULL;
    tn_house_ranks *ranks = NULL;
    tn_plan_houses *on_plan;
    tn_house last = {0};
    tn_tray trays[2];
    uint32_t length;
    mpz_t rank;
    mpz_init(rank);
    tn_status status = tn_houses_new(&made.form, made.all, plans, 0, &houses, error);
    if (status == TN_OK)
        status = tn_house_listing_new(&made.form, made.all, 0, &variants, error);
    if (status == TN_OK) {
        tn_houses_count(houses, TN_ALL_LENGTHS, rank);
        mpz_sub_ui(rank, rank, 1);
        status = tn_house_ranks_new(houses, &ranks, error);
    }
    if (status == TN_OK)
        status = tn_house_ranks_find(ranks, rank, trays, &length, error);
    if (status == TN_OK)
        status = tn_house_ranks_plan(ranks, trays, length, &on_plan, error);
    if (status == TN_OK)
        status = tn_plan_houses_at(on_plan, rank, &last, error);
    tn_house_clear(&last);
    tn_house_ranks_free(ranks);
    tn_house_listing_free(variants);
    tn_houses_free(houses);
    mpz_clear(rank);
    return status;
}

static void test_count_together(void **state)
{
    (void)state;
    expect_robust_every(count_together, 5);
    expect_robust_every(find_together, 17); /* most of it is what count_together does */
}

/* ---- the best of them, by two measures */

static tn_house_weights *weights[2];
static const tn_house_measures *measures;

static tn_status take_one(void *context, const tn_house *one, bool *stop, tn_error *error)
{
    (void)context, (void)one, (void)error;
    *stop = true;
    return TN_OK;
}

static tn_status find_best(tn_houses_aim aim, tn_error *error)
{
    tn_houses *houses = NULL;
    tn_house_listing *variants = NULL;
    const tn_houses_what what = {.measures = measures, .aim = aim, .wanted = 3};
    tn_status status = tn_houses_of(&made.form, made.all, plans, &what, 0, &houses, error);
    if (status == TN_OK)
        status = tn_house_listing_new(&made.form, made.all, 0, &variants, error);
    if (status == TN_OK)
        assert_true(tn_houses_points(houses) > 0);
    if (status == TN_OK)
        status = tn_houses_point_each(houses, 0, TN_ALIKE_NOTHING, take_one, NULL, error);
    tn_house_listing_free(variants);
    tn_houses_free(houses);
    return status;
}

static tn_status best(tn_error *error)
{
    return find_best(TN_HOUSES_LEAST, error);
}

static tn_status front(tn_error *error)
{
    return find_best(TN_HOUSES_FRONT, error);
}

static tn_status complete(tn_error *error)
{
    static const tn_open_tray trays[] = {{.gap = true}, {.gap = false}};
    const tn_open_plan open = {.trays = trays, .count = 2};
    tn_houses *houses = NULL;
    tn_completions found;
    const tn_houses_what what = {.measures = measures, .aim = TN_HOUSES_COMPLETE};
    tn_status status = tn_houses_of(&made.form, made.all, plans, &what, 0, &houses, error);
    if (status == TN_OK) {
        status = tn_houses_complete(houses, &open, &found, error);
        tn_completions_clear(&found);
    }
    tn_houses_free(houses);
    return status;
}

static void test_best(void **state)
{
    (void)state;
    tn_error error = {0};
    for (uint32_t k = 0; k < 2; k++)
        assert_int_equal(tn_house_weights_new(&made.form, tn_house_measured_of(made.module, k), &weights[k], &error),
                         TN_OK);
    const tn_house_measures two = {.count = 2, .of = {weights[0], weights[1]}, .most = {true, false}};
    measures = &two;
    expect_robust_every(best, 3);
    expect_robust_every(front, 3);
    expect_robust_every(complete, 3);
    for (uint32_t k = 0; k < 2; k++)
        tn_house_weights_free(weights[k]);
}

/* ---- clauses that compare costs */

static const char priced[] =
    "schema hut {\n  width role length = 10'\n  zone body role band = room(10')\n}\n"
    "form huts of hut {\n  storey ground 9'\n  wall 8\"\n  partition 4\"\n  floor 10\"\n  roof 8\"\n"
    "  function living at cell(body)\n  function bed at cell(body)\n"
    "  face cell(body) beside cell(body) = open | wall\n"
    "  material stone \"#808080\" price 12.50 per sf for wall\n  material pine \"#b08050\" price 90 per each for cot\n"
    "  tile cot for bed { item cot left 1'..3', back 0..6', up 0..2' }\n"
    "  tile floor for bed { keep middle left 2'..4', back 2'..4' }\n}\n"
    "library rows using hut { trays 1..2 }\nlibrary all from rows in huts { }\n"
    "library some from rows in huts {\n  require sum(cost) + 10 * quantity(cell(bed)) + sum(width) / 1' > 4000\n"
    "  prune sum(cost) in 6000..6100 or quantity(cell(living)) > 1\n}\n";

/* Clauses that ask where in the row rooms and walks are. */
static const char placed[] =
    "schema hut {\n  width role length = 10'\n  zone body role band = room(10')\n}\n"
    "form huts of hut {\n  storey ground 9'\n  wall 8\"\n  partition 4\"\n  floor 10\"\n  roof 8\"\n"
    "  function living at cell(body)\n  function bed at cell(body)\n"
    "  face cell(body) beside cell(body) = open | wall\n}\n"
    "library rows using hut { trays 1..2 }\nlibrary all from rows in huts { }\n"
    "library some from rows in huts {\n  require neighbour(room(bed, cells > 1), room(living))\n"
    "  prune symmetric neighbour(beginning, apart(cell(bed), from cell(living)))\n"
    "  require many(quantity(room(any), n < 3))\n}\n";

static void other_house(const char *text)
{
    test_house usual = made;
    tn_plan usual_plan = plan;
    tn_library *usual_plans = plans;
    tn_error error = {0};
    tn_library_options options = {0};
    test_house_compile(&made, text);
    plan = test_house_plan(&made, "10' room:10'");
    assert_int_equal(tn_library_new(made.schema, made.some->plans, &options, &plans, &error), TN_OK);
    expect_robust(count);
    expect_robust_every(count_together, 5);
    tn_library_free(plans);
    free(plan.trays);
    test_house_clear(&made);
    made = usual;
    plan = usual_plan;
    plans = usual_plans;
}

static void test_compared(void **state)
{
    (void)state;
    other_house(priced);
}

static void test_placed(void **state)
{
    (void)state;
    other_house(placed);
}

static tn_status seen(void *context, const tn_house_change *one, const tn_house *changed, tn_error *error)
{
    (void)context, (void)one, (void)changed, (void)error;
    return TN_OK;
}

static tn_status change(tn_error *error)
{
    tn_house_rules *rules;
    tn_status status = tn_house_rules_new(&made.form, 0, &rules, error);
    if (status == TN_OK)
        status = tn_house_changes(&house, rules, made.all, TN_NO_CELL, seen, NULL, error);
    tn_house_rules_free(rules);
    return status;
}

static tn_status build(tn_error *error)
{
    tn_solids built;
    tn_status status = tn_house_solids(&house, &built, error);
    tn_solids_clear(&built);
    return status;
}

static tn_status mesh(tn_error *error)
{
    tn_blocks blocks;
    tn_mesh of = {0};
    tn_status status = tn_blocks_of(&house, &solids, &blocks, error);
    if (status == TN_OK)
        status = tn_blocks_mesh(&blocks, TN_SOLID_COUNT, &of, error);
    tn_mesh_clear(&of);
    tn_blocks_clear(&blocks);
    return status;
}

/* JSON and the table of parts, both with costs. */
static tn_status describe(tn_error *error)
{
    tn_buffer text = {0};
    tn_status status = tn_house_describe(&house, &solids, NULL, 0, &text, error);
    if (status == TN_OK)
        status = tn_house_parts(&house, &solids, &text, error);
    free(text.data);
    return status;
}

/* The line and the members of JSON, and the line read again. */
static tn_status write_and_read(tn_error *error)
{
    tn_buffer line = {0}, members = {0};
    tn_json json = tn_json_text(&members, TN_JSON_TIGHT);
    tn_house again = {0};
    tn_status status = tn_house_write(&house, &line, error);
    if (status == TN_OK)
        status = tn_house_write_members(&house, &json, error);
    if (status == TN_OK && members.failed)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_house_read(&made.form, line.data, line.size, 8, &again, error);
    tn_house_clear(&again);
    free(members.data);
    free(line.data);
    return status;
}

static tn_status tile_fails(tn_error *error)
{
    tn_tile_failure failure;
    return house.form->record->tile_count ? tn_tile_fails(&house, 0, house.form->record->tile_first, &failure, error)
                                          : TN_OK;
}

static tn_status find_bare(tn_error *error)
{
    tn_bare_cells bare;
    tn_tile_failure failure;
    tn_status status = tn_bare_find(&made.form, plan.trays, plan.length, &bare, error);
    if (status == TN_OK)
        status = tn_bare_why(&bare, 0, 0, made.form.record->tile_first, &failure, error);
    tn_bare_clear(&bare);
    return status;
}

static tn_status write_ifc(tn_error *error)
{
    static const tn_ifc_said said = {.name = "a hut", .project = "huts", .seed = "huts"};
    return tn_house_write_ifc(&house, &solids, &said, sink, error);
}

static tn_status draw_dxf(tn_error *error)
{
    static const tn_aspect aspects[] = {{.kind = TN_ASPECT_PLAN},
                                        {.kind = TN_ASPECT_ROOF},
                                        {.kind = TN_ASPECT_SECTION_X, .at = INT64_C(1200000000)},
                                        {.kind = TN_ASPECT_ELEVATION, .side = TN_HOUSE_FRONT}};
    const tn_house_drawing drawing = {.aspects = aspects, .count = sizeof aspects / sizeof *aspects, .title = "a hut"};
    tn_picture picture = {.format = TN_CANVAS_DXF};
    tn_status status = tn_house_draw(&house, &solids, &drawing, &picture, error);
    free(picture.element);
    return status;
}

static void test_failing(void **state)
{
    (void)state;
    expect_robust(count);
    expect_robust(change);
    expect_robust(build);
    expect_robust(mesh);
    expect_robust(describe);
    expect_robust(write_and_read);
    expect_robust(tile_fails);
    expect_robust(find_bare);
    expect_robust(write_ifc);
    expect_robust(draw_dxf);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_count_together), cmocka_unit_test(test_best),
                                       cmocka_unit_test(test_compared), cmocka_unit_test(test_placed),
                                       cmocka_unit_test(test_failing)};
    tn_house_listing *variants = NULL;
    tn_error error = {0};
    mpz_t variant;
    mpz_init_set_ui(variant, 300);
    test_house_make(&made);
    plan = test_house_plan(&made, "8' room:12' open:4' | 10' room:10' empty");
    tn_library_options options = {.override_trays = true, .trays_min = 1, .trays_max = 1};
    tn_status status = tn_house_listing_new(&made.form, made.all, 0, &variants, &error);
    if (status == TN_OK)
        status = tn_library_new(made.schema, made.some->plans, &options, &plans, &error);
    if (status == TN_OK)
        status = tn_house_listing_at(variants, plan.trays, plan.length, variant, &house, &error);
    if (status == TN_OK)
        status = tn_house_solids(&house, &solids, &error);
    tn_house_listing_free(variants);
    mpz_clear(variant);
    sink = fopen("/dev/null", "w");
    int failed = status == TN_OK && sink ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
    if (sink)
        fclose(sink);
    tn_solids_clear(&solids);
    tn_house_clear(&house);
    tn_library_free(plans);
    free(plan.trays);
    test_house_clear(&made);
    return failed;
}
