/* The C interface to rule files with their source: tests, coverage, reports. */
#include <stdlib.h>
#include <string.h>

#include "api/compiler/compile.h"
#include "driver/coverage/coverage.h"
#include "driver/plan/tests.h"
#include "driver/report/report.h"
#include "runtime/base/array.h"

struct tartan_source {
    tn_opened opened;
    char *path;           /* the caller's, copied */
    tartan_module module; /* what was opened, borrowed by whoever asks */
};

/* Work on a source: it may be given up, and what it says is its own, not the source's. */
typedef struct api_work {
    tartan_source *source;
    tn_watch watch;
    tn_diagnostics kept; /* the source's */
} api_work;

void tartan_source_free(tartan_source *source)
{
    if (!source)
        return;
    tn_close(&source->opened);
    free(source->path);
    free(source);
}

tartan_status tartan_source_open(const char *path, const char *text, size_t size, const tartan_compile_options *options,
                                 tartan_source **source, tartan_error *error)
{
    if (!path || !source)
        return tn_api_missing(error, path ? "room for the source" : "path");
    tartan_source *made = calloc(1, sizeof *made);
    if (!made || !(made->path = strdup(path))) {
        free(made);
        return tn_api_memory(error);
    }
    tartan_status status = text ? tn_api_open(made->path, text, size, options, NULL, &made->opened, error)
                                : tn_api_open_file(made->path, options, NULL, &made->opened, error);
    if (status != TARTAN_OK) {
        tartan_source_free(made);
        return status;
    }
    made->module =
        (tartan_module){made->opened.module, made->opened.compilation.module, made->opened.compilation.module_size};
    *source = made;
    return TARTAN_OK;
}

const tartan_module *tartan_source_module(const tartan_source *source)
{
    return &source->module;
}

/* Begins work with the caller's watch (may be NULL). After TARTAN_OK, end it in any case. */
static tartan_status api_source_begin(tartan_source *source, const tartan_watch *given, api_work *work,
                                      tartan_error *error)
{
    if (!source)
        return tn_api_missing(error, "source");
    tartan_status status = tn_api_watch(given, &work->watch, error);
    if (status != TARTAN_OK)
        return status;
    tn_compilation *compilation = &source->opened.compilation;
    work->source = source;
    work->kept = compilation->diagnostics;
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
    source->opened.module->watch = &work->watch;
    return TARTAN_OK;
}

/* Ends it; a status that is not TN_OK is returned with the first error that was said. */
static tartan_status api_source_end(api_work *work, tn_status status, tartan_error *error)
{
    tn_diagnostics *list = &work->source->opened.compilation.diagnostics;
    work->source->opened.module->watch = NULL;
    tartan_status result = status == TN_OK ? TARTAN_OK : tn_api_first_error(list, status, &work->watch, error);
    tn_diagnostics_clear(list);
    *list = work->kept;
    return result;
}

/* ---- test blocks */

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
    api_work work;
    tn_test_counts counts = {0};
    if (!tests)
        return tn_api_missing(error, "room for the tests");
    tartan_status status = api_source_begin(source, watch, &work, error);
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
    status = api_source_end(&work, ran, error);
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

/* ---- coverage */

struct tartan_coverage {
    tn_covered covered;
    char **plans;   /* [part]: in decimal; NULL: not counted */
    char **changes; /* [part] */
};

static tn_status write_part(tartan_coverage *coverage, size_t i)
{
    const tn_covered_part *part = &coverage->covered.parts[i];
    tn_buffer change = {0};
    bool ok = tn_covered_change(part, &change);
    coverage->changes[i] = change.data;
    if (!ok || part->of_houses || !part->counted)
        return ok ? TN_OK : TN_MEMORY;
    coverage->plans[i] = malloc(mpz_sizeinbase(part->flips, 10) + 2);
    if (!coverage->plans[i])
        return TN_MEMORY;
    mpz_get_str(coverage->plans[i], 10, part->flips);
    return TN_OK;
}

static tn_status write_parts(tartan_coverage *coverage)
{
    tn_status status = TN_OK;
    coverage->plans = calloc(coverage->covered.count + 1, sizeof *coverage->plans);
    coverage->changes = calloc(coverage->covered.count + 1, sizeof *coverage->changes);
    if (!coverage->plans || !coverage->changes)
        return TN_MEMORY;
    for (size_t i = 0; status == TN_OK && i < coverage->covered.count; i++)
        status = write_part(coverage, i);
    return status;
}

tartan_status tartan_source_cover(tartan_source *source, const char *library, uint32_t max_states,
                                  const tartan_watch *watch, tartan_coverage **coverage, tartan_error *error)
{
    api_work work;
    const tn_coverage_options options = {.library = library, .max_states = max_states};
    if (!coverage)
        return tn_api_missing(error, "room for the coverage");
    if (source && !source->opened.compilation.program)
        return tn_api_refuse(error, TARTAN_INVALID, "%.300s is no .plan file, and only those hold tests", source->path);
    tartan_status status = api_source_begin(source, watch, &work, error);
    if (status != TARTAN_OK)
        return status;
    tartan_coverage *made = calloc(1, sizeof *made);
    tn_status measured = made ? tn_coverage_measure(&source->opened, &options, &made->covered) : TN_MEMORY;
    if (measured == TN_OK)
        measured = write_parts(made);
    status = api_source_end(&work, measured, error);
    if (status == TARTAN_OK)
        *coverage = made;
    else
        tartan_coverage_free(made);
    return status;
}

void tartan_coverage_free(tartan_coverage *coverage)
{
    if (!coverage)
        return;
    for (size_t i = 0; coverage->plans && i < coverage->covered.count; i++)
        free(coverage->plans[i]);
    for (size_t i = 0; coverage->changes && i < coverage->covered.count; i++)
        free(coverage->changes[i]);
    free(coverage->plans);
    free(coverage->changes);
    tn_covered_clear(&coverage->covered);
    free(coverage);
}

size_t tartan_coverage_count(const tartan_coverage *coverage)
{
    return coverage->covered.count;
}

size_t tartan_coverage_noticed(const tartan_coverage *coverage)
{
    return coverage->covered.noticed;
}

tartan_status tartan_coverage_part(const tartan_coverage *coverage, size_t i, tartan_covered_part *part,
                                   tartan_error *error)
{
    if (!coverage)
        return tn_api_missing(error, "coverage");
    if (i >= coverage->covered.count)
        return tn_api_refuse(error, TARTAN_INVALID, "there are %zu parts", coverage->covered.count);
    const tn_covered_part *from = &coverage->covered.parts[i];
    tartan_covered_part own = {.size = sizeof own,
                               .rule = from->name,
                               .depth = from->depth,
                               .kind = from->kind,
                               .text = from->text,
                               .plans = coverage->plans[i],
                               .noticed = from->noticed,
                               .change = coverage->changes[i]};
    return TN_API_GIVE(tartan_covered_part, part, &own, error);
}

/* ---- reports */

enum { SAMPLES_DEFAULT = 24, SAMPLES_MOST = 2000 };

/* Analyses, measures and writes, as `tartan report` does. */
static tn_status write_page(tn_opened *opened, const char *library, const tn_report_options *options, tn_buffer *page)
{
    tn_ready_library ready = {0};
    tn_plan_analyses analyses = {0};
    tn_covered covered = {0};
    tn_error error;
    const tn_library_options opening = {.max_states = options->max_states};
    tn_status status = tn_library_ready(opened, library, &opening, &ready);
    if (status == TN_OK) {
        const tn_plan_analysis_options analysis = {.max_states = options->max_states, .library = ready.library};
        status = tn_plan_analyse(opened, &analysis, &analyses);
    }
    if (status == TN_OK) {
        const tn_coverage_options coverage = {.library = tn_text(opened->module, ready.record->name),
                                              .max_states = options->max_states,
                                              .imported = true};
        status = tn_coverage_measure(opened, &coverage, &covered);
    }
    if (status == TN_OK) {
        status = tn_report_page(opened, &ready, &analyses, &covered, options, page, &error);
        if (status != TN_OK)
            tn_finding_error(opened, &error);
    }
    tn_covered_clear(&covered);
    tn_plan_analyses_free(&analyses);
    tn_library_close(&ready);
    return status;
}

tartan_status tartan_source_report(tartan_source *source, const tartan_report_options *given, const tartan_watch *watch,
                                   char **page, size_t *size, tartan_error *error)
{
    tartan_report_options options;
    api_work work;
    tn_buffer made = {0};
    if (!page || !size)
        return tn_api_missing(error, "room for the page");
    tartan_status status = TN_API_TAKE(tartan_report_options, &options, given, error);
    if (status == TARTAN_OK && options.samples > SAMPLES_MOST)
        status = tn_api_refuse(error, TARTAN_LIMIT, "a report shows at most %d plans", SAMPLES_MOST);
    if (status == TARTAN_OK)
        status = api_source_begin(source, watch, &work, error);
    if (status != TARTAN_OK)
        return status;
    const tn_report_options own = {.seed = options.seed,
                                   .samples = options.samples ? options.samples : SAMPLES_DEFAULT,
                                   .max_states = options.max_states};
    status = api_source_end(&work, write_page(&source->opened, options.library, &own, &made), error);
    if (status == TARTAN_OK) {
        *page = made.data;
        *size = made.size;
    } else {
        free(made.data);
    }
    return status;
}
