/* Writes a mesh as PLY. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/base/watch.h"
#include "runtime/geometry/write.h"

typedef struct byte_out {
    FILE *stream;
    bool failed; /* the stream takes no more: what is left need not be written */
    size_t used;
    uint8_t bytes[1 << 16];
} byte_out;

static uint8_t *room(byte_out *out, size_t size)
{
    if (out->used + size > sizeof out->bytes) {
        out->failed |= fwrite(out->bytes, 1, out->used, out->stream) != out->used; /* the caller looks at the stream */
        out->used = 0;
    }
    out->used += size;
    return out->bytes + out->used - size;
}

static void put_point(byte_out *out, const double *p, bool y_up)
{
    uint8_t *to = room(out, 24);
    tn_put_u64(to, tn_bits_of(p[0]));
    tn_put_u64(to + 8, tn_bits_of(y_up ? p[2] : p[1]));
    tn_put_u64(to + 16, tn_bits_of(y_up ? -p[1] : p[2]));
}

static void put_colour(byte_out *out, const tn_mesh_style *style, uint32_t group)
{
    unsigned char rgb[3];
    tn_mesh_style_colour(style, group, rgb);
    memcpy(room(out, 3), rgb, 3);
}

static void write_header(const tn_mesh *mesh, const tn_mesh_style *style, FILE *out, bool large)
{
    static const char colour[] = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    fputs("ply\nformat binary_little_endian 1.0\n", out);
    for (size_t i = 0; i < style->note_count; i++)
        fprintf(out, "comment %s\n", style->notes[i]);
    fprintf(out, "comment up: %s\n", style->y_up ? "y" : "z");
    fprintf(out, "element vertex %zu\nproperty double x\nproperty double y\nproperty double z\n", mesh->vertex_count);
    if (style->normals)
        fputs("property double nx\nproperty double ny\nproperty double nz\n", out);
    fprintf(out, "element face %zu\nproperty list %s int vertex_indices\n%s", mesh->face_count, large ? "int" : "uchar",
            mesh->face_group ? colour : "");
    if (mesh->line_count)
        fprintf(out, "element edge %zu\nproperty int vertex1\nproperty int vertex2\n%s", mesh->line_count,
                mesh->line_group ? colour : "");
    fputs("end_header\n", out);
}

static void write_face(byte_out *out, const tn_mesh *mesh, const tn_mesh_style *style, size_t face, bool large)
{
    uint32_t first = mesh->face_first[face], end = mesh->face_first[face + 1];
    if (large)
        tn_put_u32(room(out, 4), end - first);
    else
        *room(out, 1) = (uint8_t)(end - first);
    for (uint32_t c = first; c < end; c++)
        tn_put_u32(room(out, 4), mesh->corners[c]);
    if (mesh->face_group)
        put_colour(out, style, mesh->face_group[face]);
}

tn_status tn_mesh_write_ply(const tn_mesh *mesh, const tn_mesh_style *style, FILE *stream, tn_error *error)
{
    double *normals = NULL;
    bool large = false;
    for (size_t f = 0; f < mesh->face_count && !large; f++)
        large = mesh->face_first[f + 1] - mesh->face_first[f] > 255;
    byte_out *out = malloc(sizeof *out);
    if (!out)
        return tn_fail_memory(error);
    out->stream = stream;
    out->failed = false;
    out->used = 0;
    tn_status status = tn_mesh_style_normals(mesh, style, &normals, error);
    if (status == TN_OK) {
        write_header(mesh, style, stream, large);
        for (size_t v = 0; v < mesh->vertex_count && !out->failed && !tn_watch_stopped_at(mesh->watch, v); v++) {
            put_point(out, mesh->positions + 3 * v, style->y_up);
            if (normals)
                put_point(out, normals + 3 * v, style->y_up);
        }
        for (size_t f = 0; f < mesh->face_count && !out->failed && !tn_watch_stopped_at(mesh->watch, f); f++)
            write_face(out, mesh, style, f, large);
        for (size_t l = 0; l < mesh->line_count && !out->failed && !tn_watch_stopped_at(mesh->watch, l); l++) {
            tn_put_u32(room(out, 4), mesh->lines[2 * l]);
            tn_put_u32(room(out, 4), mesh->lines[2 * l + 1]);
            if (mesh->line_group)
                put_colour(out, style, mesh->line_group[l]);
        }
        fwrite(out->bytes, 1, out->used, stream);
    }
    free(normals);
    free(out);
    return status == TN_OK ? tn_watch_check(mesh->watch, error) : status;
}
