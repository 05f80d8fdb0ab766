/* glTF 2.0, binary: a JSON chunk that says what the binary chunk holds. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/base/json.h"
#include "runtime/base/watch.h"
#include "runtime/geometry/write.h"
#include "runtime/math/elementary.h"

/* y up: x, z, -y. */
static void turned(const double *p, double scale, float q[3])
{
    q[0] = (float)(scale * p[0]);
    q[1] = (float)(scale * p[2]);
    q[2] = (float)(scale * -p[1]);
}

/* glTF is in metres (3.4). */
static double metres(tn_mesh_unit unit)
{
    static const double factors[TN_MESH_UNIT_COUNT] = {1, 0.001, 0.01, 1, 0.0254, 0.3048};
    return factors[unit];
}

/* Colours of materials are linear (3.9.2): the amount of light that a value of sRGB stands for (IEC 61966-2-1). */
static double linear(unsigned char value)
{
    double v = value / 255.0;
    return v <= 0.04045 ? v / 12.92 : tn_pow((v + 0.055) / 1.055, 2.4);
}

static void put_floats(uint8_t **to, const float *values, int count)
{
    for (int i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        tn_put_u32(*to, bits);
        *to += 4;
    }
}

static void floats(tn_json *json, const char *key, const float values[3])
{
    tn_json_list(json, key);
    for (int k = 0; k < 3; k++)
        tn_json_rounded(json, NULL, (double)values[k], 9); /* enough to tell any float from all others */
    tn_json_list_end(json);
}

static void say_asset(tn_json *json, const tn_mesh_style *style)
{
    tn_json_object(json, "asset");
    tn_json_string(json, "version", "2.0");
    tn_json_string(json, "generator", "tartan");
    tn_json_object(json, "extras");
    tn_json_list(json, "notes");
    for (size_t i = 0; i < style->note_count; i++)
        tn_json_string(json, NULL, style->notes[i]);
    tn_json_list_end(json);
    tn_json_object_end(json);
    tn_json_object_end(json);
}

/* One scene, with one node, which has the one mesh. */
static void say_scene(tn_json *json)
{
    tn_json_count(json, "scene", 0);
    tn_json_list(json, "scenes");
    tn_json_object(json, NULL);
    tn_json_list(json, "nodes");
    tn_json_count(json, NULL, 0);
    tn_json_list_end(json);
    tn_json_object_end(json);
    tn_json_list_end(json);
    tn_json_list(json, "nodes");
    tn_json_object(json, NULL);
    tn_json_count(json, "mesh", 0);
    tn_json_object_end(json);
    tn_json_list_end(json);
}

static void say_primitives(tn_json *json, const size_t *counts, uint32_t groups, bool normals)
{
    uint32_t accessor = normals ? 2 : 1, made = 0;
    tn_json_list(json, "meshes");
    tn_json_object(json, NULL);
    tn_json_list(json, "primitives");
    for (uint32_t g = 0; g < groups; g++) {
        if (!counts[g])
            continue;
        tn_json_object(json, NULL);
        tn_json_object(json, "attributes");
        tn_json_count(json, "POSITION", 0);
        if (normals)
            tn_json_count(json, "NORMAL", 1);
        tn_json_object_end(json);
        tn_json_count(json, "indices", accessor + made);
        tn_json_count(json, "material", made++);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
    tn_json_object_end(json);
    tn_json_list_end(json);
}

static void say_material(tn_json *json, const unsigned char rgb[3])
{
    tn_json_object(json, NULL);
    tn_json_bool(json, "doubleSided", true);
    tn_json_object(json, "pbrMetallicRoughness");
    tn_json_list(json, "baseColorFactor");
    for (int k = 0; k < 3; k++)
        tn_json_rounded(json, NULL, linear(rgb[k]), 6);
    tn_json_count(json, NULL, 1);
    tn_json_list_end(json);
    tn_json_count(json, "metallicFactor", 0);
    tn_json_number(json, "roughnessFactor", 0.9);
    tn_json_object_end(json);
    tn_json_object_end(json);
}

static void say_materials(tn_json *json, const tn_mesh_style *style, const size_t *counts, uint32_t groups)
{
    tn_json_list(json, "materials");
    for (uint32_t g = 0; g < groups; g++) {
        unsigned char rgb[3] = {204, 204, 196};
        if (!counts[g])
            continue;
        if (groups > 1)
            tn_mesh_style_colour(style, g, rgb);
        say_material(json, rgb);
    }
    tn_json_list_end(json);
}

enum { FLOATS = 5126, WORDS = 5125, VERTICES = 34962, CORNERS = 34963 }; /* of OpenGL, which glTF cites */

/* Points, or corners from a byte on; the caller ends it. */
static void begin_accessor(tn_json *json, size_t view, size_t offset, int type, size_t count)
{
    tn_json_object(json, NULL);
    tn_json_count(json, "bufferView", view);
    if (type == WORDS)
        tn_json_count(json, "byteOffset", offset);
    tn_json_whole(json, "componentType", type);
    tn_json_count(json, "count", count);
    tn_json_string(json, "type", type == WORDS ? "SCALAR" : "VEC3");
}

static void say_accessors(tn_json *json, const tn_mesh *mesh, const float low[3], const float high[3],
                          const size_t *counts, uint32_t groups, bool normals)
{
    size_t corners = 0;
    tn_json_list(json, "accessors");
    begin_accessor(json, 0, 0, FLOATS, mesh->vertex_count);
    floats(json, "min", low);
    floats(json, "max", high);
    tn_json_object_end(json);
    if (normals) {
        begin_accessor(json, 1, 0, FLOATS, mesh->vertex_count);
        tn_json_object_end(json);
    }
    for (uint32_t g = 0; g < groups; g++) {
        if (!counts[g])
            continue;
        begin_accessor(json, normals ? 2 : 1, 4 * corners, WORDS, 3 * counts[g]);
        tn_json_object_end(json);
        corners += 3 * counts[g];
    }
    tn_json_list_end(json);
}

static void say_view(tn_json *json, size_t offset, size_t length, int target)
{
    tn_json_object(json, NULL);
    tn_json_count(json, "buffer", 0);
    if (offset)
        tn_json_count(json, "byteOffset", offset);
    tn_json_count(json, "byteLength", length);
    tn_json_whole(json, "target", target);
    tn_json_object_end(json);
}

static void say_buffers(tn_json *json, const tn_mesh *mesh, bool normals)
{
    size_t points = 12 * mesh->vertex_count, corners = 12 * mesh->face_count, offset = normals ? 2 * points : points;
    tn_json_list(json, "bufferViews");
    say_view(json, 0, points, VERTICES);
    if (normals)
        say_view(json, points, points, VERTICES);
    say_view(json, offset, corners, CORNERS);
    tn_json_list_end(json);
    tn_json_list(json, "buffers");
    tn_json_object(json, NULL);
    tn_json_count(json, "byteLength", offset + corners);
    tn_json_object_end(json);
    tn_json_list_end(json);
}

static void fill(const tn_mesh *mesh, double scale, const double *normals, const size_t *counts, uint32_t groups,
                 uint8_t *binary, float low[3], float high[3])
{
    uint8_t *to = binary;
    for (size_t v = 0; v < mesh->vertex_count && !tn_watch_stopped_at(mesh->watch, v); v++) {
        float q[3];
        turned(mesh->positions + 3 * v, scale, q);
        for (int k = 0; k < 3; k++) {
            low[k] = v && low[k] < q[k] ? low[k] : q[k];
            high[k] = v && high[k] > q[k] ? high[k] : q[k];
        }
        put_floats(&to, q, 3);
    }
    for (size_t v = 0; normals && v < mesh->vertex_count && !tn_watch_stopped_at(mesh->watch, v); v++) {
        float q[3];
        turned(normals + 3 * v, 1, q);
        put_floats(&to, q, 3);
    }
    for (uint32_t g = 0; g < groups; g++) {
        for (size_t f = 0; counts[g] && f < mesh->face_count && !tn_watch_stopped_at(mesh->watch, f); f++) {
            if (mesh->face_group && mesh->face_group[f] != g)
                continue;
            for (int i = 0; i < 3; i++, to += 4)
                tn_put_u32(to, mesh->corners[3 * f + (size_t)i]);
        }
    }
}

static tn_status write_chunks(FILE *out, tn_buffer *json, const uint8_t *binary, size_t size, tn_error *error)
{
    while (json->size % 4)
        if (!tn_buffer_append(json, " ", 1))
            return tn_fail_memory(error);
    size_t total = 12 + 8 + json->size + 8 + size;
    if (total > UINT32_MAX)
        return tn_fail(error, TN_LIMIT, E_FILE_TOO_LARGE,
                       "the surface is too large for a GLB file, which holds 4 GiB at most");
    uint8_t header[20], chunk[8];
    tn_put_u32(header, 0x46546c67); /* "glTF" */
    tn_put_u32(header + 4, 2);
    tn_put_u32(header + 8, (uint32_t)total);
    tn_put_u32(header + 12, (uint32_t)json->size);
    tn_put_u32(header + 16, 0x4e4f534a); /* "JSON" */
    tn_put_u32(chunk, (uint32_t)size);
    tn_put_u32(chunk + 4, 0x004e4942); /* "BIN" */
    fwrite(header, 1, sizeof header, out);
    fwrite(json->data, 1, json->size, out);
    fwrite(chunk, 1, sizeof chunk, out);
    fwrite(binary, 1, size, out); /* failing shows in the stream's state, which the caller looks at */
    return TN_OK;
}

static tn_status write_triangles(const tn_mesh *mesh, const tn_mesh_style *style, const double *normals, FILE *out,
                                 tn_error *error)
{
    uint32_t groups = mesh->face_group ? mesh->group_count : 1;
    size_t points = 12 * mesh->vertex_count * (normals ? 2 : 1), size = points + 12 * mesh->face_count;
    tn_buffer text = {0};
    size_t *counts = calloc(groups + 1, sizeof *counts);
    uint8_t *binary = malloc(size + 1);
    tn_status status = TN_OK;
    if (!counts || !binary) {
        status = tn_fail_memory(error);
    } else {
        float low[3] = {0}, high[3] = {0};
        for (size_t f = 0; f < mesh->face_count; f++)
            counts[mesh->face_group ? mesh->face_group[f] : 0]++;
        fill(mesh, metres(style->unit), normals, counts, groups, binary, low, high);
        tn_json json = tn_json_text(&text, TN_JSON_TIGHT);
        tn_json_object(&json, NULL);
        say_asset(&json, style);
        say_scene(&json);
        say_primitives(&json, counts, groups, normals != NULL);
        say_materials(&json, style, counts, groups);
        say_accessors(&json, mesh, low, high, counts, groups, normals != NULL);
        say_buffers(&json, mesh, normals != NULL);
        tn_json_object_end(&json);
        status = text.failed ? tn_fail_memory(error) : tn_watch_check(mesh->watch, error);
        if (status == TN_OK)
            status = write_chunks(out, &text, binary, size, error);
    }
    free(text.data);
    free(counts);
    free(binary);
    return status;
}

tn_status tn_mesh_write_glb(const tn_mesh *mesh, const tn_mesh_style *style, FILE *out, tn_error *error)
{
    double *normals = NULL;
    for (size_t f = 0; f < mesh->face_count; f++)
        if (mesh->face_first[f + 1] - mesh->face_first[f] != 3)
            return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a GLB file takes triangles only");
    tn_status status = tn_mesh_style_normals(mesh, style, &normals, error);
    if (status == TN_OK)
        status = write_triangles(mesh, style, normals, out, error);
    free(normals);
    return status;
}
