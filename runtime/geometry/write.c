/* Writes meshes as Wavefront OBJ, as PLY and for OpenSCAD, and finds the normals that a file is to have. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/base/watch.h"
#include "runtime/geometry/write.h"
#include "runtime/geometry/write_text.h"

/* ---- the normals that a mesh file is to have */

tn_status tn_mesh_style_normals(const tn_mesh *mesh, const tn_mesh_style *style, double **normals, tn_error *error)
{
    *normals = NULL;
    if (!style->normals)
        return TN_OK;
    if (!style->vertex_normals)
        return tn_mesh_normals(mesh, normals, error);
    *normals = malloc((3 * mesh->vertex_count + 1) * sizeof **normals);
    if (!*normals)
        return tn_fail_memory(error);
    memcpy(*normals, style->vertex_normals, 3 * mesh->vertex_count * sizeof **normals);
    return TN_OK;
}

void tn_mesh_style_colour(const tn_mesh_style *style, uint32_t group, unsigned char rgb[3])
{
    if (style->model)
        memcpy(rgb, style->model->materials[style->model->pieces[group].material].rgb, 3);
    else if (style->colours)
        memcpy(rgb, style->colours[group], 3);
    else
        tn_group_colour(group, rgb);
}

/* ---- writes a mesh as Wavefront OBJ */

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

static void write_obj_face(tn_text_out *out, const tn_mesh *mesh, size_t face, bool normals)
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

/* `o` of a part: "ground/0.01-kitchen/window". The whole has no name here. */
static void write_path(tn_text_out *out, const tn_mesh_model *model, uint32_t node, char between)
{
    uint32_t parent = model->nodes[node].parent;
    if (parent > 0) {
        write_path(out, model, parent, between);
        tn_text_add(out, (const char[]){between, '\0'});
    }
    tn_text_word(out, model->nodes[node].name);
    tn_text_flush(out, false);
}

static void write_piece(tn_text_out *out, const tn_mesh_model *model, uint32_t group, uint32_t *last)
{
    if (*last == group)
        return;
    const tn_mesh_piece *piece = &model->pieces[group];
    if (*last == UINT32_MAX || model->pieces[*last].node != piece->node) {
        tn_text_add(out, "o ");
        write_path(out, model, piece->node, '/');
        tn_text_add(out, "\ng ");
        write_path(out, model, piece->node, ' ');
        tn_text_add(out, "\n");
    }
    tn_text_add(out, "usemtl ");
    tn_text_word(out, model->materials[piece->material].name);
    tn_text_add(out, "\n");
    tn_text_flush(out, false);
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
    if (style->model && style->mtl) {
        tn_text_add(out, "mtllib ");
        tn_text_add(out, style->mtl);
        tn_text_add(out, "\n");
        tn_text_flush(out, false);
    }
    for (size_t v = 0; v < mesh->vertex_count && !out->failed && !tn_watch_stopped_at(mesh->watch, v); v++)
        write_point(out, "v ", mesh->positions + 3 * v, style->y_up);
    for (size_t v = 0; normals && v < mesh->vertex_count && !out->failed && !tn_watch_stopped_at(mesh->watch, v); v++)
        write_point(out, "vn ", normals + 3 * v, style->y_up);
    for (size_t f = 0; f < mesh->face_count && !out->failed && !tn_watch_stopped_at(mesh->watch, f); f++) {
        if (style->model)
            write_piece(out, style->model, mesh->face_group[f], &last);
        else if (mesh->face_group)
            write_group(out, mesh, mesh->face_group[f], "", &last);
        write_obj_face(out, mesh, f, normals != NULL);
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

/* ---- writes a mesh as PLY */

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

static void write_ply_face(byte_out *out, const tn_mesh *mesh, const tn_mesh_style *style, size_t face, bool large)
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
            write_ply_face(out, mesh, style, f, large);
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

/* ---- writes a mesh for OpenSCAD: a union of polyhedra, one for each group of faces */

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
