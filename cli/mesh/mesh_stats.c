/* Writes what a mesh measures: as a table, or as JSON. */
#include <inttypes.h>
#include <math.h>

#include "cli/mesh/mesh.h"
#include "runtime/base/json.h"

static void write_json(FILE *out, const tn_mesh_stats *s)
{
    static const char *const times[] = {"samples", "vertices", "triangles"};
    const tn_mesh_measures *m = s->measures;
    tn_json json = tn_json_file(out, TN_JSON_SPACED);
    tn_json_object(&json, NULL);
    tn_json_string(&json, s->what, s->name);
    tn_json_count(&json, "vertices", s->mesh->vertex_count);
    tn_json_count(&json, "triangles", s->mesh->face_count);
    tn_json_count(&json, "parts", m->parts);
    if (s->closed) {
        tn_json_whole(&json, "euler", m->euler);
        tn_json_number(&json, "volume", m->volume);
    }
    if (s->proven)
        tn_json_numbers(&json, "volume_bounds", s->proven, 2);
    if (s->thickness)
        tn_json_numbers(&json, "thickness", s->thickness, 2);
    tn_json_number(&json, "area", m->area);
    if (s->closed) {
        tn_json_numbers(&json, "centroid", m->centroid, 3);
        tn_json_list(&json, "inertia");
        for (int i = 0; i < 3; i++)
            tn_json_numbers(&json, NULL, m->inertia[i], 3);
        tn_json_list_end(&json);
    }
    tn_json_list(&json, "bounds");
    tn_json_numbers(&json, NULL, m->low, 3);
    tn_json_numbers(&json, NULL, m->high, 3);
    tn_json_list_end(&json);
    for (size_t i = 0; i < s->count_count; i++)
        tn_json_count(&json, s->counts[i].key, s->counts[i].count);
    if (s->seconds) {
        tn_json_object(&json, "seconds");
        for (int i = 0; i < 3; i++)
            tn_json_number(&json, times[i], s->seconds[i]);
        tn_json_object_end(&json);
    }
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

static double largest(const double p[3], double most)
{
    for (int k = 0; k < 3; k++)
        most = fmax(most, fabs(p[k]));
    return most;
}

/* What only rounding left, beside numbers as large as `scale`, is written as 0. */
static void write_triple(FILE *out, const char *word, const double p[3], double scale)
{
    fputs(word, out);
    for (int k = 0; k < 3; k++)
        fprintf(out, " %.6g", fabs(p[k]) < 1e-12 * scale ? 0 : p[k]);
    fputc('\n', out);
}

static void write_table(FILE *out, const tn_mesh_stats *s)
{
    const tn_mesh_measures *m = s->measures;
    const char *space = *s->unit ? " " : "", *square = *s->unit ? "^2" : "", *cube = *s->unit ? "^3" : "";
    fprintf(out, "%-9s  %s\n", s->what, s->name);
    fprintf(out, "vertices   %zu\ntriangles  %zu\nparts      %u\n", s->mesh->vertex_count, s->mesh->face_count,
            m->parts);
    if (s->closed)
        fprintf(out, "Euler      %" PRId64 "\nvolume     %.12g%s%s%s\n", m->euler, m->volume, space, s->unit, cube);
    if (s->proven)
        fprintf(out, "proven     %.12g to %.12g%s%s%s\n", s->proven[0], s->proven[1], space, s->unit, cube);
    if (s->thickness)
        fprintf(out, "thickness  at least %.6g%s%s; 99 %% of the wall at least %.6g%s%s\n", s->thickness[0], space,
                s->unit, s->thickness[1], space, s->unit);
    fprintf(out, "area       %.12g%s%s%s\n", m->area, space, s->unit, square);
    if (s->closed) {
        write_triple(out, "centroid  ", m->centroid, largest(m->low, largest(m->high, 0)));
        for (int i = 0; i < 3; i++)
            write_triple(out, i ? "          " : "inertia   ", m->inertia[i],
                         largest(m->inertia[0], largest(m->inertia[1], largest(m->inertia[2], 0))));
    }
    fprintf(out, "bounds     %.6g %.6g %.6g to %.6g %.6g %.6g\n", m->low[0], m->low[1], m->low[2], m->high[0],
            m->high[1], m->high[2]);
    for (size_t i = 0; i < s->count_count; i++)
        if (!s->counts[i].json_only)
            fprintf(out, "%-9s  %" PRIu64 "\n", s->counts[i].key, s->counts[i].count);
    if (s->seconds)
        fprintf(out, "seconds    samples %.3f, vertices %.3f, triangles %.3f\n", s->seconds[0], s->seconds[1],
                s->seconds[2]);
}

void tn_mesh_stats_write(FILE *out, bool json, const tn_mesh_stats *stats)
{
    if (json)
        write_json(out, stats);
    else
        write_table(out, stats);
}
