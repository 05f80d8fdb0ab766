/* Answers that are kept (memory.h) are those that would be found again: over random libraries that are edited to and
 * fro, in threads, where the room for answers is small, and where memory runs out. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/crew.h"
#include "runtime/plan/analysis/analysis.h"
#include "tests/support/failing_memory.h"
#include "tests/support/test_library.h"

#define EDITS 60
#define TEXT_MAX 20000

/* All counts of the clauses, and all findings, as text. */
static tn_status describe(const test_library *made, tn_plan_memory *memory, char *text, tn_error *error)
{
    tn_library *library = NULL;
    tn_plan_analysis *analysis = NULL;
    const tn_library_options options = {.max_states = 2000, .memory = memory, .threads = 1};
    const tn_plan_analysis_options analysing = {.max_states = 2000, .memory = memory, .threads = 1};
    size_t used = 0;
    mpz_t out, only;
    mpz_inits(out, only, NULL);
    tn_status status = tn_library_new(made->schema, 0, &options, &library, error);
    for (uint32_t i = 0; status == TN_OK && i < made->module->LIBRARY_records[0].clause_count; i++) {
        uint32_t states;
        status = tn_library_effect(library, i, out, only, &states, error);
        if (status == TN_OK)
            used += (size_t)gmp_snprintf(text + used, TEXT_MAX - used, "%Zd %Zd %u\n", out, only, states);
    }
    if (status == TN_OK)
        status = tn_plan_analysis_new(made->schema, &analysing, &analysis, error);
    for (size_t i = 0; status == TN_OK && i < tn_plan_analysis_count(analysis); i++) {
        const tn_plan_analysis_finding *f = tn_plan_analysis_get(analysis, i);
        used += (size_t)snprintf(text + used, TEXT_MAX - used, "%d %u %u %u %u %zu\n", f->found, f->rule, f->other,
                                 f->clause, f->offset, f->reason_count);
    }
    mpz_clears(out, only, NULL);
    tn_plan_analysis_free(analysis);
    tn_library_free(library);
    return status;
}

/* Some random libraries, in a random order with returns, as texts are edited: each as if it were the first. */
static void edit(tn_plan_memory *memory)
{
    static _Thread_local char cold[TEXT_MAX], warm[TEXT_MAX];
    for (uint64_t i = 0; i < EDITS; i++) {
        test_library made;
        tn_error error;
        uint64_t seed = 1 + i * i % 23;
        if (test_library_make(&made, seed, &test_schema_tiny, 1, 4)) {
            cold[0] = warm[0] = '\0';
            tn_status status = describe(&made, NULL, cold, &error);
            assert_int_equal(describe(&made, memory, warm, &error), status);
            assert_string_equal(warm, cold);
        }
        test_library_clear(&made);
    }
}

static void edits_give_what_they_would_give_first(void **state)
{
    (void)state;
    size_t found, looked;
    tn_plan_memory *memory = tn_plan_memory_new(0);
    assert_non_null(memory);
    edit(memory);
    tn_plan_memory_looks(memory, &found, &looked);
    assert_true(found > 20 && found < looked); /* most libraries come back, none is known at first */
    tn_plan_memory_free(memory);
}

/* So little room that answers are forgotten all the time. */
static void little_room_is_enough(void **state)
{
    (void)state;
    tn_plan_memory *memory = tn_plan_memory_new(1500);
    assert_non_null(memory);
    edit(memory);
    tn_plan_memory_free(memory);
}

typedef struct sharing {
    tn_plan_memory *memory;
    atomic_size_t wrong;
} sharing;

static void find_or_keep(void *context, uint32_t number)
{
    sharing *s = context;
    uint64_t i = number, kept[2];
    const tn_memory_key key = {i * i % 97, i % 3};
    const uint64_t answer[2] = {key.low * 7, key.high};
    if (!tn_plan_memory_find(s->memory, key, kept, sizeof kept))
        tn_plan_memory_keep(s->memory, key, answer, sizeof answer);
    else if (memcmp(kept, answer, sizeof kept) != 0)
        s->wrong++;
}

static void threads_share_it(void **state)
{
    (void)state;
    sharing s = {.memory = tn_plan_memory_new(4096)};
    tn_crew *crew = tn_crew_new(4, NULL);
    assert_non_null(s.memory);
    assert_non_null(crew);
    assert_int_equal(tn_crew_share(crew, 20000, find_or_keep, &s, NULL), TN_OK);
    assert_int_equal(s.wrong, 0);
    tn_crew_free(crew);
    tn_plan_memory_free(s.memory);
}

static void another_size_is_another_answer(void **state)
{
    (void)state;
    const tn_memory_key key = {1, 2};
    uint64_t answer[2] = {3, 4};
    tn_plan_memory *memory = tn_plan_memory_new(0);
    assert_non_null(memory);
    assert_false(tn_plan_memory_find(memory, key, answer, sizeof answer));
    tn_plan_memory_keep(memory, key, answer, sizeof answer);
    assert_false(tn_plan_memory_find(memory, key, answer, sizeof *answer));
    assert_true(tn_plan_memory_find(memory, key, answer, sizeof answer));
    tn_plan_memory_free(memory);
}

/* Each allocation fails once: what fails says so, what does not is right, and it works again afterwards. */
static void memory_runs_out(void **state)
{
    (void)state;
    static char wanted[TEXT_MAX], text[TEXT_MAX];
    test_library made;
    tn_error error;
    assert_true(test_library_make(&made, 3, &test_schema_tiny, 1, 4));
    test_ok(describe(&made, NULL, wanted, &error), &error);
    for (size_t number = 0;; number += 1 + number / 64) {
        fail_allocation(number, 0);
        tn_plan_memory *memory = tn_plan_memory_new(0);
        tn_status status = memory ? describe(&made, memory, text, &error) : TN_MEMORY;
        bool reached = stop_failing() > number;
        if (status == TN_OK)
            assert_string_equal(text, wanted);
        else
            assert_int_equal(status, TN_MEMORY);
        if (memory) {
            test_ok(describe(&made, memory, text, &error), &error);
            assert_string_equal(text, wanted);
        }
        tn_plan_memory_free(memory);
        if (!reached)
            break;
    }
    test_library_clear(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edits_give_what_they_would_give_first),
        cmocka_unit_test(little_room_is_enough),
        cmocka_unit_test(another_size_is_another_answer),
        cmocka_unit_test(memory_runs_out),
        cmocka_unit_test(threads_share_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
