/* DXF, release 12: the oldest that every CAD program reads. Group codes and values in turn, a line each; the reference
 * is Autodesk's "DXF Reference", chapters on LAYER, POLYLINE, VERTEX, SEQEND and 3DFACE. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/watch.h"
#include "runtime/geometry/edges.h"
#include "runtime/geometry/write.h"
#include "runtime/geometry/write_text.h"

#define NONE UINT32_MAX

/* Lines of one layer, joined into long ones: where exactly two lines of the layer meet they are one. */
typedef struct joining {
    const tn_mesh *mesh;
    uint32_t *first; /* [vertex + 1] into ends */
    uint32_t *ends;  /* 2 * line + end, by vertex */
    bool *done;      /* [line] */
    uint32_t *run;   /* vertices of the polyline at hand */
} joining;

static uint32_t layer_of(const tn_mesh *mesh, uint32_t line)
{
    return mesh->line_group ? mesh->line_group[line] : 0;
}

static void clear_joining(joining *j)
{
    free(j->first);
    free(j->ends);
    free(j->done);
    free(j->run);
}

static tn_status begin_joining(const tn_mesh *mesh, joining *j, tn_error *error)
{
    *j = (joining){mesh, calloc(mesh->vertex_count + 2, sizeof *j->first),
                   malloc((2 * mesh->line_count + 1) * sizeof *j->ends), calloc(mesh->line_count + 1, sizeof *j->done),
                   malloc((mesh->line_count + 2) * sizeof *j->run)};
    if (!j->first || !j->ends || !j->done || !j->run)
        return tn_fail_memory(error);
    for (size_t e = 0; e < 2 * mesh->line_count; e++)
        j->first[mesh->lines[e] + 2]++;
    for (size_t v = 0; v < mesh->vertex_count; v++)
        j->first[v + 2] += j->first[v + 1];
    for (size_t e = 0; e < 2 * mesh->line_count; e++) /* each start moves to its end, the next one's start */
        j->ends[j->first[mesh->lines[e] + 1]++] = (uint32_t)e;
    return TN_OK;
}

/* Of the line that ends in `end`, the end of the one that goes on there, or NONE. */
static uint32_t next_end(const joining *j, uint32_t end)
{
    uint32_t vertex = j->mesh->lines[end], layer = layer_of(j->mesh, end / 2), count = 0, other = NONE;
    for (uint32_t i = j->first[vertex]; i < j->first[vertex + 1]; i++) {
        uint32_t e = j->ends[i];
        if (layer_of(j->mesh, e / 2) != layer)
            continue;
        count++;
        if (e != end)
            other = e;
    }
    return count == 2 ? other : NONE;
}

/* The far end of the polyline that a line is in, going out through `end`; or the line itself, where it is a loop. */
static uint32_t far_end(const joining *j, uint32_t line, uint32_t end)
{
    for (uint32_t next = next_end(j, end); next != NONE && next / 2 != line; next = next_end(j, end))
        end = next ^ 1;
    return end;
}

/* The polyline that a line is in: its vertices into j->run; returns their number. A closed one does not repeat its
 * first. */
static uint32_t follow(joining *j, uint32_t line, bool *closed)
{
    uint32_t end = far_end(j, line, 2 * line), count = 0;
    uint32_t start = end;
    *closed = false;
    for (uint32_t at = start;;) {
        j->run[count++] = j->mesh->lines[at];
        j->done[at / 2] = true;
        uint32_t next = next_end(j, at ^ 1);
        if (next == NONE) {
            j->run[count++] = j->mesh->lines[at ^ 1];
            return count;
        }
        if (next == start) {
            *closed = true;
            return count;
        }
        at = next;
    }
}

/* ---- writing */

static void write_pair(tn_text_out *out, const char *code, const char *value)
{
    tn_text_add(out, code);
    tn_text_add(out, "\n");
    tn_text_add(out, value);
    tn_text_add(out, "\n");
}

static void write_number(tn_text_out *out, const char *code, double value)
{
    tn_text_add(out, code);
    tn_text_add(out, "\n");
    tn_text_decimal(out, value);
    tn_text_add(out, "\n");
}

static void write_whole(tn_text_out *out, const char *code, uint64_t value)
{
    tn_text_add(out, code);
    tn_text_add(out, "\n");
    tn_text_whole(out, value);
    tn_text_add(out, "\n");
}

static void write_point(tn_text_out *out, double x, double y, double z)
{
    write_number(out, "10", x);
    write_number(out, "20", y);
    write_number(out, "30", z);
}

typedef struct layer_text {
    char text[sizeof *((tn_mesh *)NULL)->group_names];
} layer_text;

/* Names of layers are of letters, digits, `$`, `-` and `_`. */
static layer_text layer_name(const tn_mesh *mesh, uint32_t layer)
{
    layer_text name = {"0"};
    if (mesh->group_names)
        memcpy(name.text, mesh->group_names[layer], sizeof name.text);
    for (char *c = name.text; *c; c++)
        if (!(*c >= '0' && *c <= '9') && !((*c | 32) >= 'a' && (*c | 32) <= 'z') && *c != '$' && *c != '-')
            *c = '_';
    return name;
}

/* Colours of AutoCAD's index that are nearest to the first of tn_group_colour; layers have names, and repeat them. */
static uint64_t layer_colour(uint32_t layer)
{
    static const uint64_t colours[] = {152, 30, 104, 221, 140, 40, 34};
    return colours[layer % (sizeof colours / sizeof *colours)];
}

static void write_tables(tn_text_out *out, const tn_mesh *mesh)
{
    write_pair(out, "0", "SECTION");
    write_pair(out, "2", "TABLES");
    write_pair(out, "0", "TABLE");
    write_pair(out, "2", "LTYPE");
    write_pair(out, "70", "1");
    write_pair(out, "0", "LTYPE");
    write_pair(out, "2", "CONTINUOUS");
    write_pair(out, "70", "0");
    write_pair(out, "3", "Solid line");
    write_pair(out, "72", "65");
    write_pair(out, "73", "0");
    write_pair(out, "40", "0.0");
    write_pair(out, "0", "ENDTAB");
    write_pair(out, "0", "TABLE");
    write_pair(out, "2", "LAYER");
    write_whole(out, "70", mesh->group_count ? mesh->group_count : 1);
    for (uint32_t layer = 0; layer == 0 || layer < mesh->group_count; layer++) {
        write_pair(out, "0", "LAYER");
        write_pair(out, "2", layer_name(mesh, layer).text);
        write_pair(out, "70", "0");
        write_whole(out, "62", layer_colour(layer));
        write_pair(out, "6", "CONTINUOUS");
        tn_text_flush(out, false);
    }
    write_pair(out, "0", "ENDTAB");
    write_pair(out, "0", "ENDSEC");
}

/* Where a vertex stands, with the axis up that is wanted. */
static void placed(const tn_mesh *mesh, uint32_t vertex, bool y_up, double p[3])
{
    const double *at = mesh->positions + 3 * (size_t)vertex;
    p[0] = at[0];
    p[1] = y_up ? at[2] : at[1];
    p[2] = y_up ? -at[1] : at[2];
}

/* A level polyline is a plane one at its height, which CAD programs offset and hatch; any other is one in space. */
static void write_polyline(tn_text_out *out, const joining *j, uint32_t count, bool closed, uint32_t layer, bool y_up)
{
    double p[3], height;
    bool level = true;
    placed(j->mesh, j->run[0], y_up, p);
    height = p[2];
    for (uint32_t i = 1; i < count && level; i++) {
        placed(j->mesh, j->run[i], y_up, p);
        level = p[2] == height;
    }
    write_pair(out, "0", "POLYLINE");
    write_pair(out, "8", layer_name(j->mesh, layer).text);
    write_pair(out, "66", "1");
    write_whole(out, "70", (closed ? 1u : 0u) | (level ? 0u : 8u));
    write_point(out, 0, 0, level ? height : 0);
    for (uint32_t i = 0; i < count; i++) {
        placed(j->mesh, j->run[i], y_up, p);
        write_pair(out, "0", "VERTEX");
        write_pair(out, "8", layer_name(j->mesh, layer).text);
        write_point(out, p[0], p[1], p[2]);
        if (!level)
            write_pair(out, "70", "32");
        tn_text_flush(out, false);
    }
    write_pair(out, "0", "SEQEND");
    write_pair(out, "8", layer_name(j->mesh, layer).text);
    tn_text_flush(out, false);
}

/* A triangle; the bits say which of its edges are not drawn. */
static void write_face(tn_text_out *out, const tn_mesh *mesh, uint32_t face, const bool *creases, bool y_up)
{
    static const char *const codes[4][3] = {
        {"10", "20", "30"}, {"11", "21", "31"}, {"12", "22", "32"}, {"13", "23", "33"}};
    const uint32_t *corners = mesh->corners + 3 * (size_t)face;
    const bool *edges = creases + 3 * (size_t)face;
    double p[3];
    write_pair(out, "0", "3DFACE");
    write_pair(out, "8", layer_name(mesh, mesh->face_group ? mesh->face_group[face] : 0).text);
    for (int i = 0; i < 4; i++) { /* a triangle has its last corner twice */
        placed(mesh, corners[i < 3 ? i : 2], y_up, p);
        for (int k = 0; k < 3; k++)
            write_number(out, codes[i][k], p[k]);
    }
    write_whole(out, "70", (edges[0] ? 0u : 1u) | (edges[1] ? 0u : 2u) | (edges[2] ? 0u : 8u));
    tn_text_flush(out, false);
}

static void write_lines(tn_text_out *out, joining *j, bool y_up)
{
    for (uint32_t line = 0; line < j->mesh->line_count && !out->failed && !tn_watch_stopped_at(j->mesh->watch, line);
         line++) {
        bool closed;
        if (j->done[line])
            continue;
        uint32_t count = follow(j, line, &closed);
        write_polyline(out, j, count, closed, layer_of(j->mesh, line), y_up);
    }
}

/* creases: where there are faces to write; otherwise NULL. */
static void write_all(tn_text_out *out, joining *j, const bool *creases, const tn_mesh_style *style)
{
    for (size_t i = 0; i < style->note_count; i++)
        write_pair(out, "999", style->notes[i]);
    write_pair(out, "999", style->y_up ? "up: y" : "up: z");
    write_pair(out, "0", "SECTION");
    write_pair(out, "2", "HEADER");
    write_pair(out, "9", "$ACADVER");
    write_pair(out, "1", "AC1009");
    write_pair(out, "0", "ENDSEC");
    write_tables(out, j->mesh);
    write_pair(out, "0", "SECTION");
    write_pair(out, "2", "ENTITIES");
    if (creases)
        for (uint32_t face = 0;
             face < j->mesh->face_count && !out->failed && !tn_watch_stopped_at(j->mesh->watch, face); face++)
            write_face(out, j->mesh, face, creases, style->y_up);
    else
        write_lines(out, j, style->y_up);
    write_pair(out, "0", "ENDSEC");
    write_pair(out, "0", "EOF");
    tn_text_flush(out, true);
}

tn_status tn_mesh_write_dxf(const tn_mesh *mesh, const tn_mesh_style *style, FILE *stream, tn_error *error)
{
    double largest = 1;
    joining j;
    tn_text_out *out = malloc(sizeof *out);
    if (!out)
        return tn_fail_memory(error);
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        largest = fmax(largest, fabs(mesh->positions[i]));
    tn_text_begin(out, stream, largest);
    bool *creases = NULL;
    tn_status status = begin_joining(mesh, &j, error);
    if (status == TN_OK && !mesh->lines)
        status = tn_mesh_creases(mesh, &creases, error);
    if (status == TN_OK)
        write_all(out, &j, creases, style);
    free(creases);
    clear_joining(&j);
    free(out);
    return status == TN_OK ? tn_watch_check(mesh->watch, error) : status;
}
