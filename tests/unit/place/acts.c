/* Deriving by acts and by steps: the same parts, figures and errors, also at every limit. Steps are taken one by one
 * where they are to be kept, which asks nothing else. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "driver/open/open.h"
#include "runtime/place/acts.h"
#include "runtime/place/grow.h"

#define BRICKS                                                                                                         \
    "B -> 'FillRect(4,3,2)' 'Place(3004)' C\n"                                                                         \
    "C -> '(' 'Move(-1,0,0)' D ')' '(' 'Move(1,0,0)' D ')'\n"                                                          \
    "D -> '(' T ')' '(' 'Move(0,3,0)' U ')'\n"                                                                         \
    "T -> '(' 'Move(0,-1,0)' 'AssertFilled()' ')'\n"                                                                   \
    "T -> '(' 'Move(-1,-3,0)' B ')' | '(' 'Rotate(90)' 'SetColor(4)' 'Move(-1,-3,0)' B ')' |\n"                        \
    "U -> 'AssertFilled()' | '(' 'Rotate(270)' 'Move(1,0,0)' B ')' |\n"

typedef struct sample {
    const char *text;
    bool known; /* by acts */
} sample;

static const sample samples[] = {
    {"S -> 'PlaceBoundingBox(5,7,5)' T\n" BRICKS, true},
    {"S -> 'PlaceBoundingSphere(7)' '(' 'SetColor(2)' T ')' 'Move(20,0,0)' 'Place(end)'\n" BRICKS, true},
    {"S -> T\n" BRICKS, true},                                 /* the first step bounds the world */
    {"S -> '(' 'PlaceBoundingBox(4,4,4)' R ')' 'Place(end)'\n" /* R ends elsewhere, and nothing needs where */
     "R -> 'FillRect(2,1,2)' 'Place(a)' 'Move(1,1,0)' 'Rotate(90)' R |\n",
     true},
    {"S -> 'PlaceBoundingBox(4,4,4)' R 'Place(end)'\n" /* the end needs where */
     "R -> 'FillRect(2,1,2)' 'Place(a)' 'Move(1,1,0)' 'Rotate(90)' R |\n",
     false},
    {"S -> 'PlaceBoundingBox(4,4,4)' '(' 'Move(0,1,0)' R\nR -> 'FillRect(2,1,2)' 'Place(a)' 'Move(1,1,0)' R |\n",
     false},
    {"S -> 'PlaceBoundingBox(4,4,4)' '(' R 'Place(b)'\nR -> 'Place(a)' ')'\n",
     false}, /* R drops a frame of another's */
    {"S -> 'PlaceBoundingBox(9,9,9)' R 'FillRect(2,1,2)'\nR -> 'FillRect(4,1,4)' 'Place(a)'\n", true}, /* is not free */
    {"S -> 'PlaceBoundingBox(9,9,9)' 'Place(a)' R\nR -> 'Place(b)' '(' 'Move(60000000,0,0)' R ')' |\n",
     true},                                                                                       /* too far */
    {"S -> 'PlaceBoundingBox(9,9,9)' 'Place(a)' A\nA -> B\nB -> A | 'FillRect(40,1,1)'\n", true}, /* does not end */
    {"S -> 'PlaceBoundingBox(9,9,9)' 'Place(a)' A\nA -> E E 'Place(b)' E A [.6] | E [.4]\nE ->\n", true},
};

static void derive(const tn_opened *opened, tn_place_options options, bool steps, tn_status *status,
                   tn_placed_model *model, tn_place_fault *fault, tn_error *error)
{
    tn_place_rules rules;
    *error = (tn_error){0};
    assert_int_equal(tn_place_rules_make(opened->module, &rules, error), TN_OK);
    options.keep_steps = steps;
    *status = tn_place_derive(&rules, &options, model, fault, error);
    tn_place_rules_clear(&rules);
}

static void assert_same_parts(const tn_placed_model *a, const tn_placed_model *b)
{
    assert_int_equal(a->count, b->count);
    for (size_t i = 0; i < a->count; i++) {
        assert_memory_equal(&a->parts[i].frame, &b->parts[i].frame, sizeof a->parts[i].frame);
        assert_string_equal(a->parts[i].name, b->parts[i].name);
    }
}

static void assert_same(const tn_opened *opened, const tn_place_options *options)
{
    tn_status by_acts, by_steps;
    tn_placed_model a, b;
    tn_place_fault a_fault, b_fault;
    tn_error a_error, b_error;
    derive(opened, *options, false, &by_acts, &a, &a_fault, &a_error);
    derive(opened, *options, true, &by_steps, &b, &b_fault, &b_error);
    assert_int_equal(by_acts, by_steps);
    assert_same_parts(&a, &b);
    assert_memory_equal(&a.counts, &b.counts, sizeof a.counts);
    assert_string_equal(a_error.message, b_error.message);
    assert_int_equal(a_fault.has_step, b_fault.has_step);
    assert_int_equal(a_fault.step, b_fault.step);
    assert_int_equal(a_fault.alternative, b_fault.alternative);
    tn_placed_model_clear(&a);
    tn_placed_model_clear(&b);
}

/* Every limit from none to more than is needed, or to so many; each with a seed of its own. What does not end takes as
 * many expansions without a step as are allowed: a million would be as good as ten thousand, and take a minute. */
static void at_every_limit(const tn_opened *opened)
{
    const uint64_t ahead = 10000;
    for (uint32_t limit = 1; limit <= 120; limit++) {
        const tn_place_options options[] = {
            {.seed = limit, .lookahead_limit = ahead, .step_limit = 100000, .part_limit = limit},
            {.seed = limit, .lookahead_limit = ahead, .part_limit = 1000, .step_limit = limit},
            {.seed = limit, .lookahead_limit = ahead, .part_limit = 1000, .frame_limit = limit},
            {.seed = limit, .part_limit = 1000, .lookahead_limit = limit}};
        for (size_t i = 0; i < sizeof options / sizeof *options; i++)
            assert_same(opened, &options[i]);
    }
}

static void test_samples(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        tn_opened opened;
        tn_place_rules rules;
        tn_traces traces;
        tn_acts acts;
        tn_error error;
        const uint8_t *text = (const uint8_t *)samples[i].text;
        assert_int_equal(tn_open_bytes("own.pcfg", text, strlen(samples[i].text), false, &opened), TN_OK);
        assert_int_equal(tn_place_rules_make(opened.module, &rules, &error), TN_OK);
        assert_int_equal(tn_traces_make(&rules, &traces, &error), TN_OK);
        assert_int_equal(tn_acts_make(&rules, &traces, &acts, &error), TN_OK);
        if (acts.known != samples[i].known)
            fail_msg("%s", samples[i].text);
        at_every_limit(&opened);
        tn_acts_clear(&acts);
        tn_traces_clear(&traces);
        tn_place_rules_clear(&rules);
        tn_close(&opened);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_samples)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
