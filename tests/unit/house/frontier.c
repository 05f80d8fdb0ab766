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

#include "runtime/house/count/data.h"
#include "runtime/house/count/listing.h"
#include "runtime/house/rank/rank.h"
#include "tests/support/drawn_house.h"
#include "tests/support/share.h"
#include "tests/support/test_house.h"

enum { LENGTH_MAX = 3 };

typedef struct check {
    const test_house *made;
    const tn_house_library_record *record;
    tn_library *plans;
    tn_houses *houses;
    tn_house_listing *listing;
    tn_house_ranks *ranks;
    mpz_t lengths[LENGTH_MAX + 1], all, faced, rank, variant;
    tn_houses_projected with; /* plans, sections and functions that have a house, plan by plan */
    uint32_t checked;
} check;

static tn_library *plans_of(const test_house *made, const tn_house_library_record *record)
{
    tn_library *plans;
    tn_error error = {0};
    tn_library_options options = {0};
    assert_int_equal(tn_library_new(made->schema, record->plans, &options, &plans, &error), TN_OK);
    return plans;
}

static void check_same(const tn_house *one, const tn_house *other)
{
    assert_memory_equal(one->shapes, other->shapes, sizeof one->shapes);
    assert_int_equal(one->cell_count, other->cell_count);
    assert_int_equal(one->face_count, other->face_count);
    for (size_t i = 0; i < one->cell_count; i++) {
        assert_int_equal(one->cells[i].function, other->cells[i].function);
        assert_int_equal(one->cells[i].variant, other->cells[i].variant);
    }
    for (size_t i = 0; i < one->face_count; i++)
        assert_int_equal(one->faces[i].kind, other->faces[i].kind);
}

/* The house has the number among those on its plan. */
static void check_number(check *c, tn_plan_houses *plan, const tn_house *house, const mpz_t variant)
{
    tn_error error = {0};
    assert_int_equal(tn_plan_houses_number(plan, house, c->rank, &error), TN_OK);
    assert_int_equal(mpz_cmp(c->rank, variant), 0);
}

/* With something else in one face the library may not keep it: it has no number, or that which is found one by one. */
static void check_changed(check *c, tn_plan_houses *plan, tn_house *house, size_t at)
{
    uint32_t kinds[TN_FACE_KINDS_MAX], was = house->faces[at].kind;
    size_t count = tn_face_options(house, &house->faces[at], kinds);
    tn_error error = {0};
    mpz_t number;
    mpz_init(number);
    for (size_t i = 0; i < house->cell_count; i++)
        house->cells[i].variant = 0;
    house->faces[at].kind = kinds[count - 1] == was ? kinds[0] : kinds[count - 1];
    tn_status status = tn_house_listing_number(c->listing, house, number, &error);
    assert_int_equal(tn_plan_houses_number(plan, house, c->rank, &error), status);
    if (status == TN_OK)
        assert_int_equal(mpz_cmp(c->rank, number), 0);
    house->faces[at].kind = was;
    mpz_clear(number);
}

/* The house of a number on the plan is that which is found by going through them one by one. */
static void check_house(check *c, tn_plan_houses *plan, const tn_tray *trays, uint32_t length, const mpz_t variant)
{
    tn_house one, other;
    tn_error error = {0};
    assert_int_equal(tn_plan_houses_at(plan, variant, &one, &error), TN_OK);
    assert_int_equal(tn_house_listing_at(c->listing, trays, length, variant, &other, &error), TN_OK);
    check_same(&one, &other);
    check_number(c, plan, &one, variant);
    if (one.face_count > 0)
        check_changed(c, plan, &one, mpz_fdiv_ui(variant, one.face_count));
    tn_house_clear(&one);
    tn_house_clear(&other);
}

/* The houses from a number on come in the same order as when they are gone through. */
enum { LISTED = 30 };
typedef struct listed {
    tn_house houses[LISTED];
    size_t count, compared;
} listed;

static tn_status collect(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    listed *l = context;
    tn_status status = tn_house_copy(house, &l->houses[l->count++], error);
    *stop = l->count == LISTED;
    return status;
}

static tn_status compare_next(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    listed *l = context;
    (void)error;
    assert_true(l->compared < l->count);
    check_same(house, &l->houses[l->compared++]);
    *stop = l->compared == LISTED;
    return TN_OK;
}

static void check_order(check *c, tn_plan_houses *plan, const tn_tray *trays, uint32_t length, const mpz_t from)
{
    listed l = {.count = 0};
    tn_error error = {0};
    assert_int_equal(tn_house_listing_each(c->listing, trays, length, from, collect, &l, &error), TN_OK);
    assert_int_equal(tn_plan_houses_each(plan, from, compare_next, &l, &error), TN_OK);
    assert_int_equal(l.compared, l.count);
    for (size_t i = 0; i < l.count; i++)
        tn_house_clear(&l.houses[i]);
}

/* How many there are, also without tiles, if these are few. */
static void check_faced(tn_plan_houses *plan, const tn_house_counts *counts)
{
    uint64_t faced;
    bool known;
    tn_error error = {0};
    mpz_t houses;
    mpz_init(houses);
    assert_int_equal(tn_plan_houses_count(plan, houses, &error), TN_OK);
    assert_int_equal(mpz_cmp(houses, counts->houses), 0);
    assert_int_equal(tn_plan_houses_faced(plan, 500, &faced, &known, &error), TN_OK);
    assert_int_equal(known, counts->faced <= 500);
    assert_true(!known || faced == counts->faced);
    mpz_clear(houses);
}

/* Houses on the plan from the first to the last; there is none behind it. */
static void check_houses(check *c, const tn_tray *trays, uint32_t length, const tn_house_counts *counts)
{
    mpz_srcptr houses = counts->houses;
    enum { PARTS = 3 };
    tn_house house;
    tn_error error = {0};
    tn_plan_houses *plan;
    assert_int_equal(tn_house_ranks_plan(c->ranks, trays, length, &plan, &error), TN_OK);
    for (unsigned long part = 0; part <= PARTS && mpz_sgn(houses) > 0; part++) {
        mpz_sub_ui(c->variant, houses, 1);
        mpz_mul_ui(c->variant, c->variant, part);
        mpz_fdiv_q_ui(c->variant, c->variant, PARTS);
        check_house(c, plan, trays, length, c->variant);
        if (part % 2 == 0)
            check_order(c, plan, trays, length, c->variant);
    }
    check_faced(plan, counts);
    assert_int_equal(tn_plan_houses_at(plan, houses, &house, &error), TN_INVALID);
    assert_int_equal(error.code, E_NO_VARIANT);
    tn_house_clear(&house);
}

/* The house, whose plan has been found, has the same plan and number among plans that are kept, twice. */
static void check_kept(check *c, const tn_tray *trays, uint32_t length)
{
    tn_error error = {0};
    tn_tray found[LENGTH_MAX];
    uint32_t found_length;
    for (int again = 0; again < 2; again++) {
        mpz_add(c->rank, c->all, c->variant);
        assert_int_equal(tn_house_ranks_find(c->ranks, c->rank, found, &found_length, &error), TN_OK);
        assert_int_equal(mpz_cmp(c->rank, c->variant), 0);
        assert_int_equal(found_length, length);
        assert_memory_equal(found, trays, length * sizeof *trays);
    }
}

/* The first and the last house on the plan have the ranks that they should have. */
static void check_ranks(check *c, const tn_tray *trays, uint32_t length, const mpz_t houses)
{
    tn_error error = {0};
    tn_tray found[LENGTH_MAX];
    uint32_t found_length;
    mpz_t on_plan;
    assert_int_equal(tn_houses_before(c->houses, trays, length, c->rank, &error), TN_OK);
    assert_int_equal(mpz_cmp(c->rank, c->all), 0);
    for (int last = 0; last < 2 && mpz_sgn(houses) > 0; last++) {
        mpz_set_ui(c->variant, 0);
        if (last)
            mpz_sub_ui(c->variant, houses, 1);
        mpz_add(c->rank, c->all, c->variant);
        mpz_init(on_plan);
        assert_int_equal(tn_houses_find(c->houses, c->rank, found, &found_length, on_plan, &error), TN_OK);
        assert_int_equal(mpz_cmp(on_plan, houses), 0);
        assert_int_equal(mpz_cmp(c->rank, c->variant), 0);
        assert_int_equal(found_length, length);
        assert_memory_equal(found, trays, length * sizeof *trays);
        mpz_clear(on_plan);
        check_kept(c, trays, length);
    }
}

/* The sections of a plan, and all that they have. */
typedef struct section_sum {
    check *c;
    tn_house_counts counts;
} section_sum;

static tn_status add_section(void *context, const uint32_t *shapes, const tn_house_counts *counts, tn_error *error)
{
    section_sum *sum = context;
    check *c = sum->c;
    (void)shapes;
    (void)error;
    mpz_add_ui(c->with.sections, c->with.sections, 1);
    mpz_add_ui(c->with.functions, c->with.functions, counts->zoned);
    sum->counts.faced += counts->faced;
    mpz_add(sum->counts.houses, sum->counts.houses, counts->houses);
    return TN_OK;
}

static void check_plan(check *c, const tn_tray *trays, uint32_t length, bool ranks)
{
    c->houses->many_slices = ++c->checked % 2 == 0 ? UINT32_MAX : 0; /* by whole steps, and by stages */
    section_sum sum = {.c = c};
    tn_error error = {0};
    tn_house_counts_init(&sum.counts);
    assert_int_equal(tn_house_listing_sections(c->listing, trays, length, add_section, &sum, &error), TN_OK);
    if (ranks) {
        check_ranks(c, trays, length, sum.counts.houses);
        check_houses(c, trays, length, &sum.counts);
    }
    mpz_add(c->all, c->all, sum.counts.houses);
    mpz_add(c->lengths[length], c->lengths[length], sum.counts.houses);
    mpz_add_ui(c->faced, c->faced, sum.counts.faced);
    mpz_add_ui(c->with.plans, c->with.plans, mpz_sgn(sum.counts.houses) > 0);
    tn_house_counts_clear(&sum.counts);
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
    if (tn_houses_faced_known(c->houses))
        assert_int_equal(mpz_cmp(count, c->faced), 0);
    mpz_clear(count);
}

/* The automaton of houses, projected, counts what has been met plan by plan. */
static void check_projected(const check *c, const tn_houses_projected *projected)
{
    assert_int_equal(mpz_cmp(projected->plans, c->with.plans), 0);
    assert_int_equal(mpz_cmp(projected->sections, c->with.sections), 0);
    assert_int_equal(mpz_cmp(projected->functions, c->with.functions), 0);
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
    tn_worth worth;
    mpq_t value, cost;
    mpq_inits(value, cost, NULL);
    assert_int_equal(tn_house_rules_start(t->rules, house, error), TN_OK);
    assert_int_equal(tn_house_rules_measure(t->rules, t->measure, value, cost, &worth, error), TN_OK);
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
            assert_int_equal(tn_house_listing_each(c->listing, trays, length, from, tally_house, &t, &error), TN_OK);
    tn_cursor_free(cursor);
    assert_int_equal(tn_house_weights_new(&c->made->form, t.measure, &weights, &error), TN_OK);
    tn_house_measures measures = {.count = 1, .of = {weights}};
    tn_houses_what what = {.only = only, .length = only_length, .measures = &measures};
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

/* Those of costs are held against single houses in best.c. */
static bool adds_costs(const tn_module *module, uint32_t measure)
{
    tn_house_measured of = tn_house_measured_of(module, measure);
    bool costs = false;
    for (uint32_t i = 0; i < of.term_count; i++)
        costs = costs || module->HOUSE_TERM_records[of.term_first + i].kind == TN_HOUSE_COST;
    return costs;
}

static void check_measures(check *c)
{
    const tn_module *module = c->made->form.module;
    const tn_tray plan[2] = {0, 1};
    uint32_t measures = (uint32_t)module->HOUSE_MEASURE_count + (uint32_t)module->MEASURE_count;
    for (uint32_t i = 0; i < measures && mpz_cmp_ui(c->all, 20000) < 0; i++) {
        if (adds_costs(module, i))
            continue;
        check_measure(c, i, NULL, 0);
        check_measure(c, i, plan, 2);
    }
}

/* One plan in so many is looked at more closely: in fewer where the share is small. */
static uint32_t every(uint32_t plans)
{
    return plans * (uint32_t)(4 / test_share(4));
}

/* Ranks then go the steps that counting went once more. */
static void forget_steps(tn_houses *houses)
{
    for (size_t i = 0; i < houses->kind_count; i++)
        for (uint32_t k = 0; k <= houses->high * tn_houses_stages(houses, &houses->kinds[i]); k++)
            tn_houses_forget_steps(&houses->kinds[i], k);
}

/* Returns how many houses there are. */
static uint64_t check_library(const test_house *made, const tn_house_library_record *record, uint32_t rank_every)
{
    check c = {.made = made, .record = record, .plans = plans_of(made, record)};
    tn_error error = {0};
    for (uint32_t k = 0; k <= LENGTH_MAX; k++)
        mpz_init(c.lengths[k]);
    mpz_inits(c.all, c.faced, c.rank, c.variant, NULL);
    assert_int_equal(tn_house_listing_new(&made->form, record, 0, &c.listing, &error), TN_OK);
    tn_status status = tn_houses_new(&made->form, record, c.plans, 0, &c.houses, &error);
    if (status != TN_OK)
        fprintf(stderr, "%s\n", error.message);
    assert_int_equal(status, TN_OK);
    assert_int_equal(tn_houses_recount(c.houses, 2000, &error), TN_OK);
    assert_int_equal(tn_house_ranks_new(c.houses, &c.ranks, &error), TN_OK);
    static int libraries;
    if (++libraries % 2 == 0)
        forget_steps(c.houses);
    tn_houses_projected projected;
    tn_houses_projected_init(&projected);
    tn_houses_projected_init(&c.with);
    assert_int_equal(tn_houses_project(c.houses, &projected, &error), TN_OK);
    check_plans(&c, rank_every);
    check_projected(&c, &projected);
    tn_houses_projected_clear(&projected);
    tn_houses_projected_clear(&c.with);
    check_numbers(&c);
    check_measures(&c);
    mpz_set(c.rank, c.all);
    assert_int_equal(tn_house_ranks_find(c.ranks, c.rank, NULL, &(uint32_t){0}, &error), TN_INVALID);
    assert_int_equal(error.code, E_NO_VARIANT);
    uint64_t houses = mpz_get_ui(c.all);
    for (uint32_t k = 0; k <= LENGTH_MAX; k++)
        mpz_clear(c.lengths[k]);
    mpz_clears(c.all, c.faced, c.rank, c.variant, NULL);
    tn_house_ranks_free(c.ranks);
    tn_houses_free(c.houses);
    tn_house_listing_free(c.listing);
    tn_library_free(c.plans);
    return houses;
}

static void test_written(void **state)
{
    (void)state;
    test_house made;
    test_house_make(&made);
    assert_true(check_library(&made, made.all, every(7)) > 1000);
    assert_true(check_library(&made, made.some, every(7)) > 100);
    test_house_clear(&made);
}

/* ---- forms and clauses that are drawn */

static void test_drawn(void **state)
{
    (void)state;
    drawn_house d = {.state = 7};
    uint32_t with_houses = 0;
    for (int i = 0; i < test_share(24); i++) {
        test_house made;
        drawn_house_write(&d);
        test_house_compile(&made, d.text);
        uint64_t all = check_library(&made, made.all, 50), some = check_library(&made, made.some, 50);
        assert_true(some <= all);
        with_houses += some > 0 && some < all;
        test_house_clear(&made);
    }
    assert_true(with_houses >= (uint32_t)test_share(6));
}

/* ---- clauses that compare measures: the interpreter says of each house of `all` whether `some` has it */

typedef struct asking {
    const tn_house_library_record *record;
    tn_house_rules *rules;
    uint64_t kept;
} asking;

static tn_status ask_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    asking *a = context;
    bool kept = false;
    *stop = false;
    assert_int_equal(tn_house_rules_start(a->rules, house, error), TN_OK);
    assert_int_equal(tn_house_rules_keep(a->rules, a->record, &kept, error), TN_OK);
    a->kept += kept;
    return TN_OK;
}

static uint64_t kept_one_by_one(const test_house *made)
{
    asking a = {.record = made->some};
    tn_error error = {0};
    tn_library *plans = plans_of(made, made->all);
    tn_house_listing *listing;
    tn_cursor *cursor;
    const tn_tray *trays;
    uint32_t length;
    mpz_t from, to;
    mpz_inits(from, to, NULL);
    tn_library_kept(plans, TN_ALL_LENGTHS, to);
    assert_int_equal(tn_house_rules_new(&made->form, 0, &a.rules, &error), TN_OK);
    assert_int_equal(tn_house_listing_new(&made->form, made->all, 0, &listing, &error), TN_OK);
    assert_int_equal(tn_cursor_new(plans, from, to, &cursor, &error), TN_OK);
    while (tn_cursor_next(cursor, &trays, &length))
        assert_int_equal(tn_house_listing_each(listing, trays, length, from, ask_house, &a, &error), TN_OK);
    tn_cursor_free(cursor);
    tn_house_listing_free(listing);
    tn_house_rules_free(a.rules);
    tn_library_free(plans);
    mpz_clears(from, to, NULL);
    return a.kept;
}

/* Costs add up, so that they are counted? */
static bool adds_up(const test_house *made)
{
    tn_library *plans = plans_of(made, made->some);
    tn_houses *houses;
    tn_error error = {0};
    tn_status status = tn_houses_new(&made->form, made->some, plans, 0, &houses, &error);
    assert_true(status == TN_OK || error.code == E_COST_OF_ALL);
    tn_houses_free(houses);
    tn_library_free(plans);
    return status == TN_OK;
}

static void check_compared(bool priced, int draws, uint32_t wanted)
{
    drawn_house d = {.state = 3, .priced = priced, .compares = true};
    uint32_t with_houses = 0;
    for (int i = 0; i < draws; i++) {
        test_house made;
        drawn_house_write(&d);
        test_house_compile(&made, d.text);
        uint64_t kept = kept_one_by_one(&made);
        if (adds_up(&made)) {
            assert_int_equal(check_library(&made, made.some, every(3)), kept);
            with_houses += kept > 0;
        }
        test_house_clear(&made);
    }
    assert_true(draws < 4 || with_houses > wanted); /* few may have none */
}

static void test_compared(void **state)
{
    (void)state;
    check_compared(false, test_share(8), 0);
}

static void test_compared_costs(void **state)
{
    (void)state;
    check_compared(true, test_share(8), 0);
}

/* Where in the row rooms and walks are: such as two halves of a room that meet in its last tray. */
static void test_placed(void **state)
{
    (void)state;
    static const char form[] =
        "schema hut {\n  width role length = 8'\n  zone body role band = room(10')\n  zone bay role band = empty role "
        "absent | open(6')\n}\nform huts of hut {\n  storey ground 9'\n  wall 8\"\n  partition 4\"\n  floor 10\"\n"
        "  roof 8\"\n  function bed at cell(any)\n  function seat at cell(bay)\n"
        "  face cell(bed) beside cell(bed) = open | wall\n  face cell(seat) across cell(any) = open | wall\n}\n"
        "library rows using hut { trays 1..3 }\nlibrary all from rows in huts { }\n"
        "library some from rows in huts { prune %s }\n";
    static const char *const clauses[] = {"neighbour(room(bed, cells > 2), any)",
                                          "symmetric neighbour(beginning, room(bed, cells = 2))",
                                          "many(quantity(room(bed), n = 1))",
                                          "quantity(room(bed) and not room(seat), n = 1)",
                                          "not neighbour(room(seat), room(bed), end)",
                                          "neighbour(quantity(room(bed, cells < 3), n = 2), room(bed))",
                                          "neighbour(apart(cell(seat), from cell(bed), by open), tray(bay open))"};
    for (size_t i = 0; i < sizeof clauses / sizeof *clauses; i++) {
        char text[2000];
        test_house made;
        snprintf(text, sizeof text, form, clauses[i]);
        test_house_compile(&made, text);
        uint64_t kept = kept_one_by_one(&made);
        assert_true(kept > 0);
        assert_int_equal(check_library(&made, made.some, 1), kept);
        assert_true(kept < check_library(&made, made.all, 1));
        test_house_clear(&made);
    }
}

/* More of them at once than are told apart: said with the clause. */
static void test_placed_limit(void **state)
{
    (void)state;
    char text[4000];
    size_t size = (size_t)snprintf(text, sizeof text, "schema hut {\n  width role length = 8'\n");
    for (int z = 0; z < 6; z++)
        size += (size_t)snprintf(text + size, sizeof text - size,
                                 "  zone part%d role band = empty role absent | room(8')\n", z);
    snprintf(text + size, sizeof text - size,
             "}\nform huts of hut {\n  storey ground 9'\n  wall 8\"\n  partition 4\"\n  floor 10\"\n  roof 8\"\n"
             "  function bed at cell(any)\n  face cell(bed) along cell(bed) = open\n}\n"
             "library rows using hut { trays 6 prune neighbour(tray(part0 room), tray(part0 empty)) }\n"
             "library all from rows in huts { }\n"
             "library some from rows in huts { prune neighbour(beginning, room(bed)) }\n");
    test_house made;
    tn_houses *houses;
    tn_error error = {0};
    test_house_compile(&made, text);
    tn_library *plans = plans_of(&made, made.some);
    assert_int_equal(tn_houses_new(&made.form, made.some, plans, 0, &houses, &error), TN_LIMIT);
    assert_int_equal(error.code, E_FRONTIER);
    assert_non_null(strstr(error.message, "prune@21` asks where more rooms or walks are"));
    tn_library_free(plans);
    test_house_clear(&made);
}

/* The same of forms and clauses that are drawn. */
static void test_places(void **state)
{
    (void)state;
    static const uint64_t draws[] = {0, 5, 18, 1017};
    uint32_t with_houses = 0;
    for (int i = 0; i < test_share(4); i++) {
        test_house made;
        drawn_house d = {.state = draws[i], .places = true};
        drawn_house_write(&d);
        test_house_compile(&made, d.text);
        uint64_t kept = kept_one_by_one(&made);
        assert_int_equal(check_library(&made, made.some, 200), kept);
        with_houses += kept > 0;
        test_house_clear(&made);
    }
    assert_true(with_houses > 0);
}

/* Cells that no passage leaves, beside others of their tray: what can never reach its goal is in a slice whose other
 * cells have passages across interfaces. */
typedef struct walled {
    char text[2048];
} walled;

static walled walled_text(const char *clause)
{
    walled made;
    snprintf(made.text, sizeof made.text,
             "schema hut {\n  width role length = 8'\n  zone rear role band = room(6') role solid | none role absent\n"
             "  zone body role band = hall(10') role void | room(8') role solid\n}\nform huts of hut {\n"
             "  storey ground 9'\n  wall 8\"\n  partition 4\"\n  floor 10\"\n  roof 8\"\n"
             "  function living at cell(rear room) or cell(body room)\n  function store at cell(body room)\n"
             "  opening door wide 2'8\" high 6'8\" passage\n  face cell(store) beside cell(any) = wall\n"
             "  face cell(any) beside cell(any) = door\n}\nlibrary rows using hut { trays 1..3 }\n"
             "library all from rows in huts { }\nlibrary some from rows in huts {\n  %s\n}\n"
             "measure cells using huts = quantity(cell(any))\n",
             clause);
    return made;
}

static void check_walled(const char *clause)
{
    test_house made;
    test_house_compile(&made, walled_text(clause).text);
    uint64_t kept = kept_one_by_one(&made);
    assert_true(kept > 0);
    assert_int_equal(check_library(&made, made.some, 50), kept);
    test_house_clear(&made);
}

/* The example that the head of frontier.h counts by hand: so many houses, by three states. */
static void test_by_hand(void **state)
{
    (void)state;
    static const char text[] =
        "schema row {\n  bay role length = 3m\n  zone house = room(4m)\n}\nform two of row {\n"
        "  storey floor 3m\n  wall 300mm\n  partition 100mm\n  floor 300mm\n  roof 200mm\n"
        "  function living at cell(house)\n  function store at cell(house)\n"
        "  opening door wide 1m high 2m passage\n  face cell(any) beside cell(any) = door | wall\n}\n"
        "library rows using row { trays 1..3 }\nlibrary all from rows in two { }\nlibrary some from rows in two {\n"
        "  prune apart(cell(store), from cell(living), through cell(any), by door)\n}\n";
    static const unsigned long by_hand[] = {1, 4, 14};
    test_house made;
    tn_houses *houses;
    tn_error error = {0};
    mpz_t count;
    mpz_init(count);
    test_house_compile(&made, text);
    tn_library *plans = plans_of(&made, made.some);
    assert_int_equal(tn_houses_new(&made.form, made.some, plans, 0, &houses, &error), TN_OK);
    for (uint32_t length = 1; length <= 3; length++) {
        tn_houses_count(houses, length, count);
        assert_int_equal(mpz_get_ui(count), by_hand[length - 1]);
    }
    assert_int_equal(houses->kinds[0].frontier->states.count, 3);
    tn_houses_free(houses);
    tn_library_free(plans);
    test_house_clear(&made);
    mpz_clear(count);
}

/* A wrong count is noticed where houses are counted once more. */
static void test_recount(void **state)
{
    (void)state;
    test_house made;
    tn_error error = {0};
    tn_houses *houses;
    test_house_compile(&made, walled_text("prune apart(cell(store), from cell(living))").text);
    tn_library *plans = plans_of(&made, made.some);
    assert_int_equal(tn_houses_new(&made.form, made.some, plans, 0, &houses, &error), TN_OK);
    assert_int_equal(tn_houses_recount(houses, 100000, &error), TN_OK);
    mpz_add_ui(houses->kinds[0].houses[1], houses->kinds[0].houses[1], 1);
    assert_int_equal(tn_houses_recount(houses, 100000, &error), TN_INTERNAL);
    assert_int_equal(tn_houses_recount(houses, 10, &error), TN_OK); /* more than are gone through */
    tn_houses_free(houses);
    tn_library_free(plans);
    test_house_clear(&made);
}

static void test_walled(void **state)
{
    (void)state;
    check_walled("prune apart(cell(store), from cell(living))");
    check_walled("prune apart(cell(living), from cell(store))");
    check_walled("require apart(cell(store), from cell(living))");
    check_walled("prune apart(cell(store), from cell(living), through cell(living))");
    check_walled("require apart(cell(living, body), from cell(living, rear)) and not cell(store, 8')");
}

/* Cells that meet across an interface, where the clause may be read from either end of the row. */
static void test_mirror(void **state)
{
    (void)state;
    static const char text[] =
        "schema hut {\n  width role length = 8' | 10'\n  zone body role band = room(10')\n}\nform huts of hut {\n"
        "  storey ground 9'\n  wall 8\"\n  partition 4\"\n  floor 10\"\n  roof 8\"\n"
        "  function living at cell(body)\n  function bed at cell(body)\n"
        "  opening door wide 2'8\" high 6'8\" passage\n  face cell(any) beside cell(any) = door | wall\n}\n"
        "library rows using hut { trays 1..3 }\nlibrary all from rows in huts { }\nlibrary some from rows in huts {\n"
        "  require symmetric neighbour(touch(cell(bed), cell(living) by door), tray(8'))\n}\n";
    test_house made;
    test_house_compile(&made, text);
    uint64_t kept = kept_one_by_one(&made);
    assert_true(kept > 0);
    assert_int_equal(check_library(&made, made.some, 1), kept);
    test_house_clear(&made);
}

/* Both limits are met, of states and of what is between trays, before the houses are counted. */
static void test_limit(void **state)
{
    (void)state;
    test_house made;
    tn_houses *houses;
    tn_error error = {0};
    uint32_t states = 0, between = 0;
    test_house_make(&made);
    tn_library *plans = plans_of(&made, made.some);
    for (uint32_t most = 1; tn_houses_new(&made.form, made.some, plans, most, &houses, &error) != TN_OK; most++) {
        assert_int_equal(error.status, TN_LIMIT);
        assert_int_equal(error.code, E_FRONTIER);
        assert_non_null(strstr(error.help, "(--plan), or allow more (--max-states N)"));
        states += strstr(error.message, " states") != NULL;
        between += strstr(error.message, " choices of what is between two trays") != NULL;
    }
    assert_true(states > 0);
    assert_true(between > 0);
    tn_houses_free(houses);
    tn_library_free(plans);
    test_house_clear(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_written),        cmocka_unit_test(test_drawn),  cmocka_unit_test(test_compared),
        cmocka_unit_test(test_compared_costs), cmocka_unit_test(test_placed), cmocka_unit_test(test_placed_limit),
        cmocka_unit_test(test_places),         cmocka_unit_test(test_walled), cmocka_unit_test(test_recount),
        cmocka_unit_test(test_mirror),         cmocka_unit_test(test_limit),  cmocka_unit_test(test_by_hand)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
