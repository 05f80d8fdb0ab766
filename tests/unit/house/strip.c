/* All houses of a library: their number, by length and without tiles, is that of going through the plans one by one;
 * ranks follow the plans; and a limit is an error that names a clause. Of a form that is written out, and of forms and
 * clauses that are drawn. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/house/strip/houses.h"
#include "runtime/house/variant/variant.h"
#include "tests/support/test_house.h"

enum { LENGTH_MAX = 3 };

typedef struct check {
    const test_house *made;
    const tn_house_library_record *record;
    tn_library *plans;
    tn_houses *houses;
    tn_house_variants *variants;
    mpz_t lengths[LENGTH_MAX + 1], all, faced, rank, variant;
} check;

static tn_library *plans_of(const test_house *made, const tn_house_library_record *record)
{
    tn_library *plans;
    tn_error error = {0};
    tn_library_options options = {0};
    assert_int_equal(tn_library_new(made->schema, record->plans, &options, &plans, &error), TN_OK);
    return plans;
}

/* The first and the last house on the plan have the ranks that they should have. */
static void check_ranks(check *c, const tn_tray *trays, uint32_t length, const mpz_t houses)
{
    tn_error error = {0};
    tn_tray found[LENGTH_MAX];
    uint32_t found_length;
    assert_int_equal(tn_houses_before(c->houses, trays, length, c->rank, &error), TN_OK);
    assert_int_equal(mpz_cmp(c->rank, c->all), 0);
    for (int last = 0; last < 2 && mpz_sgn(houses) > 0; last++) {
        mpz_set_ui(c->variant, 0);
        if (last)
            mpz_sub_ui(c->variant, houses, 1);
        mpz_add(c->rank, c->all, c->variant);
        assert_int_equal(tn_houses_find(c->houses, c->rank, found, &found_length, &error), TN_OK);
        assert_int_equal(mpz_cmp(c->rank, c->variant), 0);
        assert_int_equal(found_length, length);
        assert_memory_equal(found, trays, length * sizeof *trays);
    }
}

static void check_plan(check *c, const tn_tray *trays, uint32_t length, bool ranks)
{
    tn_house_counts counts;
    tn_error error = {0};
    tn_house_counts_init(&counts);
    assert_int_equal(tn_house_variants_count(c->variants, trays, length, &counts, &error), TN_OK);
    if (ranks)
        check_ranks(c, trays, length, counts.houses);
    mpz_add(c->all, c->all, counts.houses);
    mpz_add(c->lengths[length], c->lengths[length], counts.houses);
    mpz_add_ui(c->faced, c->faced, counts.faced);
    tn_house_counts_clear(&counts);
}

static void check_numbers(check *c)
{
    mpz_t count;
    mpz_init(count);
    for (uint32_t k = 0; k <= LENGTH_MAX; k++) {
        tn_houses_count(c->houses, k, count);
        assert_int_equal(mpz_cmp(count, c->lengths[k]), 0);
    }
    tn_houses_count(c->houses, TN_ALL_LENGTHS, count);
    assert_int_equal(mpz_cmp(count, c->all), 0);
    tn_houses_faced(c->houses, count);
    assert_int_equal(mpz_cmp(count, c->faced), 0);
    mpz_clear(count);
}

static void check_plans(check *c, uint32_t rank_every)
{
    tn_cursor *cursor;
    tn_error error = {0};
    const tn_tray *trays;
    uint32_t length, n = 0;
    tn_library_kept(c->plans, TN_ALL_LENGTHS, c->rank);
    assert_int_equal(tn_cursor_new(c->plans, c->variant, c->rank, &cursor, &error), TN_OK);
    while (tn_cursor_next(cursor, &trays, &length))
        check_plan(c, trays, length, n++ % rank_every == 0);
    tn_cursor_free(cursor);
}

/* ---- measures: the distribution against house by house */

typedef struct tally {
    const test_house *made;
    tn_house_rules *rules;
    tn_house_measured measure;
    mpq_t values[2000];
    uint64_t counts[2000];
    size_t count;
    uint64_t houses;
} tally;

static tn_status tally_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    tally *t = context;
    mpq_t value, cost;
    mpq_inits(value, cost, NULL);
    assert_int_equal(tn_house_rules_start(t->rules, house, error), TN_OK);
    assert_int_equal(tn_house_rules_measure(t->rules, t->measure, value, cost, error), TN_OK);
    assert_int_equal(mpq_sgn(cost), 0);
    size_t i = 0;
    while (i < t->count && !mpq_equal(t->values[i], value))
        i++;
    if (i == t->count) {
        assert_true(t->count < 2000);
        mpq_init(t->values[t->count++]);
        mpq_set(t->values[i], value);
        t->counts[i] = 0;
    }
    t->counts[i]++;
    *stop = ++t->houses == UINT64_MAX;
    mpq_clears(value, cost, NULL);
    return TN_OK;
}

static void compare_spread(const tally *t, const tn_distribution *d)
{
    mpq_t value;
    mpq_init(value);
    assert_int_equal(d->count, t->count);
    assert_int_equal(mpz_cmp_ui(d->all, t->houses), 0);
    for (size_t k = 0; k < d->count; k++) {
        size_t i = 0;
        tn_distribution_value(d, k, value);
        while (i < t->count && !mpq_equal(t->values[i], value))
            i++;
        assert_true(i < t->count);
        assert_int_equal(mpz_cmp_ui(d->plans[k], t->counts[i]), 0);
        assert_true(k == 0 || d->value[k - 1] < d->value[k]);
    }
    mpq_clear(value);
}

/* only: on one plan. */
static void check_measure(check *c, uint32_t measure, const tn_tray *only, uint32_t only_length)
{
    tally t = {.made = c->made, .measure = tn_house_measured_of(c->made->form.module, measure)};
    tn_house_weights *weights;
    tn_houses *houses;
    tn_distribution d;
    tn_cursor *cursor;
    tn_error error = {0};
    const tn_tray *trays;
    uint32_t length;
    mpz_t from;
    mpz_init(from);
    assert_int_equal(tn_house_rules_new(&c->made->form, 0, &t.rules, &error), TN_OK);
    tn_library_kept(c->plans, TN_ALL_LENGTHS, c->rank);
    assert_int_equal(tn_cursor_new(c->plans, from, c->rank, &cursor, &error), TN_OK);
    while (tn_cursor_next(cursor, &trays, &length))
        if (!only || (length == only_length && memcmp(trays, only, length * sizeof *trays) == 0))
            assert_int_equal(tn_house_variants_each(c->variants, trays, length, from, tally_house, &t, &error), TN_OK);
    tn_cursor_free(cursor);
    assert_int_equal(tn_house_weights_new(&c->made->form, t.measure, &weights, &error), TN_OK);
    tn_houses_what what = {only, only_length, weights};
    assert_int_equal(tn_houses_of(&c->made->form, c->record, c->plans, &what, 0, &houses, &error), TN_OK);
    tn_distribution_init(&d);
    assert_int_equal(tn_houses_spread(houses, &d, &error), TN_OK);
    compare_spread(&t, &d);
    tn_distribution_clear(&d);
    tn_houses_free(houses);
    tn_house_weights_free(weights);
    tn_house_rules_free(t.rules);
    while (t.count > 0)
        mpq_clear(t.values[--t.count]);
    mpz_clear(from);
}

static void check_measures(check *c)
{
    const tn_module *module = c->made->form.module;
    const tn_tray plan[2] = {0, 1};
    uint32_t measures = (uint32_t)module->HOUSE_MEASURE_count + (uint32_t)module->MEASURE_count;
    for (uint32_t i = 0; i < measures && mpz_cmp_ui(c->all, 20000) < 0; i++) {
        check_measure(c, i, NULL, 0);
        check_measure(c, i, plan, 2);
    }
}

/* Returns how many houses there are. */
static uint64_t check_library(const test_house *made, const tn_house_library_record *record, uint32_t rank_every)
{
    check c = {.made = made, .record = record, .plans = plans_of(made, record)};
    tn_error error = {0};
    for (uint32_t k = 0; k <= LENGTH_MAX; k++)
        mpz_init(c.lengths[k]);
    mpz_inits(c.all, c.faced, c.rank, c.variant, NULL);
    assert_int_equal(tn_house_variants_new(&made->form, record, 0, &c.variants, &error), TN_OK);
    tn_status status = tn_houses_new(&made->form, record, c.plans, 0, &c.houses, &error);
    if (status != TN_OK)
        fprintf(stderr, "%s\n", error.message);
    assert_int_equal(status, TN_OK);
    check_plans(&c, rank_every);
    check_numbers(&c);
    check_measures(&c);
    mpz_set(c.rank, c.all);
    assert_int_equal(tn_houses_find(c.houses, c.rank, NULL, &(uint32_t){0}, &error), TN_INVALID);
    assert_int_equal(error.code, E_NO_VARIANT);
    uint64_t houses = mpz_get_ui(c.all);
    for (uint32_t k = 0; k <= LENGTH_MAX; k++)
        mpz_clear(c.lengths[k]);
    mpz_clears(c.all, c.faced, c.rank, c.variant, NULL);
    tn_houses_free(c.houses);
    tn_house_variants_free(c.variants);
    tn_library_free(c.plans);
    return houses;
}

static void test_written(void **state)
{
    (void)state;
    test_house made;
    test_house_make(&made);
    assert_true(check_library(&made, made.all, 7) > 1000);
    assert_true(check_library(&made, made.some, 7) > 100);
    test_house_clear(&made);
}

/* ---- forms and clauses that are drawn */

typedef struct draws {
    uint64_t state;
    char text[8192];
    size_t size;
} draws;

static uint32_t draw(draws *d, uint32_t below)
{
    d->state = d->state * UINT64_C(6364136223846793005) + 1442695040888963407u;
    return (uint32_t)(d->state >> 33) % below;
}

static void put(draws *d, const char *piece)
{
    size_t size = strlen(piece);
    assert_true(d->size + size < sizeof d->text);
    memcpy(d->text + d->size, piece, size + 1);
    d->size += size;
}

#define ONE_OF(D, ...) ONE_OF_LIST(D, ((const char *const[]){__VA_ARGS__}))
#define ONE_OF_LIST(D, LIST) put(D, (LIST)[draw(D, sizeof(LIST) / sizeof *(LIST))])

static void put_cell(draws *d)
{
    ONE_OF(d, "cell(living)", "cell(bed)", "cell(stair)", "cell(seat)", "cell(void)", "cell(any)",
           "cell(bed or living)", "cell(body, loft)", "cell(not bed, ground)", "cell(area < 90sf)", "cell(8')",
           "cell(bed, 10')", "cell(bay)");
}

static void put_room(draws *d)
{
    put(d, "room(");
    ONE_OF(d, "bed", "living", "any", "not stair", "body", "seat");
    if (draw(d, 2))
        ONE_OF(d, ", glazing < 1:9", ", glazing >= 1:11", ", not by window", ", by window", ", by door",
               ", not by open", ", by wall", ", by floor");
    if (draw(d, 2))
        ONE_OF(d, ", area < 100sf", ", area >= 160sf", ", cells > 1", ", cells = 2", ", cells <= 1");
    put(d, ")");
}

static void put_by(draws *d)
{
    ONE_OF(d, "", "", " by open", " by door", " by stair", " by wall or door", " by floor");
    put(d, ")");
}

static void put_expression(draws *d, int depth);

static void put_simple(draws *d)
{
    switch (draw(d, 10)) {
    case 0:
        put_cell(d);
        return;
    case 1:
        put_room(d);
        return;
    case 2:
        put(d, "touch(");
        put_cell(d);
        put(d, ", ");
        put_cell(d);
        put_by(d);
        return;
    case 3:
    case 4:
        put(d, "apart(");
        put_cell(d);
        put(d, ", from ");
        put_cell(d);
        if (draw(d, 2)) {
            put(d, ", through ");
            put_cell(d);
        }
        put(d, ")");
        return;
    case 5:
        put(d, "quantity(");
        put_cell(d);
        ONE_OF(d, ", n > 1)", ", n = 1)", ", n in 1..3)", ", n mod 2 = 0)");
        return;
    case 6:
        put(d, "quantity(");
        put_room(d);
        ONE_OF(d, ", n > 1)", ", n = 1)", ", n < 2)", ", n = 0)");
        return;
    case 7:
        put(d, "sum(area of ");
        put_cell(d);
        ONE_OF(d, ", a < 200sf)", ", a >= 150sf)", ", a > 300sf)");
        return;
    case 8:
        ONE_OF(d, "section(body storeys 1)", "section(cladding board)", "section(body roof gable)");
        return;
    default:
        ONE_OF(d, "tray(8')", "tray(bay open)", "neighbour(tray(8'), tray(10'))", "neighbour(beginning, tray(10'))");
        return;
    }
}

static void put_row(draws *d)
{
    put(d, draw(d, 3) ? "neighbour(" : "symmetric neighbour(");
    put_cell(d);
    put(d, ", ");
    switch (draw(d, 4)) {
    case 0:
        put(d, "many(");
        put_cell(d);
        put(d, ")");
        break;
    case 1:
        put(d, "end");
        break;
    case 2:
        put(d, "touch(");
        put_cell(d);
        put(d, ", ");
        put_cell(d);
        put_by(d);
        break;
    default:
        put_cell(d);
    }
    put(d, ")");
}

static void put_expression(draws *d, int depth)
{
    uint32_t kind = depth > 0 ? draw(d, 7) : 6;
    if (kind == 0)
        put(d, "not (");
    if (kind < 3) {
        put(d, kind == 0 ? "" : "(");
        put_expression(d, depth - 1);
        if (kind > 0) {
            put(d, kind == 1 ? " and " : " or ");
            put_expression(d, depth - 1);
        }
        put(d, ")");
    } else if (kind == 3) {
        put_row(d);
    } else {
        put_simple(d);
    }
}

static void put_form(draws *d)
{
    put(d, "form huts of hut {\n  storey ground 9'\n  storey loft 8'\n  wall 8\"\n  partition 4\"\n  deck 10\"\n  roof "
           "8\"\n");
    ONE_OF(d, "  section body storeys = 1 | 2\n", "  section body storeys = 2 | 1\n",
           "  section bay storeys = 1\n  section body storeys = 1 | 2\n");
    put(d, "  section body roof = gable(9:12) | vault(3')\n  section cladding = shingle | board\n");
    ONE_OF(d, "", "  void cell(loft, 10')\n", "  void cell(body 12', loft)\n", "  no cell(bay, loft)\n");
    put(d, "  function living at cell(body, ground)\n  function bed at cell(body)\n");
    ONE_OF(d, "  function stair at cell(body)\n", "  function stair at cell(body, 8')\n");
    put(d, "  function seat at cell(bay)\n  opening door wide 2'8\" high 6'8\" clear 2' passage\n"
           "  opening window wide 3' high 4' sill 2'8\" glazed\n");
    ONE_OF(d, "", "  face cell(bed) along cell(bed) = open | wall\n",
           "  face cell(living) along cell(any) = party | door\n");
    ONE_OF(d, "  face cell(stair) under cell(stair) = stair\n", "  face cell(any) under cell(stair) = stair | floor\n",
           "");
    put(d, "  face cell(living) beside cell(living) = open | door\n");
    ONE_OF(d, "  face cell(seat) across cell(any) = open\n", "  face cell(seat) beside cell(any) = open | wall\n", "");
    put(d, "  face cell(any) beside cell(any) = door\n");
    ONE_OF(d, "  face cell(bed) outside = window | wall\n", "  face cell(bed) outside front = window | wall\n",
           "  face cell(any) outside left = wall | window\n");
    ONE_OF(d, "  face cell(seat) outside front = window | wall\n", "");
    ONE_OF(
        d,
        "  tile cot for bed { against wall or window wide 7'..12' item cot left 1'..right 1', back 0..6', up 0..2' }\n",
        "  tile rug for bed, living { item rug left 2'..right 2', back 1'..4' keep edge left 0..1' }\n"
        "  tile cot for bed { against wall item cot right 3'..right 0, back 0..6'6\", up 0..2' }\n",
        "");
    put(d, "}\n");
}

static void put_measures(draws *d)
{
    put(d, "measure first using huts = 3 * quantity(");
    put_cell(d);
    put(d, ") - 1/2 * quantity(");
    put_room(d);
    put(d, ") + 7\nmeasure second using huts = sum(area of ");
    put_cell(d);
    ONE_OF(d, ") + sum(width) * 1'", ") - 2 * sum(area of cell(bed))", ")");
    put(d, "\nmeasure third using huts = 10 * second / 1sf - first + 5 * quantity(tray(10')) + matches(");
    ONE_OF(d, "neighbour(tray(8'), tray(10'))", "tray(bay open)");
    put(d, ")\nmeasure fourth using hut = sum(width) + occurrences(tray(8')) * 1'\n");
}

static void write_random(draws *d)
{
    d->size = 0;
    put(d, "schema hut {\n  width role length = 8' | 10'\n  zone body role band = room(10', 12')\n"
           "  zone bay role band = empty role absent | open(4')\n}\n");
    put_form(d);
    put(d,
        "library rows using hut { trays 1..2 }\nlibrary all from rows in huts { }\nlibrary some from rows in huts {\n");
    for (uint32_t i = 1 + draw(d, 3); i > 0; i--) {
        put(d, draw(d, 2) ? "  require " : "  prune ");
        put_expression(d, 2);
        put(d, "\n");
    }
    put(d, "}\n");
    put_measures(d);
}

static void test_drawn(void **state)
{
    (void)state;
    draws d = {.state = 7};
    uint32_t with_houses = 0;
    for (int i = 0; i < 40; i++) {
        test_house made;
        write_random(&d);
        test_house_compile(&made, d.text);
        uint64_t all = check_library(&made, made.all, 50), some = check_library(&made, made.some, 50);
        assert_true(some <= all);
        with_houses += some > 0 && some < all;
        test_house_clear(&made);
    }
    assert_true(with_houses > 10);
}

static void test_limit(void **state)
{
    (void)state;
    test_house made;
    tn_houses *houses;
    tn_error error = {0};
    test_house_make(&made);
    tn_library *plans = plans_of(&made, made.some);
    assert_int_equal(tn_houses_new(&made.form, made.some, plans, 10, &houses, &error), TN_LIMIT);
    assert_int_equal(error.code, E_STRIP);
    assert_non_null(strstr(error.help, "` keeps most apart"));
    tn_library_free(plans);
    test_house_clear(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_written), cmocka_unit_test(test_drawn),
                                       cmocka_unit_test(test_limit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
