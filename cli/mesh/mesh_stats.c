/* Writes what a mesh of a field measures. */
#include <inttypes.h>

#include "cli/mesh/mesh.h"

static void write_json(FILE *out, const tn_open_field *open, const tn_contour *c, const tn_mesh_measures *m,
                       bool closed)
{
    fprintf(out, "{\"surface\": \"%s\", \"vertices\": %zu, \"triangles\": %zu, \"parts\": %u, ",
            tn_text(open->field.module, open->field.record->name), c->mesh.vertex_count, c->mesh.face_count, m->parts);
    if (closed)
        fprintf(out, "\"euler\": %" PRId64 ", \"volume\": %.17g, ", m->euler, m->volume);
    fprintf(out, "\"area\": %.17g, ", m->area);
    if (closed) {
        fprintf(out, "\"centroid\": [%.17g, %.17g, %.17g], \"inertia\": [", m->centroid[0], m->centroid[1],
                m->centroid[2]);
        for (int i = 0; i < 3; i++)
            fprintf(out, "%s[%.17g, %.17g, %.17g]", i ? ", " : "", m->inertia[i][0], m->inertia[i][1],
                    m->inertia[i][2]);
        fputs("], ", out);
    }
    fprintf(out, "\"bounds\": [[%.17g, %.17g, %.17g], [%.17g, %.17g, %.17g]], ", m->low[0], m->low[1], m->low[2],
            m->high[0], m->high[1], m->high[2]);
    fprintf(out, "\"jumps\": %" PRIu64 ", \"moved\": %" PRIu64 ", \"no_values\": %" PRIu64 "}\n", c->jumps, c->moved,
            c->no_values);
}

static void write_table(FILE *out, const tn_open_field *open, const tn_contour *c, const tn_mesh_measures *m,
                        bool closed)
{
    static const char *const units[TN_UNIT_COUNT] = {"", " mm", " cm", " m", " in", " ft"};
    const char *unit = units[open->field.record->unit];
    fprintf(out, "surface    %s\n", tn_text(open->field.module, open->field.record->name));
    fprintf(out, "vertices   %zu\ntriangles  %zu\nparts      %u\n", c->mesh.vertex_count, c->mesh.face_count, m->parts);
    if (closed)
        fprintf(out, "Euler      %" PRId64 "\nvolume     %.12g%s%s\n", m->euler, m->volume, unit, *unit ? "^3" : "");
    fprintf(out, "area       %.12g%s%s\n", m->area, unit, *unit ? "^2" : "");
    if (closed) {
        fprintf(out, "centroid   %.6g %.6g %.6g\n", m->centroid[0], m->centroid[1], m->centroid[2]);
        for (int i = 0; i < 3; i++)
            fprintf(out, "%s %.6g %.6g %.6g\n", i ? "          " : "inertia   ", m->inertia[i][0], m->inertia[i][1],
                    m->inertia[i][2]);
    }
    fprintf(out, "bounds     %.6g %.6g %.6g to %.6g %.6g %.6g\n", m->low[0], m->low[1], m->low[2], m->high[0],
            m->high[1], m->high[2]);
    fprintf(out, "jumps      %" PRIu64 "\nmoved      %" PRIu64 "\n", c->jumps, c->moved);
}

void tn_mesh_stats_write(FILE *out, bool json, const tn_open_field *open, const tn_contour *contour,
                         const tn_mesh_measures *measures, bool closed)
{
    if (json)
        write_json(out, open, contour, measures, closed);
    else
        write_table(out, open, contour, measures, closed);
}
