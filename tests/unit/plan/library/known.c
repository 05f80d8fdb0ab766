/* Known answers: the paper's rules (Fig. 8a to 8d) over a schema of 192 trays, and constructions known to grow or to
 * stay small. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/library/library.h"
#include "runtime/plan/match/rules.h"
#include "tests/support/test_rule.h"

#define FEET(n) (TN_FOOT_NM * (n))

static const test_schema schema_192 = {
    .name = "known",
    .field_count = 7,
    .fields = {
        {"width",
         TN_FIELD_LENGTH,
         3,
         {{"4'", "4'", "", FEET(4)}, {"8'", "8'", "", FEET(8)}, {"12'", "12'", "", FEET(12)}}},
        {"height", TN_FIELD_CHOICE, 2, {{"single", "single", "", 0}, {"double", "double", "", 0}}},
        {"public", TN_FIELD_FLAG, 2, {{"-", "-", "", 0}, {"public", "public", "", 0}}},
        {"great", TN_FIELD_FLAG, 2, {{"-", "-", "", 0}, {"great", "great", "", 0}}},
        {"machine", TN_FIELD_ZONE, 2, {{"dense", "dense:4'", "4'", FEET(4)}, {"empty", "empty", "", 0}}},
        {"body", TN_FIELD_ZONE, 2, {{"open", "open:12'", "12'", FEET(12)}, {"dense", "dense:12'", "12'", FEET(12)}}},
        {"bay", TN_FIELD_ZONE, 2, {{"open", "open:3'", "3'", FEET(3)}, {"empty", "empty", "", 0}}}}};

/* Values as bits of a specifier; a field of which no bit is given may have any value. */
enum {
    W4 = 1 << 0,
    W8 = 1 << 1,
    W12 = 1 << 2,
    SINGLE = 1 << 3,
    PUBLIC = 1 << 6,
    GREAT = 1 << 8,
    MACHINE_DENSE = 1 << 9,
    MACHINE_EMPTY = 1 << 10,
    BODY_OPEN = 1 << 11,
    BODY_DENSE = 1 << 12
};

/* ---- rules built by hand; freed with test_rule_free */

typedef struct maker {
    uint32_t nodes;
} maker;

static test_rule *node(maker *m, test_rule_kind kind, test_rule *a, test_rule *b, test_rule *c)
{
    test_rule *rule = calloc(1, sizeof *rule);
    assert_non_null(rule);
    rule->kind = kind;
    rule->id = m->nodes++;
    test_rule *parts[] = {a, b, c};
    for (; rule->part_count < 3 && parts[rule->part_count]; rule->part_count++)
        rule->parts[rule->part_count] = parts[rule->part_count];
    return rule;
}

static test_rule *tray(maker *m, uint64_t bits)
{
    static const uint64_t fields[] = {0x7, 0x18, 0x60, 0x180, 0x600, 0x1800, 0x6000};
    test_rule *rule = node(m, TEST_TRAY, NULL, NULL, NULL);
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++)
        rule->mask |= bits & fields[f] ? bits & fields[f] : fields[f];
    return rule;
}

static test_rule *counted(maker *m, test_rule_kind kind, test_rule *part, tn_opcode opcode, int64_t first,
                          int64_t second)
{
    test_rule *rule = node(m, kind, part, NULL, NULL);
    rule->condition = calloc(1, sizeof *rule->condition);
    assert_non_null(rule->condition);
    *rule->condition = (test_condition){.opcode = opcode, .first = first, .second = second};
    return rule;
}

static test_rule *rule_8a(maker *m)
{
    return node(m, TEST_NEIGHBOUR, tray(m, W4), tray(m, W4), NULL);
}

static test_rule *rule_8b(maker *m)
{
    test_rule *neighbour = node(m, TEST_NEIGHBOUR, tray(m, BODY_DENSE), NULL, NULL);
    neighbour->beginning = true;
    return node(m, TEST_SYMMETRIC, neighbour, NULL, NULL);
}

static test_rule *rule_8c(maker *m)
{
    test_rule *fat = node(m, TEST_NOT, tray(m, W12 | BODY_DENSE), NULL, NULL);
    return node(m, TEST_AND, fat, counted(m, TEST_QUANTITY, tray(m, W12 | MACHINE_EMPTY), TN_OP_GREATER, 1, 0), NULL);
}

/* Some single tray with `most` 12' trays or more between it and any dense one. */
static test_rule *rule_8d(maker *m, int64_t most)
{
    test_rule *dense = node(m, TEST_OR, tray(m, MACHINE_DENSE), tray(m, BODY_DENSE), NULL);
    test_rule *between = tray(m, W12 | MACHINE_EMPTY | BODY_OPEN);
    return node(m, TEST_DISTANCE, tray(m, SINGLE), dense,
                counted(m, TEST_QUANTITY, between, TN_OP_GREATER, most - 1, 0));
}

/* neighbour(great, exactly k trays, public) */
static test_rule *exactly_between(maker *m, int64_t k)
{
    test_rule *any = counted(m, TEST_QUANTITY, tray(m, 0), TN_OP_EQUAL, k, 0);
    return node(m, TEST_NEIGHBOUR, tray(m, GREAT), any, tray(m, PUBLIC));
}

/* ---- sets of rules */

#define RULES_MAX 8

typedef struct known {
    size_t count;
    uint32_t functions[RULES_MAX];
    tn_builder *builder;
    tn_module *module;
    tn_schema *schema;
} known;

static void known_begin(known *set)
{
    memset(set, 0, sizeof *set);
    set->builder = tn_builder_new();
    assert_non_null(set->builder);
    test_schema_add(set->builder, &schema_192);
}

static void known_add(known *set, test_rule *rule)
{
    uint32_t whole;
    test_rule_emit(set->builder, rule, &whole, &set->functions[set->count++]);
    test_rule_free(rule);
}

static void known_end(known *set)
{
    set->module = test_module(set->builder);
    set->schema = test_schema_open(set->module, 0);
    assert_int_equal(set->schema->tray_count, 192);
}

static void known_clear(known *set)
{
    tn_schema_free(set->schema);
    tn_module_free(set->module);
}

static tn_rules *known_rules(const known *set, const tn_rules_options *options)
{
    tn_rules *rules = NULL;
    tn_error error;
    test_ok(tn_rules_new(set->schema, set->functions, set->count, options, &rules, &error), &error);
    return rules;
}

static void the_papers_rules_have_their_states(void **state)
{
    (void)state;
    known set;
    known_begin(&set);
    known_add(&set, rule_8a(&(maker){0}));
    known_add(&set, rule_8b(&(maker){0}));
    known_add(&set, rule_8c(&(maker){0}));
    known_add(&set, rule_8d(&(maker){0}, 2));
    known_end(&set);
    tn_rules *rules = known_rules(&set, NULL);
    const uint32_t states[] = {3, 4, 4, 6};
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(tn_rules_states(rules, i), states[i]);
        assert_null(tn_rules_fallback(rules, i));
    }
    tn_rules_free(rules);
    known_clear(&set);
}

/* ---- the library of the four rules */

static tn_library *library_of(known *set, uint32_t max, tn_library_options *options)
{
    tn_library_record record = {.name = tn_builder_string(set->builder, "paper"),
                                .trays_min = 1,
                                .trays_max = max,
                                .clause_count = (uint32_t)set->count};
    for (size_t i = 0; i < set->count; i++)
        tn_builder_add_CLAUSE(set->builder, &(tn_clause_record){.name = tn_builder_string(set->builder, "prune"),
                                                                .kind = TN_CLAUSE_PRUNE,
                                                                .holds = set->functions[i]});
    tn_builder_add_LIBRARY(set->builder, &record);
    known_end(set);
    tn_library *library = NULL;
    tn_error error;
    test_ok(tn_library_new(set->schema, 0, options, &library, &error), &error);
    return library;
}

static tn_library *papers_library(known *set, uint32_t max)
{
    known_begin(set);
    known_add(set, rule_8a(&(maker){0}));
    known_add(set, rule_8b(&(maker){0}));
    known_add(set, rule_8c(&(maker){0}));
    known_add(set, rule_8d(&(maker){0}, 2));
    return library_of(set, max, NULL);
}

static void the_papers_library_has_its_counts(void **state)
{
    (void)state;
    static const char *const kept[] = {"72",
                                       "6592",
                                       "1306112",
                                       "231268352",
                                       "40242053120",
                                       "7005086679040",
                                       "1224736518438912",
                                       "214889984585367552",
                                       "37795440232304214016",
                                       "6656474744531514818560",
                                       "1172963314647629576536064",
                                       "206689117482878778342375424"};
    known set;
    tn_library *library = papers_library(&set, 12);
    assert_int_equal(tn_library_states(library), 44);
    mpz_t count, expected;
    mpz_inits(count, expected, NULL);
    for (uint32_t length = 1; length <= 12; length++) {
        mpz_set_str(expected, kept[length - 1], 10);
        tn_library_kept(library, length, count);
        assert_int_equal(mpz_cmp(count, expected), 0);
        tn_error error;
        test_ok(tn_library_generated(library, length, count, &error), &error);
        mpz_ui_pow_ui(expected, 192, length);
        assert_int_equal(mpz_cmp(count, expected), 0);
    }
    mpz_clears(count, expected, NULL);
    tn_library_free(library);
    known_clear(&set);
}

/* The four rules are their own mirrors, so of every pair one is left: (kept + palindromes) / 2. */
static void the_papers_library_has_its_mirror_pairs(void **state)
{
    (void)state;
    known set;
    tn_library *library = papers_library(&set, 4);
    uint64_t palindromes[5] = {0};
    for (tn_tray a = 0; a < 192; a++) {
        palindromes[1] += tn_library_has(library, &a, 1);
        palindromes[2] += tn_library_has(library, (tn_tray[]){a, a}, 2);
        for (tn_tray b = 0; b < 192; b++) {
            palindromes[3] += tn_library_has(library, (tn_tray[]){a, b, a}, 3);
            palindromes[4] += tn_library_has(library, (tn_tray[]){a, b, b, a}, 4);
        }
    }
    mpz_t count, pairs;
    mpz_inits(count, pairs, NULL);
    for (uint32_t length = 1; length <= 4; length++) {
        tn_error error;
        tn_library_kept(library, length, count);
        mpz_add_ui(count, count, palindromes[length]);
        test_ok(tn_library_kept_mirror(library, length, pairs, &error), &error);
        mpz_mul_ui(pairs, pairs, 2);
        assert_int_equal(mpz_cmp(pairs, count), 0);
    }
    mpz_clears(count, pairs, NULL);
    tn_library_free(library);
    known_clear(&set);
}

/* Ranks of large plans: beyond 64 bits, to the plan and back, and in order. */
static void large_ranks_are_inverse(void **state)
{
    (void)state;
    known set;
    tn_library *library = papers_library(&set, 60);
    mpz_t all, rank, again;
    mpz_inits(all, rank, again, NULL);
    tn_library_kept(library, TN_ALL_LENGTHS, all);
    assert_true(mpz_sizeinbase(all, 2) > 400);
    tn_tray trays[60];
    uint32_t length;
    for (unsigned i = 0; i <= 100; i++) {
        mpz_mul_ui(rank, all, i);
        mpz_fdiv_q_ui(rank, rank, 100);
        if (i == 100) {
            assert_false(tn_library_unrank(library, rank, trays, &length));
            mpz_sub_ui(rank, rank, 1);
        }
        assert_true(tn_library_unrank(library, rank, trays, &length));
        assert_true(tn_library_rank(library, trays, length, again));
        assert_int_equal(mpz_cmp(rank, again), 0);
    }
    mpz_clears(all, rank, again, NULL);
    tn_library_free(library);
    known_clear(&set);
}

static void distances_stay_small(void **state)
{
    (void)state;
    known set;
    known_begin(&set);
    known_add(&set, rule_8d(&(maker){0}, 16));
    known_add(&set, rule_8d(&(maker){0}, 64));
    known_end(&set);
    tn_rules *rules = known_rules(&set, &(tn_rules_options){.engine = TN_ENGINE_DFA, .max_states = 2000});
    assert_in_range(tn_rules_states(rules, 0), 10, 100);
    assert_in_range(tn_rules_states(rules, 1), 40, 400);
    tn_rules_free(rules);
    known_clear(&set);
}

static void exact_gaps_double_and_pass_the_limit(void **state)
{
    (void)state;
    known set;
    known_begin(&set);
    for (int64_t k = 1; k <= 12; k += 5)
        known_add(&set, exactly_between(&(maker){0}, k));
    known_add(&set, exactly_between(&(maker){0}, 20));
    known_end(&set);
    tn_rules *rules = known_rules(&set, NULL);
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(tn_rules_states(rules, i), (2u << (1 + 5 * i)) + 1);
    assert_int_equal(tn_rules_states(rules, 3), 0);
    const tn_error *why = tn_rules_fallback(rules, 3);
    assert_non_null(why);
    assert_int_equal(why->status, TN_LIMIT);
    assert_int_equal(why->code, 802);
    assert_true(why->code_offset < set.module->code_size);
    assert_non_null(strstr(why->message, "20000"));
    tn_rules_free(rules);
    tn_error error;
    tn_rules_options forced = {.engine = TN_ENGINE_DFA};
    assert_int_equal(tn_rules_new(set.schema, set.functions, set.count, &forced, &rules, &error), TN_LIMIT);
    assert_int_equal(error.code, 802);
    known_clear(&set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_papers_rules_have_their_states),
        cmocka_unit_test(the_papers_library_has_its_counts),
        cmocka_unit_test(the_papers_library_has_its_mirror_pairs),
        cmocka_unit_test(large_ranks_are_inverse),
        cmocka_unit_test(distances_stay_small),
        cmocka_unit_test(exact_gaps_double_and_pass_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
