/* Analysis of rules' parts: a distance is said to hold only where there is no destination, and a specifier to be met by
 * no tray, exactly where trying every short plan says so. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/open/open.h"
#include "runtime/plan/analysis/analysis.h"
#include "runtime/plan/match/vm.h"
#include "tests/support/test_rule.h"

enum { TEXT = 2000, EXPRESSION = 200, LONGEST = 6, DISTANCES = 80 };

static const char schema[] = "schema s { w = 1m | 2m a = flag forbid tray(2m, a) }\n";

typedef struct analysed {
    tn_opened opened;
    tn_schema *schema;
    tn_plan_vm *vm;
    tn_plan_analysis *analysis;
} analysed;

static void open_text(analysed *made, const char *text)
{
    tn_error error;
    *made = (analysed){0};
    if (tn_open_bytes("r.plan", (const uint8_t *)text, strlen(text), false, &made->opened) != TN_OK)
        fail_msg("%s\n%s", text, made->opened.compilation.diagnostics.items[0].message);
    test_ok(tn_schema_new(made->opened.module, 0, 0, &made->schema, &error), &error);
    test_ok(tn_plan_vm_new(made->schema, 0, &made->vm, &error), &error);
    test_ok(tn_plan_analysis_new(made->schema, NULL, &made->analysis, &error), &error);
}

static void close_text(analysed *made)
{
    tn_plan_analysis_free(made->analysis);
    tn_plan_vm_free(made->vm);
    tn_schema_free(made->schema);
    tn_close(&made->opened);
}

static const tn_plan_analysis_finding *find(const analysed *made, tn_found found, uint32_t rule)
{
    for (size_t i = 0; i < tn_plan_analysis_count(made->analysis); i++) {
        const tn_plan_analysis_finding *finding = tn_plan_analysis_get(made->analysis, i);
        if (finding->found == found && finding->rule == rule)
            return finding;
    }
    return NULL;
}

static bool holds(const analysed *made, uint32_t rule, const tn_tray *trays, size_t length)
{
    bool result;
    tn_error error;
    test_ok(tn_plan_vm_plan(made->vm, trays, length, &error), &error);
    test_ok(tn_plan_vm_holds(made->vm, made->opened.module->RULE_records[rule].holds, &result, &error), &error);
    return result;
}

/* ---- random texts */

static void tray(test_random *random, char text[EXPRESSION])
{
    static const char *const specifiers[] = {"tray(1m)", "tray(2m)", "tray(a)", "tray(not a)", "tray(1m, a)", "any"};
    strcpy(text, specifiers[test_random_below(random, 6)]);
}

static void part(test_random *random, char text[EXPRESSION])
{
    char one[EXPRESSION], other[EXPRESSION];
    tray(random, one);
    tray(random, other);
    switch (test_random_below(random, 7)) {
    case 0:
        snprintf(text, EXPRESSION, "neighbour(%.60s, %.60s)", one, other);
        return;
    case 1:
        snprintf(text, EXPRESSION, "many(%.60s)", one);
        return;
    case 2:
        snprintf(text, EXPRESSION, "not %.60s", one);
        return;
    case 3:
        snprintf(text, EXPRESSION, "(%.60s and quantity(%.60s, n > 1))", one, other);
        return;
    default:
        strcpy(text, one);
    }
}

static void separator(test_random *random, char text[EXPRESSION])
{
    static const char *const relations[] = {"<", "=", ">", "!="};
    char one[EXPRESSION];
    const char *relation = relations[test_random_below(random, 4)];
    tray(random, one);
    if (test_random_below(random, 3) == 0)
        snprintf(text, EXPRESSION, "sum(w of %.60s, l %s %um)", one, relation, test_random_below(random, 2));
    else
        snprintf(text, EXPRESSION, "quantity(%.60s, n %s %u)", one, relation, test_random_below(random, 2));
}

/* ---- distances */

/* Tries every plan of up to LONGEST trays: the length of the shortest where the distance holds (0: none), and whether
 * it holds in one that has a destination. */
static uint32_t try_plans(const analysed *made, bool *reached)
{
    uint32_t shortest = 0, count = made->schema->tray_count;
    *reached = false;
    for (uint32_t length = 1; length <= LONGEST && !*reached; length++) {
        uint32_t codes = 1;
        for (uint32_t i = 0; i < length; i++)
            codes *= count;
        for (uint32_t code = 0; code < codes && !*reached; code++) {
            tn_tray trays[LONGEST];
            for (uint32_t i = 0, rest = code; i < length; i++, rest /= count)
                trays[i] = rest % count;
            if (!holds(made, 0, trays, length))
                continue;
            shortest = shortest ? shortest : length;
            *reached = *reached || holds(made, 1, trays, length);
        }
    }
    return shortest;
}

/* A neighbour of one part is found wherever the part is a match as a whole. */
static void distances(void **state)
{
    (void)state;
    test_random random = {.seed = 21};
    size_t vacuous = 0;
    for (int n = 0; n < DISTANCES; n++) {
        char text[TEXT], source[EXPRESSION], destination[EXPRESSION], by[EXPRESSION];
        analysed made;
        bool reached;
        part(&random, source);
        part(&random, destination);
        separator(&random, by);
        snprintf(text, sizeof text, "%srule far = distance(from %s, to %s, by %s)\nrule there = neighbour(%s)\n",
                 schema, source, destination, by, destination);
        open_text(&made, text);
        uint32_t shortest = try_plans(&made, &reached);
        const tn_plan_analysis_finding *finding = find(&made, TN_FOUND_VACUOUS, 0);
        if ((finding != NULL) != (shortest > 0 && !reached))
            fail_msg("%sit holds in plans of %u trays, with a destination: %d, and W007 is %sfound", text, shortest,
                     reached, finding ? "" : "not ");
        if (finding && finding->plans[0].shown) {
            assert_int_equal(finding->plans[0].length, shortest);
            assert_true(holds(&made, 0, finding->plans[0].trays, shortest));
            assert_false(holds(&made, 1, finding->plans[0].trays, shortest));
        }
        vacuous += finding != NULL;
        close_text(&made);
    }
    assert_true(vacuous > 5);
}

/* ---- specifiers */

static void specifiers(void **state)
{
    (void)state;
    static const char *const widths[] = {"", "1m", "2m", "w < 2m", "1m or 2m", "w > 1m"};
    static const char *const flags[] = {"", "a", "not a"};
    size_t none = 0;
    for (size_t i = 0; i < 6; i++)
        for (size_t k = 0; k < 3; k++) {
            char text[TEXT];
            analysed made;
            bool met = false;
            snprintf(text, sizeof text, "%srule r = neighbour(any, tray(%s%s%s))\nrule s = tray(%s%s%s)\n", schema,
                     widths[i], *widths[i] && *flags[k] ? ", " : "", flags[k], widths[i],
                     *widths[i] && *flags[k] ? ", " : "", flags[k]);
            open_text(&made, text);
            for (tn_tray t = 0; t < made.schema->tray_count; t++)
                met = met || holds(&made, 1, &t, 1);
            assert_int_equal(find(&made, TN_FOUND_NO_TRAY, 0) != NULL, !met);
            assert_int_equal(find(&made, TN_FOUND_NO_TRAY, 1) != NULL, !met);
            none += !met;
            close_text(&made);
        }
    assert_int_equal(none, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(distances), cmocka_unit_test(specifiers)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
