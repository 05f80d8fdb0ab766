/* Writes a mesh as Wavefront OBJ. */
#include <stdlib.h>

#include "runtime/base/watch.h"
#include "runtime/geometry/write.h"
#include "runtime/geometry/write_text.h"

static void write_point(tn_text_out *out, const char *word, const double *p, bool y_up)
{
    tn_text_add(out, word);
    tn_text_number(out, p[0]);
    tn_text_add(out, " ");
    tn_text_number(out, y_up ? p[2] : p[1]);
    tn_text_add(out, " ");
    tn_text_number(out, y_up ? -p[1] : p[2]);
    tn_text_add(out, "\n");
    tn_text_flush(out, false);
}

static void write_face(tn_text_out *out, const tn_mesh *mesh, size_t face, bool normals)
{
    tn_text_add(out, "f");
    for (uint32_t c = mesh->face_first[face]; c < mesh->face_first[face + 1]; c++) {
        uint64_t v = (uint64_t)mesh->corners[c] + 1;
        tn_text_add(out, " ");
        tn_text_whole(out, v);
        if (normals) {
            tn_text_add(out, "//");
            tn_text_whole(out, v);
        }
        tn_text_flush(out, false);
    }
    tn_text_add(out, "\n");
    tn_text_flush(out, false);
}

static void write_group(tn_text_out *out, const tn_mesh *mesh, uint32_t group, const char *what, uint32_t *last)
{
    if (!mesh->group_names || *last == group)
        return;
    tn_text_add(out, "g ");
    tn_text_add(out, what);
    tn_text_add(out, mesh->group_names[group]);
    tn_text_add(out, "\n");
    *last = group;
}

static void write_all(tn_text_out *out, const tn_mesh *mesh, const tn_mesh_style *style, const double *normals)
{
    uint32_t last = UINT32_MAX;
    for (size_t i = 0; i < style->note_count; i++) {
        tn_text_add(out, "# ");
        tn_text_add(out, style->notes[i]);
        tn_text_add(out, "\n");
        tn_text_flush(out, false);
    }
    tn_text_add(out, style->y_up ? "# up: y\n" : "# up: z\n");
    for (size_t v = 0; v < mesh->vertex_count && !out->failed && !tn_watch_stopped_at(mesh->watch, v); v++)
        write_point(out, "v ", mesh->positions + 3 * v, style->y_up);
    for (size_t v = 0; normals && v < mesh->vertex_count && !out->failed && !tn_watch_stopped_at(mesh->watch, v); v++)
        write_point(out, "vn ", normals + 3 * v, style->y_up);
    for (size_t f = 0; f < mesh->face_count && !out->failed && !tn_watch_stopped_at(mesh->watch, f); f++) {
        if (mesh->face_group)
            write_group(out, mesh, mesh->face_group[f], "", &last);
        write_face(out, mesh, f, normals != NULL);
    }
    last = UINT32_MAX;
    for (size_t l = 0; l < mesh->line_count && !out->failed && !tn_watch_stopped_at(mesh->watch, l); l++) {
        if (mesh->line_group)
            write_group(out, mesh, mesh->line_group[l], "edges_", &last);
        tn_text_add(out, "l ");
        tn_text_whole(out, (uint64_t)mesh->lines[2 * l] + 1);
        tn_text_add(out, " ");
        tn_text_whole(out, (uint64_t)mesh->lines[2 * l + 1] + 1);
        tn_text_add(out, "\n");
        tn_text_flush(out, false);
    }
    tn_text_flush(out, true);
}

tn_status tn_mesh_write_obj(const tn_mesh *mesh, const tn_mesh_style *style, FILE *stream, tn_error *error)
{
    double *normals = NULL;
    tn_text_out *out = malloc(sizeof *out);
    if (!out)
        return tn_fail_memory(error);
    tn_status status = tn_mesh_style_normals(mesh, style, &normals, error);
    tn_text_begin(out, stream, 1);
    if (status == TN_OK)
        write_all(out, mesh, style, normals);
    free(normals);
    free(out);
    return status == TN_OK ? tn_watch_check(mesh->watch, error) : status;
}
