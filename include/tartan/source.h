/* Rule files with their source: their test blocks, what the tests cover, and a report as a page. Only libtartan has
 * this. */
#ifndef TARTAN_SOURCE_H
#define TARTAN_SOURCE_H

#include "compile.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A rule file that was compiled, with its source. It belongs to one thread at a time. */
typedef struct tartan_source tartan_source;

/* Compiles a text as tartan_compile_text does; text NULL: the file at `path`. What `options` point to is used during
 * the call only. */
TARTAN_API tartan_status tartan_source_open(const char *path, const char *text, size_t size,
                                            const tartan_compile_options *options, tartan_source **source,
                                            tartan_error *error);
TARTAN_API void tartan_source_free(tartan_source *source);
TARTAN_API const tartan_module *tartan_source_module(const tartan_source *source);

/* ---- tests */

typedef enum tartan_test_outcome {
    TARTAN_TEST_PASSED,
    TARTAN_TEST_FAILED,
    TARTAN_TEST_TODO, /* failed, as its mark `todo` expects */
    TARTAN_TEST_DONE, /* passed in spite of its mark `todo`: a failure too */
} tartan_test_outcome;

typedef struct tartan_test_case {
    size_t size;
    tartan_test_outcome outcome;
    const char *subject; /* the rule or library that it is about */
    const char *doc;     /* what its author says of it, or NULL */
    const char *message; /* why it failed, or NULL */
    const char *path;    /* of its file; its bytes there: */
    uint32_t source_begin, source_end;
} tartan_test_case;
TARTAN_SIZED(tartan_test_case)

typedef struct tartan_tests tartan_tests;

/* Runs the test blocks of the file itself, each case by both engines. TARTAN_OK also where cases fail. max_states: of
 * any automaton; 0: 20,000. `watch` may be NULL. TARTAN_INVALID: only .plan files have tests. */
TARTAN_API tartan_status tartan_source_test(tartan_source *source, uint32_t max_states, const tartan_watch *watch,
                                            tartan_tests **tests, tartan_error *error);
TARTAN_API void tartan_tests_free(tartan_tests *tests);
TARTAN_API size_t tartan_tests_count(const tartan_tests *tests);
TARTAN_API size_t tartan_tests_failed(const tartan_tests *tests); /* FAILED and DONE */
TARTAN_API tartan_status tartan_tests_case(const tartan_tests *tests, size_t i, tartan_test_case *test,
                                           tartan_error *error);

/* ---- coverage */

/* A small change of a rule about plans, or of a clause of its library; or a part of a rule about houses, which never
 * matches then. */
typedef struct tartan_covered_part {
    size_t size;
    const char *rule;   /* name of the rule or clause */
    uint32_t depth;     /* 0: the whole rule */
    const char *kind;   /* what is changed: "neighbour", "tray", "item", "value" */
    const char *text;   /* as its author wrote it, cut off where it is long */
    const char *plans;  /* how many plans would be decided otherwise, in decimal; NULL: the part is of a rule about
                         * houses, or that passes the limit of states */
    bool noticed;       /* would a test case notice that? */
    const char *change; /* what is made of the text: "never matches", "changed to `12'`" */
} tartan_covered_part;
TARTAN_SIZED(tartan_covered_part)

typedef struct tartan_coverage tartan_coverage;

/* Measures which small changes of the rules the tests notice. Plans are counted among all of the library's lengths
 * (name NULL: the only one of the file; in a file without one, of 1 to 4 trays). What passes max_states (0: 20,000) is
 * not counted. `watch` may be NULL. */
TARTAN_API tartan_status tartan_source_cover(tartan_source *source, const char *library, uint32_t max_states,
                                             const tartan_watch *watch, tartan_coverage **coverage,
                                             tartan_error *error);
TARTAN_API void tartan_coverage_free(tartan_coverage *coverage);
TARTAN_API size_t tartan_coverage_count(const tartan_coverage *coverage);
TARTAN_API size_t tartan_coverage_noticed(const tartan_coverage *coverage); /* parts that a test notices */
TARTAN_API tartan_status tartan_coverage_part(const tartan_coverage *coverage, size_t i, tartan_covered_part *part,
                                              tartan_error *error);

/* ---- the report */

typedef struct tartan_report_options {
    size_t size;
    const char *library; /* NULL: the only one of the file */
    uint64_t seed;       /* of the sample */
    uint32_t samples;    /* plans that are kept, and as many that are generated and dropped; 0: 24; at most 2,000 */
    uint32_t max_states; /* 0: the default */
} tartan_report_options;
TARTAN_SIZED(tartan_report_options)

/* A library as one HTML page that needs nothing else: what `tartan report` writes. `options` and `watch` may be NULL.
 * Free the page with tartan_text_free. */
TARTAN_API tartan_status tartan_source_report(tartan_source *source, const tartan_report_options *options,
                                              const tartan_watch *watch, char **page, size_t *size,
                                              tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
