/* The C interface to test blocks: what became of each case. */
#include <stdlib.h>
#include <string.h>

#include "api/source/source.h"
#include "driver/plan/tests.h"
#include "runtime/base/array.h"

typedef struct test_result {
    tn_test_outcome outcome;
    const char *subject, *doc; /* the source's */
    char *message;
    const char *path;
    uint32_t begin, end;
} test_result;

struct tartan_tests {
    test_result *items;
    size_t count, capacity;
    size_t failed;
    const tn_sources *sources;
    bool out_of_memory;
};

static void see(void *context, const tn_test_block *block, const tn_test_case *test, tn_test_outcome outcome,
                const char *message)
{
    tartan_tests *tests = context;
    if (!tn_array_reserve(&tests->items, &tests->capacity, tests->count, 1, sizeof *tests->items)) {
        tests->out_of_memory = true;
        return;
    }
    test_result *result = &tests->items[tests->count++];
    *result = (test_result){.outcome = outcome,
                            .subject = block->subject,
                            .doc = test->doc,
                            .message = message ? strdup(message) : NULL,
                            .path = tests->sources->files[test->span.file].path,
                            .begin = test->span.begin,
                            .end = test->span.end};
    tests->out_of_memory |= message && !result->message;
    tests->failed += outcome == TN_TEST_FAILED || outcome == TN_TEST_DONE;
}

tartan_status tartan_source_test(tartan_source *source, uint32_t max_states, const tartan_watch *watch,
                                 tartan_tests **tests, tartan_error *error)
{
    tn_api_work work;
    tn_test_counts counts = {0};
    if (!tests)
        return tn_api_missing(error, "room for the tests");
    tartan_status status = tn_api_source_begin(source, watch, &work, error);
    if (status != TARTAN_OK)
        return status;
    tartan_tests *made = calloc(1, sizeof *made);
    tn_status ran = TN_MEMORY;
    if (made) {
        made->sources = &source->opened.compilation.sources;
        const tn_test_watcher watcher = {see, made};
        ran = tn_tests_run(&source->opened, max_states, &watcher, &counts);
        if (ran == TN_INVALID && made->failed > 0)
            ran = TN_OK; /* cases failed: that is the answer */
        if (made->out_of_memory)
            ran = TN_MEMORY;
    }
    status = tn_api_source_end(&work, ran, error);
    if (status == TARTAN_OK)
        *tests = made;
    else
        tartan_tests_free(made);
    return status;
}

void tartan_tests_free(tartan_tests *tests)
{
    for (size_t i = 0; tests && i < tests->count; i++)
        free(tests->items[i].message);
    free(tests ? tests->items : NULL);
    free(tests);
}

size_t tartan_tests_count(const tartan_tests *tests)
{
    return tests->count;
}

size_t tartan_tests_failed(const tartan_tests *tests)
{
    return tests->failed;
}

_Static_assert((int)TARTAN_TEST_DONE == (int)TN_TEST_DONE, "outcomes are the same numbers");

tartan_status tartan_tests_case(const tartan_tests *tests, size_t i, tartan_test_case *test, tartan_error *error)
{
    if (!tests)
        return tn_api_missing(error, "tests");
    if (i >= tests->count)
        return tn_api_refuse(error, TARTAN_INVALID, "there are %zu test cases", tests->count);
    const test_result *r = &tests->items[i];
    tartan_test_case own = {.size = sizeof own,
                            .outcome = (tartan_test_outcome)r->outcome,
                            .subject = r->subject,
                            .doc = r->doc,
                            .message = r->message,
                            .path = r->path,
                            .source_begin = r->begin,
                            .source_end = r->end};
    return TN_API_GIVE(tartan_test_case, test, &own, error);
}
