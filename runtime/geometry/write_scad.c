/* Writes a mesh for OpenSCAD: a union of polyhedra, one for each group of faces. */
#include "runtime/base/watch.h"
#include "runtime/geometry/write.h"

/* The vertices of a stretch of faces are numbers low to high. */
typedef struct stretch {
    size_t first, end; /* faces */
    uint32_t low, high;
} stretch;

/* The faces from `first` on that are of one group; all of them where there are no groups. */
static stretch group_at(const tn_mesh *mesh, size_t first)
{
    stretch s = {.first = first, .end = first, .low = UINT32_MAX};
    while (s.end < mesh->face_count && (!mesh->face_group || mesh->face_group[s.end] == mesh->face_group[first])) {
        for (uint32_t c = mesh->face_first[s.end]; c < mesh->face_first[s.end + 1]; c++) {
            s.low = mesh->corners[c] < s.low ? mesh->corners[c] : s.low;
            s.high = mesh->corners[c] > s.high ? mesh->corners[c] : s.high;
        }
        s.end++;
    }
    return s;
}

static void write_points(const tn_mesh *mesh, const stretch *s, bool y_up, FILE *out)
{
    for (uint32_t v = s->low; v <= s->high; v++) {
        const double *p = mesh->positions + 3 * (size_t)v;
        fprintf(out, "%s[%.17g, %.17g, %.17g]", v > s->low ? ", " : "", p[0], y_up ? p[2] : p[1], y_up ? -p[1] : p[2]);
    }
}

/* OpenSCAD wants faces clockwise from outside. */
static void write_faces(const tn_mesh *mesh, const stretch *s, FILE *out)
{
    for (size_t face = s->first; face < s->end; face++) {
        fprintf(out, "%s[", face > s->first ? ", " : "");
        for (uint32_t c = mesh->face_first[face + 1]; c-- > mesh->face_first[face];)
            fprintf(out, "%u%s", mesh->corners[c] - s->low, c > mesh->face_first[face] ? ", " : "");
        fputc(']', out);
    }
}

tn_status tn_mesh_write_scad(const tn_mesh *mesh, const tn_mesh_style *style, FILE *out, tn_error *error)
{
    for (size_t i = 0; i < style->note_count; i++)
        fprintf(out, "// %s\n", style->notes[i]);
    fputs("union() {\n", out);
    for (size_t face = 0; face < mesh->face_count;) {
        tn_status status = tn_watch_check(mesh->watch, error);
        if (status != TN_OK)
            return status;
        stretch s = group_at(mesh, face);
        fputs("polyhedron(points = [", out);
        write_points(mesh, &s, style->y_up, out);
        fputs("], faces = [", out);
        write_faces(mesh, &s, out);
        fputs("]);", out);
        if (mesh->face_group)
            fprintf(out, " // %s", mesh->group_names[mesh->face_group[face]]);
        fputc('\n', out);
        face = s.end;
    }
    fputs("}\n", out);
    return TN_OK;
}
