/* What coverage says of each change is what a brute force finds: the changed file is opened, and the interpreter is
 * asked about every plan, as the rules are and as they are changed. The tests that are written pass, and notice what
 * they were written for. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/coverage/coverage.h"
#include "driver/plan/tests.h"
#include "runtime/plan/match/vm.h"
#include "tests/support/test_rule.h"

#define FILES 60
#define RULES 2
#define LONGEST 4 /* trays; the libraries' lengths are at most one less */

/* A file that is compiled, and what the interpreter says of its plans. */
typedef struct compiled {
    tn_opened opened;
    tn_schema *schema;
    tn_plan_vm *vm;
} compiled;

static void make_ready(compiled *made)
{
    tn_error error;
    test_ok(tn_schema_new(made->opened.module, 0, 0, &made->schema, &error), &error);
    test_ok(tn_plan_vm_new(made->schema, 0, &made->vm, &error), &error);
}

static bool compile(const char *text, compiled *made)
{
    *made = (compiled){0};
    if (tn_open_bytes("r.plan", (const uint8_t *)text, strlen(text), false, &made->opened) != TN_OK)
        return false;
    make_ready(made);
    return true;
}

static void compiled_clear(compiled *made)
{
    tn_plan_vm_free(made->vm);
    tn_schema_free(made->schema);
    tn_close(&made->opened);
}

static bool holds(const compiled *made, uint32_t function)
{
    bool result;
    tn_error error;
    test_ok(tn_plan_vm_holds(made->vm, function, &result, &error), &error);
    return result;
}

/* ---- what is decided of a plan: bit 0 whether the library keeps it, bit i + 1 whether rule i matches it */

static uint32_t decide(const compiled *made, const tn_tray *trays, size_t length)
{
    const tn_module *module = made->opened.module;
    uint32_t decided = 0;
    tn_error error;
    test_ok(tn_plan_vm_plan(made->vm, trays, length, &error), &error);
    for (uint32_t i = 0; i < module->RULE_count; i++)
        decided |= (uint32_t)holds(made, module->RULE_records[i].holds) << (i + 1);
    if (module->LIBRARY_count == 0)
        return decided;
    const tn_library_record *library = &module->LIBRARY_records[0];
    bool kept = length >= library->trays_min && length <= library->trays_max;
    for (uint32_t i = 0; kept && i < library->clause_count; i++) {
        const tn_clause_record *clause = &module->CLAUSE_records[library->clause_first + i];
        kept = holds(made, clause->holds) != (clause->kind == TN_CLAUSE_PRUNE);
    }
    return decided | kept;
}

static bool next_plan(tn_tray *trays, size_t length, uint32_t count)
{
    for (size_t i = 0; i < length; i++) {
        if (++trays[i] < count)
            return true;
        trays[i] = 0;
    }
    return false;
}

/* Of the plans of a range of lengths: how many have a bit of `mask` decided otherwise, and the length of the shortest.
 */
static size_t count_otherwise(const compiled *now, const compiled *then, uint32_t mask, size_t min, size_t max,
                              size_t *shortest)
{
    size_t count = 0;
    for (size_t length = min; length <= max; length++) {
        tn_tray trays[LONGEST] = {0};
        do {
            if (((decide(now, trays, length) ^ decide(then, trays, length)) & mask) == 0)
                continue;
            if (count++ == 0)
                *shortest = length;
        } while (next_plan(trays, length, now->schema->tray_count));
    }
    return count;
}

/* ---- the tests of a file, by the interpreter */

static bool case_passes(const compiled *made, const tn_test_block *block, const tn_test_case *test)
{
    tn_tray trays[LONGEST];
    for (size_t i = 0; i < test->length; i++)
        trays[i] = tn_schema_tray(made->schema, test->values + i * made->schema->field_count);
    uint32_t decided = decide(made, trays, test->length) >> (block->is_library ? 0 : block->index + 1);
    bool wanted = test->expectation == TN_EXPECT_MATCH || test->expectation == TN_EXPECT_KEEP;
    return (decided & 1) == wanted;
}

static bool tests_differ(const compiled *now, const compiled *then)
{
    const tn_program *a = now->opened.compilation.program, *b = then->opened.compilation.program;
    for (size_t i = 0; i < a->test_count; i++)
        for (size_t k = 0; k < a->tests[i].case_count; k++)
            if (case_passes(now, &a->tests[i], &a->tests[i].cases[k]) !=
                case_passes(then, &b->tests[i], &b->tests[i].cases[k]))
                return true;
    return false;
}

/* ---- a change */

/* The rule in which it is, or, where that says the same of all plans, all rules. */
static size_t count_alone(const compiled *now, const compiled *then, const tn_covered *covered, uint32_t rule,
                          size_t *shortest)
{
    uint32_t all = (1u << (now->opened.module->RULE_count + 1)) - 2;
    size_t own = rule == TN_NO_RECORD ? 0 : count_otherwise(now, then, 1u << (rule + 1), 1, covered->max, shortest);
    return own ? own : count_otherwise(now, then, all, 1, covered->max, shortest);
}

static void check_telling(const compiled *now, const compiled *then, const tn_covered *covered,
                          const tn_covered_part *part)
{
    const tn_telling *telling = &covered->parts[part->telling.same_as].telling;
    uint32_t bit = telling->of_library ? 0 : telling->rule + 1;
    bool before = decide(now, telling->trays, telling->length) >> bit & 1;
    bool after = decide(then, telling->trays, telling->length) >> bit & 1;
    size_t shortest = 0;
    assert_int_equal(before, telling->now);
    assert_int_not_equal(before, after);
    if (telling != &part->telling)
        return;
    if (telling->of_library)
        count_otherwise(now, then, 1, 0, covered->max + 1, &shortest);
    else
        count_alone(now, then, covered, part->change->rule, &shortest);
    assert_int_equal(telling->length, shortest);
}

static void check_part(const compiled *now, const compiled *then, const tn_covered *covered,
                       const tn_covered_part *part, const char *text)
{
    size_t kept = 0, alone = 0, shortest;
    if (covered->library)
        kept = count_otherwise(now, then, 1, 0, covered->max + 1, &shortest);
    if (kept == 0)
        alone = count_alone(now, then, covered, part->change->rule, &shortest);
    bool noticed = tests_differ(now, then);
    if (mpz_cmp_ui(part->flips, kept + alone) != 0 || part->alone != (covered->library && alone > 0) ||
        part->noticed != noticed)
        fail_msg("`%s` at %u, change %d: %zu plans and %d, not %zu and %d, of\n%s", part->text, part->place.begin,
                 (int)part->change->kind, (size_t)mpz_get_ui(part->flips), part->noticed, kept + alone, noticed, text);
    assert_int_equal(part->fate, noticed ? TN_FATE_NOTICED : kept + alone > 0 ? TN_FATE_SURVIVES : TN_FATE_EQUAL);
    if (part->fate == TN_FATE_SURVIVES) {
        assert_true(part->telling.found);
        check_telling(now, then, covered, part);
    }
}

/* ---- a file */

static tn_change_scope scope_of(const compiled *made, const tn_covered *covered)
{
    return (tn_change_scope){.opened = &made->opened, .library = covered->library, .most = TN_COVERAGE_CHANGES};
}

static size_t check_parts(const compiled *now, const tn_covered *covered, const char *text)
{
    const tn_change_scope scope = scope_of(now, covered);
    size_t tried = 0;
    for (size_t i = 0; i < covered->count; i++) {
        compiled then = {0};
        tn_status status =
            tn_change_open(&scope, (size_t)(covered->parts[i].change - covered->changes.items), 0, &then.opened);
        assert_int_equal(status, TN_OK);
        make_ready(&then);
        check_part(now, &then, covered, &covered->parts[i], text);
        compiled_clear(&then);
        tried++;
    }
    return tried;
}

/* The file with the tests that are written: they pass, and nothing survives. */
static size_t check_written(const char *text, const tn_covered *covered, size_t failed)
{
    const tn_coverage_options options = {.tell = true};
    tn_buffer more = {0};
    tn_covered again;
    compiled made;
    tn_test_counts counts = {0};
    size_t survived = tn_covered_count(covered, false, TN_FATE_SURVIVES);
    assert_true(tn_buffer_printf(&more, "%s", text) && tn_covered_tests(covered, &more));
    if (!compile(more.data, &made))
        fail_msg("does not compile:\n%s", more.data);
    tn_tests_run(&made.opened, 0, NULL, &counts);
    assert_int_equal(counts.failed, failed);
    assert_int_equal(tn_coverage_measure(&made.opened, &options, &again), TN_OK);
    if (tn_covered_count(&again, false, TN_FATE_SURVIVES) > 0)
        fail_msg("some survive:\n%s", more.data);
    tn_covered_clear(&again);
    compiled_clear(&made);
    free(more.data);
    return survived;
}

typedef struct counted {
    size_t tried, survived;
} counted;

static void check_file(const char *text, counted *total)
{
    const tn_coverage_options options = {.tell = true};
    compiled made;
    tn_covered covered;
    tn_test_counts counts = {0};
    if (!compile(text, &made))
        fail_msg("does not compile:\n%s", text);
    tn_tests_run(&made.opened, 0, NULL, &counts);
    assert_int_equal(tn_coverage_measure(&made.opened, &options, &covered), TN_OK);
    total->tried += check_parts(&made, &covered, text);
    total->survived += check_written(text, &covered, counts.failed);
    tn_covered_clear(&covered);
    compiled_clear(&made);
}

/* ---- random files */

static void print_plan(test_random *random, FILE *out)
{
    static const char *const trays[] = {"4'", "8'", "4' open", "8' open"};
    uint32_t length = 1 + test_random_below(random, LONGEST - 1);
    fputc('[', out);
    for (uint32_t i = 0; i < length; i++)
        fprintf(out, "%s%s", i ? " | " : "", trays[test_random_below(random, 4)]);
    fputs("]\n", out);
}

static void print_tests(test_random *random, const char *subject, const char *yes, const char *no, FILE *out)
{
    fprintf(out, "test %s {\n", subject);
    for (uint32_t i = test_random_below(random, 4); i > 0; i--) {
        fprintf(out, "  %s ", test_random_below(random, 2) ? yes : no);
        print_plan(random, out);
    }
    fputs("}\n", out);
}

static void print_rule(test_random *random, FILE *out)
{
    test_rule *rule = test_rule_random(random, &test_schema_tiny, 1 + test_random_below(random, 2), true);
    test_rule_print(&test_schema_tiny, rule, out);
    test_rule_free(rule);
}

/* A clause that is a rule's name, one that is written out, and a total. */
static void print_library(test_random *random, FILE *out)
{
    uint32_t min = test_random_below(random, 2), max = min + test_random_below(random, 3 - min) + (min == 0);
    fprintf(out, "library l {\n  trays %u..%u\n  prune r0\n  ", min, max);
    fputs(test_random_below(random, 2) ? "require " : "prune ", out);
    print_rule(random, out);
    if (test_random_below(random, 2))
        fprintf(out, "\n  total 4'..%u'", 8 + 4 * test_random_below(random, 3));
    fputs("\n}\n", out);
    print_tests(random, "l", "keep", "drop", out);
}

static void random_files(bool library, size_t least)
{
    test_random random = {.seed = library ? 31 : 17};
    counted total = {0};
    for (uint32_t i = 0; i < FILES; i++) {
        char *text = NULL;
        size_t size = 0;
        FILE *stream = open_memstream(&text, &size);
        assert_non_null(stream);
        test_schema_print(&test_schema_tiny, stream);
        for (unsigned r = 0; r < RULES; r++) {
            char name[8];
            snprintf(name, sizeof name, "r%u", r);
            fprintf(stream, "\nrule %s =\n  ", name);
            print_rule(&random, stream);
            fputc('\n', stream);
            print_tests(&random, name, "match", "reject", stream);
        }
        if (library)
            print_library(&random, stream);
        fclose(stream);
        check_file(text, &total);
        free(text);
    }
    assert_true(total.tried > least && total.survived > least / 10);
}

static void rules(void **state)
{
    (void)state;
    random_files(false, 400);
}

static void libraries(void **state)
{
    (void)state;
    random_files(true, 600);
}

/* ---- files that use every form */

#define SCHEMA "schema s { width = 4' | 8'  public = flag  kind = a | b }\n"

static void forms(void **state)
{
    static const char *const files[] = {
        SCHEMA "rule end-pair = symmetric neighbour(beginning, tray(a), optional(tray(8')))\n"
               "test end-pair { match [4' a]  reject [4' b | 4' b] }\n",
        SCHEMA "rule few = quantity(tray(a)) <= quantity(tray(public)) + 1 implies sum(width of tray(b), s <= 8')\n"
               "rule odd = quantity(any, n mod 2 = 1) and not few\n",
        SCHEMA "rule far = distance(from tray(a), to tray(b, public), by quantity(tray(4'), n > 0))\n"
               "rule both = every(tray(8'), tray(public or not public)) or plan [4' | ... | 8']\n",
        SCHEMA "let most = 1\nrule near(x) = neighbour(x, many(any), x)\n"
               "library l { trays 0..2  require quantity(tray(a)) <= most, not near(tray(public))  prune tray(width >= "
               "8', b) as wide\n"
               "  total width <= 12' }\ntest l { keep [4' a]  drop [8' b] by wide }\n",
        SCHEMA
        "rule some-kind = some v in kind (neighbour(tray(v), tray(v)))\n"
        "library l { trays 2..3  prune some-kind, symmetric neighbour(tray(4'..8'), tray((4' or 8'), not a)) }\n",
        SCHEMA "rule lone = tray(a) beside tray(b, public)\nrule far = every tray(a) at least 2 from every tray(b)\n"
               "rule wide = tray(public) within 8' of tray(b)\nrule close = every tray(8') within 1 of tray(public)\n",
        SCHEMA "rule half = tray(a) where quantity(any before) = quantity(any after)\n"
               "rule same = mirrored(kind, width) and values(kind) >= 2\n"
               "rule third = every(any where quantity(any before) mod 2 = 1, tray(public))\n",
        SCHEMA "library l { trays 1..3  prune tray(a) }\ntest l { drop [4' a]  keep [4' b] }\n",
        SCHEMA "library l { trays 1..3  require not tray(a) }\ntest l { drop [4' a]  keep [4' b] }\n",
    };
    counted total = {0};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        check_file(files[i], &total);
    assert_true(total.tried > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rules), cmocka_unit_test(libraries), cmocka_unit_test(forms)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
