/* How long designs of boxes take: solid SCENE COUNT RUNS [FILE.scad]
 *
 * Scenes: crowded (COUNT random boxes, of which each overlaps a few, corrected, clipped and meshed), sphere (a sphere
 * of about COUNT clipped boxes of a grid), and tables (COUNT random designs of eight boxes with two planes of symmetry
 * and five measures, none of which needs the surface). Prints the median of the runs, of the thread's own time. FILE
 * gets the corrected and clipped cells as a union of polyhedra, so that OpenSCAD can be timed on the same. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/bench.h"
#include "runtime/geometry/union/union.h"
#include "runtime/geometry/write.h"
#include "runtime/solid/measure.h"

static uint64_t state = 1;

static double uniform(double low, double high)
{
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * ((double)(state >> 11) / 9007199254740992.0);
}

static int compare(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static void random_box(double extent, tn_solid_box *box)
{
    double length = 0, diagonal = 0;
    for (int k = 0; k < 3; k++) {
        double at = uniform(0, extent), size = uniform(0.5, 2);
        box->low[k] = at - size / 2;
        box->high[k] = at + size / 2;
        box->normal[k] = uniform(-1, 1);
        length += box->normal[k] * box->normal[k];
        diagonal += size * size;
    }
    for (int k = 0; k < 3; k++)
        box->normal[k] /= sqrt(length);
    box->distance = uniform(-0.1, 0.5) * sqrt(diagonal);
    box->clipped = true;
}

static tn_design crowded(uint32_t count)
{
    tn_design design = {.box_count = count, .boxes = calloc(count + 1u, sizeof *design.boxes)};
    for (uint32_t i = 0; design.boxes && i < count; i++)
        random_box(cbrt(count), &design.boxes[i]);
    return design;
}

/* Boxes of a grid whose inner corner is within the sphere; a plane touches the sphere where each looks outward. */
static tn_design sphere(uint32_t count)
{
    int cells = (int)fmax(2, cbrt((double)count * 6 / 3.14159265358979)); /* of which a sphere fills pi / 6 */
    tn_design design = {.boxes = calloc((size_t)cells * (size_t)cells * (size_t)cells + 1, sizeof *design.boxes)};
    for (int i = 0; design.boxes && i < cells * cells * cells; i++) {
        const int at[3] = {i % cells, i / cells % cells, i / cells / cells};
        tn_solid_box box = {.clipped = true};
        double inner = 0, length = 0;
        for (int k = 0; k < 3; k++) {
            box.low[k] = 2.0 * at[k] / cells - 1;
            box.high[k] = 2.0 * (at[k] + 1) / cells - 1;
            double near = fmax(0, fmax(box.low[k], -box.high[k])), centre = (box.low[k] + box.high[k]) / 2;
            inner += near * near;
            length += centre * centre;
            box.normal[k] = centre;
        }
        length = sqrt(length);
        for (int k = 0; k < 3; k++)
            box.normal[k] = length > 0 ? box.normal[k] / length : k == 0;
        box.distance = 1 - length;
        if (inner < 1)
            design.boxes[design.box_count++] = box;
    }
    return design;
}

/* The cells of a design: corrected and clipped. */
static tn_cut_box *make_cells(const tn_design *written)
{
    tn_design design;
    tn_error error = {0};
    tn_cut_box *cells = malloc((written->box_count + 1u) * sizeof *cells);
    if (!cells || tn_design_copy(written, &design, &error) != TN_OK ||
        tn_design_correct(&design, NULL, &error) != TN_OK)
        stop("out of memory");
    for (uint32_t i = 0; i < design.box_count; i++)
        tn_design_cell(&design, i, 0, &cells[i]);
    tn_design_clear(&design);
    return cells;
}

/* Seconds of one run: correction, clipping and the mesh. */
static double mesh_once(const tn_design *written, size_t *triangles)
{
    tn_union u;
    tn_error error = {0};
    double begun = seconds(CLOCK_THREAD_CPUTIME_ID);
    tn_cut_box *cells = make_cells(written);
    if (tn_union_make(cells, written->box_count, &u, &error) != TN_OK)
        stop(error.message);
    double took = seconds(CLOCK_THREAD_CPUTIME_ID) - begun;
    *triangles = u.mesh.face_count;
    tn_union_clear(&u);
    free(cells);
    return took;
}

static void write_scad(const tn_design *written, const char *path)
{
    tn_mesh mesh = {0};
    tn_error error = {0};
    tn_cut_box *cells = make_cells(written);
    FILE *out = fopen(path, "w");
    if (!out || tn_union_cells(cells, written->box_count, &mesh, &error) != TN_OK ||
        !(mesh.group_names = calloc(mesh.group_count + 1u, sizeof *mesh.group_names)))
        stop("cannot write the cells");
    if (tn_mesh_write_scad(&mesh, &(tn_mesh_style){0}, out, &error) != TN_OK || fclose(out) != 0)
        stop("cannot write the cells");
    tn_mesh_clear(&mesh);
    free(cells);
}

#define MEASURED(NAME) (UINT64_C(1) << TN_SOLID_##NAME##_MEASURED)

static double score_once(uint32_t count)
{
    const uint64_t asked = MEASURED(VOLUME) | MEASURED(HEIGHT) | MEASURED(PARTS) | MEASURED(STABLE) | MEASURED(SUPPORT);
    double values[TN_SOLID_MEASURED_COUNT], begun = seconds(CLOCK_THREAD_CPUTIME_ID);
    tn_error error = {0};
    for (uint32_t i = 0; i < count; i++) {
        tn_solid_box boxes[8] = {0};
        tn_built built = {
            .built = {.boxes = boxes, .box_count = 8, .flags = TN_SOLID_SYMMETRY_X | TN_SOLID_SYMMETRY_Z}};
        tn_cut_box cells[32];
        for (int b = 0; b < 8; b++)
            random_box(3, &boxes[b]);
        built.written = built.built;
        if (tn_design_correct(&built.built, NULL, &error) != TN_OK)
            stop(error.message);
        built.cells = cells;
        built.cell_count = 32;
        for (uint32_t c = 0; c < 32; c++)
            tn_design_cell(&built.built, c % 8, tn_design_image(&built.built, c / 8), &cells[c]);
        if (tn_built_measure(&built, asked, values, &error) != TN_OK)
            stop(error.message);
    }
    return seconds(CLOCK_THREAD_CPUTIME_ID) - begun;
}

int main(int argc, char **argv)
{
    uint32_t count = argc > 3 ? (uint32_t)strtoul(argv[2], NULL, 10) : 0;
    int runs = argc > 3 ? atoi(argv[3]) : 0;
    if (count == 0 || runs < 1)
        stop("usage: solid crowded|sphere|tables COUNT RUNS [FILE.scad]");
    double *times = malloc((size_t)runs * sizeof *times);
    bool tables = strcmp(argv[1], "tables") == 0;
    tn_design design = tables ? (tn_design){0} : strcmp(argv[1], "sphere") == 0 ? sphere(count) : crowded(count);
    size_t triangles = 0;
    if (!times || (!tables && !design.boxes))
        stop("out of memory");
    for (int i = 0; i < runs; i++)
        times[i] = tables ? score_once(count) : mesh_once(&design, &triangles);
    if (argc > 4 && !tables)
        write_scad(&design, argv[4]);
    qsort(times, (size_t)runs, sizeof *times, compare);
    double median = times[runs / 2];
    if (tables)
        printf("tables %u: %.0f designs a second\n", count, count / median);
    else
        printf("%s %u: %.2f ms, %.2f us a box, %zu triangles\n", argv[1], design.box_count, median * 1e3,
               median * 1e6 / design.box_count, triangles);
    tn_design_clear(&design);
    free(times);
    return 0;
}
