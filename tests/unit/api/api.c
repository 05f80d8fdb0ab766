/* The C interface, as a program that embeds Tartan sees it. */
#include "include/tartan/tartan.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char rules_text[] = "schema box \"boxes\" {\n"
                                 "  width = 1m | 2m\n"
                                 "  lid = flag\n"
                                 "}\n"
                                 "rule pair \"two lids side by side\" = neighbour(tray(lid), tray(lid))\n"
                                 "rule wide allow W019 = tray(2m)\n"
                                 "library rows \"rows of boxes\" using box {\n"
                                 "  trays 1..3\n"
                                 "  prune pair\n"
                                 "}\n";

/* Trays in schema order: 1m, 1m lid, 2m, 2m lid. */
enum { SMALL, SMALL_LID, LARGE, LARGE_LID };

typedef struct seen {
    size_t errors, warnings;
    char code[8], path[32], help[200];
    size_t line, column;
} seen;

static void count(void *context, const tartan_diagnostic *diagnostic)
{
    seen *s = context;
    s->errors += diagnostic->severity == TARTAN_ERROR;
    s->warnings += diagnostic->severity == TARTAN_WARNING;
    snprintf(s->code, sizeof s->code, "%s", diagnostic->code);
    snprintf(s->path, sizeof s->path, "%s", diagnostic->path ? diagnostic->path : "");
    snprintf(s->help, sizeof s->help, "%s", diagnostic->help ? diagnostic->help : "");
    s->line = diagnostic->line;
    s->column = diagnostic->column;
}

static tartan_compile_options counting(seen *s)
{
    tartan_compile_options options = tartan_compile_options_init();
    options.report = count;
    options.report_context = s;
    return options;
}

static tartan_module *compile(const char *text)
{
    tartan_error error;
    tartan_module *module = NULL;
    seen s = {0};
    tartan_compile_options options = counting(&s);
    if (tartan_compile_text("box.plan", text, strlen(text), &options, &module, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    assert_int_equal(s.errors + s.warnings, 0);
    return module;
}

static tartan_status open_named(const tartan_module *module, const char *name, uint32_t max_states,
                                tartan_library **library, tartan_error *error)
{
    tartan_library_options options = tartan_library_options_init();
    options.name = name;
    options.max_states = max_states;
    return tartan_library_open(module, &options, NULL, library, error);
}

static void compiles_and_describes(void **state)
{
    (void)state;
    tartan_module *module = compile(rules_text);
    assert_int_equal(tartan_module_rule_count(module), 2);
    assert_string_equal(tartan_module_rule_name(module, 0), "pair");
    assert_string_equal(tartan_module_rule_doc(module, 0), "two lids side by side");
    assert_string_equal(tartan_module_rule_doc(module, 1), "");
    assert_null(tartan_module_rule_name(module, 2));
    assert_int_equal(tartan_module_library_count(module), 1);
    assert_string_equal(tartan_module_library_name(module, 0), "rows");
    assert_string_equal(tartan_module_library_doc(module, 0), "rows of boxes");
    assert_null(tartan_module_library_doc(module, 1));
    tartan_module_free(module);
    assert_string_equal(tartan_version(), TARTAN_VERSION);
}

static void says_what_is_wrong(void **state)
{
    (void)state;
    static const char wrong[] = "schema box { width = 1m | 2m }\nrule wide = tray(3m)\n";
    tartan_error error;
    tartan_module *module = NULL;
    seen s = {0};
    tartan_compile_options options = counting(&s);
    assert_int_equal(tartan_compile_text("box.plan", wrong, sizeof wrong - 1, &options, &module, &error),
                     TARTAN_INVALID);
    assert_null(module);
    assert_int_equal(s.errors, 1);
    assert_string_equal(s.path, "box.plan");
    assert_int_equal(s.line, 2);
    assert_int_equal(s.column, 18);
    assert_int_equal(s.code[0], 'E');
    assert_int_equal(error.status, TARTAN_INVALID);
    assert_true(error.code > 0 && error.message[0]);
    /* nobody has to listen */
    assert_int_equal(tartan_compile_text("box.plan", wrong, sizeof wrong - 1, NULL, &module, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_compile_file("/nowhere/box.plan", NULL, &module, &error), TARTAN_IO);
    assert_true(error.message[0]);
}

/* Texts by a table: no file is opened. */
static tartan_status from_table(void *context, const tartan_use *use, tartan_text *found, tartan_error *error)
{
    ++*(int *)context;
    static const char shared[] = "schema box { lid = flag }\nrule open = tray(lid)\n";
    if (strcmp(use->path, "shared") != 0) {
        snprintf(error->message, sizeof error->message, "the table has no %s", use->path);
        return TARTAN_INVALID;
    }
    assert_string_equal(use->extension, ".plan");
    assert_string_equal(use->user, "main.plan");
    *found = (tartan_text){.text = shared, .size = sizeof shared - 1};
    return TARTAN_OK;
}

static void asks_the_resolver(void **state)
{
    (void)state;
    static const char good[] = "use \"shared\"\nrule shut = not open\n", bad[] = "use \"other\"\n";
    tartan_compile_options options = tartan_compile_options_init();
    tartan_module *module = NULL;
    tartan_error error;
    int asked = 0;
    options.resolve = from_table;
    options.resolve_context = &asked;
    if (tartan_compile_text("main.plan", good, sizeof good - 1, &options, &module, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    assert_int_equal(asked, 1);
    assert_int_equal(tartan_module_rule_count(module), 2);
    tartan_module_free(module);
    module = NULL;
    assert_int_equal(tartan_compile_text("main.plan", bad, sizeof bad - 1, &options, &module, &error), TARTAN_INVALID);
    assert_string_equal(error.message, "the table has no other");
    assert_null(module);
}

static void saves_and_loads(void **state)
{
    (void)state;
    tartan_module *module = compile(rules_text), *again = NULL;
    tartan_error error;
    size_t size;
    const void *bytes = tartan_module_bytes(module, &size);
    assert_int_equal(tartan_module_load(bytes, size, &again, &error), TARTAN_OK);
    assert_string_equal(tartan_module_rule_name(again, 1), "wide");
    tartan_module_free(again);
    again = NULL;
    assert_int_equal(tartan_module_load(bytes, size - 1, &again, &error), TARTAN_INVALID);
    assert_int_equal(tartan_module_load("", 0, &again, NULL), TARTAN_INVALID);
    assert_null(again);
    /* a module is not a rule file */
    assert_int_equal(tartan_compile_text("box.plan", bytes, size, NULL, &again, &error), TARTAN_INVALID);
    assert_int_equal(tartan_module_load_file("/nowhere/box.tnb", &again, &error), TARTAN_IO);
    tartan_module_free(module);
    tartan_module_free(NULL);
}

static void matches(void **state)
{
    (void)state;
    tartan_module *module = compile(rules_text);
    tartan_error error;
    tartan_rules *rules = NULL;
    tartan_matcher *matcher = NULL;
    assert_int_equal(tartan_rules_new(module, NULL, 0, NULL, &rules, &error), TARTAN_OK);
    assert_int_equal(tartan_rules_count(rules), 2);
    assert_string_equal(tartan_rules_name(rules, 1), "wide");
    assert_null(tartan_rules_name(rules, 2));
    assert_int_equal(tartan_rules_words(rules), 1);
    assert_string_equal(tartan_schema_name(tartan_rules_schema(rules)), "box");
    assert_int_equal(tartan_schema_tray_count(tartan_rules_schema(rules)), 4);
    assert_int_equal(tartan_matcher_new(rules, &matcher, &error), TARTAN_OK);
    uint64_t bits = UINT64_MAX;
    assert_int_equal(tartan_match(matcher, (uint32_t[]){SMALL_LID, SMALL_LID}, 2, &bits, &error), TARTAN_OK);
    assert_int_equal(bits, 1);
    assert_int_equal(tartan_match(matcher, (uint32_t[]){SMALL_LID, LARGE}, 2, &bits, &error), TARTAN_OK);
    assert_int_equal(bits, 2);
    assert_int_equal(tartan_match(matcher, NULL, 0, &bits, &error), TARTAN_OK);
    assert_int_equal(bits, 0);
    assert_int_equal(tartan_match(matcher, (uint32_t[]){4}, 1, &bits, &error), TARTAN_INVALID);
    tartan_matcher_free(matcher);
    tartan_rules_free(rules);

    const char *one[] = {"wide"}, *none[] = {"wied"};
    assert_int_equal(tartan_rules_new(module, one, 1, NULL, &rules, &error), TARTAN_OK);
    assert_string_equal(tartan_rules_name(rules, 0), "wide");
    tartan_rules_free(rules);
    assert_int_equal(tartan_rules_new(module, none, 1, NULL, &rules, &error), TARTAN_INVALID);
    assert_non_null(strstr(error.message, "wied"));
    assert_string_equal(error.help, "did you mean `wide`?");
    tartan_module_free(module);
}

static void matches_many(void **state)
{
    (void)state;
    enum { PLANS = 10000 }; /* some shares of threads */
    tartan_module *module = compile(rules_text);
    tartan_error error;
    tartan_rules *rules = NULL;
    uint32_t *trays = malloc(PLANS * 3 * sizeof *trays);
    size_t ends[PLANS], at = 0;
    uint64_t bits[2][PLANS];
    assert_non_null(trays);
    for (size_t i = 0; i < PLANS; i++) {
        for (size_t k = 0; k < i % 4; k++)
            trays[at++] = (uint32_t)((i * 7 + k * 3) % 4);
        ends[i] = at;
    }
    assert_int_equal(tartan_rules_new(module, NULL, 0, NULL, &rules, &error), TARTAN_OK);
    assert_int_equal(tartan_match_all(rules, trays, ends, PLANS, 1, bits[0], NULL, &error), TARTAN_OK);
    assert_int_equal(tartan_match_all(rules, trays, ends, PLANS, 3, bits[1], NULL, &error), TARTAN_OK);
    assert_memory_equal(bits[0], bits[1], sizeof bits[0]);
    tartan_matcher *matcher = NULL;
    assert_int_equal(tartan_matcher_new(rules, &matcher, &error), TARTAN_OK);
    for (size_t i = 0; i < PLANS; i++) {
        uint64_t alone;
        size_t begin = i ? ends[i - 1] : 0;
        assert_int_equal(tartan_match(matcher, trays + begin, ends[i] - begin, &alone, &error), TARTAN_OK);
        assert_int_equal(alone, bits[0][i]);
    }
    tartan_matcher_free(matcher);
    assert_int_equal(tartan_match_all(rules, trays, ends, 0, 0, bits[0], NULL, &error), TARTAN_OK);
    for (unsigned threads = 1; threads <= 4; threads++) {
        uint8_t matches[PLANS];
        memset(matches, 7, sizeof matches);
        assert_int_equal(tartan_match_any(rules, trays, ends, PLANS, threads, matches, NULL, &error), TARTAN_OK);
        for (size_t i = 0; i < PLANS; i++)
            assert_int_equal(matches[i], bits[0][i] != 0);
    }

    assert_int_equal(tartan_match_all(rules, trays, ends, PLANS, UINT32_MAX, bits[1], NULL, &error), TARTAN_OK);
    assert_memory_equal(bits[0], bits[1], sizeof bits[0]);

    /* the first plan that is wrong is the one that the error is about, in however many threads */
    trays[ends[9700] + 0] = 9;
    trays[ends[5100] + 1] = 8;
    for (unsigned threads = 1; threads <= 4; threads++) {
        assert_int_equal(tartan_match_all(rules, trays, ends, PLANS, threads, bits[0], NULL, &error), TARTAN_INVALID);
        assert_non_null(strstr(error.message, "plan 5103: tray 1 of the plan has number 8"));
        uint8_t matches[PLANS];
        assert_int_equal(tartan_match_any(rules, trays, ends, PLANS, threads, matches, NULL, &error), TARTAN_INVALID);
        assert_non_null(strstr(error.message, "number 8"));
    }
    ends[5] = 0;
    assert_int_equal(tartan_match_all(rules, trays, ends, PLANS, 1, bits[0], NULL, &error), TARTAN_INVALID);
    tartan_rules_free(rules);
    free(trays);
    tartan_module_free(module);
}

static void reads_and_writes_plans(void **state)
{
    (void)state;
    tartan_module *module = compile(rules_text);
    tartan_error error;
    tartan_library *library = NULL;
    assert_int_equal(tartan_library_open(module, NULL, NULL, &library, &error), TARTAN_OK);
    const tartan_schema *schema = tartan_library_schema(library);
    uint32_t trays[3];
    size_t length = 9;
    char *line = NULL;
    assert_int_equal(tartan_plan_read(schema, "2m lid | 1m -", 13, trays, 3, &length, &error), TARTAN_OK);
    assert_int_equal(length, 2);
    assert_int_equal(trays[0], LARGE_LID);
    assert_int_equal(trays[1], SMALL);
    assert_int_equal(tartan_plan_write(schema, trays, 2, &line, &error), TARTAN_OK);
    assert_string_equal(line, "2m lid | 1m -");
    tartan_text_free(line);
    assert_int_equal(tartan_plan_write(schema, trays, 0, &line, &error), TARTAN_OK);
    assert_string_equal(line, "");
    tartan_text_free(line);
    assert_int_equal(tartan_plan_read(schema, "", 0, trays, 3, &length, &error), TARTAN_OK);
    assert_int_equal(length, 0);
    assert_int_equal(tartan_plan_read(schema, "2m lid | 3m -", 13, trays, 3, &length, &error), TARTAN_INVALID);
    assert_int_equal(error.column, 10);
    assert_int_equal(tartan_plan_read(schema, "1m - | 1m - | 1m - | 1m -", 25, trays, 3, &length, &error),
                     TARTAN_LIMIT);
    assert_string_equal(error.help, "give it room for more than 3 trays");
    assert_int_equal(tartan_plan_write(schema, (uint32_t[]){7}, 1, &line, &error), TARTAN_INVALID);
    tartan_library_free(library);
    tartan_module_free(module);
}

/* The kept plans, by hand: of 1, 2 and 3 trays 4, 12 and 40 with 2 + 2 kinds of tray, no two lids side by side:
 * a(n) = 2 a(n-1) + 4 a(n-2), a(0) = 1, a(1) = 4, so 4, 12, 40. */
static void opens_a_library(void **state)
{
    (void)state;
    tartan_module *module = compile(rules_text);
    tartan_error error;
    tartan_library *library = NULL;
    char *text = NULL, hash[33];
    assert_int_equal(open_named(module, "rows", 0, &library, &error), TARTAN_OK);
    assert_int_equal(tartan_library_min_trays(library), 1);
    assert_int_equal(tartan_library_max_trays(library), 3);
    tartan_library_hash(library, hash);
    assert_int_equal(strspn(hash, "0123456789abcdef"), 32);
    assert_int_equal(tartan_library_count(library, TARTAN_ANY_LENGTH, &text, &error), TARTAN_OK);
    assert_string_equal(text, "56");
    tartan_text_free(text);
    assert_int_equal(tartan_library_count(library, 2, &text, &error), TARTAN_OK);
    assert_string_equal(text, "12");
    tartan_text_free(text);

    uint32_t trays[3];
    size_t length;
    for (unsigned rank = 0; rank < 56; rank++) {
        char digits[8];
        snprintf(digits, sizeof digits, "%u", rank);
        assert_int_equal(tartan_library_unrank(library, digits, trays, &length, &error), TARTAN_OK);
        assert_int_equal(length, rank < 4 ? 1 : rank < 16 ? 2 : 3);
        assert_int_equal(tartan_library_rank(library, trays, length, &text, &error), TARTAN_OK);
        assert_string_equal(text, digits);
        tartan_text_free(text);
    }
    assert_int_equal(tartan_library_unrank(library, "56", trays, &length, &error), TARTAN_INVALID);
    assert_int_equal(tartan_library_unrank(library, "-1", trays, &length, &error), TARTAN_INVALID);
    assert_int_equal(tartan_library_unrank(library, "", trays, &length, &error), TARTAN_INVALID);
    assert_int_equal(tartan_library_rank(library, (uint32_t[]){SMALL_LID, LARGE_LID}, 2, &text, &error),
                     TARTAN_INVALID);
    assert_int_equal(tartan_library_rank(library, (uint32_t[]){0, 0, 0, 0}, 4, &text, &error), TARTAN_INVALID);
    tartan_library_free(library);
    assert_int_equal(open_named(module, "rows", 1, &library, &error), TARTAN_LIMIT);
    assert_int_equal(error.code, 802);
    assert_non_null(strstr(error.help, "--max-states"));
    assert_int_equal(open_named(module, "rows", 1000, &library, &error), TARTAN_OK);
    assert_int_equal(tartan_library_count(library, TARTAN_ANY_LENGTH, &text, &error), TARTAN_OK);
    assert_string_equal(text, "56");
    tartan_text_free(text);
    tartan_library_free(library);
    assert_int_equal(open_named(module, "columns", 0, &library, &error), TARTAN_INVALID);
    tartan_module_free(module);
}

static void walks_and_samples(void **state)
{
    (void)state;
    tartan_module *module = compile(rules_text);
    tartan_error error;
    tartan_library *library = NULL;
    tartan_plans *plans = NULL;
    const uint32_t *trays;
    size_t length, found = 0;
    assert_int_equal(tartan_library_open(module, NULL, NULL, &library, &error), TARTAN_OK);
    assert_int_equal(tartan_library_plans(library, NULL, NULL, &plans, &error), TARTAN_OK);
    while (tartan_plans_next(plans, &trays, &length))
        found++;
    assert_int_equal(found, 56);
    tartan_plans_free(plans);

    assert_int_equal(tartan_library_plans(library, "3", "5", &plans, &error), TARTAN_OK);
    assert_true(tartan_plans_next(plans, &trays, &length));
    assert_int_equal(length, 1);
    assert_int_equal(trays[0], LARGE_LID);
    assert_true(tartan_plans_next(plans, &trays, &length));
    assert_int_equal(length, 2);
    assert_false(tartan_plans_next(plans, &trays, &length));
    tartan_plans_free(plans);
    assert_int_equal(tartan_library_plans(library, "99999999999999999999999", NULL, &plans, &error), TARTAN_OK);
    assert_false(tartan_plans_next(plans, &trays, &length));
    tartan_plans_free(plans);
    assert_int_equal(tartan_library_plans(library, "one", NULL, &plans, &error), TARTAN_INVALID);

    uint32_t first[2][5] = {{0}};
    for (size_t run = 0; run < 2; run++) {
        assert_int_equal(tartan_library_sample(library, 42, 3, 5, &plans, &error), TARTAN_OK);
        for (size_t i = 0; i < 5; i++) {
            assert_true(tartan_plans_next(plans, &trays, &length));
            assert_int_equal(length, 3);
            first[run][i] = trays[0] * 16 + trays[1] * 4 + trays[2];
            if (i)
                assert_true(first[run][i] > first[run][i - 1]);
        }
        assert_false(tartan_plans_next(plans, &trays, &length));
        tartan_plans_free(plans);
    }
    assert_memory_equal(first[0], first[1], sizeof first[0]);
    assert_int_equal(tartan_library_sample(library, 1, TARTAN_ANY_LENGTH, SIZE_MAX, &plans, &error), TARTAN_OK);
    for (found = 0; tartan_plans_next(plans, &trays, &length); found++)
        continue;
    assert_int_equal(found, 56);
    tartan_plans_free(plans);
    tartan_library_free(library);
    tartan_module_free(module);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(compiles_and_describes),
        cmocka_unit_test(says_what_is_wrong),
        cmocka_unit_test(asks_the_resolver),
        cmocka_unit_test(saves_and_loads),
        cmocka_unit_test(matches),
        cmocka_unit_test(matches_many),
        cmocka_unit_test(reads_and_writes_plans),
        cmocka_unit_test(opens_a_library),
        cmocka_unit_test(walks_and_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
