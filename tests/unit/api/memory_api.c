/* Out of memory behind the C interface: each allocation fails once, and then all from there on. Every call must say so,
 * and leave nothing behind. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "include/tartan/tartan.h"
#include "tests/support/failing_memory.h"

static const char text[] = "schema box { width = 1m | 2m  lid = flag }\n"
                           "rule pair = neighbour(tray(lid), tray(lid))\n"
                           "library rows using box { trays 1..3 prune pair }\n"
                           "measure long = sum(width)\nmeasure lids = quantity(tray(lid))\n";

static const char kit[] =
    "unit 10 x 8 x 10;\nconnector stud joins tube;\nconnector tube joins stud;\n"
    "part 3005 { fill 20 x 24 x 20; stud up; tube down at (0, -24, 0); }\nrule up at stud = 3005;\n"
    "model post { inside box(20, 72, 20); start stud at (0, 0, 0) by up; require elements = 3; }\n";

static const char grammar[] = "S -> 'PlaceBoundingBox(9,9,9)' 'Place(3005)' A\nA -> 'Move(0,-3,0)' 'Place(3005)' |\n";

/* Parts as LDraw has them: two joined ones, one loose, and one that the kit lacks. */
#define AT(Y) "1 4 0 " Y " 0 1 0 0 0 1 0 0 0 1 "
#define DRAWN AT("-24") "3005.dat\\n" AT("-48") "3005.dat\\n" AT("-144") "3005.dat\\n" AT("-240") "none.dat\\n"

static const char tested[] = "test pair { match [1m lid | 2m lid] reject [1m - | 2m lid] }\n";

/* The file before an edit, or a model that was drawn. */
static tartan_status before_edit(void *context, const tartan_use *use, tartan_text *found, tartan_error *error)
{
    static const char part[] = "1 4 0 -24 0 1 0 0 0 1 0 0 0 1 3005.dat\n";
    bool drawn = strcmp(use->extension, ".ldr") == 0;
    (void)context;
    (void)error;
    found->text = drawn ? part : text;
    found->size = strlen(found->text);
    return TARTAN_OK;
}

typedef tartan_status operation(const tartan_module *module, tartan_error *error);

static tartan_status compile(const tartan_module *module, tartan_error *error)
{
    (void)module;
    tartan_module *made = NULL;
    tartan_status status = tartan_compile_text("box.plan", text, sizeof text - 1, NULL, &made, error);
    if (status == TARTAN_OK)
        tartan_module_free(made);
    else
        assert_null(made);
    return status;
}

static tartan_status compile_where(const tartan_module *module, tartan_error *error)
{
    const char *const wheres[] = {"tray(lid)"};
    tartan_module *made = NULL;
    (void)module;
    tartan_status status = tartan_compile_where("box.plan", text, sizeof text - 1, NULL, NULL, wheres, 1, &made, error);
    tartan_module_free(made);
    return status;
}

static tartan_status load(const tartan_module *module, tartan_error *error)
{
    tartan_module *again = NULL;
    size_t size;
    const void *bytes = tartan_module_bytes(module, &size);
    tartan_status status = tartan_module_load(bytes, size, &again, error);
    tartan_module_free(again);
    return status;
}

/* Values for params. */
static tartan_status ask_with_params(const char *rules, const char *const *questions, size_t count, tartan_error *error)
{
    static const char *const params[] = {"side=right", "most=3m"};
    tartan_compile_options options = tartan_compile_options_init();
    options.params = params;
    options.param_count = 2;
    tartan_session *session = NULL;
    tartan_status status = tartan_session_open("a.plan", rules, strlen(rules), &options, &session, error);
    for (size_t i = 0; i < count && status == TARTAN_OK; i++) {
        char *answer = NULL;
        status = tartan_ask(session, questions[i], "{}", NULL, NULL, NULL, &answer, error);
        tartan_text_free(answer);
    }
    tartan_session_free(session);
    return status;
}

static tartan_status set_params(const tartan_module *module, tartan_error *error)
{
    static const char rules[] = "schema s { w = 1m | 2m }\nparam most = 4m in 2m..6m\nparam side = left | right\n"
                                "rule big = side = right and sum(w) > most\n"
                                "test big with most = 2m { match [2m | 1m] }\n";
    static const char *const questions[] = {"schema", "test"};
    (void)module;
    return ask_with_params(rules, questions, 2, error);
}

static tartan_status cover_params(const tartan_module *module, tartan_error *error)
{
    static const char rules[] = "schema s { w = 1m | 2m }\nparam most = 4m\nparam side = left | right\n"
                                "rule big = side = right and tray(2m)\ntest big with side = left { reject [2m] }\n";
    static const char *const questions[] = {"coverage"};
    (void)module;
    return ask_with_params(rules, questions, 1, error);
}

typedef struct asked_question {
    const char *question, *request;
} asked_question;

static tartan_status ask_of(const char *path, const char *whole, const asked_question *asked, size_t count,
                            tartan_error *error)
{
    tartan_compile_options options = tartan_compile_options_init();
    options.resolve = before_edit;
    tartan_session *session = NULL;
    tartan_status status = tartan_session_open(path, whole, strlen(whole), &options, &session, error);
    for (size_t i = 0; i < count && status == TARTAN_OK; i++) {
        char *answer = NULL;
        status = tartan_ask(session, asked[i].question, asked[i].request, NULL, NULL, NULL, &answer, error);
        assert_true(!answer == (status != TARTAN_OK));
        tartan_text_free(answer);
    }
    tartan_session_free(session);
    return status;
}

static tartan_status ask_all(const asked_question *asked, size_t count, tartan_error *error)
{
    char whole[sizeof text + sizeof tested];
    snprintf(whole, sizeof whole, "%s%s", text, tested);
    return ask_of("box.plan", whole, asked, count, error);
}

/* A few together, as what they take is multiplied by how often they allocate. */
#define ASKING(NAME, ...)                                                                                              \
    static tartan_status NAME(const tartan_module *module, tartan_error *error)                                        \
    {                                                                                                                  \
        static const asked_question asked[] = {__VA_ARGS__};                                                           \
        (void)module;                                                                                                  \
        return ask_all(asked, sizeof asked / sizeof *asked, error);                                                    \
    }

ASKING(ask_numbers, {"count", "{}"}, {"count", "{\"by\": \"long\"}"},
       {"count", "{\"where\": [\"trays = 2\"], \"mirror\": true}"})
ASKING(ask_why, {"explain", "{\"plan\": \"#1\"}"}, {"explain", "{\"plan\": \"1m lid | 2m lid\", \"nearest\": 2}"},
       {"match", "{\"plans\": [\"2m lid | 1m -\"]}"}, {"prune", "{\"plans\": [\"2m lid | 1m lid\"]}"},
       {"rank", "{\"plan\": \"2m lid | 1m -\"}"}, {"unrank", "{\"rank\": \"2\"}"},
       {"relations", "{\"examples\": true}"})
ASKING(ask_spellings, {"rank", "{\"plan\": \"[2m lid | 1m]\"}"},
       {"rank", "{\"plan\": \"tray(2m, lid) | 1m, not lid\"}"}, {"complete", "{\"pattern\": \"[2m lid | 1m]\"}"},
       {"complete", "{\"pattern\": \"2m lid | 1m -\"}"})
ASKING(ask_lists, {"sample", "{\"count\": 2}"}, {"sample", "{\"per_length\": 1}"},
       {"enumerate", "{\"limit\": 2, \"lines\": true}"}, {"best", "{\"by\": [{\"measure\": \"long\"}], \"count\": 2}"})
ASKING(ask_trade_offs, {"pareto", "{\"by\": [{\"measure\": \"long\"}, {\"measure\": \"lids\", \"most\": true}]}"},
       {"complete", "{\"pattern\": \"? | lid\"}"}, {"complete", "{\"pattern\": \"lid | lid\"}"},
       {"complete", "{\"pattern\": \"? | ...\", \"by\": [{\"measure\": \"lids\"}]}"})
ASKING(ask_edits, {"diff", "{\"before\": \"old.plan\"}"}, {"test", "{}"})
ASKING(ask_text, {"check", "{\"threads\": 1}"}, {"format", "{}"})

/* A rule or two, as each of its changes is compiled. */
static tartan_status ask_coverage(const tartan_module *module, tartan_error *error)
{
    static const char rules[] = "schema s { use = a | b }\nrule pair = neighbour(tray(a), tray(a))\n"
                                "library l { trays 1  prune pair }\ntest pair { match [a | a] }\n";
    static const asked_question asked[] = {{"coverage", "{}"}};
    (void)module;
    return ask_of("s.plan", rules, asked, 1, error);
}

/* Of kits and models of parts. */
static tartan_status ask_kit(const tartan_module *module, tartan_error *error)
{
    static const asked_question asked[] = {
        {"place", "{\"formats\": [\"ldr\", \"mpd\", \"csv\", \"obj\"], \"program\": true, \"threads\": null}"},
        {"place", "{\"trace\": true, \"steps\": \"part\", \"part_limit\": 3, \"keep_partial\": true}"},
        {"inspect", "{\"ldraw\": \"" DRAWN "\", \"require\": \"count(3005) = 3\", \"model\": \"post\"}"},
        {"enumerate", "{\"parts\": 3}"},
        {"export", "{\"as\": \"pcfg\"}"},
        {"export", "{\"as\": \"pcfg\", \"ldraw\": \"" DRAWN "\"}"},
        {"export", "{\"as\": \"kit\", \"ldraw\": \"" DRAWN "\"}"},
        {"inspect", "{\"path\": \"drawn.ldr\"}"},
        {"export", "{\"as\": \"kit\", \"path\": \"drawn.ldr\"}"}};
    (void)module;
    return ask_of("own.kit", kit, asked, sizeof asked / sizeof *asked, error);
}

static tartan_status ask_grammar(const tartan_module *module, tartan_error *error)
{
    static const asked_question asked[] = {
        {"place", "{\"fitness\": \"elements <= 2\", \"formats\": [\"ldr\"], \"header\": true}"}};
    (void)module;
    return ask_of("own.pcfg", grammar, asked, 1, error);
}

ASKING(ask_exports, {"export", "{}"}, {"export", "{\"as\": \"regex\", \"rule\": \"pair\"}"})

static tartan_status match(const tartan_module *module, tartan_error *error)
{
    tartan_rules *rules = NULL;
    tartan_matcher *matcher = NULL;
    uint64_t bits[2];
    char *line = NULL;
    uint32_t trays[] = {1, 3, 0};
    tartan_status status = tartan_rules_new(module, NULL, 0, NULL, &rules, error);
    if (status == TARTAN_OK)
        status = tartan_matcher_new(rules, &matcher, error);
    if (status == TARTAN_OK)
        status = tartan_match(matcher, trays, 2, bits, error);
    if (status == TARTAN_OK)
        status = tartan_match_all(rules, trays, (size_t[]){2, 3}, 2, 1, bits, NULL, error);
    if (status == TARTAN_OK)
        status = tartan_match_any(rules, trays, (size_t[]){2, 3}, 2, 1, (uint8_t[2]){0}, NULL, error);
    if (status == TARTAN_OK)
        status = tartan_plan_write(tartan_rules_schema(rules), trays, 3, &line, error);
    if (status == TARTAN_OK) {
        size_t length;
        status = tartan_plan_read(tartan_rules_schema(rules), line, strlen(line), trays, 3, &length, error);
    }
    tartan_text_free(line);
    tartan_matcher_free(matcher);
    tartan_rules_free(rules);
    return status;
}

static tartan_status walk(const tartan_module *module, tartan_error *error)
{
    tartan_library *library = NULL;
    tartan_plans *plans = NULL, *sample = NULL;
    char *count = NULL, *rank = NULL;
    uint32_t trays[3];
    size_t length;
    tartan_status status = tartan_library_open(module, NULL, NULL, &library, error);
    if (status == TARTAN_OK)
        status = tartan_library_count(library, TARTAN_ANY_LENGTH, &count, error);
    if (status == TARTAN_OK)
        status = tartan_library_unrank(library, "20", trays, &length, error);
    if (status == TARTAN_OK)
        status = tartan_library_rank(library, trays, length, &rank, error);
    if (status == TARTAN_OK)
        status = tartan_library_plans(library, "1", "3", &plans, error);
    if (status == TARTAN_OK)
        status = tartan_library_sample(library, 1, TARTAN_ANY_LENGTH, 3, &sample, error);
    const uint32_t *plan;
    if (status == TARTAN_OK)
        assert_true(tartan_plans_next(plans, &plan, &length) && tartan_plans_next(sample, &plan, &length));
    tartan_plans_free(plans);
    tartan_plans_free(sample);
    tartan_text_free(count);
    tartan_text_free(rank);
    tartan_library_free(library);
    return status;
}

static tartan_status measure(const tartan_module *module, tartan_error *error)
{
    const tartan_wish wishes[] = {{"long", true}, {"lids", false}};
    const tartan_open_tray places[] = {{NULL, false}, {NULL, true}};
    tartan_library *library = NULL;
    tartan_distribution *distribution = NULL;
    tartan_best *best = NULL;
    tartan_front *front = NULL;
    tartan_completions *completions = NULL;
    char *texts[4] = {NULL};
    const uint32_t *trays;
    size_t length;
    bool found;
    double value;
    tartan_status status = tartan_library_open(module, NULL, NULL, &library, error);
    if (status == TARTAN_OK)
        status = tartan_measure_plans(library, "long", &(uint32_t){1}, &(size_t){1}, 1, NULL, &value, error);
    if (status == TARTAN_OK)
        status = tartan_distribution_new(library, "long", &distribution, error);
    if (status == TARTAN_OK)
        status = tartan_distribution_value(distribution, 0, &texts[0], &texts[1], error);
    if (status == TARTAN_OK)
        status = tartan_best_new(library, wishes, 2, &best, error);
    if (status == TARTAN_OK)
        status = tartan_best_next(best, &trays, &length, &found, error);
    if (status == TARTAN_OK)
        status = tartan_best_value(best, 0, &texts[2], error);
    if (status == TARTAN_OK)
        status = tartan_front_new(library, wishes, 2, &front, error);
    if (status == TARTAN_OK)
        status = tartan_front_plans(front, 0, &texts[3], &trays, &length, error);
    if (status == TARTAN_OK)
        status = tartan_completions_new(library, places, 2, wishes, &completions, error);
    for (size_t i = 0; i < 4; i++)
        tartan_text_free(texts[i]);
    tartan_completions_free(completions);
    tartan_front_free(front);
    tartan_best_free(best);
    tartan_distribution_free(distribution);
    tartan_library_free(library);
    return status;
}

static void fails_cleanly(void **state)
{
    static operation *const operations[] = {compile,     compile_where, set_params,    cover_params, load,
                                            ask_numbers, ask_why,       ask_spellings, ask_lists,    ask_trade_offs,
                                            ask_edits,   ask_coverage,  ask_text,      ask_kit,      ask_grammar,
                                            ask_exports, match,         walk,          measure};
    for (size_t i = 0; i < sizeof operations / sizeof *operations; i++) {
        size_t failures = 0;
        for (int all_after = 0; all_after < 2; all_after++) {
            for (size_t number = 0;; number++) {
                tartan_error error = {0};
                fail_allocation(number, all_after);
                tartan_status status = operations[i](*state, &error);
                if (stop_failing() <= number) {
                    assert_int_equal(status, TARTAN_OK);
                    break;
                }
                if (status == TARTAN_OK)
                    continue; /* GMP's own allocations, and threads that are done without */
                if (status != TARTAN_MEMORY || !error.message[0])
                    fail_msg("operation %zu, allocation %zu: status %d, %s", i, number, (int)status, error.message);
                failures++;
            }
        }
        assert_true(failures > 0);
    }
}

static int make(void **state)
{
    tartan_module *module = NULL;
    tartan_status status = tartan_compile_text("box.plan", text, sizeof text - 1, NULL, &module, NULL);
    *state = module;
    return status != TARTAN_OK;
}

static int unmake(void **state)
{
    tartan_module_free(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(fails_cleanly)};
    return cmocka_run_group_tests(tests, make, unmake);
}
