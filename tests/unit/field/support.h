/* What tests of fields share: compiling a text, and whether a mesh is closed and manifold. */
#ifndef TARTAN_TESTS_UNIT_FIELD_SUPPORT_H
#define TARTAN_TESTS_UNIT_FIELD_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/field/contour.h"
#include "runtime/load.h"
#include "tests/support/compile_file.h"

static const char *const stdlib_dir = TARTAN_SOURCE_DIR "/stdlib";
static const library_folders folders = {.stdlib_dirs = &stdlib_dir, .stdlib_dir_count = 1};

static inline tn_module *compile(const char *text)
{
    tn_compilation c;
    tn_module *module;
    tn_error error;
    tn_diagnostics_init(&c.diagnostics, &c.sources);
    if (compile_text("t.field", text, strlen(text), &folders, &c) != TN_OK)
        fail_msg("%s\n%s", c.diagnostics.count ? c.diagnostics.items[0].message : "", text);
    assert_int_equal(tn_module_load(c.module, c.module_size, NULL, &module, &error), TN_OK);
    tn_compilation_clear(&c);
    return module;
}

typedef struct dice {
    uint64_t count;
} dice;

static inline uint32_t roll(dice *d, uint32_t sides)
{
    return (uint32_t)(tn_random64(3, 9, d->count++) % sides);
}

static inline double between(dice *d, double low, double high)
{
    return low + (high - low) * (double)(tn_random64(3, 9, d->count++) >> 11) * 0x1p-53;
}

typedef struct side {
    uint32_t from, to;
} side;

static inline int by_ends(const void *a, const void *b)
{
    const side *p = a, *q = b;
    return p->from != q->from ? (p->from < q->from ? -1 : 1) : p->to != q->to ? (p->to < q->to ? -1 : 1) : 0;
}

/* Every side once in each direction, and the triangles at a vertex in one ring. */
static inline void check_manifold(const tn_mesh *mesh)
{
    size_t count = 3 * mesh->face_count;
    side *sides = calloc(count + 1, sizeof *sides);
    uint32_t *degree = calloc(mesh->vertex_count + 1, sizeof *degree);
    assert_non_null(sides);
    assert_non_null(degree);
    for (size_t i = 0; i < count; i++) {
        sides[i] = (side){mesh->corners[i], mesh->corners[i % 3 == 2 ? i - 2 : i + 1]};
        degree[mesh->corners[i]]++;
    }
    qsort(sides, count, sizeof *sides, by_ends);
    for (size_t i = 0; i < count; i++) {
        side other = {sides[i].to, sides[i].from};
        assert_true(i == 0 || by_ends(&sides[i - 1], &sides[i]) != 0);
        assert_non_null(bsearch(&other, sides, count, sizeof other, by_ends));
    }
    /* One ring: walking from triangle to triangle round a vertex meets all of them. */
    uint32_t *next = calloc(count + 1, sizeof *next); /* of the side from v to a: the side from v to b, b before a */
    assert_non_null(next);
    for (size_t f = 0; f < mesh->face_count; f++)
        for (size_t k = 0; k < 3; k++) {
            const uint32_t *c = mesh->corners + 3 * f;
            side own = {c[k], c[(k + 1) % 3]}, across = {c[k], c[(k + 2) % 3]};
            size_t at = (size_t)((side *)bsearch(&own, sides, count, sizeof own, by_ends) - sides);
            next[at] = (uint32_t)((side *)bsearch(&across, sides, count, sizeof across, by_ends) - sides);
        }
    for (size_t i = 0; i < count; i += degree[sides[i].from]) {
        uint32_t at = (uint32_t)i, met = 0;
        do {
            at = next[at];
            met++;
        } while (at != i && met <= count);
        assert_int_equal(met, degree[sides[i].from]);
    }
    free(next);
    free(sides);
    free(degree);
}

#endif
