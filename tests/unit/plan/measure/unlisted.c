/* Schemas whose trays are kept as a diagram answer as those whose trays are listed: random schemas, rules, libraries
 * and measures, each opened both ways. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/open/open.h"
#include "runtime/base/buffer.h"
#include "runtime/plan/library/diff.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/match/rules.h"
#include "runtime/plan/match/vm.h"
#include "runtime/plan/measure/best.h"
#include "runtime/plan/measure/distribution.h"
#include "runtime/plan/measure/pareto.h"
#include "tests/support/test_rule.h"

enum { ROUNDS = 60, FIELDS = 4, LONGEST = 3, LONG = 7, SOME = 200 };

/* ---- random files */

typedef struct writing {
    test_random random;
    tn_buffer text;
    uint32_t fields, values[FIELDS];
} writing;

static uint32_t below(writing *w, uint32_t bound)
{
    return test_random_below(&w->random, bound);
}

#define PUT(...) assert_true(tn_buffer_printf(&w->text, __VA_ARGS__))

/* A value, or some: field 0 has lengths. */
static void put_values(writing *w, uint32_t field)
{
    uint32_t first = below(w, w->values[field]), second = below(w, w->values[field]);
    for (uint32_t i = 0; i < 2; i++) {
        uint32_t value = i ? second : first;
        if (i && (second == first || below(w, 2)))
            return;
        PUT("%s", i ? " or " : "");
        if (field == 0)
            PUT("%um", value + 1);
        else
            PUT("v%u_%u", field, value);
    }
}

static void put_tray(writing *w)
{
    bool any = false;
    PUT("tray(");
    for (uint32_t f = 0; f < w->fields; f++)
        if (below(w, 5) < 2 || (!any && f + 1 == w->fields)) {
            PUT("%s", any ? ", " : "");
            put_values(w, f);
            any = true;
        }
    PUT(")");
}

static void put_rule(writing *w, uint32_t depth)
{
    switch (depth ? below(w, 9) : 0) {
    case 1:
        PUT("neighbour(");
        put_rule(w, depth - 1);
        PUT(", ");
        put_rule(w, depth - 1);
        PUT(")");
        return;
    case 2:
        PUT("symmetric neighbour(");
        put_tray(w);
        PUT(", any, ");
        put_tray(w);
        PUT(")");
        return;
    case 3:
        PUT("quantity(");
        put_tray(w);
        PUT(", n > %u)", below(w, 3));
        return;
    case 4:
        PUT("sum(width) >= %um", 1 + below(w, 6));
        return;
    case 5:
        PUT("sum(price) > %u", below(w, 7));
        return;
    case 6:
        PUT("(");
        put_rule(w, depth - 1);
        PUT(" %s ", below(w, 2) ? "and" : "or");
        put_rule(w, depth - 1);
        PUT(")");
        return;
    case 7:
        PUT("distance(from ");
        put_tray(w);
        PUT(", to ");
        put_tray(w);
        PUT(", by quantity(any, n > 1))");
        return;
    default:
        put_tray(w);
        return;
    }
}

static void put_schema(writing *w)
{
    w->fields = 2 + below(w, FIELDS - 1);
    PUT("schema s {\n");
    for (uint32_t f = 0; f < w->fields; f++) {
        w->values[f] = 2 + below(w, 2);
        if (f)
            PUT("  f%u = ", f);
        else
            PUT("  width = ");
        for (uint32_t v = 0; v < w->values[f]; v++)
            if (f)
                PUT("%sv%u_%u", v ? " | " : "", f, v);
            else
                PUT("%s%um", v ? " | " : "", v + 1);
        PUT("\n");
    }
    for (uint32_t i = below(w, 4); i-- > 0;) {
        PUT("  forbid ");
        put_tray(w);
        PUT("\n");
    }
    if (below(w, 3) == 0)
        PUT("  only tray(width > 1m) or tray(v1_0)\n");
    PUT("  number price = 2 where ");
    put_tray(w);
    PUT(" | width / 1m where ");
    put_tray(w);
    PUT(" | 0\n}\n");
}

static void put_file(writing *w)
{
    uint32_t rules = 1 + below(w, 3), shortest = below(w, 2);
    put_schema(w);
    for (uint32_t i = 0; i < rules; i++) {
        PUT("rule r%u = ", i);
        put_rule(w, 2);
        PUT("\n");
    }
    PUT("measure cost = sum(price)\nmeasure some = quantity(");
    put_tray(w);
    PUT(")\nlibrary L { trays %u..%u", shortest, LONGEST);
    for (uint32_t i = 0; i < rules; i++)
        PUT(" %s r%u", below(w, 3) ? "prune" : "require", i);
    PUT(" }\nlibrary M { trays 0..2 prune r%u }\n", rules - 1);
}

/* ---- one file, opened one way */

typedef struct opened {
    tn_schema *schema;
    tn_library *library, *other;
    tn_weighed *weighed;
} opened;

static bool make(opened *o, const tn_module *module, uint64_t max_listed)
{
    static const uint32_t measures[] = {0, 1};
    tn_error error;
    test_ok(tn_schema_new(module, 0, max_listed, &o->schema, &error), &error);
    tn_status status = tn_library_new(o->schema, 0, NULL, &o->library, &error);
    if (status == TN_OK)
        status = tn_library_new(o->schema, 1, NULL, &o->other, &error);
    if (status == TN_OK)
        status = tn_weighed_new(o->library, measures, 2, &o->weighed, &error);
    if (status != TN_LIMIT)
        test_ok(status, &error);
    return status == TN_OK;
}

static void clear(opened *o)
{
    tn_weighed_free(o->weighed);
    tn_library_free(o->library);
    tn_library_free(o->other);
    tn_schema_free(o->schema);
}

/* ---- both ways */

static void same_trays(const tn_schema *a, const tn_schema *b)
{
    assert_null(a->legal);
    assert_non_null(b->legal);
    assert_int_equal(a->tray_count, b->tray_count);
    for (tn_tray t = 0; t < a->tray_count; t++) {
        uint8_t values[FIELDS];
        for (uint32_t f = 0; f < a->field_count; f++) {
            values[f] = (uint8_t)tn_tray_value(a, t, f);
            assert_int_equal(tn_tray_value(b, t, f), values[f]);
        }
        assert_int_equal(tn_schema_tray(b, values), t);
        for (uint32_t s = 0; s < a->module->SPEC_count; s++)
            assert_int_equal(tn_spec_meets(a, s, t), tn_spec_meets(b, s, t));
    }
}

static void same_counts(const opened *a, const opened *b)
{
    mpz_t one, other;
    tn_error error;
    mpz_inits(one, other, NULL);
    assert_int_equal(tn_library_states(a->library), tn_library_states(b->library));
    for (uint32_t n = 0; n <= LONGEST; n++) {
        tn_library_kept(a->library, n, one);
        tn_library_kept(b->library, n, other);
        assert_int_equal(mpz_cmp(one, other), 0);
        test_ok(tn_library_generated(a->library, n, one, &error), &error);
        test_ok(tn_library_generated(b->library, n, other, &error), &error);
        assert_int_equal(mpz_cmp(one, other), 0);
        test_ok(tn_library_kept_mirror(a->library, n, one, &error), &error);
        test_ok(tn_library_kept_mirror(b->library, n, other, &error), &error);
        assert_int_equal(mpz_cmp(one, other), 0);
    }
    mpz_clears(one, other, NULL);
}

/* The plans of all ranks, or of many, from the cursor, from ranks, and their ranks. */
static void same_plans(const opened *a, const opened *b, test_random *random)
{
    mpz_t from, to, rank, found;
    tn_cursor *one, *other;
    const tn_tray *trays, *others;
    tn_tray plan[LONGEST];
    uint32_t length, same, given = 0;
    tn_error error;
    mpz_inits(from, to, rank, found, NULL);
    tn_library_kept(a->library, TN_ALL_LENGTHS, to);
    mpz_set_ui(from, mpz_sgn(to) ? (unsigned long)(test_random_next(random) % mpz_get_ui(to)) : 0);
    if (test_random_below(random, 2))
        mpz_set_ui(from, 0);
    test_ok(tn_cursor_new(a->library, from, to, &one, &error), &error);
    test_ok(tn_cursor_new(b->library, from, to, &other, &error), &error);
    mpz_set(rank, from);
    while (given++ < SOME && tn_cursor_next(one, &trays, &length)) {
        assert_true(tn_cursor_next(other, &others, &same));
        assert_int_equal(length, same);
        assert_memory_equal(trays, others, length * sizeof *trays);
        assert_true(tn_library_has(b->library, trays, length));
        assert_true(tn_library_unrank(b->library, rank, plan, &same));
        assert_int_equal(length, same);
        assert_memory_equal(trays, plan, length * sizeof *trays);
        assert_true(tn_library_rank(b->library, trays, length, found));
        assert_int_equal(mpz_cmp(rank, found), 0);
        mpz_add_ui(rank, rank, 1);
    }
    tn_cursor_free(one);
    tn_cursor_free(other);
    mpz_clears(from, to, rank, found, NULL);
}

/* Compares the ranks of plans that are drawn in two libraries, one of which leaves a clause out of its automaton; how
 * many of them had one. */
static uint32_t same_ranks(const tn_library *whole, const tn_library *apart, test_random *random)
{
    uint32_t ranks = 0;
    mpz_t rank, found;
    tn_error error;
    mpz_inits(rank, found, NULL);
    for (uint32_t k = 0; k < SOME; k++) {
        tn_tray trays[LONG];
        bool has;
        size_t length = test_random_below(random, LONG + 1);
        for (size_t i = 0; i < length; i++)
            trays[i] = test_random_below(random, tn_library_schema(whole)->tray_count);
        bool there = tn_library_rank(whole, trays, length, rank);
        test_ok(tn_library_counted_rank(apart, trays, length, &has, found, &error), &error);
        assert_int_equal(has, there);
        assert_true(!there || mpz_cmp(rank, found) == 0);
        ranks += there;
    }
    mpz_clears(rank, found, NULL);
    return ranks;
}

/* The same of libraries of longer plans that may have few states. */
static uint32_t same_ranks_apart(const opened *a, const opened *b, test_random *random)
{
    uint32_t ranks = 0;
    tn_library_options options = {.override_trays = true, .trays_max = LONG, .only_counted = true, .threads = 1};
    tn_library *whole = NULL;
    tn_error error;
    test_ok(tn_library_new(a->schema, 0, &options, &whole, &error), &error);
    options.max_eager = 1;
    for (options.max_states = 4; options.max_states < 100; options.max_states += 1 + options.max_states / 8) {
        tn_library *few = NULL;
        tn_status status = tn_library_new(b->schema, 0, &options, &few, &error);
        if (status == TN_OK && tn_library_apart(few) != SIZE_MAX)
            ranks += same_ranks(whole, few, random);
        tn_library_free(few);
    }
    tn_library_free(whole);
    return ranks;
}

static void same_measures(const opened *a, const opened *b)
{
    tn_distribution one, other;
    tn_error error;
    tn_distribution_init(&one);
    tn_distribution_init(&other);
    test_ok(tn_distribution_make(&one, a->weighed, &error), &error);
    test_ok(tn_distribution_make(&other, b->weighed, &error), &error);
    assert_int_equal(one.count, other.count);
    assert_true(mpq_equal(one.unit, other.unit));
    for (size_t i = 0; i < one.count; i++) {
        assert_int_equal(one.value[i], other.value[i]);
        assert_int_equal(mpz_cmp(one.plans[i], other.plans[i]), 0);
    }
    tn_distribution_clear(&one);
    tn_distribution_clear(&other);
}

static void same_best(const opened *a, const opened *b, bool most)
{
    tn_best *one, *other;
    tn_error error;
    const bool mosts[] = {most, !most};
    test_ok(tn_best_new(a->weighed, mosts, &one, &error), &error);
    test_ok(tn_best_new(b->weighed, mosts, &other, &error), &error);
    for (uint32_t i = 0; i < SOME; i++) {
        tn_tray trays[LONGEST], others[LONGEST];
        uint32_t length, same;
        int64_t values[TN_WEIGHED_MAX] = {0}, those[TN_WEIGHED_MAX] = {0};
        bool found, too;
        test_ok(tn_best_next(one, trays, &length, values, &found, &error), &error);
        test_ok(tn_best_next(other, others, &same, those, &too, &error), &error);
        assert_int_equal(found, too);
        if (!found)
            break;
        assert_int_equal(length, same);
        assert_memory_equal(trays, others, length * sizeof *trays);
        assert_memory_equal(values, those, 2 * sizeof *values);
    }
    tn_best_free(one);
    tn_best_free(other);
}

static void same_front(const opened *a, const opened *b)
{
    static const bool most[] = {true, false};
    tn_pareto_front one, other;
    tn_error error;
    test_ok(tn_pareto_make(&one, a->weighed, most, &error), &error);
    test_ok(tn_pareto_make(&other, b->weighed, most, &error), &error);
    assert_int_equal(one.count, other.count);
    for (size_t i = 0; i < one.count; i++) {
        const tn_pareto_point *p = &one.points[i], *q = &other.points[i];
        assert_memory_equal(p->values, q->values, 2 * sizeof *p->values);
        assert_int_equal(mpz_cmp(p->plans, q->plans), 0);
        assert_int_equal(p->length, q->length);
        assert_memory_equal(p->trays, q->trays, p->length * sizeof *p->trays);
    }
    tn_pareto_clear(&one);
    tn_pareto_clear(&other);
}

/* What rules match of random plans, by automata and by the interpreter. */
static void same_matches(const opened *a, const opened *b, test_random *random)
{
    const tn_module *module = a->schema->module;
    uint32_t functions[8];
    tn_rules *rules;
    tn_matcher *matcher;
    tn_plan_vm *one, *other;
    tn_error error;
    for (uint32_t i = 0; i < module->RULE_count; i++)
        functions[i] = module->RULE_records[i].holds;
    const tn_rules_options options = {.any = true};
    test_ok(tn_rules_new(b->schema, functions, module->RULE_count, &options, &rules, &error), &error);
    test_ok(tn_matcher_new(rules, &matcher, &error), &error);
    test_ok(tn_plan_vm_new(a->schema, 0, &one, &error), &error);
    test_ok(tn_plan_vm_new(b->schema, 0, &other, &error), &error);
    for (uint32_t k = 0; k < SOME; k++) {
        tn_tray trays[2 * LONGEST];
        size_t length = test_random_below(random, 2 * LONGEST + 1);
        uint64_t bits;
        for (size_t i = 0; i < length; i++)
            trays[i] = test_random_below(random, a->schema->tray_count);
        test_ok(tn_match(matcher, trays, length, &bits, &error), &error);
        test_ok(tn_plan_vm_plan(one, trays, length, &error), &error);
        test_ok(tn_plan_vm_plan(other, trays, length, &error), &error);
        for (uint32_t i = 0; i < module->RULE_count; i++) {
            bool holds, too;
            test_ok(tn_plan_vm_holds(one, functions[i], &holds, &error), &error);
            test_ok(tn_plan_vm_holds(other, functions[i], &too, &error), &error);
            assert_int_equal(holds, too);
            assert_int_equal(holds, bits >> i & 1);
        }
    }
    tn_plan_vm_free(one);
    tn_plan_vm_free(other);
    tn_matcher_free(matcher);
    tn_rules_free(rules);
}

/* What one library keeps and the other does not. */
static void same_differences(const opened *a, const opened *b)
{
    tn_library_diff *one, *other;
    mpz_t plans, those;
    tn_error error;
    mpz_inits(plans, those, NULL);
    test_ok(tn_library_diff_new(a->library, a->other, 0, NULL, &one, &error), &error);
    test_ok(tn_library_diff_new(b->library, b->other, 0, NULL, &other, &error), &error);
    for (int part = 0; part < TN_DIFF_PARTS; part++) {
        const tn_library *mine = tn_library_diff_part(one, part), *its = tn_library_diff_part(other, part);
        tn_tray trays[LONGEST], same[LONGEST];
        uint32_t length, too;
        tn_library_kept(mine, TN_ALL_LENGTHS, plans);
        tn_library_kept(its, TN_ALL_LENGTHS, those);
        assert_int_equal(mpz_cmp(plans, those), 0);
        if (mpz_sgn(plans) == 0)
            continue;
        mpz_sub_ui(plans, plans, 1); /* the last */
        assert_true(tn_library_unrank(mine, plans, trays, &length) && tn_library_unrank(its, plans, same, &too));
        assert_int_equal(length, too);
        assert_memory_equal(trays, same, length * sizeof *trays);
        test_ok(tn_library_diff_rank(one, part, trays, length, plans, &error), &error);
        test_ok(tn_library_diff_rank(other, part, trays, length, those, &error), &error);
        assert_int_equal(mpz_cmp(plans, those), 0);
    }
    assert_int_equal(tn_library_diff_clauses(one), tn_library_diff_clauses(other));
    for (size_t i = 0; i < tn_library_diff_clauses(one); i++) {
        const tn_changed_clause *c = tn_library_diff_clause(one, i), *d = tn_library_diff_clause(other, i);
        assert_int_equal(mpz_cmp(c->removes, d->removes), 0);
        assert_int_equal(mpz_cmp(c->adds, d->adds), 0);
    }
    tn_library_diff_free(one);
    tn_library_diff_free(other);
    mpz_clears(plans, those, NULL);
}

/* The hash of a library whose trays are not listed is its own, and of the plans, not of the rules' wording. */
static void check_hash(const opened *a, const opened *b)
{
    char one[33], other[33];
    tn_library_hash(a->library, one);
    tn_library_hash(b->library, other);
    assert_string_not_equal(one, other);
    tn_library_hash(b->library, one);
    assert_string_equal(one, other);
}

static void test_both_ways(void **state)
{
    uint32_t made = 0, legal = 0, ranks = 0;
    (void)state;
    for (uint64_t seed = 1; seed <= ROUNDS; seed++) {
        writing w = {.random = {.seed = seed}};
        tn_opened file;
        opened a = {0}, b = {0};
        put_file(&w);
        tn_status status = tn_open_bytes("w.plan", (const uint8_t *)w.text.data, w.text.size, false, &file);
        if (status == TN_OK && make(&a, file.module, 0) && a.schema->tray_count > 1 && make(&b, file.module, 1)) {
            same_trays(a.schema, b.schema);
            same_counts(&a, &b);
            same_plans(&a, &b, &w.random);
            ranks += same_ranks_apart(&a, &b, &w.random);
            same_measures(&a, &b);
            same_best(&a, &b, seed % 2);
            same_front(&a, &b);
            same_differences(&a, &b);
            same_matches(&a, &b, &w.random);
            check_hash(&a, &b);
            made++;
            legal += a.schema->tray_count < a.schema->code_count;
        }
        clear(&a);
        clear(&b);
        tn_close(&file);
        free(w.text.data);
    }
    assert_true(made > ROUNDS / 2); /* some files forbid every tray, and some rules match no tray */
    assert_true(legal > ROUNDS / 4);
    assert_true(ranks > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_both_ways)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
