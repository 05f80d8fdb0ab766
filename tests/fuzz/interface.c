/* The C interface on any text, as each notation: compiling ends and says what is wrong at a place that is there; what
 * it accepts is the same module each time, loads again with the same contents, and answers what programs ask of it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "include/tartan/tartan.h"
#include "tests/fuzz/fuzz.h"

enum { STATES = 2000, LONGEST = 4, TRAYS_MOST = 64, PATIENCE = 30 };

static const char *path; /* of the text, which says its notation */

static void fail(const char *what)
{
    fprintf(stderr, "%s: %s\n", path, what);
    abort();
}

/* A call that may fail, but not without a reason, nor by a mistake of Tartan's own. */
static bool done(tartan_status status, const tartan_error *error)
{
    if (status == TARTAN_INTERNAL || (status != TARTAN_OK && (error->message[0] == '\0' || error->status != status)))
        fail("a failure without a reason");
    return status == TARTAN_OK;
}

/* ---- compiling */

/* Whatever a text uses is small, and what its ending says. */
static tartan_status resolve(void *context, const tartan_use *use, tartan_text *found, tartan_error *error)
{
    static const char *const texts[][2] = {
        {".plan", "schema s { width = 3m | 4m use = shop | home }\nrule r = tray(shop)\nnumber n = 1\n"},
        {".bnf", "<s> ::= <s> <s> | a | b\n"},
        {".hemls", "A + A + A\nA -> A A\nAngle 45\nBranchAngle 90\n"}};
    (void)context, (void)error;
    *found = (tartan_text){.text = "", .name = use->path};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (strcmp(use->extension, texts[i][0]) == 0)
            found->text = texts[i][1];
    found->size = strlen(found->text);
    return TARTAN_OK;
}

typedef struct said {
    size_t errors, size; /* size: of the text */
} said;

static void report(void *context, const tartan_diagnostic *d)
{
    said *s = context;
    s->errors += d->severity == TARTAN_ERROR;
    if (!d->code || !d->message || d->message[0] == '\0')
        fail("nothing is said");
    if (!d->path || strcmp(d->path, path) != 0)
        return;
    bool before = d->end_line < d->line || (d->end_line == d->line && d->end_column < d->column);
    if (d->line == 0 || d->column == 0 || before || d->line > s->size + 1 || d->column > s->size + 1)
        fail("a diagnostic is about a place that is not there");
}

static tartan_source *compile(const char *text, size_t size)
{
    said s = {.size = size};
    tartan_compile_options options = tartan_compile_options_init();
    tartan_source *source = NULL;
    tartan_error error;
    options.report = report;
    options.report_context = &s;
    options.resolve = resolve;
    bool good = done(tartan_source_open(path, text, size, &options, &source, &error), &error);
    if (good != (s.errors == 0) || good != (source != NULL))
        fail("failed without an error, or compiled with one");
    return source;
}

static void format(const char *text, size_t size)
{
    said s = {.size = size};
    char *laid_out = NULL;
    size_t laid_out_size;
    tartan_error error;
    if (!done(tartan_format_text(path, text, size, report, &s, &laid_out, &laid_out_size, &error), &error) &&
        s.errors == 0 && error.status == TARTAN_INVALID)
        fail("not laid out, and nothing says why");
    tartan_text_free(laid_out);
}

/* ---- modules */

static bool same_text(const char *one, const char *other)
{
    return one && other ? strcmp(one, other) == 0 : one == other;
}

static void compare(const tartan_module *one, const tartan_module *other)
{
    bool same = tartan_module_rule_count(one) == tartan_module_rule_count(other) &&
                tartan_module_library_count(one) == tartan_module_library_count(other) &&
                tartan_module_surface_count(one) == tartan_module_surface_count(other);
    for (size_t i = 0; same && i < tartan_module_rule_count(one); i++)
        same = same_text(tartan_module_rule_name(one, i), tartan_module_rule_name(other, i)) &&
               same_text(tartan_module_rule_doc(one, i), tartan_module_rule_doc(other, i));
    for (size_t i = 0; same && i < tartan_module_library_count(one); i++)
        same = same_text(tartan_module_library_name(one, i), tartan_module_library_name(other, i)) &&
               same_text(tartan_module_library_doc(one, i), tartan_module_library_doc(other, i));
    if (!same)
        fail("a module that is loaded again is another");
}

/* What was written must load, whatever was compiled. */
static void load_again(const tartan_module *module)
{
    size_t size;
    const void *bytes = tartan_module_bytes(module, &size);
    tartan_module *again = NULL;
    tartan_error error;
    if (!done(tartan_module_load(bytes, size, &again, &error), &error))
        fail(error.message);
    compare(module, again);
    tartan_module_free(again);
}

static void compile_again(const char *text, size_t size, const tartan_module *module)
{
    size_t first_size, second_size;
    tartan_source *again = compile(text, size);
    const void *first = tartan_module_bytes(module, &first_size);
    const void *second = again ? tartan_module_bytes(tartan_source_module(again), &second_size) : NULL;
    if (!second || first_size != second_size || memcmp(first, second, first_size) != 0)
        fail("compiled again it is another module");
    tartan_source_free(again);
}

/* ---- what programs ask */

/* Long work is given up: it is not what is looked for here. */
static bool go_on(void *context, double work, double total)
{
    unsigned *calls = context;
    (void)work, (void)total;
    return ++*calls < PATIENCE;
}

static tartan_watch watch(unsigned *calls)
{
    tartan_watch made = tartan_watch_init();
    *calls = 0;
    made.go_on = go_on;
    made.context = calls;
    return made;
}

static void match(const tartan_module *module)
{
    tartan_rules *rules = NULL;
    tartan_matcher *matcher = NULL;
    tartan_error error;
    unsigned calls;
    const tartan_watch waiting = watch(&calls);
    if (!done(tartan_rules_new(module, NULL, 0, &waiting, &rules, &error), &error))
        return;
    const uint32_t most = tartan_schema_tray_count(tartan_rules_schema(rules)) - 1;
    const uint32_t trays[LONGEST] = {0, most, most / 2, most};
    const size_t words = tartan_rules_words(rules);
    uint64_t *bits = calloc(words + 1, sizeof *bits);
    if (bits && done(tartan_matcher_new(rules, &matcher, &error), &error))
        for (size_t length = 0; length <= LONGEST; length++) {
            uint8_t any = 0;
            bool set = false;
            if (!done(tartan_match(matcher, trays, length, bits, &error), &error) ||
                !done(tartan_match_any(rules, trays, &length, 1, 1, &any, NULL, &error), &error))
                break;
            for (size_t i = 0; i < words; i++)
                set |= bits[i] != 0;
            if (set != (any == 1))
                fail("a rule matches, and none does");
        }
    tartan_matcher_free(matcher);
    tartan_rules_free(rules);
    free(bits);
}

/* The first plan of a library has the rank 0, and is one that can be written and read. */
static void look_at_first(const tartan_library *library)
{
    uint32_t trays[TRAYS_MOST], again[TRAYS_MOST];
    size_t length, again_length;
    char *rank = NULL, *line = NULL;
    tartan_error error;
    const tartan_schema *schema = tartan_library_schema(library);
    if (tartan_library_max_trays(library) > TRAYS_MOST ||
        !done(tartan_library_unrank(library, "0", trays, &length, &error), &error))
        return;
    if (!done(tartan_library_rank(library, trays, length, &rank, &error), &error) || strcmp(rank, "0") != 0)
        fail("the first plan is not the first");
    if (done(tartan_plan_write(schema, trays, length, &line, &error), &error)) {
        tartan_status status = tartan_plan_read(schema, line, strlen(line), again, TRAYS_MOST, &again_length, &error);
        if (!done(status, &error) || again_length != length || memcmp(trays, again, length * sizeof *trays) != 0)
            fail("a plan is read as another");
    }
    tartan_text_free(line);
    tartan_text_free(rank);
}

static void open_library(const tartan_module *module, const char *name)
{
    tartan_library_options options = tartan_library_options_init();
    tartan_library *library = NULL;
    char *count = NULL;
    tartan_error error;
    unsigned calls;
    const tartan_watch waiting = watch(&calls);
    options.name = name;
    options.max_states = STATES;
    if (!done(tartan_library_open(module, &options, &waiting, &library, &error), &error))
        return;
    if (done(tartan_library_count(library, TARTAN_ANY_LENGTH, &count, &error), &error) && strcmp(count, "0") != 0)
        look_at_first(library);
    tartan_text_free(count);
    tartan_library_free(library);
}

static void run_tests(tartan_source *source)
{
    tartan_tests *tests = NULL;
    tartan_test_case test = tartan_test_case_init();
    tartan_error error;
    unsigned calls;
    const tartan_watch waiting = watch(&calls);
    if (!done(tartan_source_test(source, STATES, &waiting, &tests, &error), &error))
        return;
    for (size_t i = 0; i < tartan_tests_count(tests); i++)
        if (!done(tartan_tests_case(tests, i, &test, &error), &error) || test.source_begin > test.source_end)
            fail("a test is nowhere");
    tartan_tests_free(tests);
}

static void ask(tartan_source *source)
{
    const tartan_module *module = tartan_source_module(source);
    if (tartan_module_rule_count(module) > 0)
        match(module);
    for (size_t i = 0; i < tartan_module_library_count(module); i++)
        open_library(module, tartan_module_library_name(module, i));
    run_tests(source);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const paths[] = {"fuzz.plan",  "fuzz.hemls", "fuzz.study", "fuzz.bnf",
                                        "fuzz.field", "fuzz.pcfg",  "fuzz.kit",   "fuzz.solid"};
    const char *text = (const char *)data;
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        path = paths[i];
        format(text, size);
        tartan_source *source = compile(text, size);
        if (!source)
            continue;
        load_again(tartan_source_module(source));
        compile_again(text, size, tartan_source_module(source));
        ask(source);
        tartan_source_free(source);
    }
    return 0;
}
