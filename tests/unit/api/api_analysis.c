/* Explaining, analysing, comparing and drawing plans through the C interface, and cancelling these. */
#include "include/tartan/tartan.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Trays: 1m, 1m lid, 2m, 2m lid. */
static const char before_text[] = "schema box { width = 1m | 2m  lid = flag }\n"
                                  "rule pair \"two lids\" = neighbour(tray(lid), tray(lid))\n"
                                  "rule wide = tray(2m)\n"
                                  "rule wide-lid = tray(2m, lid)\n"
                                  "library rows using box { trays 1..3 prune pair }\n";
static const char after_text[] = "schema box { width = 1m | 2m  lid = flag }\n"
                                 "rule pair = neighbour(tray(lid), tray(lid))\n"
                                 "rule wide = tray(2m)\n"
                                 "library rows using box { trays 1..3 prune pair, wide }\n";

static tartan_module *compile(const char *text)
{
    tartan_module *module = NULL;
    tartan_error error;
    if (tartan_compile_text("box.plan", text, strlen(text), NULL, &module, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return module;
}

static void explains(void **state)
{
    (void)state;
    tartan_module *module = compile(before_text);
    tartan_explanation *why = NULL;
    tartan_verdict verdict = tartan_verdict_init();
    tartan_part part = tartan_part_init();
    tartan_error error;
    uint32_t trays[] = {0, 1, 3};
    assert_int_equal(tartan_explain_library(module, NULL, trays, 3, NULL, &why, &error), TARTAN_OK);
    memset(trays, 0, sizeof trays); /* they were copied */
    assert_false(tartan_explanation_kept(why) || tartan_explanation_length_drops(why));
    assert_int_equal(tartan_explanation_count(why), 1);
    assert_int_equal(tartan_explanation_verdict(why, 0, &verdict, &error), TARTAN_OK);
    assert_true(verdict.matches && verdict.drops && verdict.prunes && verdict.part_count >= 3);
    assert_string_equal(verdict.name, "pair");
    assert_string_equal(verdict.doc, "two lids");
    bool found = false;
    for (size_t i = 0; i < verdict.part_count; i++) {
        assert_int_equal(tartan_explanation_part(why, 0, i, &part, &error), TARTAN_OK);
        assert_true(part.parent == TARTAN_NO_PART || part.parent < i);
        if (strcmp(part.kind, "neighbour") == 0) {
            found = true;
            assert_string_equal(part.text, "neighbour(tray(lid), tray(lid))");
            assert_true(part.matched && part.stretch_count == 1 && part.stretches[0].begin == 1 &&
                        part.stretches[0].end == 3);
            assert_string_equal(part.path, "box.plan");
            assert_memory_equal(before_text + part.source_begin, "neighbour(", 10);
        }
    }
    assert_true(found);
    assert_int_equal(tartan_explanation_part(why, 0, verdict.part_count, &part, &error), TARTAN_INVALID);
    assert_int_equal(tartan_explanation_verdict(why, 1, &verdict, &error), TARTAN_INVALID);
    tartan_explanation_free(why);
    why = NULL;
    const char *names[] = {"wide", "pair"};
    assert_int_equal(tartan_explain_rules(module, names, 2, (uint32_t[]){2}, 1, NULL, &why, &error), TARTAN_OK);
    assert_int_equal(tartan_explanation_verdict(why, 0, &verdict, &error), TARTAN_OK);
    assert_true(verdict.matches && !verdict.drops);
    assert_int_equal(tartan_explanation_verdict(why, 1, &verdict, &error), TARTAN_OK);
    assert_false(verdict.matches);
    tartan_explanation_free(why);
    why = NULL;
    assert_int_equal(tartan_explain_rules(module, NULL, 0, (uint32_t[]){4}, 1, NULL, &why, &error), TARTAN_INVALID);
    assert_int_equal(tartan_explain_rules(module, NULL, 0, NULL, 1, NULL, &why, &error), TARTAN_INVALID);
    assert_int_equal(tartan_explain_library(NULL, NULL, NULL, 0, NULL, &why, &error), TARTAN_INVALID);
    assert_null(why);

    tartan_near *near = NULL;
    size_t length;
    assert_int_equal(tartan_near_find(module, "rows", (uint32_t[]){0, 1, 3}, 3, 10, NULL, &near, &error), TARTAN_OK);
    assert_int_equal(tartan_near_cost(near), 1);
    assert_int_equal(tartan_near_count(near), 2); /* either lid goes */
    assert_false(tartan_near_more(near));
    assert_memory_equal(tartan_near_plan(near, 0, &length), ((uint32_t[]){0, 0, 3}), 3 * sizeof(uint32_t));
    assert_int_equal(length, 3);
    assert_null(tartan_near_plan(near, 2, &length));
    tartan_near_free(near);
    tartan_module_free(module);
}

static void analyses(void **state)
{
    (void)state;
    tartan_module *module = compile(before_text);
    tartan_analysis *analysis = NULL;
    tartan_error error;
    assert_int_equal(tartan_analysis_new(module, 0, NULL, &analysis, &error), TARTAN_OK);
    assert_int_equal(tartan_analysis_rule_count(analysis), 3);
    assert_string_equal(tartan_analysis_rule_name(analysis, 1), "wide");
    assert_null(tartan_analysis_rule_name(analysis, 3));
    assert_int_equal(tartan_analysis_relation(analysis, 2, 1), TARTAN_RULES_INSIDE);
    assert_int_equal(tartan_analysis_relation(analysis, 1, 2), TARTAN_RULES_CONTAINS);
    assert_int_equal(tartan_analysis_relation(analysis, 0, 1), TARTAN_RULES_OVERLAP);
    assert_int_equal(tartan_analysis_relation(analysis, 0, 3), TARTAN_RULES_UNKNOWN);
    bool found = false;
    for (size_t i = 0; i < tartan_analysis_count(analysis); i++) {
        tartan_finding finding = tartan_finding_init();
        assert_int_equal(tartan_analysis_finding(analysis, i, &finding, &error), TARTAN_OK);
        if (finding.kind != TARTAN_FOUND_SUBSUMED)
            continue;
        found = true;
        assert_string_equal(finding.rule, "wide-lid");
        assert_string_equal(finding.other, "wide");
        assert_true(finding.tray_count == 1 && finding.trays[0] == 2);
        assert_string_equal(finding.path, "box.plan");
    }
    assert_true(found);
    tartan_finding none = tartan_finding_init();
    assert_int_equal(tartan_analysis_finding(analysis, 1000, &none, &error), TARTAN_INVALID);
    tartan_analysis_free(analysis);
    tartan_module_free(module);
}

static void assert_count(const tartan_library *library, const char *wanted)
{
    char *count;
    assert_int_equal(tartan_library_count(library, TARTAN_ANY_LENGTH, &count, NULL), TARTAN_OK);
    assert_string_equal(count, wanted);
    tartan_text_free(count);
}

/* Of 4 + 12 + 36... the numbers are counted by hand: rows without two lids side by side, of which those without 2 m. */
static void compares(void **state)
{
    (void)state;
    tartan_module *modules[2] = {compile(before_text), compile(after_text)};
    tartan_library *libraries[2] = {NULL, NULL};
    tartan_diff *diff = NULL;
    tartan_error error;
    for (int i = 0; i < 2; i++)
        assert_int_equal(tartan_library_open(modules[i], NULL, NULL, &libraries[i], &error), TARTAN_OK);
    assert_count(libraries[0], "56");
    assert_count(libraries[1], "10");
    assert_int_equal(tartan_diff_new(libraries[0], libraries[1], NULL, &diff, &error), TARTAN_OK);
    assert_count(tartan_diff_removed(diff), "46");
    assert_count(tartan_diff_added(diff), "0");
    assert_count(tartan_diff_kept(diff), "10");
    assert_int_equal(tartan_library_clause_count(tartan_diff_kept(diff)), 0);
    assert_null(tartan_library_clause_name(tartan_diff_kept(diff), 0));
    uint32_t trays[3];
    size_t length;
    assert_int_equal(tartan_library_unrank(tartan_diff_removed(diff), "0", trays, &length, &error), TARTAN_OK);
    assert_true(length == 1 && trays[0] == 2);
    tartan_changed_clause clause = tartan_changed_clause_init();
    assert_int_equal(tartan_diff_clause_count(diff), 1);
    assert_int_equal(tartan_diff_clause(diff, 0, &clause, &error), TARTAN_OK);
    assert_int_equal(clause.change, TARTAN_ADDED);
    assert_string_equal(clause.name, "wide");
    assert_string_equal(clause.removes, "46");
    assert_int_equal(tartan_diff_clause(diff, 1, &clause, &error), TARTAN_INVALID);
    tartan_diff *again = NULL;
    assert_int_equal(tartan_diff_new(tartan_diff_kept(diff), libraries[1], NULL, &again, &error), TARTAN_INVALID);
    assert_int_equal(tartan_diff_new(NULL, libraries[1], NULL, &again, &error), TARTAN_INVALID);
    tartan_diff_free(diff);

    char *out, *only;
    assert_string_equal(tartan_library_clause_name(libraries[1], 1), "wide");
    assert_true(tartan_library_clause_prunes(libraries[1], 1));
    assert_int_equal(tartan_library_clause_effect(libraries[1], 1, &out, &only, &error), TARTAN_OK);
    assert_string_equal(only, "46");
    tartan_text_free(out);
    tartan_text_free(only);
    assert_int_equal(tartan_library_clause_effect(libraries[1], 2, &out, &only, &error), TARTAN_INVALID);
    for (int i = 0; i < 2; i++) {
        tartan_library_free(libraries[i]);
        tartan_module_free(modules[i]);
    }
}

static void draws_plans(void **state)
{
    (void)state;
    tartan_module *module = compile(before_text);
    tartan_rules *rules = NULL;
    tartan_error error;
    void *bytes = NULL;
    size_t size = 0;
    const uint32_t trays[] = {0, 3, 1};
    const size_t ends[] = {2, 3}, wrong[] = {2, 1};
    assert_int_equal(tartan_rules_new(module, NULL, 0, NULL, &rules, &error), TARTAN_OK);
    const tartan_schema *schema = tartan_rules_schema(rules);
    static const char *const begins[] = {"<?xml", "\x89PNG", "%PDF", "0\nSECTION"};
    for (int format = TARTAN_SVG; format <= TARTAN_DRAWN_DXF; format++) {
        assert_int_equal(
            tartan_plans_draw(schema, trays, ends, 2, (tartan_picture_format)format, NULL, NULL, &bytes, &size, &error),
            TARTAN_OK);
        assert_memory_equal(bytes, begins[format], strlen(begins[format]));
        tartan_bytes_free(bytes);
        bytes = NULL;
    }
    tartan_plans_drawing drawing = tartan_plans_drawing_init();
    drawing.profile = "us";
    assert_int_equal(tartan_plans_draw(schema, trays, ends, 2, TARTAN_SVG, &drawing, NULL, &bytes, &size, &error),
                     TARTAN_INVALID);
    assert_int_equal(tartan_plans_draw(schema, trays, ends, 2, TARTAN_DRAWN_DXF, &drawing, NULL, &bytes, &size, &error),
                     TARTAN_OK);
    assert_non_null(strstr(bytes, "\nA-ANNO-TTLB\n"));
    tartan_bytes_free(bytes);
    bytes = NULL;
    drawing.profile = "din";
    assert_int_equal(tartan_plans_draw(schema, trays, ends, 2, TARTAN_DRAWN_DXF, &drawing, NULL, &bytes, &size, &error),
                     TARTAN_INVALID);
    drawing.profile = NULL;
    drawing.paper = "napkin";
    assert_int_equal(tartan_plans_draw(schema, trays, ends, 2, TARTAN_SVG, &drawing, NULL, &bytes, &size, &error),
                     TARTAN_INVALID);
    assert_int_equal(tartan_plans_draw(schema, trays, wrong, 2, TARTAN_SVG, NULL, NULL, &bytes, &size, &error),
                     TARTAN_INVALID);
    assert_int_equal(tartan_plans_draw(NULL, trays, ends, 2, TARTAN_SVG, NULL, NULL, &bytes, &size, &error),
                     TARTAN_INVALID);
    assert_null(bytes);
    tartan_rules_free(rules);
    tartan_module_free(module);
}

static bool refuse(void *context, double done, double total)
{
    (void)done, (void)total;
    ++*(int *)context;
    return false;
}

static void can_be_stopped(void **state)
{
    (void)state;
    tartan_module *module = compile(before_text);
    tartan_library *library = NULL, *other = NULL;
    tartan_rules *rules = NULL;
    tartan_analysis *analysis = NULL;
    tartan_diff *diff = NULL;
    tartan_error error;
    int asked = 0;
    uint8_t matches[1];
    tartan_watch watch = tartan_watch_init();
    watch.go_on = refuse;
    watch.context = &asked;
    assert_int_equal(tartan_library_open(module, NULL, &watch, &library, &error), TARTAN_STOPPED);
    assert_int_equal(tartan_rules_new(module, NULL, 0, &watch, &rules, &error), TARTAN_STOPPED);
    assert_int_equal(tartan_analysis_new(module, 0, &watch, &analysis, &error), TARTAN_STOPPED);
    assert_int_equal(asked, 3);
    assert_true(!library && !rules && !analysis);
    assert_int_equal(tartan_library_open(module, NULL, NULL, &library, &error), TARTAN_OK);
    assert_int_equal(tartan_library_open(module, NULL, NULL, &other, &error), TARTAN_OK);
    assert_int_equal(tartan_diff_new(library, other, &watch, &diff, &error), TARTAN_STOPPED);
    assert_null(diff);
    assert_count(library, "56"); /* as it was */
    assert_int_equal(tartan_rules_new(module, NULL, 0, NULL, &rules, &error), TARTAN_OK);
    assert_int_equal(tartan_match_any(rules, (uint32_t[]){0}, (size_t[]){1}, 1, 1, matches, &watch, &error),
                     TARTAN_STOPPED);
    tartan_rules_free(rules);
    tartan_library_free(other);
    tartan_library_free(library);
    tartan_module_free(module);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(explains),    cmocka_unit_test(analyses),       cmocka_unit_test(compares),
        cmocka_unit_test(draws_plans), cmocka_unit_test(can_be_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
