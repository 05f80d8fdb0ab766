/* Projections: as automata, forwards, turned round and over marked words; interpreted; and the first plan above one;
 * and all of it where memory runs out at each allocation in turn: an error, and nothing is lost. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/match/image_search.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/vm.h"
#include "tests/support/failing_memory.h"
#include "tests/support/load_plan.h"
#include "tests/support/test_rule.h"

/* Halls are open, and of two neighbours one is open and one shut: so open and shut trays alternate. */
static const char text[] = "schema row { use = hall | room }\n"
                           "schema bays from row { bay = open | shut  forbid tray(hall, shut) }\n"
                           "schema lamps from bays { use = ... | stair  lamp = flag }\n"
                           "rule opens using bays = tray(open) beside tray(open)\n"
                           "rule shuts using bays = neighbour(tray(shut), tray(shut))\n"
                           "rule dark using lamps = neighbour(tray(shut, not lamp), any)\n"
                           "library lit using lamps { trays 0..30 prune dark }\n"
                           "library zoned from lit onto bays { prune opens, shuts }\n"
                           "library bare from zoned onto row { }\n";

enum { LONG = 15, SHORT = 4 };

typedef struct opened {
    tn_compilation compilation;
    tn_module *module;
    tn_schema *schema;
    uint32_t function; /* of the projection onto `row` */
} opened;

static int setup(void **state)
{
    static opened o;
    o.module = load_plan(text, &o.compilation);
    assert_int_equal(tn_schema_new(o.module, 0, 0, &o.schema, NULL), TN_OK);
    o.function = o.module->CLAUSE_records[o.module->LIBRARY_records[2].clause_first].holds;
    *state = &o;
    return 0;
}

static int teardown(void **state)
{
    opened *o = *state;
    tn_schema_free(o->schema);
    tn_module_free(o->module);
    tn_compilation_clear(&o->compilation);
    return 0;
}

/* Trays that alternate between open and shut: halls are all at even places, or all at odd ones. */
static bool expected(const tn_tray *trays, size_t length)
{
    bool even = false, odd = false;
    for (size_t i = 0; i < length; i++)
        if (trays[i] == 0)
            *(i % 2 ? &odd : &even) = true;
    return !(even && odd);
}

static bool read_word(const tn_dfa *dfa, const tn_classes *classes, const tn_tray *trays, size_t length, bool turned)
{
    uint32_t state = 0;
    for (size_t i = 0; i < length; i++)
        state = tn_dfa_read(dfa, state, classes->of_tray[trays[turned ? length - 1 - i : i]]);
    return dfa->accept[state];
}

/* With markers before tray `from` and before tray `to`. */
static bool read_marked(const tn_dfa *dfa, const tn_classes *classes, const tn_tray *trays, size_t length, size_t from,
                        size_t to)
{
    uint32_t state = 0;
    for (size_t i = 0; i <= length; i++) {
        for (unsigned marks = (i == from) + (i == to); marks > 0; marks--)
            state = tn_dfa_read(dfa, state, classes->count);
        if (i < length)
            state = tn_dfa_read(dfa, state, classes->of_tray[trays[i]]);
    }
    return dfa->accept[state];
}

static tn_status lowered(const opened *o, tn_error *error)
{
    tn_classes *classes = NULL;
    tn_lowering *lowering = NULL;
    tn_dfa *dfas[3] = {0};
    tn_status status = tn_classes_new(o->schema, &o->function, 1, &classes, error);
    if (status == TN_OK)
        status = tn_lowering_new(classes, 0, &lowering, error);
    if (status == TN_OK)
        status = tn_lower(lowering, o->function, &dfas[0], error);
    if (status == TN_OK)
        status = tn_lower_reversed(lowering, o->function, &dfas[1], error);
    if (status == TN_OK)
        status = tn_lower_marked(lowering, o->function, &dfas[2], error);
    for (uint32_t code = 1; status == TN_OK && code < 2u << SHORT; code++) { /* a bit a tray below the highest */
        size_t length = 31 - (size_t)__builtin_clz(code);
        tn_tray trays[SHORT + 1];
        for (size_t i = 0; i < length; i++)
            trays[i] = code >> i & 1;
        bool wanted = expected(trays, length);
        assert_int_equal(read_word(dfas[0], classes, trays, length, false), wanted);
        assert_int_equal(read_word(dfas[1], classes, trays, length, true), wanted);
        for (size_t from = 0; from <= length; from++)
            for (size_t to = from; to <= length; to++)
                assert_int_equal(read_marked(dfas[2], classes, trays, length, from, to),
                                 wanted && from == 0 && to == length);
    }
    for (int i = 0; i < 3; i++)
        tn_dfa_free(dfas[i]);
    tn_lowering_free(lowering);
    tn_classes_free(classes);
    return status;
}

static tn_status interpreted(const opened *o, tn_error *error)
{
    tn_tray trays[LONG];
    tn_plan_vm *vm = NULL;
    tn_status status = tn_plan_vm_new(o->schema, 0, &vm, error);
    for (size_t length = 3; status == TN_OK && length <= 6; length += 3)
        for (unsigned fits = 0; status == TN_OK && fits < 2; fits++) {
            bool holds = false;
            for (size_t i = 0; i < length; i++)
                trays[i] = 1;
            trays[1] = trays[fits ? length - 2 : length - 1] = 0;
            status = tn_plan_vm_plan(vm, trays, length, error);
            if (status == TN_OK)
                status = tn_plan_vm_holds(vm, o->function, &holds, error);
            if (status == TN_OK)
                assert_int_equal(holds, expected(trays, length));
        }
    tn_plan_vm_free(vm);
    return status;
}

static tn_status searched(const opened *o, tn_error *error)
{
    tn_instruction image;
    tn_image_search *search = NULL;
    tn_tray trays[LONG], newer[LONG];
    bool found = false;
    assert_true(tn_function_is_image(o->module, o->function, &image));
    tn_status status = tn_image_search_new(o->schema, &image, &search, error);
    for (size_t length = 0; status == TN_OK && length <= LONG; length += length ? LONG - 2 : 2) {
        for (size_t i = 0; i < length; i++)
            trays[i] = 1; /* rooms alone: open, shut, open, ... is the first */
        status = tn_image_search_find(search, trays, length, &found, newer, error);
        for (size_t i = 0; status == TN_OK && i < length; i++)
            assert_int_equal(newer[i], 1 + i % 2);
        assert_true(found || status != TN_OK);
    }
    tn_image_search_free(search);
    return status;
}

/* More newer plans than are tried. */
static void test_limit(void **state)
{
    const opened *o = *state;
    tn_tray trays[LONG];
    tn_plan_vm *vm = NULL;
    tn_error error = {0};
    bool holds;
    for (size_t i = 0; i < LONG; i++)
        trays[i] = i == 3 || i == 6 ? 0 : 1;
    assert_int_equal(tn_plan_vm_new(o->schema, 0, &vm, NULL), TN_OK);
    assert_int_equal(tn_plan_vm_plan(vm, trays, LONG, NULL), TN_OK);
    assert_int_equal(tn_plan_vm_holds(vm, o->function, &holds, &error), TN_LIMIT);
    assert_int_equal(error.code, E_MATCHING_WORK);
    tn_plan_vm_free(vm);
}

typedef tn_status question(const opened *o, tn_error *error);

static void fail_each(const opened *o, question *ask)
{
    for (size_t failing = 0;; failing++) {
        tn_error error = {0};
        fail_allocation(failing, 0);
        tn_status status = ask(o, &error);
        size_t asked = stop_failing();
        if (asked <= failing) {
            assert_int_equal(status, TN_OK);
            break;
        }
        assert_true(status == TN_MEMORY || status == TN_OK); /* products do without a table that they cannot have */
        assert_int_equal(error.status, status);
    }
}

static void test_lowering(void **state)
{
    assert_int_equal(lowered(*state, NULL), TN_OK);
    fail_each(*state, lowered);
}

static void test_interpreting(void **state)
{
    assert_int_equal(interpreted(*state, NULL), TN_OK);
    fail_each(*state, interpreted);
}

static void test_searching(void **state)
{
    assert_int_equal(searched(*state, NULL), TN_OK);
    fail_each(*state, searched);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_lowering), cmocka_unit_test(test_interpreting),
                                       cmocka_unit_test(test_searching), cmocka_unit_test(test_limit)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
