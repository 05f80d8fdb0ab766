/* Measures through the C interface, against the list of all plans. */
#include "include/tartan/tartan.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Trays: 1m, 1m lid, 2m, 2m lid. */
static const char text[] = "schema box { width = 1m | 2m  lid = flag }\n"
                           "rule pair \"two lids\" = neighbour(tray(lid), tray(lid))\n"
                           "library rows using box { trays 1..3 prune pair }\n"
                           "library none using box { trays 1..1 require pair }\n"
                           "measure long = sum(width)\n"
                           "measure lids = quantity(tray(lid))\n"
                           "measure third = sum(width) / 3m\n"
                           "measure most = max(width)\n"
                           "measure half = sum(width) / 2 - 25%  * sum(width)\n";

typedef struct setting {
    tartan_module *module;
    tartan_library *library;
} setting;

static int open_library(void **state)
{
    static setting s;
    tartan_error error;
    tartan_library_options options = tartan_library_options_init();
    options.name = "rows";
    if (tartan_compile_text("box.plan", text, sizeof text - 1, NULL, &s.module, &error) != TARTAN_OK ||
        tartan_library_open(s.module, &options, NULL, &s.library, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    *state = &s;
    return 0;
}

static int close_library(void **state)
{
    setting *s = *state;
    tartan_library_free(s->library);
    tartan_module_free(s->module);
    return 0;
}

static unsigned metres(const uint32_t *trays, size_t length)
{
    unsigned sum = 0;
    for (size_t i = 0; i < length; i++)
        sum += 1 + trays[i] / 2;
    return sum;
}

static unsigned lids(const uint32_t *trays, size_t length)
{
    unsigned sum = 0;
    for (size_t i = 0; i < length; i++)
        sum += trays[i] % 2;
    return sum;
}

/* How many plans are as long and have as many lids; lids 9: any. */
static unsigned plans_with(const setting *s, unsigned long_, unsigned lids_)
{
    tartan_plans *plans;
    const uint32_t *trays;
    size_t length;
    unsigned found = 0;
    assert_int_equal(tartan_library_plans(s->library, NULL, NULL, &plans, NULL), TARTAN_OK);
    while (tartan_plans_next(plans, &trays, &length))
        found += metres(trays, length) == long_ && (lids_ == 9 || lids(trays, length) == lids_);
    tartan_plans_free(plans);
    return found;
}

static void statistic_is(const tartan_distribution *d, tartan_statistic which, const char *wanted)
{
    char *value = NULL;
    assert_int_equal(tartan_distribution_statistic(d, which, &value, NULL), TARTAN_OK);
    assert_string_equal(value, wanted);
    tartan_text_free(value);
}

/* Every third of a tray that follows another: values that no double has. */
static void measures_plans(void **state)
{
    const setting *s = *state;
    enum { ROOM = 6 };
    tartan_plans *plans;
    uint32_t trays[ROOM];
    size_t ends[ROOM], taken, all = 0;
    double values[ROOM];
    tartan_error error;
    char *kept;
    assert_int_equal(tartan_library_plans(s->library, NULL, NULL, &plans, NULL), TARTAN_OK);
    assert_int_equal(tartan_plans_take(plans, ROOM, trays, 2, ends), 0); /* a plan may have three trays */
    while ((taken = tartan_plans_take(plans, ROOM, trays, ROOM, ends)) > 0) {
        assert_true(taken <= ROOM && ends[taken - 1] <= ROOM);
        assert_int_equal(tartan_measure_plans(s->library, "third", trays, ends, taken, NULL, values, &error),
                         TARTAN_OK);
        for (size_t i = 0, begin = 0; i < taken; begin = ends[i++]) {
            char *said, *over;
            unsigned third = metres(trays + begin, ends[i] - begin);
            assert_true(values[i] == third / 3.0);
            assert_int_equal(tartan_measure_plan(s->library, "third", trays + begin, ends[i] - begin, &said, NULL),
                             TARTAN_OK);
            over = strchr(said, '/');
            assert_int_equal(strtoul(said, NULL, 10) * 3, third * (over ? strtoul(over + 1, NULL, 10) : 1));
            tartan_text_free(said);
        }
        all += taken;
    }
    tartan_plans_free(plans);
    assert_int_equal(tartan_library_count(s->library, TARTAN_ANY_LENGTH, &kept, NULL), TARTAN_OK);
    assert_int_equal(strtoul(kept, NULL, 10), all);
    tartan_text_free(kept);
}

static void measures_other_plans(void **state)
{
    const setting *s = *state;
    const uint32_t lids_[] = {1, 1, 1}, wrong[] = {4}; /* the library drops the first; there is no tray 4 */
    const size_t end = 3, ends[] = {3, 2};
    double value[2];
    static char before[] = "as it was";
    char *said = before;
    tartan_error error;
    assert_int_equal(tartan_measure_plans(s->library, "lids", lids_, &end, 1, NULL, value, &error), TARTAN_OK);
    assert_true(value[0] == 3);
    assert_int_equal(tartan_measure_plans(s->library, "most", NULL, &(size_t){0}, 1, NULL, value, &error), TARTAN_OK);
    assert_true(value[0] != value[0]);
    assert_int_equal(tartan_measure_plan(s->library, "most", NULL, 0, &said, NULL), TARTAN_OK);
    assert_null(said);
    assert_int_equal(tartan_measure_plan(s->library, "lids", wrong, 1, &said, &error), TARTAN_INVALID);
    assert_non_null(strstr(error.message, "number 4"));
    assert_int_equal(tartan_measure_plan(s->library, "lid", lids_, 3, &said, &error), TARTAN_INVALID);
    assert_non_null(strstr(error.help, "lids"));
    assert_int_equal(tartan_measure_plan(NULL, "lids", lids_, 3, &said, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_measure_plan(s->library, "lids", NULL, 3, &said, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_measure_plans(s->library, "lids", lids_, ends, 2, NULL, value, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_measure_plans(s->library, "lids", NULL, &end, 1, NULL, value, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_measure_plans(s->library, "lids", lids_, &end, 1, NULL, NULL, NULL), TARTAN_INVALID);
    assert_null(said);
}

static void tells_fields(void **state)
{
    const setting *s = *state;
    const tartan_schema *schema = tartan_library_schema(s->library);
    tartan_field field = tartan_field_init();
    tartan_value value = tartan_value_init();
    tartan_error error;
    uint32_t widths[4];
    assert_int_equal(tartan_schema_field_count(schema), 2);
    assert_int_equal(tartan_schema_field(schema, 0, &field, NULL), TARTAN_OK);
    assert_string_equal(field.name, "width");
    assert_true(field.kind == TARTAN_FIELD_LENGTH && field.value_count == 2);
    assert_int_equal(tartan_schema_field(schema, 1, &field, NULL), TARTAN_OK);
    assert_true(field.kind == TARTAN_FIELD_FLAG);
    assert_int_equal(tartan_schema_value(schema, 0, 1, &value, NULL), TARTAN_OK);
    assert_string_equal(value.spelling, "2m");
    assert_true(value.length == INT64_C(2000000000));
    assert_int_equal(tartan_schema_value(schema, 1, 0, &value, NULL), TARTAN_OK);
    assert_string_equal(value.name, "-");
    assert_int_equal(tartan_schema_trays(schema, 0, widths, NULL), TARTAN_OK);
    assert_true(widths[0] == 0 && widths[1] == 0 && widths[2] == 1 && widths[3] == 1);
    assert_int_equal(tartan_schema_field(schema, 2, &field, &error), TARTAN_INVALID);
    assert_int_equal(tartan_schema_value(schema, 0, 2, &value, &error), TARTAN_INVALID);
    assert_non_null(strstr(error.message, "`width` has no value 2"));
    assert_int_equal(tartan_schema_trays(schema, 2, widths, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_schema_trays(NULL, 0, widths, NULL), TARTAN_INVALID);
}

/* What is asked for besides is counted as if it stood in the library. */
static void asks_for_more(void **state)
{
    const setting *s = *state;
    const char *wheres[] = {"quantity(tray(lid), n = 1)"}, *wrong[] = {"quantity(tray(lit), n = 1)"};
    tartan_module *module = NULL;
    tartan_library *library;
    tartan_library_options options = tartan_library_options_init();
    tartan_error error;
    char *count;
    unsigned with = 0;
    for (unsigned i = 1; i <= 6; i++)
        with += plans_with(s, i, 1);
    assert_int_equal(tartan_compile_where("box.plan", text, sizeof text - 1, NULL, "rows", wheres, 1, &module, &error),
                     TARTAN_OK);
    options.name = "rows";
    assert_int_equal(tartan_library_open(module, &options, NULL, &library, &error), TARTAN_OK);
    assert_int_equal(tartan_library_count(library, TARTAN_ANY_LENGTH, &count, NULL), TARTAN_OK);
    assert_int_equal(strtoul(count, NULL, 10), with);
    assert_string_equal(tartan_library_clause_name(library, 1), "where@1");
    tartan_text_free(count);
    tartan_library_free(library);
    tartan_module_free(module);
    module = NULL;
    assert_int_equal(tartan_compile_where("box.plan", text, sizeof text - 1, NULL, "rows", wrong, 1, &module, &error),
                     TARTAN_INVALID);
    assert_non_null(strstr(error.message, "lit"));
    assert_int_equal(tartan_compile_where("box.plan", text, sizeof text - 1, NULL, "rows", NULL, 1, &module, &error),
                     TARTAN_INVALID);
    assert_null(module);
}

static void spreads(void **state)
{
    const setting *s = *state;
    tartan_distribution *d = NULL;
    tartan_error error;
    assert_string_equal(tartan_measure_unit(s->library, "long"), "m");
    assert_string_equal(tartan_measure_unit(s->library, "lids"), "");
    assert_null(tartan_measure_unit(s->library, "short"));
    assert_int_equal(tartan_distribution_new(s->library, "long", &d, &error), TARTAN_OK);
    assert_int_equal(tartan_distribution_count(d), 6);
    unsigned long sum = 0, all = 0;
    for (size_t i = 0; i < 6; i++) {
        char *value, *plans;
        assert_int_equal(tartan_distribution_value(d, i, &value, &plans, &error), TARTAN_OK);
        assert_int_equal(strtoul(value, NULL, 10), i + 1);
        assert_int_equal(strtoul(plans, NULL, 10), plans_with(s, (unsigned)i + 1, 9));
        sum += (i + 1) * strtoul(plans, NULL, 10);
        all += strtoul(plans, NULL, 10);
        tartan_text_free(value);
        tartan_text_free(plans);
    }
    char *mean;
    assert_int_equal(tartan_distribution_statistic(d, TARTAN_MEAN, &mean, &error), TARTAN_OK);
    char *over = strchr(mean, '/');
    assert_int_equal(strtoul(mean, NULL, 10) * all, sum * (over ? strtoul(over + 1, NULL, 10) : 1));
    tartan_text_free(mean);
    statistic_is(d, TARTAN_LEAST, "1");
    statistic_is(d, TARTAN_MOST, "6");
    statistic_is(d, TARTAN_MEDIAN, "4");
    assert_int_equal(tartan_distribution_value(d, 6, &mean, &mean, &error), TARTAN_INVALID);
    assert_int_equal(tartan_distribution_statistic(d, (tartan_statistic)7, &mean, &error), TARTAN_INVALID);
    tartan_distribution_free(d);
    assert_int_equal(tartan_distribution_new(s->library, "half", &d, &error), TARTAN_OK);
    statistic_is(d, TARTAN_LEAST, "1/4");
    tartan_distribution_free(d);
    d = NULL;
    assert_int_equal(tartan_distribution_new(s->library, "lonk", &d, &error), TARTAN_INVALID);
    assert_non_null(strstr(error.help, "long"));
    assert_int_equal(tartan_distribution_new(NULL, "long", &d, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_distribution_new(s->library, NULL, &d, NULL), TARTAN_INVALID);
    assert_null(d);
}

static void spreads_nothing(void **state)
{
    const setting *s = *state;
    tartan_library_options options = tartan_library_options_init();
    tartan_library *empty;
    tartan_distribution *d;
    char *value;
    options.name = "none";
    assert_int_equal(tartan_library_open(s->module, &options, NULL, &empty, NULL), TARTAN_OK);
    assert_int_equal(tartan_distribution_new(empty, "long", &d, NULL), TARTAN_OK);
    assert_int_equal(tartan_distribution_count(d), 0);
    assert_int_equal(tartan_distribution_statistic(d, TARTAN_MEAN, &value, NULL), TARTAN_INVALID);
    tartan_distribution_free(d);
    tartan_library_free(empty);
}

static void finds_the_best(void **state)
{
    const setting *s = *state;
    const tartan_wish wishes[] = {{"long", true}, {"lids", false}, {"half", true}, {"lids", true}};
    tartan_best *best = NULL;
    const uint32_t *trays;
    size_t length, count = 0;
    bool found = true;
    unsigned last_long = 99, last_lids = 0;
    char *value = NULL;
    assert_int_equal(tartan_best_new(s->library, wishes, 2, &best, NULL), TARTAN_OK);
    assert_int_equal(tartan_best_value(best, 0, &value, NULL), TARTAN_INVALID);
    while (tartan_best_next(best, &trays, &length, &found, NULL) == TARTAN_OK && found) {
        unsigned now = metres(trays, length), with = lids(trays, length);
        assert_true(now < last_long || (now == last_long && with >= last_lids));
        last_long = now;
        last_lids = with;
        assert_int_equal(tartan_best_value(best, 1, &value, NULL), TARTAN_OK);
        assert_int_equal(strtoul(value, NULL, 10), with);
        tartan_text_free(value);
        assert_int_equal(tartan_best_value(best, 2, &value, NULL), TARTAN_INVALID);
        count++;
    }
    assert_int_equal(count, 56);
    assert_int_equal(tartan_best_next(NULL, &trays, &length, &found, NULL), TARTAN_INVALID);
    tartan_best_free(best);
    best = NULL;
    assert_int_equal(tartan_best_new(s->library, wishes, 0, &best, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_best_new(s->library, wishes, 4, &best, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_best_new(s->library, NULL, 1, &best, NULL), TARTAN_INVALID);
    assert_null(best);
}

static void finds_fronts(void **state)
{
    const setting *s = *state;
    const tartan_wish wishes[] = {{"long", false}, {"lids", true}};
    tartan_front *front = NULL;
    assert_int_equal(tartan_front_new(s->library, wishes, 2, &front, NULL), TARTAN_OK);
    assert_int_equal(tartan_front_count(front), 2); /* 1m lid; 1m lid | 1m | 1m lid */
    for (size_t i = 0; i < 2; i++) {
        char *value, *plans;
        const uint32_t *trays;
        size_t length;
        assert_int_equal(tartan_front_value(front, i, 1, &value, NULL), TARTAN_OK);
        assert_int_equal(strtoul(value, NULL, 10), i + 1);
        tartan_text_free(value);
        assert_int_equal(tartan_front_plans(front, i, &plans, &trays, &length, NULL), TARTAN_OK);
        assert_int_equal(strtoul(plans, NULL, 10), plans_with(s, metres(trays, length), (unsigned)i + 1));
        assert_int_equal(lids(trays, length), i + 1);
        tartan_text_free(plans);
    }
    char *none = NULL;
    assert_int_equal(tartan_front_value(front, 2, 0, &none, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_front_value(front, 0, 5, &none, NULL), TARTAN_INVALID);
    assert_null(none);
    tartan_front_free(front);
    assert_int_equal(tartan_front_new(s->library, wishes, 1, &front, NULL), TARTAN_INVALID);
}

/* "? | 2m | ..." */
static void completes(void **state)
{
    const setting *s = *state;
    const bool wide[] = {false, false, true, true};
    const tartan_open_tray places[] = {{NULL, false}, {wide, false}, {NULL, true}};
    const tartan_wish wish = {"long", false};
    tartan_completions *c = NULL;
    tartan_plans *plans;
    const uint32_t *trays;
    size_t length;
    unsigned all = 0, first_lid = 0, second_lid = 0;
    assert_int_equal(tartan_library_plans(s->library, NULL, NULL, &plans, NULL), TARTAN_OK);
    while (tartan_plans_next(plans, &trays, &length)) {
        bool fits = length >= 2 && trays[1] >= 2;
        all += fits;
        first_lid += fits && trays[0] % 2;
        second_lid += fits && trays[1] % 2;
    }
    tartan_plans_free(plans);
    assert_int_equal(tartan_completions_new(s->library, places, 3, &wish, &c, NULL), TARTAN_OK);
    assert_int_equal(strtoul(tartan_completions_plans(c), NULL, 10), all);
    assert_int_equal(tartan_completions_count(c, 0), 4);
    assert_int_equal(tartan_completions_count(c, 2), 0);
    for (size_t place = 0; place < 2; place++)
        for (size_t i = 0; i < 4; i++) {
            tartan_choice choice;
            assert_int_equal(tartan_completions_choice(c, place, i, &choice, NULL), TARTAN_OK);
            assert_string_equal(choice.field, i < 2 ? "width" : "lid");
            if (i == 3)
                assert_int_equal(strtoul(choice.plans, NULL, 10), place ? second_lid : first_lid);
            if (place == 1 && i == 0)
                assert_true(strcmp(choice.value, "1m") == 0 && strcmp(choice.plans, "0") == 0 && !choice.best);
            if (place == 0 && i == 1)
                assert_true(strcmp(choice.value, "2m") == 0 && strcmp(choice.best, "4") == 0);
        }
    tartan_choice past;
    assert_int_equal(tartan_completions_choice(c, 0, 4, &past, NULL), TARTAN_INVALID);
    tartan_completions_free(c);
    c = NULL;
    assert_int_equal(tartan_completions_new(s->library, places, 3, NULL, &c, NULL), TARTAN_OK);
    assert_int_equal(tartan_completions_choice(c, 0, 0, &past, NULL), TARTAN_OK);
    assert_null(past.best);
    tartan_completions_free(c);
    assert_int_equal(tartan_completions_new(s->library, NULL, 3, NULL, &c, NULL), TARTAN_INVALID);
}

static void draws_rules(void **state)
{
    const setting *s = *state;
    tartan_rules *rules = NULL;
    void *bytes = NULL;
    size_t size = 0;
    assert_int_equal(tartan_rules_new(s->module, NULL, 0, NULL, &rules, NULL), TARTAN_OK);
    assert_int_equal(tartan_rules_draw(rules, TARTAN_SVG, NULL, &bytes, &size, NULL), TARTAN_OK);
    assert_true(size > 100 && memcmp(bytes, "<?xml", 5) == 0);
    tartan_bytes_free(bytes);
    assert_int_equal(tartan_rules_draw(rules, TARTAN_DRAWN_DXF, NULL, &bytes, &size, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_rules_draw(NULL, TARTAN_SVG, NULL, &bytes, &size, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_rules_draw(rules, (tartan_picture_format)9, NULL, &bytes, &size, NULL), TARTAN_INVALID);
    tartan_rules_free(rules);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(spreads),        cmocka_unit_test(spreads_nothing),
                                       cmocka_unit_test(finds_the_best), cmocka_unit_test(finds_fronts),
                                       cmocka_unit_test(completes),      cmocka_unit_test(draws_rules),
                                       cmocka_unit_test(measures_plans), cmocka_unit_test(measures_other_plans),
                                       cmocka_unit_test(tells_fields),   cmocka_unit_test(asks_for_more)};
    return cmocka_run_group_tests(tests, open_library, close_library);
}
