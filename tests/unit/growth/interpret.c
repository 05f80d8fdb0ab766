/* Growing by templates and by interpreting the rules' code: the same bytes after every step, on the standard library,
 * in surroundings of all kinds, and on random systems. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/growth/growth.h"
#include "runtime/growth/study.h"
#include "runtime/load.h"
#include "runtime/mesh/openmesh.h"
#include "tests/support/compile_file.h"
#include "tests/support/test_system.h"

enum { SYSTEMS = 600, STEPS = 4, EDGES = 1500 };

typedef struct pair {
    tn_compilation compilation;
    tn_module *module;
    tn_growth_system *system;
    tn_study study;
    tn_growth *by_template, *by_code;
} pair;

/* How much the systems together did, so that the test is known to try what it should. */
typedef struct seen {
    uint64_t steps, limits, rewrites, joins, refused;
} seen;

static const char *const dirs[] = {TARTAN_SOURCE_DIR "/stdlib"};

static void plant(pair *p, const char *path, const char *text)
{
    library_folders folders = {.stdlib_dirs = dirs, .stdlib_dir_count = 1};
    tn_error error = {0};
    memset(p, 0, sizeof *p);
    if (compile_text(path, text, strlen(text), &folders, &p->compilation) != TN_OK)
        fail_msg("%s\n%s", p->compilation.diagnostics.count ? p->compilation.diagnostics.items[0].message : "", text);
    tn_status status = tn_module_load(p->compilation.module, p->compilation.module_size, NULL, &p->module, &error);
    if (status == TN_OK)
        status = tn_growth_system_read(p->module, &p->system, &error);
    if (status == TN_OK)
        status = tn_study_read(p->module, path, &tn_openmesh_reader, &p->study, &error);
    if (status != TN_OK)
        fail_msg("%s\n%s", error.message, text);
}

static void begin(pair *p)
{
    tn_error error;
    p->study.options.threads = 1;
    p->study.options.interpret = false;
    assert_int_equal(tn_growth_new(p->system, &p->study.environment, &p->study.options, &p->by_template, &error),
                     TN_OK);
    p->study.options.interpret = true;
    assert_int_equal(tn_growth_new(p->system, &p->study.environment, &p->study.options, &p->by_code, &error), TN_OK);
}

static void uproot(pair *p)
{
    tn_growth_free(p->by_template);
    tn_growth_free(p->by_code);
    tn_growth_system_free(p->system);
    tn_study_clear(&p->study);
    tn_module_free(p->module);
    tn_compilation_clear(&p->compilation);
}

static bool same(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

static bool same_map(const tn_map *a, const tn_map *b)
{
    size_t edges = a->edge_count;
    return a->vertex_count == b->vertex_count && edges == b->edge_count && a->face_count == b->face_count &&
           same(a->positions, b->positions, 24 * (size_t)a->vertex_count) && same(a->states, b->states, 4 * edges) &&
           same(a->origin, b->origin, 8 * edges) && same(a->side, b->side, 8 * edges) &&
           same(a->face_first, b->face_first, 4 * (size_t)a->face_count);
}

/* Both take a step. False where a limit ends it, for both and with the same words. */
static bool step(pair *p, const char *text, seen *so_far)
{
    tn_error one = {0}, other = {0};
    tn_status status = tn_growth_step(p->by_template, &one);
    if (tn_growth_step(p->by_code, &other) != status || strcmp(one.message, other.message) != 0)
        fail_msg("step %u of one engine says: %s; of the other: %s\n%s", tn_growth_steps(p->by_template) + 1,
                 one.message, other.message, text);
    if (status != TN_OK) {
        so_far->limits++;
        return false;
    }
    tn_growth_counts a = tn_growth_last_counts(p->by_template), b = tn_growth_last_counts(p->by_code);
    if (!same_map(tn_growth_map(p->by_template), tn_growth_map(p->by_code)) || memcmp(&a, &b, sizeof a) != 0 ||
        tn_growth_at_rest(p->by_template) != tn_growth_at_rest(p->by_code))
        fail_msg("the engines differ after step %u\n%s", tn_growth_steps(p->by_template), text);
    so_far->steps++;
    so_far->rewrites += a.rewrites;
    so_far->joins += a.joins;
    so_far->refused += a.refused;
    return true;
}

static void test_the_standard_library(void **state)
{
    (void)state;
    static const char *const studies[] = {
        "rules \"square\" steps 6",
        "rules \"triangle\" steps 5 branch-length 2 repeller at 1 1 0 strength 0.5",
        "rules \"koch\" steps 4 scale 1 mirror",
        "rules \"ruffle\" steps 6 attractor at 3 2 2 strength 1 exponent 1.5",
        "rules \"apical\" steps 8 facing",
        "rules \"alternate\" steps 6 branch-angle 75",
        "rules \"probabilistic\" steps 4 seed 5 gravity 0 0 -0.3",
        "rules \"square\" steps 5 gravity 0 0 -0.4 boundary sphere at 0 0 -1 radius 0.9",
        "rules \"square\" steps 5 fixed-perimeter boundary plane at 0 0 -0.1 normal 0 0 1 stop gravity 0 0 -1",
    };
    seen so_far = {0};
    for (size_t i = 0; i < sizeof studies / sizeof *studies; i++) {
        pair p;
        plant(&p, "t.study", studies[i]);
        begin(&p);
        for (uint32_t n = 0; n < p.study.steps; n++)
            assert_true(step(&p, studies[i], &so_far));
        uproot(&p);
    }
    assert_true(so_far.rewrites > 5000 && so_far.joins > 500);
}

static void test_random_systems(void **state)
{
    (void)state;
    seen so_far = {0};
    for (uint64_t number = 0; number < SYSTEMS; number++) {
        char *text = test_system_text(number);
        pair p;
        plant(&p, "t.hemls", text);
        p.study.options.edge_limit = EDGES;
        p.study.options.seed = number;
        p.study.options.mirror = number % 5 == 0;
        p.study.options.facing = number % 7 == 0;
        p.study.options.explain = number % 3 == 0;
        p.study.options.branch_angle = number % 4 == 0 ? (double)(number % 180) : -1;
        begin(&p);
        for (uint32_t n = 0; n < STEPS && step(&p, text, &so_far); n++)
            ;
        uproot(&p);
        free(text);
    }
    assert_true(so_far.steps > 2 * SYSTEMS && so_far.limits > SYSTEMS / 20);
    assert_true(so_far.rewrites > 10000 && so_far.joins > 500 && so_far.refused > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_standard_library),
        cmocka_unit_test(test_random_systems),
    };
    return cmocka_run_group_tests_name("interpret", tests, NULL, NULL);
}
