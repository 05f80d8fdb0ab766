/* The mapping and the union on designs that the test makes, half of them on coarse lattices, where everything
 * coincides: no two boxes overlap, correcting again changes nothing, every mesh is closed, a manifold, and holds the
 * volume of the cells, which is what random points say. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/geometry/union/contacts.h"
#include "runtime/geometry/union/union.h"
#include "runtime/math/elementary.h"
#include "runtime/solid/measure.h"
#include "tests/support/openmesh_takes.h"

enum { BOXES = 12 };

static uint64_t state;

static double uniform(void)
{
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(state >> 11) / 9007199254740992.0;
}

static double choose(double low, double high, bool lattice)
{
    double x = low + (high - low) * uniform();
    return lattice ? floor(x * 2 + 0.5) / 2 : x;
}

static void make_box(tn_solid_box *box, bool lattice)
{
    static const double angles[] = {0, 45, 90, -45, 180, 35.264389682754654, 30};
    double size[3];
    for (int k = 0; k < 3; k++) {
        double at = choose(-3, 3, lattice);
        size[k] = choose(0.5, 3, lattice);
        box->low[k] = at - size[k] / 2;
        box->high[k] = at + size[k] / 2;
    }
    double a = lattice ? angles[(int)(uniform() * 7)] : 360 * uniform(),
           b = lattice ? angles[(int)(uniform() * 7)] : 180 * uniform() - 90;
    box->normal[0] = tn_cos_degrees(b) * tn_sin_degrees(a);
    box->normal[1] = tn_sin_degrees(b);
    box->normal[2] = tn_cos_degrees(b) * tn_cos_degrees(a);
    box->distance = choose(-1, 2, lattice);
    if (lattice && uniform() < 0.3) { /* through a corner, or beside it by one unit in the last place */
        box->distance = 0;
        for (int k = 0; k < 3; k++)
            box->distance += box->normal[k] * (uniform() < 0.5 ? -size[k] : size[k]) / 2;
        if (uniform() < 0.5)
            box->distance = nextafter(box->distance, uniform() < 0.5 ? -9 : 9);
    }
    box->clipped = uniform() < 0.8;
    box->rigid = uniform() < 0.1;
}

static void make_design(uint64_t seed, tn_design *design)
{
    state = seed * 2654435761u + 17;
    uniform();
    bool lattice = seed % 2;
    *design = (tn_design){.box_count = 1 + (uint32_t)(uniform() * BOXES), .flags = (uint32_t)(uniform() * 8)};
    if (uniform() < 0.3)
        design->flags |= TN_SOLID_PENETRATION;
    design->boxes = calloc(BOXES + 1, sizeof *design->boxes);
    for (uint32_t i = 0; i < design->box_count; i++)
        make_box(&design->boxes[i], lattice);
}

static void check_apart(const tn_cut_box *cells, const tn_design *design, size_t count)
{
    uint32_t n = design->box_count;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++) {
            bool apart = design->boxes[i % n].void_ || design->boxes[j % n].void_;
            if (apart)
                continue;
            for (int k = 0; k < 3; k++)
                apart |= cells[i].low[k] >= cells[j].high[k] || cells[j].low[k] >= cells[i].high[k];
            assert_true(apart);
        }
}

static int by_value(const void *a, const void *b)
{
    const uint64_t *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* Each edge once in each direction: two triangles an edge. */
static void check_edges(const tn_mesh *mesh)
{
    size_t count = 3 * mesh->face_count;
    uint64_t *there = malloc((count + 1) * sizeof *there), *back = malloc((count + 1) * sizeof *back);
    for (size_t c = 0; c < count; c++) {
        uint64_t a = mesh->corners[c], b = mesh->corners[c % 3 == 2 ? c - 2 : c + 1];
        there[c] = a << 32 | b;
        back[c] = b << 32 | a;
    }
    qsort(there, count, sizeof *there, by_value);
    qsort(back, count, sizeof *back, by_value);
    assert_memory_equal(there, back, count * sizeof *there);
    for (size_t c = 1; c < count; c++)
        assert_true(there[c] != there[c - 1]);
    free(there);
    free(back);
}

typedef struct spoke {
    uint32_t vertex, from, to; /* a triangle at a vertex: the two others, counter-clockwise */
} spoke;

static int by_vertex(const void *a, const void *b)
{
    const spoke *x = a, *y = b;
    return (x->vertex > y->vertex) - (x->vertex < y->vertex);
}

/* The triangles at each vertex go round it once, all of them. */
static void check_umbrellas(const tn_mesh *mesh)
{
    size_t count = 3 * mesh->face_count;
    spoke *spokes = malloc((count + 1) * sizeof *spokes);
    for (size_t c = 0; c < count; c++) {
        size_t f = c - c % 3;
        spokes[c] = (spoke){mesh->corners[c], mesh->corners[f + (c + 1) % 3], mesh->corners[f + (c + 2) % 3]};
    }
    qsort(spokes, count, sizeof *spokes, by_vertex);
    for (size_t begin = 0, end; begin < count; begin = end) {
        uint32_t at = spokes[begin].from;
        size_t steps = 0;
        for (end = begin; end < count && spokes[end].vertex == spokes[begin].vertex;)
            end++;
        do {
            size_t i = begin;
            while (i < end && spokes[i].from != at)
                i++;
            assert_true(i < end);
            at = spokes[i].to;
            steps++;
        } while (at != spokes[begin].from && steps <= end - begin);
        assert_int_equal(steps, end - begin);
    }
    free(spokes);
}

static uint32_t root(uint32_t *parent, uint32_t x)
{
    while (parent[x] != x)
        x = parent[x] = parent[parent[x]];
    return x;
}

static double volume_under(const tn_mesh *mesh, size_t face)
{
    const double *a = mesh->positions + 3 * (size_t)mesh->corners[3 * face],
                 *b = mesh->positions + 3 * (size_t)mesh->corners[3 * face + 1],
                 *c = mesh->positions + 3 * (size_t)mesh->corners[3 * face + 2];
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Pieces of the mesh that hold a volume; hollows, whose surface is turned inside, do not count. */
static size_t count_pieces(const tn_mesh *mesh)
{
    uint32_t *parent = malloc((mesh->vertex_count + 1) * sizeof *parent);
    double *volume = calloc(mesh->vertex_count + 1, sizeof *volume);
    size_t pieces = 0;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        parent[v] = v;
    for (size_t c = 0; c < 3 * mesh->face_count; c++)
        parent[root(parent, mesh->corners[c])] = root(parent, mesh->corners[c % 3 == 2 ? c - 2 : c + 1]);
    for (size_t f = 0; f < mesh->face_count; f++)
        volume[root(parent, mesh->corners[3 * f])] += volume_under(mesh, f);
    for (size_t v = 0; v < mesh->vertex_count; v++)
        pieces += volume[v] > 0;
    free(parent);
    free(volume);
    return pieces;
}

static size_t count_parts(const tn_cut_box *cells, size_t count, double least)
{
    tn_contacts contacts;
    tn_error error = {0};
    uint32_t *parent = malloc((count + 1) * sizeof *parent);
    size_t parts = 0;
    for (uint32_t i = 0; i < count; i++)
        parent[i] = i;
    assert_int_equal(tn_contacts_find(cells, count, least, &contacts, &error), TN_OK);
    for (size_t i = 0; i < contacts.count; i++)
        parent[root(parent, contacts.items[i].a)] = root(parent, contacts.items[i].b);
    tn_contacts_clear(&contacts);
    for (uint32_t i = 0; i < count; i++)
        parts += cells[i].face_count > 0 && root(parent, i) == i;
    free(parent);
    return parts;
}

/* Each image is the box as it is written with the signs turned round, to the last bit. */
static void check_symmetry(const tn_design *design, const tn_cut_box *cells)
{
    uint32_t n = design->box_count;
    for (uint32_t i = 0; i < n * tn_design_images(design); i++) {
        uint32_t image = tn_design_image(design, i / n);
        const tn_cut_box *own = &cells[i % n], *other = &cells[i];
        assert_int_equal(own->corner_count, other->corner_count);
        for (int k = 0; k < 3 && own->corner_count; k++) {
            bool turned = image >> k & 1;
            assert_true(other->low[k] == (turned ? -own->high[k] : own->low[k]));
            for (uint32_t v = 0; v < own->corner_count; v++)
                assert_true(other->at[v][k] == (turned ? -own->at[v][k] : own->at[v][k]));
        }
    }
}

/* Is a * b exactly c * d? Products with what rounding left out. */
static bool equal_products(double a, double b, double c, double d)
{
    double p = a * b, q = c * d;
    return p == q && fma(a, b, -p) == fma(c, d, -q);
}

static bool has_area(const double a[3], const double b[3], const double c[3])
{
    for (int k = 0; k < 3; k++) {
        int u = (k + 1) % 3, v = (k + 2) % 3;
        if (!equal_products(b[u] - a[u], c[v] - a[v], b[v] - a[v], c[u] - a[u]))
            return true;
    }
    return false;
}

static double volume_of(const tn_mesh *mesh)
{
    double volume = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        const double *a = mesh->positions + 3 * mesh->corners[3 * f],
                     *b = mesh->positions + 3 * mesh->corners[3 * f + 1],
                     *c = mesh->positions + 3 * mesh->corners[3 * f + 2];
        assert_true(has_area(a, b, c));
        volume += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return volume / 6;
}

/* As many pieces as parts; what shares next to no area may be joined or not. */
static void check_parts(const tn_mesh *mesh, const tn_cut_box *cells, size_t count, uint64_t seed)
{
    size_t pieces = count_pieces(mesh), most = count_parts(cells, count, TN_CONTACT_LEAST);
    if (pieces == most || (pieces < most && pieces >= count_parts(cells, count, 0)))
        return;
    fail_msg("design %llu: %zu pieces, %zu parts", (unsigned long long)seed, pieces, most);
}

/* Is the point in what is left of a box, in its image? */
static bool holds(const tn_design *design, uint32_t i, uint32_t image, const double point[3])
{
    const tn_solid_box *box = &design->boxes[i];
    double beyond = -box->distance;
    bool inside = !box->void_;
    for (int k = 0; k < 3; k++) {
        double p = image >> k & 1 ? -point[k] : point[k];
        inside = inside && box->low[k] < p && p < box->high[k];
        beyond += box->normal[k] * (p - (box->low[k] + box->high[k]) / 2);
    }
    return inside && (!box->clipped || beyond <= 0);
}

/* Random points lie in the share of the space that the volume is of it, and in one cell at most. */
static void check_points(const tn_design *design, const tn_cut_box *cells, size_t count, double volume, uint64_t seed)
{
    enum { POINTS = 4000 };
    double low[3], high[3], point[3], space = 1, hits = 0;
    tn_cut_boxes_bounds(cells, count, low, high);
    for (int k = 0; k < 3; k++)
        space *= high[k] - low[k];
    for (int n = 0; n < POINTS; n++) {
        int inside = 0;
        for (int k = 0; k < 3; k++)
            point[k] = low[k] + (high[k] - low[k]) * uniform();
        for (uint32_t i = 0; i < count; i++)
            inside += holds(design, i % design->box_count, tn_design_image(design, i / design->box_count), point);
        assert_true(inside <= 1);
        hits += inside;
    }
    double share = volume / space, spread = sqrt(share * (1 - share) / POINTS);
    if (fabs(hits / POINTS - share) > 6 * spread + 1e-9)
        fail_msg("design %llu: points say %g of the space, cells %g", (unsigned long long)seed, hits / POINTS, share);
}

static void check_design(uint64_t seed)
{
    tn_design design, again;
    tn_error error = {0};
    tn_union u;
    make_design(seed, &design);
    assert_int_equal(tn_design_correct(&design, NULL, &error), TN_OK);
    assert_int_equal(tn_design_copy(&design, &again, &error), TN_OK);
    assert_int_equal(tn_design_correct(&again, NULL, &error), TN_OK);
    assert_memory_equal(design.boxes, again.boxes, design.box_count * sizeof *design.boxes);
    uint32_t n = design.box_count;
    size_t count = (size_t)n * tn_design_images(&design);
    tn_cut_box *cells = calloc(count + 1, sizeof *cells);
    tn_moments moments = {0};
    for (uint32_t i = 0; i < count; i++) {
        tn_design_cell(&design, i % n, tn_design_image(&design, i / n), &cells[i]);
        tn_cut_box_moments(&cells[i], &moments);
    }
    check_apart(cells, &design, count);
    if (tn_union_make(cells, count, &u, &error) != TN_OK)
        fail_msg("design %llu: %s", (unsigned long long)seed, error.message);
    check_symmetry(&design, cells);
    if (seed % 16 < 2 && u.mesh.face_count)
        check_points(&design, cells, count, moments.volume, seed);
    check_edges(&u.mesh);
    check_umbrellas(&u.mesh);
    assert_true(openmesh_takes(&u.mesh));
    if (u.doubled == 0)
        check_parts(&u.mesh, cells, count, seed);
    double volume = volume_of(&u.mesh);
    if (!(fabs(volume - moments.volume) <= 1e-9 * (1 + moments.volume)))
        fail_msg("design %llu: the mesh holds %.17g, the cells %.17g", (unsigned long long)seed, volume,
                 moments.volume);
    tn_union_clear(&u);
    free(cells);
    tn_design_clear(&design);
    tn_design_clear(&again);
}

/* TARTAN_DESIGNS: how many, where not the usual number. */
static void test_random(void **unused)
{
    (void)unused;
    const char *wanted = getenv("TARTAN_DESIGNS"), *first = getenv("TARTAN_FIRST_DESIGN");
    uint64_t begin = first ? strtoull(first, NULL, 10) : 0, count = wanted ? strtoull(wanted, NULL, 10) : 2000;
    for (uint64_t seed = begin; seed < begin + count; seed++)
        check_design(seed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_random)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
