/* Writes what a mesh measures as a table. */
#include <inttypes.h>
#include <math.h>

#include "cli/mesh/mesh.h"

static double largest(const tn_space_point *p, double most)
{
    return fmax(fmax(most, fabs(p->x)), fmax(fabs(p->y), fabs(p->z)));
}

/* What only rounding left, beside numbers as large as `scale`, is written as 0. */
static double shown(double number, double scale)
{
    return fabs(number) < 1e-12 * scale ? 0 : number;
}

static void write_triple(FILE *out, const char *word, const tn_space_point *p, double scale)
{
    fprintf(out, "%s %.6g %.6g %.6g\n", word, shown(p->x, scale), shown(p->y, scale), shown(p->z, scale));
}

static void write_count(FILE *out, const char *word, bool given, uint64_t count)
{
    if (given)
        fprintf(out, "%-9s  %" PRIu64 "\n", word, count);
}

/* Of a closed mesh. */
static void write_moments(FILE *out, const tn_measured_mesh *m)
{
    const tn_space_tensor *i = &m->inertia;
    double scale = largest(&i->xs, largest(&i->ys, largest(&i->zs, 0)));
    write_triple(out, "centroid  ", &m->centroid, largest(&m->bounds.low, largest(&m->bounds.high, 0)));
    write_triple(out, "inertia   ", &i->xs, scale);
    write_triple(out, "          ", &i->ys, scale);
    write_triple(out, "          ", &i->zs, scale);
}

void tn_mesh_table(const tn_measured_mesh *m, FILE *out)
{
    const char *unit = m->unit, *space = *unit ? " " : "", *square = *unit ? "^2" : "", *cube = *unit ? "^3" : "";
    const tn_space_point *low = &m->bounds.low, *high = &m->bounds.high;
    fprintf(out, "%-9s  %s\n", m->has_solid ? "solid" : "surface", m->has_solid ? m->solid : m->surface);
    write_count(out, "vertices", true, m->vertices);
    write_count(out, "triangles", true, m->triangles);
    write_count(out, "parts", true, m->parts);
    if (m->has_volume)
        fprintf(out, "Euler      %" PRId64 "\nvolume     %.12g%s%s%s\n", m->euler, m->volume, space, unit, cube);
    if (m->has_volume_bounds)
        fprintf(out, "proven     %.12g to %.12g%s%s%s\n", m->volume_bounds.least, m->volume_bounds.most, space, unit,
                cube);
    if (m->has_thickness)
        fprintf(out, "thickness  at least %.6g%s%s; 99 %% of the wall at least %.6g%s%s\n", m->thickness.least, space,
                unit, m->thickness.hundredth, space, unit);
    fprintf(out, "area       %.12g%s%s%s\n", m->area, space, unit, square);
    if (m->has_centroid)
        write_moments(out, m);
    fprintf(out, "bounds     %.6g %.6g %.6g to %.6g %.6g %.6g\n", low->x, low->y, low->z, high->x, high->y, high->z);
    write_count(out, "jumps", m->has_jumps, m->jumps);
    write_count(out, "moved", m->has_moved, m->moved);
    write_count(out, "sharp", m->has_sharp, m->sharp);
    write_count(out, "crossings", m->has_crossings, m->crossings);
    write_count(out, "boxes", m->has_boxes, m->boxes);
    write_count(out, "doubled", m->has_doubled, m->doubled);
    if (m->has_seconds)
        fprintf(out, "seconds    samples %.3f, vertices %.3f, triangles %.3f\n", m->seconds.samples,
                m->seconds.vertices, m->seconds.triangles);
}
