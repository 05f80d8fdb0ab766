/* glTF 2.0, binary: a JSON chunk that says what the binary chunk holds. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/base/watch.h"
#include "runtime/geometry/write.h"

typedef struct text {
    char *bytes;
    size_t used, size;
} text;

__attribute__((format(printf, 2, 3))) static void say(text *json, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int size = vsnprintf(json->bytes + json->used, json->size - json->used, format, args);
    va_end(args);
    json->used += (size_t)size < json->size - json->used ? (size_t)size : json->size - json->used - 1;
}

/* y up: x, z, -y. */
static void turned(const double *p, float q[3])
{
    q[0] = (float)p[0];
    q[1] = (float)p[2];
    q[2] = (float)-p[1];
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

static void say_notes(text *json, const tn_mesh_style *style)
{
    say(json, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"tartan\",\"extras\":{\"notes\":[");
    for (size_t i = 0; i < style->note_count; i++) {
        say(json, "%s\"", i ? "," : "");
        for (const char *c = style->notes[i]; *c; c++)
            say(json, (*c == '"' || *c == '\\') ? "\\%c" : (unsigned char)*c < ' ' ? " " : "%c", *c);
        say(json, "\"");
    }
    say(json, "]}},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],");
}

static void say_primitives(text *json, const tn_mesh_style *style, const size_t *counts, uint32_t groups, bool normals)
{
    uint32_t accessor = normals ? 2 : 1, made = 0;
    say(json, "\"meshes\":[{\"primitives\":[");
    for (uint32_t g = 0; g < groups; g++) {
        if (!counts[g])
            continue;
        say(json, "%s{\"attributes\":{\"POSITION\":0%s},\"indices\":%u,\"material\":%u}", made ? "," : "",
            normals ? ",\"NORMAL\":1" : "", accessor + made, made);
        made++;
    }
    say(json, "]}],\"materials\":[");
    made = 0;
    for (uint32_t g = 0; g < groups; g++) {
        unsigned char rgb[3] = {204, 204, 196};
        if (!counts[g])
            continue;
        if (groups > 1)
            tn_mesh_style_colour(style, g, rgb);
        say(json,
            "%s{\"doubleSided\":true,\"pbrMetallicRoughness\":{\"baseColorFactor\":[%.3f,%.3f,%.3f,1],"
            "\"metallicFactor\":0,\"roughnessFactor\":0.9}}",
            made++ ? "," : "", rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
    }
    say(json, "],");
}

static void say_accessors(text *json, const tn_mesh *mesh, const float low[3], const float high[3],
                          const size_t *counts, uint32_t groups, bool normals)
{
    size_t points = 12 * mesh->vertex_count, indices = 0;
    say(json,
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\",\"min\":[%.9g,%.9g,%."
        "9g],\"max\":[%.9g,%.9g,%.9g]}",
        mesh->vertex_count, low[0], low[1], low[2], high[0], high[1], high[2]);
    if (normals)
        say(json, ",{\"bufferView\":1,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\"}", mesh->vertex_count);
    for (uint32_t g = 0; g < groups; g++) {
        if (!counts[g])
            continue;
        say(json, ",{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":5125,\"count\":%zu,\"type\":\"SCALAR\"}",
            normals ? 2 : 1, indices, 3 * counts[g]);
        indices += 12 * counts[g];
    }
    say(json, "],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu,\"target\":34962}", points);
    if (normals)
        say(json, ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"target\":34962}", points, points);
    size_t offset = normals ? 2 * points : points;
    say(json,
        ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"target\":34963}],\"buffers\":[{\"byteLength\":%zu}]}",
        offset, indices, offset + indices);
}

static void fill(const tn_mesh *mesh, const double *normals, const size_t *counts, uint32_t groups, uint8_t *binary,
                 float low[3], float high[3])
{
    uint8_t *to = binary;
    for (size_t v = 0; v < mesh->vertex_count && !tn_watch_stopped_at(mesh->watch, v); v++) {
        float q[3];
        turned(mesh->positions + 3 * v, q);
        for (int k = 0; k < 3; k++) {
            low[k] = v && low[k] < q[k] ? low[k] : q[k];
            high[k] = v && high[k] > q[k] ? high[k] : q[k];
        }
        put_floats(&to, q, 3);
    }
    for (size_t v = 0; normals && v < mesh->vertex_count && !tn_watch_stopped_at(mesh->watch, v); v++) {
        float q[3];
        turned(normals + 3 * v, q);
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

static tn_status write_chunks(FILE *out, text *json, const uint8_t *binary, size_t size, tn_error *error)
{
    while (json->used % 4)
        json->bytes[json->used++] = ' ';
    size_t total = 12 + 8 + json->used + 8 + size;
    if (total > UINT32_MAX)
        return tn_fail(error, TN_LIMIT, E_FILE_TOO_LARGE,
                       "the surface is too large for a GLB file, which holds 4 GiB at most");
    uint8_t header[20], chunk[8];
    tn_put_u32(header, 0x46546c67); /* "glTF" */
    tn_put_u32(header + 4, 2);
    tn_put_u32(header + 8, (uint32_t)total);
    tn_put_u32(header + 12, (uint32_t)json->used);
    tn_put_u32(header + 16, 0x4e4f534a); /* "JSON" */
    tn_put_u32(chunk, (uint32_t)size);
    tn_put_u32(chunk + 4, 0x004e4942); /* "BIN" */
    fwrite(header, 1, sizeof header, out);
    fwrite(json->bytes, 1, json->used, out);
    fwrite(chunk, 1, sizeof chunk, out);
    fwrite(binary, 1, size, out); /* failing shows in the stream's state, which the caller looks at */
    return TN_OK;
}

static tn_status write_triangles(const tn_mesh *mesh, const tn_mesh_style *style, const double *normals, FILE *out,
                                 tn_error *error)
{
    uint32_t groups = mesh->face_group ? mesh->group_count : 1;
    size_t points = 12 * mesh->vertex_count * (normals ? 2 : 1), size = points + 12 * mesh->face_count, notes = 0;
    for (size_t i = 0; i < style->note_count; i++)
        notes += 2 * strlen(style->notes[i]) + 4;
    text json = {.size = 2000 + notes + 700 * (size_t)groups};
    json.bytes = malloc(json.size + 4);
    size_t *counts = calloc(groups + 1, sizeof *counts);
    uint8_t *binary = malloc(size + 1);
    tn_status status = TN_OK;
    if (!json.bytes || !counts || !binary) {
        status = tn_fail_memory(error);
    } else {
        float low[3] = {0}, high[3] = {0};
        for (size_t f = 0; f < mesh->face_count; f++)
            counts[mesh->face_group ? mesh->face_group[f] : 0]++;
        fill(mesh, normals, counts, groups, binary, low, high);
        say_notes(&json, style);
        say_primitives(&json, style, counts, groups, normals != NULL);
        say_accessors(&json, mesh, low, high, counts, groups, normals != NULL);
        status = tn_watch_check(mesh->watch, error);
        if (status == TN_OK)
            status = write_chunks(out, &json, binary, size, error);
    }
    free(json.bytes);
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
