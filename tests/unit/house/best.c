/* The best houses by measures, their fronts, and those that complete open plans, against all houses listed. Of forms,
 * clauses and measures that are drawn. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/house/count/houses.h"
#include "runtime/house/rank/rank.h"
#include "runtime/house/schedule/cost.h"
#include "tests/support/drawn_house.h"
#include "tests/support/share.h"
#include "tests/support/test_house.h"

enum { HOUSES_MAX = 20000, MEASURES = 2, WANTED = 7, LENGTH_MAX = 3, PLACES = 3, ALIKE_MOST = 500 };

typedef struct listed {
    mpq_t values[MEASURES]; /* with the sign that makes less better */
    char *line;
    tn_tray trays[LENGTH_MAX];
    size_t length;
} listed;

typedef struct check {
    const test_house *made;
    const tn_house_library_record *record;
    tn_library *plans;
    tn_house_listing *variants;
    tn_house_rules *rules;
    tn_house_weights *weights[MEASURES];
    tn_house_measures measures;
    listed houses[HOUSES_MAX], *order[HOUSES_MAX];
    size_t count, given, most;
} check;

static char *line_of(const tn_house *house)
{
    tn_buffer line = {0};
    tn_error error = {0};
    assert_int_equal(tn_house_write(house, &line, &error), TN_OK);
    return line.data;
}

/* cost := what a house costs, from its solids. */
static void find_cost(const tn_house *house, mpq_t cost)
{
    tn_solids solids;
    tn_costs costs;
    tn_error error = {0};
    assert_int_equal(tn_house_solids(house, &solids, &error), TN_OK);
    assert_int_equal(tn_house_costs(house, &solids, &costs, &error), TN_OK);
    mpq_set(cost, costs.exact);
    tn_costs_clear(&costs);
    tn_solids_clear(&solids);
}

static tn_status list_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    check *c = context;
    if (c->count == c->most) {
        *stop = true;
        return TN_OK;
    }
    listed *one = &c->houses[c->count++];
    tn_worth worth;
    mpq_t cost, whole;
    mpq_inits(cost, whole, NULL);
    if (tn_form_has_costs(house->form))
        find_cost(house, whole);
    one->line = line_of(house);
    one->length = house->length;
    memcpy(one->trays, house->trays, house->length * sizeof *house->trays);
    assert_int_equal(tn_house_rules_start(c->rules, house, error), TN_OK);
    for (uint32_t k = 0; k < MEASURES; k++) {
        mpq_init(one->values[k]);
        assert_int_equal(tn_house_rules_measure(c->rules, c->measures.of[k]->of, one->values[k], cost, &worth, error), TN_OK);
        mpq_mul(cost, cost, whole);
        mpq_add(one->values[k], one->values[k], cost);
        if (c->measures.most[k])
            mpq_neg(one->values[k], one->values[k]);
    }
    mpq_clears(cost, whole, NULL);
    return TN_OK;
}

static void list_houses(check *c)
{
    tn_cursor *cursor;
    tn_error error = {0};
    const tn_tray *trays;
    uint32_t length;
    mpz_t from, to;
    mpz_inits(from, to, NULL);
    tn_library_kept(c->plans, TN_ALL_LENGTHS, to);
    assert_int_equal(tn_cursor_new(c->plans, from, to, &cursor, &error), TN_OK);
    while (c->count < c->most && tn_cursor_next(cursor, &trays, &length))
        assert_int_equal(tn_house_listing_each(c->variants, trays, length, from, list_house, c, &error), TN_OK);
    tn_cursor_free(cursor);
    mpz_clears(from, to, NULL);
}

static int compare_values(const listed *a, const listed *b)
{
    int order = mpq_cmp(a->values[0], b->values[0]);
    return order != 0 ? order : mpq_cmp(a->values[1], b->values[1]);
}

static int compare_listed(const void *left, const void *right)
{
    const listed *a = *(listed *const *)left, *b = *(listed *const *)right;
    int order = compare_values(a, b);
    return order != 0 ? order : (a > b) - (a < b);
}

static bool is_bettered(const check *c, const listed *one)
{
    for (size_t i = 0; i < c->count; i++) {
        int first = mpq_cmp(c->houses[i].values[0], one->values[0]);
        int second = mpq_cmp(c->houses[i].values[1], one->values[1]);
        if (first <= 0 && second <= 0 && (first < 0 || second < 0))
            return true;
    }
    return false;
}

/* The next houses of the order are given, one by one. */
static tn_status expect_next(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    check *c = context;
    char *line = line_of(house);
    (void)error;
    assert_true(c->given < c->count);
    assert_string_equal(line, c->order[c->given]->line);
    free(line);
    *stop = ++c->given == WANTED;
    return TN_OK;
}

static size_t same_from(const check *c, size_t at)
{
    size_t end = at;
    while (end < c->count && compare_values(c->order[at], c->order[end]) == 0)
        end++;
    return end - at;
}

/* How much of the line houses have in common that are so alike. */
static size_t common_part(const char *line, tn_house_alike alike)
{
    const char *at = line;
    for (int part = 0; part <= (int)alike && at; part++) {
        at = strchr(at, ';');
        at = at ? at + 1 : NULL;
    }
    return at ? (size_t)(at - line) : strlen(line);
}

/* The first houses of a point of those that are alike, in the order. */
typedef struct alike_houses {
    check *c;
    size_t from, at, end; /* in the order: the point's, and how far they have come */
    tn_house_alike alike;
} alike_houses;

/* Is the house the first of those that are as alike? */
static bool is_first(const check *c, size_t from, size_t at, tn_house_alike alike)
{
    const char *line = c->order[at]->line;
    size_t size = common_part(line, alike);
    for (size_t i = from; i < at; i++)
        if (common_part(c->order[i]->line, alike) == size && memcmp(c->order[i]->line, line, size) == 0)
            return false;
    return true;
}

static tn_status expect_unlike(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    alike_houses *a = context;
    char *line = line_of(house);
    (void)stop;
    (void)error;
    while (a->at < a->end && !is_first(a->c, a->from, a->at, a->alike))
        a->at++;
    assert_true(a->at < a->end);
    assert_string_equal(line, a->c->order[a->at++]->line);
    free(line);
    return TN_OK;
}

static void check_alike(check *c, tn_houses *houses, size_t point, size_t from)
{
    tn_error error = {0};
    for (int alike = TN_ALIKE_PLAN; alike <= TN_ALIKE_NOTHING; alike++) {
        alike_houses a = {c, from, from, from + same_from(c, from), (tn_house_alike)alike};
        assert_int_equal(tn_houses_point_each(houses, point, a.alike, expect_unlike, &a, &error), TN_OK);
        while (a.at < a.end)
            assert_false(is_first(c, from, a.at++, a.alike));
    }
}

static void check_least(check *c, tn_houses *houses)
{
    tn_error error = {0};
    size_t at = 0;
    int64_t values[TN_WEIGHED_MAX];
    mpz_t count;
    mpz_init(count);
    for (size_t i = 0; i < tn_houses_points(houses); i++) {
        tn_houses_point(houses, i, values, count);
        assert_true(at < c->count && at < WANTED);
        assert_int_equal(mpz_cmp_ui(count, same_from(c, at)), 0);
        if (same_from(c, at) < ALIKE_MOST)
            check_alike(c, houses, i, at);
        at += same_from(c, at);
        if (c->given < WANTED)
            assert_int_equal(tn_houses_point_each(houses, i, TN_ALIKE_NOTHING, expect_next, c, &error), TN_OK);
    }
    assert_int_equal(c->given, c->count < WANTED ? c->count : WANTED);
    mpz_clear(count);
}

/* The first house of a point. */
static tn_status expect_first(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    (void)error;
    *stop = true;
    char *line = line_of(house);
    assert_string_equal(line, *(char *const *)context);
    free(line);
    return TN_OK;
}

static void check_front(check *c, tn_houses *houses)
{
    tn_error error = {0};
    int64_t values[TN_WEIGHED_MAX];
    size_t point = 0;
    mpz_t count;
    mpz_init(count);
    for (size_t i = 0; i < c->count; i += same_from(c, i)) {
        if (is_bettered(c, c->order[i]))
            continue;
        assert_true(point < tn_houses_points(houses));
        tn_houses_point(houses, point, values, count);
        assert_int_equal(mpz_cmp_ui(count, same_from(c, i)), 0);
        assert_int_equal(
            tn_houses_point_each(houses, point, TN_ALIKE_NOTHING, expect_first, &c->order[i]->line, &error), TN_OK);
        point++;
    }
    assert_int_equal(point, tn_houses_points(houses));
    mpz_clear(count);
}

static void check_aim(check *c, tn_houses_aim aim)
{
    tn_houses *houses;
    tn_error error = {0};
    const tn_houses_what what = {.measures = &c->measures, .aim = aim, .wanted = WANTED};
    assert_int_equal(tn_houses_of(&c->made->form, c->record, c->plans, &what, 0, &houses, &error), TN_OK);
    c->given = 0;
    (aim == TN_HOUSES_LEAST ? check_least : check_front)(c, houses);
    tn_houses_free(houses);
}

/* ---- open plans */

typedef struct open_pattern {
    tn_open_tray places[PLACES];
    bool fits[PLACES][64]; /* of each place, the trays of the schema */
    size_t count;
} open_pattern;

/* Some trays, any tray, or a gap. */
static void draw_pattern(open_pattern *p, uint32_t trays, uint64_t *state)
{
    assert_true(trays <= 64);
    *p = (open_pattern){0};
    *state = *state * UINT64_C(6364136223846793005) + 1442695040888963407u;
    uint64_t bits = *state >> 20;
    p->count = 1 + bits % PLACES;
    for (size_t i = 0; i < p->count; i++) {
        uint64_t kind = bits >> (4 + 2 * i) & 3;
        p->places[i].gap = kind == 0;
        for (uint32_t t = 0; t < trays; t++)
            p->fits[i][t] = bits >> (12 + (t + 3 * i) % 24) & 1;
        p->places[i].fits = kind == 1 ? NULL : p->fits[i];
    }
}

/* The leftmost places of the written trays, from place `at` and tray `from` on; false where the plan does not fit. */
static bool put_places(const open_pattern *p, size_t at, const listed *one, size_t from, size_t *where)
{
    if (at == p->count || at == PLACES)
        return from == one->length;
    if (p->places[at].gap) {
        for (size_t next = from; next <= one->length; next++)
            if (put_places(p, at + 1, one, next, where))
                return true;
        return false;
    }
    where[at] = from;
    return from < one->length && (!p->places[at].fits || p->places[at].fits[one->trays[from]]) &&
           put_places(p, at + 1, one, from + 1, where);
}

typedef struct completed {
    size_t houses;
    mpq_t best; /* of the first measure */
} completed;

static void add_house(const listed *one, completed *to)
{
    if (to->houses == 0 || mpq_cmp(one->values[0], to->best) < 0)
        mpq_set(to->best, one->values[0]);
    to->houses++;
}

/* A value of a field at a written tray. */
static completed list_completed(const check *c, const open_pattern *p, size_t place, uint32_t field, uint32_t value)
{
    completed sum = {0};
    size_t where[PLACES];
    mpq_init(sum.best);
    for (size_t i = 0; i < c->count; i++)
        if (put_places(p, 0, &c->houses[i], 0, where) &&
            tn_tray_value(c->made->schema, c->houses[i].trays[where[place]], field) == value)
            add_house(&c->houses[i], &sum);
    return sum;
}

/* A value as it is given out: the nearest step, half up. */
static int64_t shown(const tn_house_weights *weights, const mpq_t value)
{
    mpq_t number, half;
    mpz_t floor;
    mpq_inits(number, half, NULL);
    mpz_init(floor);
    mpq_set_ui(half, 1, 2);
    mpq_div(number, value, weights->shown);
    mpq_add(number, number, half);
    mpz_fdiv_q(floor, mpq_numref(number), mpq_denref(number));
    int64_t steps = mpz_get_si(floor);
    mpq_clears(number, half, NULL);
    mpz_clear(floor);
    return steps;
}

static void compare_completed(const check *c, const tn_completions *found, size_t at, const completed *sum)
{
    mpq_t best;
    mpq_init(best);
    assert_int_equal(mpz_cmp_ui(found->counts[at], sum->houses), 0);
    mpq_set(best, sum->best);
    if (c->measures.most[0])
        mpq_neg(best, best);
    if (sum->houses > 0)
        assert_int_equal(found->best[at], shown(c->weights[0], best));
    mpq_clear(best);
}

static void check_pattern(const check *c, tn_houses *houses, const open_pattern *p)
{
    const tn_schema *schema = c->made->schema;
    const tn_open_plan open = {.trays = p->places, .count = p->count};
    tn_completions found;
    tn_error error = {0};
    size_t place = 0, where[PLACES], all = 0;
    assert_int_equal(tn_houses_complete(houses, &open, &found, &error), TN_OK);
    for (size_t i = 0; i < c->count; i++)
        all += put_places(p, 0, &c->houses[i], 0, where);
    assert_int_equal(mpz_cmp_ui(found.plans, all), 0);
    for (size_t i = 0; i < p->count; i++) {
        for (uint32_t f = 0; !p->places[i].gap && f < schema->field_count; f++)
            for (uint32_t v = 0; v < schema->fields[f].value_count; v++) {
                completed sum = list_completed(c, p, i, f, v);
                compare_completed(c, &found, place * found.values + schema->value_start[f] + v, &sum);
                mpq_clear(sum.best);
            }
        place += !p->places[i].gap;
    }
    assert_int_equal(found.trays, place);
    tn_completions_clear(&found);
}

static void check_open_plans(check *c)
{
    tn_houses *houses;
    tn_error error = {0};
    uint64_t state = c->count;
    const tn_houses_what what = {.measures = &c->measures, .aim = TN_HOUSES_COMPLETE};
    assert_int_equal(tn_houses_of(&c->made->form, c->record, c->plans, &what, 0, &houses, &error), TN_OK);
    for (int i = 0; i < 12; i++) {
        open_pattern p;
        draw_pattern(&p, c->made->schema->tray_count, &state);
        check_pattern(c, houses, &p);
    }
    tn_houses_free(houses);
}

/* ---- all houses by the first measure */

static int compare_steps(const void *a, const void *b)
{
    int64_t p = *(const int64_t *)a, q = *(const int64_t *)b;
    return (p > q) - (p < q);
}

static void check_spread(const check *c)
{
    tn_houses *houses;
    tn_error error = {0};
    tn_distribution d;
    const tn_house_measures one = {.count = 1, .of = {c->weights[0]}};
    const tn_houses_what what = {.measures = &one};
    int64_t *steps = malloc((c->count + 1) * sizeof *steps);
    size_t at = 0;
    mpq_t value;
    mpq_init(value);
    assert_non_null(steps);
    for (size_t i = 0; i < c->count; i++) {
        mpq_set(value, c->houses[i].values[0]);
        if (c->measures.most[0])
            mpq_neg(value, value);
        steps[i] = shown(c->weights[0], value);
    }
    qsort(steps, c->count, sizeof *steps, compare_steps);
    tn_distribution_init(&d);
    assert_int_equal(tn_houses_of(&c->made->form, c->record, c->plans, &what, 0, &houses, &error), TN_OK);
    assert_int_equal(tn_houses_spread(houses, &d, &error), TN_OK);
    for (size_t i = 0, end; i < c->count; i = end, at++) {
        for (end = i; end < c->count && steps[end] == steps[i];)
            end++;
        assert_true(at < d.count && d.value[at] == steps[i]);
        assert_int_equal(mpz_cmp_ui(d.plans[at], end - i), 0);
    }
    assert_int_equal(at, d.count);
    tn_distribution_clear(&d);
    tn_houses_free(houses);
    mpq_clear(value);
    free(steps);
}

static void check_houses(check *c)
{
    for (size_t i = 0; i < c->count; i++)
        c->order[i] = &c->houses[i];
    qsort(c->order, c->count, sizeof *c->order, compare_listed);
    check_aim(c, TN_HOUSES_LEAST);
    check_aim(c, TN_HOUSES_FRONT);
    check_open_plans(c);
    check_spread(c);
}

/* most: a bit for each measure. Returns how many houses there are, 0 where they are more than can be listed. */
static size_t check_library(const test_house *made, const tn_house_library_record *record, const uint32_t *measures,
                            uint32_t most, size_t houses_most)
{
    check *c = calloc(1, sizeof *c);
    tn_error error = {0};
    const tn_library_options options = {0};
    assert_non_null(c);
    c->made = made;
    c->record = record;
    c->most = houses_most;
    c->measures.count = MEASURES;
    assert_int_equal(tn_library_new(made->schema, record->plans, &options, &c->plans, &error), TN_OK);
    assert_int_equal(tn_house_listing_new(&made->form, record, 0, &c->variants, &error), TN_OK);
    assert_int_equal(tn_house_rules_new(&made->form, 0, &c->rules, &error), TN_OK);
    for (uint32_t k = 0; k < MEASURES; k++) {
        tn_house_measured measure = tn_house_measured_of(made->form.module, measures[k]);
        assert_int_equal(tn_house_weights_new(&made->form, measure, &c->weights[k], &error), TN_OK);
        c->measures.of[k] = c->weights[k];
        c->measures.most[k] = most >> k & 1;
    }
    list_houses(c);
    size_t count = c->count < c->most ? c->count : 0;
    if (count > 0)
        check_houses(c);
    for (size_t i = 0; i < c->count; i++) {
        for (uint32_t k = 0; k < MEASURES; k++)
            mpq_clear(c->houses[i].values[k]);
        free(c->houses[i].line);
    }
    for (uint32_t k = 0; k < MEASURES; k++)
        tn_house_weights_free(c->weights[k]);
    tn_house_rules_free(c->rules);
    tn_house_listing_free(c->variants);
    tn_library_free(c->plans);
    free(c);
    return count;
}

/* Returns how many libraries are checked. */
static uint32_t check_drawn(drawn_house d, uint32_t count, size_t houses_most)
{
    uint32_t libraries = 0;
    for (uint32_t i = 0; i < count; i++) {
        test_house made;
        do /* costs of flights that stand where ways are left do not add up tray by tray */
            drawn_house_write(&d);
        while (d.priced && d.ways);
        test_house_compile(&made, d.text);
        uint32_t measures = (uint32_t)made.module->HOUSE_MEASURE_count + (uint32_t)made.module->MEASURE_count;
        uint32_t first = d.priced ? (uint32_t)made.module->HOUSE_MEASURE_count - 1 : i % measures; /* `fifth` */
        const uint32_t two[MEASURES] = {first, (first + 1 + i / measures % (measures - 1)) % measures};
        libraries += check_library(&made, made.some, two, i % 4, houses_most) > 0;
        test_house_clear(&made);
    }
    return libraries;
}

static void test_drawn(void **state)
{
    (void)state;
    assert_true(check_drawn((drawn_house){.state = 2}, (uint32_t)test_share(40), HOUSES_MAX) >
                (uint32_t)test_share(5) / 2);
}

static void test_costs(void **state)
{
    (void)state;
    assert_true(check_drawn((drawn_house){.state = 5, .priced = true}, (uint32_t)test_share(40), 5000) >=
                (uint32_t)test_share(9));
}

/* Libraries whose clauses compare measures. */
static void test_compared(void **state)
{
    (void)state;
    assert_true(check_drawn((drawn_house){.state = 2, .compares = true}, (uint32_t)test_share(30), HOUSES_MAX) >
                (uint32_t)test_share(4) - 1);
    assert_true(check_drawn((drawn_house){.state = 9, .priced = true, .compares = true}, 12, 2000) > 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_drawn), cmocka_unit_test(test_costs),
                                       cmocka_unit_test(test_compared)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
