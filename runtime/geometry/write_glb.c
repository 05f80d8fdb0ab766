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

/* ---- what is written: a mesh for each part, which has the groups from one to another and vertices of its own */

typedef struct glb_part {
    uint32_t node, group_first, group_end; /* node: of the model */
    size_t vertex_first, vertex_count;
    float low[3], high[3];
} glb_part;

/* Without a model there is one part, with all vertices in their order. */
typedef struct glb {
    const tn_mesh *mesh;
    const tn_mesh_style *style;
    const double *normals;
    uint32_t groups, part_count;
    glb_part *parts;
    size_t *counts;     /* [groups] of faces */
    uint32_t *vertices; /* of the mesh, in the order in which they are written; NULL: all of them */
    uint32_t *corners;  /* [faces][3] counted in their parts; NULL: those of the mesh */
    size_t vertex_count;
} glb;

static void clear(glb *g)
{
    free(g->parts);
    free(g->counts);
    free(g->vertices);
    free(g->corners);
}

static void count_faces(glb *g)
{
    for (size_t f = 0; f < g->mesh->face_count; f++)
        g->counts[g->mesh->face_group ? g->mesh->face_group[f] : 0]++;
}

/* Those of the groups that have faces, a part for each node. */
static void find_parts(glb *g)
{
    const tn_mesh_model *model = g->style->model;
    if (!model) {
        g->parts[g->part_count++] = (glb_part){.group_end = g->groups, .vertex_count = g->mesh->vertex_count};
        return;
    }
    for (uint32_t group = 0; group < g->groups; group++) {
        uint32_t node = model->pieces[group].node;
        if (!g->counts[group])
            continue;
        if (g->part_count == 0 || g->parts[g->part_count - 1].node != node)
            g->parts[g->part_count++] = (glb_part){.node = node, .group_first = group};
        g->parts[g->part_count - 1].group_end = group + 1;
    }
}

/* The vertices that each part uses; those that several use are there several times. */
static tn_status find_vertices(glb *g, tn_error *error)
{
    const tn_mesh *mesh = g->mesh;
    uint32_t *seen = calloc(mesh->vertex_count + 1, sizeof *seen), /* the last part that has it, counted from 1 */
        *local = malloc((mesh->vertex_count + 1) * sizeof *local);
    g->vertices = malloc((3 * mesh->face_count + 1) * sizeof *g->vertices);
    g->corners = malloc((3 * mesh->face_count + 1) * sizeof *g->corners);
    tn_status status = seen && local && g->vertices && g->corners ? TN_OK : tn_fail_memory(error);
    size_t corner = 0;
    g->vertex_count = 0;
    for (uint32_t p = 0; status == TN_OK && p < g->part_count; p++) {
        glb_part *part = &g->parts[p];
        size_t end = corner;
        for (uint32_t group = part->group_first; group < part->group_end; group++)
            end += 3 * g->counts[group];
        part->vertex_first = g->vertex_count;
        for (; corner < end; corner++) {
            uint32_t v = mesh->corners[corner];
            if (seen[v] != p + 1) {
                seen[v] = p + 1;
                local[v] = (uint32_t)(g->vertex_count - part->vertex_first);
                g->vertices[g->vertex_count++] = v;
            }
            g->corners[corner] = local[v];
        }
        part->vertex_count = g->vertex_count - part->vertex_first;
    }
    free(seen);
    free(local);
    return status;
}

static tn_status gather(glb *g, tn_error *error)
{
    g->groups = g->mesh->face_group ? g->mesh->group_count : 1;
    g->vertex_count = g->mesh->vertex_count;
    g->counts = calloc((size_t)g->groups + 1, sizeof *g->counts);
    g->parts = malloc(((size_t)g->groups + 1) * sizeof *g->parts);
    if (!g->counts || !g->parts)
        return tn_fail_memory(error);
    count_faces(g);
    find_parts(g);
    return g->style->model ? find_vertices(g, error) : TN_OK;
}

/* ---- nodes */

/* Children in their order: of each node the first, and the next sibling; 0: there is none. */
static uint32_t *find_children(const tn_mesh_model *model)
{
    uint32_t *links = calloc(2 * model->node_count + 1, sizeof *links),
             *next = links ? links + model->node_count : NULL;
    for (size_t i = model->node_count; links && i-- > 1;) {
        next[i] = links[model->nodes[i].parent];
        links[model->nodes[i].parent] = (uint32_t)i;
    }
    return links;
}

static void say_node(tn_json *json, const tn_mesh_model *model, uint32_t node, const uint32_t *links, const glb *g,
                     uint32_t *part)
{
    tn_json_object(json, NULL);
    tn_json_string(json, "name", model->nodes[node].name);
    if (*part < g->part_count && g->parts[*part].node == node)
        tn_json_count(json, "mesh", (*part)++);
    if (links[node]) {
        tn_json_list(json, "children");
        for (uint32_t child = links[node]; child; child = links[model->node_count + child])
            tn_json_count(json, NULL, child);
        tn_json_list_end(json);
    }
    if (model->nodes[node].facts)
        tn_json_written_value(json, "extras", model->nodes[node].facts);
    tn_json_object_end(json);
}

static tn_status say_nodes(tn_json *json, const glb *g, tn_error *error)
{
    const tn_mesh_model *model = g->style->model;
    uint32_t *links = model ? find_children(model) : NULL, part = 0;
    if (model && !links)
        return tn_fail_memory(error);
    tn_json_list(json, "nodes");
    if (!model) {
        tn_json_object(json, NULL);
        tn_json_count(json, "mesh", 0);
        tn_json_object_end(json);
    }
    for (uint32_t i = 0; model && i < model->node_count; i++)
        say_node(json, model, i, links, g, &part);
    tn_json_list_end(json);
    free(links);
    return TN_OK;
}

/* One scene, of one node, below which all others are. */
static void say_scene(tn_json *json, const tn_mesh_model *model)
{
    tn_json_count(json, "scene", 0);
    tn_json_list(json, "scenes");
    tn_json_object(json, NULL);
    if (model)
        tn_json_string(json, "name", model->nodes[0].name);
    tn_json_list(json, "nodes");
    tn_json_count(json, NULL, 0);
    tn_json_list_end(json);
    if (model && model->facts)
        tn_json_written_value(json, "extras", model->facts);
    tn_json_object_end(json);
    tn_json_list_end(json);
}

/* ---- meshes: positions (and normals) of all parts are the first accessors, corners of all groups those behind */

static void say_primitives(tn_json *json, const glb *g, uint32_t number, uint32_t *made)
{
    const glb_part *part = &g->parts[number];
    uint32_t each = g->normals ? 2 : 1;
    tn_json_list(json, "primitives");
    for (uint32_t group = part->group_first; group < part->group_end; group++) {
        if (!g->counts[group])
            continue;
        tn_json_object(json, NULL);
        tn_json_object(json, "attributes");
        tn_json_count(json, "POSITION", each * number);
        if (g->normals)
            tn_json_count(json, "NORMAL", each * number + 1);
        tn_json_object_end(json);
        tn_json_count(json, "indices", each * g->part_count + *made);
        tn_json_count(json, "material", g->style->model ? g->style->model->pieces[group].material : *made);
        (*made)++;
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static void say_meshes(tn_json *json, const glb *g)
{
    uint32_t made = 0;
    if (g->part_count == 0)
        return;
    tn_json_list(json, "meshes");
    for (uint32_t p = 0; p < g->part_count; p++) {
        tn_json_object(json, NULL);
        if (g->style->model)
            tn_json_string(json, "name", g->style->model->nodes[g->parts[p].node].name);
        say_primitives(json, g, p, &made);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

/* Glass is seen through, and has its two faces; other parts are seen from inside, too, where those before them are
 * hidden. */
static void say_material(tn_json *json, const char *name, const unsigned char rgb[3], double opacity)
{
    tn_json_object(json, NULL);
    if (name)
        tn_json_string(json, "name", name);
    if (opacity < 1)
        tn_json_string(json, "alphaMode", "BLEND");
    else
        tn_json_bool(json, "doubleSided", true);
    tn_json_object(json, "pbrMetallicRoughness");
    tn_json_list(json, "baseColorFactor");
    for (int k = 0; k < 3; k++)
        tn_json_rounded(json, NULL, linear(rgb[k]), 6);
    tn_json_number(json, NULL, opacity);
    tn_json_list_end(json);
    tn_json_count(json, "metallicFactor", 0);
    tn_json_number(json, "roughnessFactor", opacity < 1 ? 0.1 : 0.9);
    tn_json_object_end(json);
    tn_json_object_end(json);
}

static void say_materials(tn_json *json, const glb *g)
{
    const tn_mesh_model *model = g->style->model;
    tn_json_list(json, "materials");
    for (size_t i = 0; model && i < model->material_count; i++)
        say_material(json, model->materials[i].name, model->materials[i].rgb, model->materials[i].opacity);
    for (uint32_t group = 0; !model && group < g->groups; group++) {
        unsigned char rgb[3] = {204, 204, 196};
        if (!g->counts[group])
            continue;
        if (g->groups > 1)
            tn_mesh_style_colour(g->style, group, rgb);
        say_material(json, g->mesh->group_names ? g->mesh->group_names[group] : NULL, rgb, 1);
    }
    tn_json_list_end(json);
}

enum { FLOATS = 5126, WORDS = 5125, VERTICES = 34962, CORNERS = 34963 }; /* of OpenGL, which glTF cites */

/* Points, or corners, from a byte on; the caller ends it. */
static void begin_accessor(tn_json *json, size_t view, size_t offset, int type, size_t count)
{
    tn_json_object(json, NULL);
    tn_json_count(json, "bufferView", view);
    if (type == WORDS || offset)
        tn_json_count(json, "byteOffset", offset);
    tn_json_whole(json, "componentType", type);
    tn_json_count(json, "count", count);
    tn_json_string(json, "type", type == WORDS ? "SCALAR" : "VEC3");
}

static void say_accessors(tn_json *json, const glb *g)
{
    size_t corners = 0;
    tn_json_list(json, "accessors");
    for (uint32_t p = 0; p < g->part_count; p++) {
        const glb_part *part = &g->parts[p];
        begin_accessor(json, 0, 12 * part->vertex_first, FLOATS, part->vertex_count);
        floats(json, "min", part->low);
        floats(json, "max", part->high);
        tn_json_object_end(json);
        if (!g->normals)
            continue;
        begin_accessor(json, 1, 12 * part->vertex_first, FLOATS, part->vertex_count);
        tn_json_object_end(json);
    }
    for (uint32_t group = 0; group < g->groups; group++) {
        if (!g->counts[group])
            continue;
        begin_accessor(json, g->normals ? 2 : 1, 4 * corners, WORDS, 3 * g->counts[group]);
        tn_json_object_end(json);
        corners += 3 * g->counts[group];
    }
    tn_json_list_end(json);
}

/* Points that several accessors have need their stride (3.6.2.4). */
static void say_view(tn_json *json, size_t offset, size_t length, int target, bool strided)
{
    tn_json_object(json, NULL);
    tn_json_count(json, "buffer", 0);
    if (offset)
        tn_json_count(json, "byteOffset", offset);
    tn_json_count(json, "byteLength", length);
    if (strided)
        tn_json_count(json, "byteStride", 12);
    tn_json_whole(json, "target", target);
    tn_json_object_end(json);
}

static void say_buffers(tn_json *json, const glb *g)
{
    size_t points = 12 * g->vertex_count, corners = 12 * g->mesh->face_count, offset = g->normals ? 2 * points : points;
    tn_json_list(json, "bufferViews");
    say_view(json, 0, points, VERTICES, g->part_count > 1);
    if (g->normals)
        say_view(json, points, points, VERTICES, g->part_count > 1);
    say_view(json, offset, corners, CORNERS, false);
    tn_json_list_end(json);
    tn_json_list(json, "buffers");
    tn_json_object(json, NULL);
    tn_json_count(json, "byteLength", offset + corners);
    tn_json_object_end(json);
    tn_json_list_end(json);
}

/* ---- arrays */

static const double *vertex_in(const glb *g, const double *values, size_t i)
{
    return values + 3 * (g->vertices ? g->vertices[i] : i);
}

static void fill_part(const glb *g, glb_part *part, double scale, uint8_t **to)
{
    for (size_t i = 0; i < part->vertex_count && !tn_watch_stopped_at(g->mesh->watch, i); i++) {
        float q[3];
        turned(vertex_in(g, g->mesh->positions, part->vertex_first + i), scale, q);
        for (int k = 0; k < 3; k++) {
            part->low[k] = i && part->low[k] < q[k] ? part->low[k] : q[k];
            part->high[k] = i && part->high[k] > q[k] ? part->high[k] : q[k];
        }
        put_floats(to, q, 3);
    }
}

/* Group by group, which is the order of a model's faces already. */
static void fill_corners(const glb *g, uint8_t *to)
{
    const tn_mesh *mesh = g->mesh;
    for (size_t i = 0; g->corners && i < 3 * mesh->face_count; i++, to += 4)
        tn_put_u32(to, g->corners[i]);
    for (uint32_t group = 0; !g->corners && group < g->groups; group++) {
        for (size_t f = 0; g->counts[group] && f < mesh->face_count && !tn_watch_stopped_at(mesh->watch, f); f++) {
            if (mesh->face_group && mesh->face_group[f] != group)
                continue;
            for (int i = 0; i < 3; i++, to += 4)
                tn_put_u32(to, mesh->corners[3 * f + (size_t)i]);
        }
    }
}

static void fill(glb *g, uint8_t *binary)
{
    uint8_t *to = binary;
    for (uint32_t p = 0; p < g->part_count; p++)
        fill_part(g, &g->parts[p], metres(g->style->unit), &to);
    for (size_t i = 0; g->normals && i < g->vertex_count && !tn_watch_stopped_at(g->mesh->watch, i); i++) {
        float q[3];
        turned(vertex_in(g, g->normals, i), 1, q);
        put_floats(&to, q, 3);
    }
    fill_corners(g, to);
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

static tn_status write_json(glb *g, tn_buffer *text, tn_error *error)
{
    tn_json json = tn_json_text(text, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    say_asset(&json, g->style);
    say_scene(&json, g->style->model);
    tn_status status = say_nodes(&json, g, error);
    say_meshes(&json, g);
    say_materials(&json, g);
    say_accessors(&json, g);
    say_buffers(&json, g);
    tn_json_object_end(&json);
    return status == TN_OK && text->failed ? tn_fail_memory(error) : status;
}

static tn_status write_triangles(glb *g, FILE *out, tn_error *error)
{
    tn_buffer text = {0};
    tn_status status = gather(g, error);
    size_t size = 12 * g->vertex_count * (g->normals ? 2 : 1) + 12 * g->mesh->face_count;
    uint8_t *binary = status == TN_OK ? malloc(size + 1) : NULL;
    if (status == TN_OK && !binary)
        status = tn_fail_memory(error);
    if (status == TN_OK) {
        fill(g, binary);
        status = tn_watch_check(g->mesh->watch, error);
    }
    if (status == TN_OK)
        status = write_json(g, &text, error);
    if (status == TN_OK)
        status = write_chunks(out, &text, binary, size, error);
    free(text.data);
    free(binary);
    clear(g);
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
        status = write_triangles(&(glb){.mesh = mesh, .style = style, .normals = normals}, out, error);
    free(normals);
    return status;
}
