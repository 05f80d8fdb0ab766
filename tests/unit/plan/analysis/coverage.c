/* Coverage counts what a brute force counts: the rule is compiled again with the part written as one that never
 * matches, and both are asked about every plan. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/open/open.h"
#include "runtime/plan/analysis/coverage.h"
#include "runtime/plan/match/parts.h"
#include "runtime/plan/match/vm.h"
#include "tests/support/test_rule.h"

#define RULES 60
#define LONGEST 3

static const char never[] = "(any and not any)";

typedef struct compiled {
    tn_opened opened;
    tn_schema *schema;
    tn_plan_vm *vm;
} compiled;

static bool compile(const char *text, compiled *made)
{
    tn_error error;
    *made = (compiled){0};
    if (tn_open_bytes("r.plan", (const uint8_t *)text, strlen(text), false, &made->opened) != TN_OK)
        return false;
    test_ok(tn_schema_new(made->opened.module, 0, 0, &made->schema, &error), &error);
    test_ok(tn_plan_vm_new(made->schema, 0, &made->vm, &error), &error);
    return true;
}

static void compiled_clear(compiled *made)
{
    tn_plan_vm_free(made->vm);
    tn_schema_free(made->schema);
    tn_close(&made->opened);
}

static bool holds(const compiled *made, const tn_tray *trays, size_t length)
{
    bool result;
    tn_error error;
    test_ok(tn_plan_vm_plan(made->vm, trays, length, &error), &error);
    test_ok(tn_plan_vm_holds(made->vm, made->opened.module->RULE_records[0].holds, &result, &error), &error);
    return result;
}

/* Every plan of 1 to LONGEST trays, counted like a number. */
static unsigned long brute_force(const compiled *with, const compiled *without)
{
    unsigned long flips = 0;
    for (size_t length = 1; length <= LONGEST; length++) {
        tn_tray trays[LONGEST] = {0};
        for (size_t at = 0; at < length;) {
            flips += holds(with, trays, length) != holds(without, trays, length);
            for (at = 0; at < length && ++trays[at] == with->schema->tray_count; at++)
                trays[at] = 0;
        }
    }
    return flips;
}

static bool same_part(const tn_module *module, const tn_part *a, const tn_part *b)
{
    const tn_source_map_record *x = tn_module_place(module, a->root), *y = tn_module_place(module, b->root);
    return a->kind == b->kind && x->begin == y->begin && x->end == y->end;
}

/* The part's count against the brute force; false where the part cannot be written so (a distance's separator, a side
 * of an `and` in parentheses). */
static bool compare(const char *text, const compiled *with, tn_coverage *coverage, const tn_parts *trees, uint32_t part)
{
    const tn_module *module = with->opened.module;
    const tn_source_map_record *place = tn_module_place(module, trees[0].parts[part].root);
    char *changed = malloc(strlen(text) + sizeof never);
    assert_non_null(changed);
    memcpy(changed, text, place->begin);
    strcpy(changed + place->begin, never);
    strcat(changed, text + place->end);
    compiled without;
    bool written = compile(changed, &without);
    if (written) {
        uint32_t offsets[256];
        size_t count = 0;
        mpz_t flips;
        tn_error error;
        for (int t = 0; t < 2; t++)
            for (uint32_t i = 0; i < trees[t].count && count < 256; i++)
                if (same_part(module, &trees[0].parts[part], &trees[t].parts[i]))
                    offsets[count++] = trees[t].parts[i].root;
        mpz_init(flips);
        test_ok(tn_coverage_without(coverage, offsets, count, &error), &error);
        test_ok(tn_coverage_flips(coverage, flips, &error), &error);
        unsigned long wanted = brute_force(with, &without);
        if (mpz_cmp_ui(flips, wanted) != 0)
            fail_msg("%lu plans flip, not %lu, without [%u, %u) of\n%s", mpz_get_ui(flips), wanted, place->begin,
                     place->end, text);
        mpz_clear(flips);
    }
    compiled_clear(&without);
    free(changed);
    return written;
}

static size_t cover_rule(const char *text)
{
    compiled with;
    tn_parts trees[2];
    tn_coverage *coverage;
    tn_error error;
    size_t compared = 0;
    assert_true(compile(text, &with));
    const tn_rule_record *rule = &with.opened.module->RULE_records[0];
    if (tn_coverage_new(with.schema, &rule->holds, 1, 1, LONGEST, 2000, &coverage, &error) == TN_OK) {
        test_ok(tn_parts_read(with.opened.module, rule->holds, &trees[0], &error), &error);
        test_ok(tn_parts_read(with.opened.module, rule->whole, &trees[1], &error), &error);
        for (uint32_t part = 0; part < trees[0].count; part++)
            if (!tn_part_unwritten(&trees[0], part))
                compared += compare(text, &with, coverage, trees, part);
        tn_parts_clear(&trees[0]);
        tn_parts_clear(&trees[1]);
        tn_coverage_free(coverage);
    }
    compiled_clear(&with);
    return compared;
}

static void random_rules(void **state)
{
    (void)state;
    test_random random = {.seed = 17};
    size_t compared = 0;
    for (uint32_t i = 0; i < RULES; i++) {
        test_rule *rule = test_rule_random(&random, &test_schema_tiny, 1 + test_random_below(&random, 3), true);
        char *text = NULL;
        size_t size = 0;
        FILE *stream = open_memstream(&text, &size);
        assert_non_null(stream);
        test_schema_print(&test_schema_tiny, stream);
        fputs("\nrule r =\n  ", stream);
        test_rule_print(&test_schema_tiny, rule, stream);
        fputs("\n", stream);
        fclose(stream);
        compared += cover_rule(text);
        free(text);
        test_rule_free(rule);
    }
    assert_true(compared > 2 * RULES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_rules)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
