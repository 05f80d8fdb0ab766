/* What is measured of grown surfaces beside a slow computation of the same from their meshes; and what requirements
 * lack. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/geometry/crossing.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/soundness.h"
#include "runtime/growth/study.h"
#include "runtime/growth/surface.h"
#include "runtime/load.h"
#include "tests/support/compile_file.h"

static const char *const stdlib_dir = TARTAN_SOURCE_DIR "/stdlib";
static const library_folders folders = {.stdlib_dirs = &stdlib_dir, .stdlib_dir_count = 1};

typedef struct grown {
    tn_compilation compilation;
    tn_module *module;
    tn_growth_system *system;
    tn_study study;
    tn_growth *growth;
    tn_fitness fitness;
} grown;

static void grow(grown *g, const char *text, uint64_t asked)
{
    tn_error error = {0};
    memset(g, 0, sizeof *g);
    assert_int_equal(compile_text("t.study", text, strlen(text), &folders, &g->compilation), TN_OK);
    assert_int_equal(tn_module_load(g->compilation.module, g->compilation.module_size, NULL, &g->module, &error),
                     TN_OK);
    assert_int_equal(tn_growth_system_read(g->module, &g->system, &error), TN_OK);
    assert_int_equal(tn_study_read(g->module, "t.study", NULL, &g->study, &error), TN_OK);
    assert_int_equal(tn_growth_new(g->system, &g->study.environment, &g->study.options, &g->growth, &error), TN_OK);
    for (uint32_t n = 0; n < g->study.steps; n++)
        assert_int_equal(tn_growth_step(g->growth, &error), TN_OK);
    g->fitness = tn_fitness_measure(g->growth);
    assert_int_equal(
        tn_soundness_measure(g->growth, &g->study.measuring, asked | g->study.goal.asked, &g->fitness, &error), TN_OK);
}

static void uproot(grown *g)
{
    tn_growth_free(g->growth);
    tn_study_clear(&g->study);
    tn_growth_system_free(g->system);
    tn_module_free(g->module);
    tn_compilation_clear(&g->compilation);
}

static double value(const grown *g, tn_measured measured)
{
    return g->fitness.further[measured - TN_MEASURED_WIDTH];
}

static void is(const grown *g, tn_measured measured, double wanted)
{
    double got = value(g, measured);
    if (!(fabs(got - wanted) <= 1e-9 * (1 + fabs(wanted))))
        fail_msg("%s is %.17g, not %.17g", tn_names_MEASURED[measured], got, wanted);
}

static void test_flat(void **state)
{
    (void)state;
    grown g;
    grow(&g, "rules \"square\" steps 3 scale 1", UINT64_MAX);
    is(&g, TN_MEASURED_WIDTH, 1);
    is(&g, TN_MEASURED_DEPTH, 1);
    is(&g, TN_MEASURED_AREA, 1);
    is(&g, TN_MEASURED_SMALLEST_ANGLE, 90);
    for (int none = TN_MEASURED_CROSSED_FACES; none <= TN_MEASURED_CROSSINGS; none++)
        is(&g, (tn_measured)none, 0);
    assert_true(value(&g, TN_MEASURED_EDGE_SPREAD) < 1e-6);
    is(&g, TN_MEASURED_HEIGHT, 0);
    is(&g, TN_MEASURED_VOLUME, 0);
    is(&g, TN_MEASURED_PLANARITY, 0);
    is(&g, TN_MEASURED_SPAN, 0);
    uproot(&g);
}

static double distance(const double *a, const double *b, int dimensions)
{
    double sum = 0;
    for (int k = 0; k < dimensions; k++)
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sqrt(sum);
}

static double lowest(const tn_mesh *mesh, double *highest)
{
    double low = INFINITY;
    *highest = -INFINITY;
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        low = fmin(low, mesh->positions[3 * v + 2]);
        *highest = fmax(*highest, mesh->positions[3 * v + 2]);
    }
    return low;
}

static double slow_span(const tn_mesh *mesh)
{
    double high, low = lowest(mesh, &high), span = 0;
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        double nearest = INFINITY;
        for (size_t w = 0; w < mesh->vertex_count; w++)
            if (mesh->positions[3 * w + 2] <= low + 0.01 * (high - low))
                nearest = fmin(nearest, distance(mesh->positions + 3 * v, mesh->positions + 3 * w, 2));
        span = fmax(span, nearest);
    }
    return span;
}

static double slow_angle(const tn_mesh *mesh)
{
    double least = 180;
    for (size_t f = 0; f < mesh->face_count; f++) {
        uint32_t first = mesh->face_first[f], size = mesh->face_first[f + 1] - first;
        for (uint32_t i = 0; i < size; i++) {
            const double *at = mesh->positions + 3 * (size_t)mesh->corners[first + i],
                         *a = mesh->positions + 3 * (size_t)mesh->corners[first + (i + 1) % size],
                         *b = mesh->positions + 3 * (size_t)mesh->corners[first + (i + size - 1) % size];
            double p = distance(at, a, 3), q = distance(at, b, 3), r = distance(a, b, 3);
            least = fmin(least, acos(fmax(-1, fmin(1, (p * p + q * q - r * r) / (2 * p * q)))) * 180 / acos(-1));
        }
    }
    return least;
}

/* Area and volume by triangles: all faces of these surfaces have four corners, cut along either diagonal. */
static void slow_sizes(const tn_mesh *mesh, double *least, double *most, double *volume)
{
    double high, low = lowest(mesh, &high);
    *least = *most = *volume = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        uint32_t size = mesh->face_first[f + 1] - mesh->face_first[f];
        double n[3];
        tn_mesh_face_normal(mesh, mesh->corners + mesh->face_first[f], size, n);
        double own = 0, middle[3] = {0};
        for (uint32_t i = 0; i < size; i++)
            for (uint32_t k = 0; k < 3; k++)
                middle[k] += mesh->positions[3 * (size_t)mesh->corners[mesh->face_first[f] + i] + k] / size;
        for (uint32_t i = 0; i < size; i++) { /* a prism with a sloping top under each side's triangle */
            const double *a = &mesh->positions[3 * (size_t)mesh->corners[mesh->face_first[f] + i]],
                         *b = &mesh->positions[3 * (size_t)mesh->corners[mesh->face_first[f] + (i + 1) % size]];
            double plan = 0.5 * (a[0] * b[1] - b[0] * a[1] + b[0] * middle[1] - middle[0] * b[1] + middle[0] * a[1] -
                                 a[0] * middle[1]);
            *volume += plan * ((a[2] + b[2] + middle[2]) / 3 - low);
        }
        for (uint32_t i = 1; i + 1 < size; i++) {
            uint32_t triangle[3] = {mesh->corners[mesh->face_first[f]], mesh->corners[mesh->face_first[f] + i],
                                    mesh->corners[mesh->face_first[f] + i + 1]};
            double t[3];
            tn_mesh_face_normal(mesh, triangle, 3, t);
            own += 0.5 * sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
        }
        *most += own;
        *least += 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    }
    *volume = fabs(*volume);
}

static void test_bent(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "rules \"square\" steps 4 scale 1.2 gravity 0 0 -0.2 repeller at 0.5 0.5 -1 strength 0.6",
        "rules \"square\" steps 5 scale 1 attractor at 2 1 3 strength 0.9 repeller at 0 0 1 strength 0.3",
        "rules \"triangle\" steps 4 scale 1.1 attractor at 0.3 0.2 2 strength 1.5"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        grown g;
        tn_mesh mesh;
        tn_error error;
        double least, most, volume;
        uint64_t crossings;
        grow(&g, texts[i], UINT64_MAX);
        assert_int_equal(tn_surface_mesh(g.growth, &(tn_surface_options){0}, &mesh, &error), TN_OK);
        slow_sizes(&mesh, &least, &most, &volume);
        is(&g, TN_MEASURED_AREA, least);
        assert_true(value(&g, TN_MEASURED_AREA) <= most * (1 + 1e-12));
        is(&g, TN_MEASURED_VOLUME, volume);
        is(&g, TN_MEASURED_SPAN, slow_span(&mesh));
        assert_true(fabs(value(&g, TN_MEASURED_SMALLEST_ANGLE) - slow_angle(&mesh)) < 1e-4);
        assert_true(value(&g, TN_MEASURED_PLANARITY) <= value(&g, TN_MEASURED_WORST_PLANARITY));
        assert_true(value(&g, TN_MEASURED_WORST_PLANARITY) > 0 || i == 2);
        assert_int_equal(tn_mesh_triangulate(&mesh, &error), TN_OK);
        assert_int_equal(tn_mesh_crossings(&mesh, &crossings, &error), TN_OK);
        is(&g, TN_MEASURED_CROSSINGS, (double)crossings);
        tn_mesh_clear(&mesh);
        uproot(&g);
    }
}

static void test_requirements(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double lacking;
    } cases[] = {{"require area <= 1", 0},
                 {"require area <= 0.25", 0.75},
                 {"require width = 3 and depth >= 1.5", 2.0 / 3 + 0.5 / 1.5},
                 {"require 3 = width or depth >= 1.5", 0.5 / 1.5},
                 {"require 3 <= width", 2.0 / 3},
                 {"require not (width < 2 * 1.5)", 2.0 / 3},
                 {"require faces >= 20 require edges in 100..200", 0.2 + 0.6}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        grown g;
        char text[200];
        snprintf(text, sizeof text, "rules \"square\" steps 2 scale 1 fitness area target 2 weight 3 %s",
                 cases[i].text);
        grow(&g, text, 0);
        assert_true(fabs(tn_fitness_lacking(&g.fitness, &g.study.goal) - cases[i].lacking) < 1e-9);
        assert_true(fabs(tn_fitness_total(&g.fitness, &g.study.goal, 1) - (10 * cases[i].lacking + 1.5)) < 1e-9);
        is(&g, TN_MEASURED_CROSSINGS, 0);
        uproot(&g);
    }
}

/* ---- light */

/* Does a line from a point towards the sun meet a triangle? */
static bool is_met(const tn_mesh *mesh, size_t face, tn_vector from, tn_vector sun)
{
    tn_vector a = tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * face]),
              u = tn_sub(tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * face + 1]), a),
              v = tn_sub(tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * face + 2]), a),
              p = tn_cross(sun, v), t = tn_sub(from, a), q = tn_cross(t, u);
    double det = tn_dot(u, p), x = tn_dot(t, p) / det, y = tn_dot(sun, q) / det;
    return fabs(det) > 1e-12 && x >= 0 && y >= 0 && x + y <= 1 && tn_dot(v, q) / det > 1e-7;
}

/* Lines from points spread over all triangles. */
static double share_by_lines(const grown *g, tn_vector sun)
{
    enum { POINTS = 60 };
    tn_mesh mesh;
    tn_error error;
    double lit = 0, whole = 0;
    assert_int_equal(tn_surface_mesh(g->growth, &(tn_surface_options){0}, &mesh, &error), TN_OK);
    assert_int_equal(tn_mesh_triangulate(&mesh, &error), TN_OK);
    for (size_t f = 0; f < mesh.face_count; f++) {
        tn_vector a = tn_vector_at(mesh.positions + 3 * (size_t)mesh.corners[3 * f]),
                  u = tn_sub(tn_vector_at(mesh.positions + 3 * (size_t)mesh.corners[3 * f + 1]), a),
                  v = tn_sub(tn_vector_at(mesh.positions + 3 * (size_t)mesh.corners[3 * f + 2]), a);
        double area = tn_norm(tn_cross(u, v)) / 2;
        whole += area;
        for (uint32_t i = 0; i < POINTS; i++) {
            double x = (double)(tn_random64(1, f, 2 * i) >> 11) * 0x1p-53,
                   y = (double)(tn_random64(1, f, 2 * i + 1) >> 11) * 0x1p-53;
            if (x + y > 1) {
                x = 1 - x;
                y = 1 - y;
            }
            tn_vector from = tn_along(tn_along(a, u, x), v, y);
            bool dark = fabs(tn_dot(tn_cross(u, v), sun)) < 1e-6 * area;
            for (size_t other = 0; other < mesh.face_count && !dark; other++)
                dark = other != f && is_met(&mesh, other, from, sun);
            lit += dark ? 0 : area / POINTS;
        }
    }
    tn_mesh_clear(&mesh);
    return lit / whole;
}

static void test_light(void **state)
{
    (void)state;
    grown g;
    grow(&g, "rules \"square\" steps 3", UINT64_MAX);
    is(&g, TN_MEASURED_SUNLIT, 1);
    assert_true(isnan(value(&g, TN_MEASURED_DISTANCE_TO)));
    uproot(&g);
    grow(&g, "rules \"square\" steps 3 sun 1 0 0", UINT64_MAX);
    is(&g, TN_MEASURED_SUNLIT, 0);
    uproot(&g);
    static const char *const studies[] = {
        "rules \"ruffle\" steps 4 sun 1 0.3 0.2", "rules \"square\" steps 4 sun -1 2 0.7 attractor at 2 1 3 strength 4",
        "rules \"square\" steps 4 sun 0 0 1 attractor at 1 1 -1 strength 9 repeller at 0 0 1 strength 2",
        "rules \"triangle\" steps 3 sun 3 -1 0.4 gravity 0 0 -0.4 boundary sphere at 0 0 -1 radius 0.9"};
    for (size_t i = 0; i < sizeof studies / sizeof *studies; i++) {
        grow(&g, studies[i], UINT64_MAX);
        double wanted = share_by_lines(&g, g.study.measuring.sun), got = value(&g, TN_MEASURED_SUNLIT);
        if (!(fabs(got - wanted) < 0.01))
            fail_msg("%s: sunlit is %.17g, not %.17g", studies[i], got, wanted);
        uproot(&g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_flat), cmocka_unit_test(test_light),
                                       cmocka_unit_test(test_bent), cmocka_unit_test(test_requirements)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
