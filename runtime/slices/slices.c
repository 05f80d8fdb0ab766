/* Slices: outlines in level layers; of closed meshes, and as files. */
#include "runtime/slices/slices.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/buffer.h"
#include "runtime/geometry/edges.h"
#include "runtime/geometry/write.h"
#include "runtime/geometry/write_text.h"

/* ==== the layers of slices, and what is owned by them */

#define LAYERS_MAX 1000000u

void tn_slices_clear(tn_slices *slices)
{
    free(slices->points);
    free(slices->line_first);
    free(slices->layer_first);
    free(slices->heights);
    *slices = (tn_slices){0};
}

tn_status tn_slices_layers(double low, double high, double thickness, tn_slices *slices, tn_error *error)
{
    double layers = ceil((high - low) / thickness - 1e-9);
    *slices = (tn_slices){0};
    if (!(thickness > 0) || !(layers >= 1) || layers > LAYERS_MAX) {
        tn_fail(error, TN_INVALID, E_FIELD_LAYER, "layers %.6g high do not fill a box %.6g high", thickness,
                high - low);
        tn_error_help(error, "--layer takes a height above 0 that gives at most %u layers", LAYERS_MAX);
        return TN_INVALID;
    }
    slices->layer_count = (size_t)layers;
    slices->heights = calloc(slices->layer_count, sizeof *slices->heights);
    slices->layer_first = calloc(slices->layer_count + 1, sizeof *slices->layer_first);
    if (!slices->heights || !slices->layer_first)
        return tn_fail_memory(error);
    for (size_t i = 0; i < slices->layer_count; i++) /* the last layer may be lower */
        slices->heights[i] =
            fmin(low + ((double)i + 0.5) * thickness, 0.5 * (low + (double)i * thickness) + 0.5 * high);
    return TN_OK;
}

/* ==== slices a closed mesh: in each layer, from triangle to triangle over the edges that cross its height */

#define NONE TN_NO_TWIN

typedef struct tracing {
    const tn_mesh *mesh;
    bool *creases;
    uint32_t *twin;  /* [corner] of the other triangle that has the edge to the next corner */
    bool *done;      /* [triangle], of the layer at hand */
    uint32_t *order; /* triangles by their lowest height */
    double *lowest;  /* [triangle] */
    tn_slices *slices;
    size_t point_room, line_room;
} tracing;

static uint32_t next_corner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

static double height_of(const tracing *t, uint32_t corner)
{
    return t->mesh->positions[3 * (size_t)t->mesh->corners[corner] + 2];
}

/* ---- lines */

/* Where the edge crosses the height, the same seen from both of its triangles. */
static void crossing(const tracing *t, uint32_t corner, double height, double point[2])
{
    const double *a = t->mesh->positions + 3 * (size_t)t->mesh->corners[corner],
                 *b = t->mesh->positions + 3 * (size_t)t->mesh->corners[next_corner(corner)];
    if (a[2] > b[2]) {
        const double *other = a;
        a = b;
        b = other;
    }
    double share = (height - a[2]) / (b[2] - a[2]);
    for (int k = 0; k < 2; k++)
        point[k] = share >= 1 ? b[k] : a[k] + share * (b[k] - a[k]);
}

static tn_status trace_point(tracing *t, const double point[2], tn_error *error)
{
    tn_slices *s = t->slices;
    if (s->point_count > s->line_first[s->line_count] &&
        memcmp(s->points[s->point_count - 1], point, sizeof *s->points) == 0)
        return TN_OK;
    if (s->point_count >= NONE || !tn_array_reserve(&s->points, &t->point_room, s->point_count, 1, sizeof *s->points))
        return tn_fail_memory(error);
    memcpy(s->points[s->point_count++], point, sizeof *s->points);
    return TN_OK;
}

/* Of the triangle's edges the one that rises through the height, or falls; NONE where it does not cross it. */
static uint32_t edge_through(const tracing *t, uint32_t face, double height, bool rises)
{
    for (uint32_t c = 3 * face; c < 3 * face + 3; c++) {
        bool from = height_of(t, c) >= height, to = height_of(t, next_corner(c)) >= height;
        if (from != to && to == rises)
            return c;
    }
    return NONE;
}

/* Seen from above, with the inside on the left, a line enters a triangle by the edge that falls and leaves it by the
 * one that rises. Lines of fewer than three corners have no inside, and are left out. */
static tn_status trace_line(tracing *t, uint32_t face, double height, tn_error *error)
{
    tn_slices *s = t->slices;
    tn_status status = TN_OK;
    for (uint32_t at = face; at != NONE && !t->done[at] && status == TN_OK;) {
        uint32_t leaves = edge_through(t, at, height, true);
        double point[2];
        t->done[at] = true;
        crossing(t, leaves, height, point);
        if (t->creases[leaves])
            status = trace_point(t, point, error);
        at = t->twin[leaves] == NONE ? NONE : t->twin[leaves] / 3;
    }
    uint32_t first = s->line_first[s->line_count];
    while (s->point_count > first + 1 &&
           memcmp(s->points[first], s->points[s->point_count - 1], sizeof *s->points) == 0)
        s->point_count--;
    if (s->point_count < first + 3u)
        s->point_count = first;
    if (status != TN_OK || s->point_count == first)
        return status;
    if (!tn_array_reserve(&s->line_first, &t->line_room, s->line_count, 2, sizeof *s->line_first))
        return tn_fail_memory(error);
    s->line_first[++s->line_count] = (uint32_t)s->point_count;
    return TN_OK;
}

static double highest_of(const tracing *t, uint32_t face)
{
    return fmax(height_of(t, 3 * face), fmax(height_of(t, 3 * face + 1), height_of(t, 3 * face + 2)));
}

/* Triangles that reach from below a layer into it are open; they come in order of their lowest heights. */
static tn_status trace_layers(tracing *t, tn_error *error)
{
    tn_slices *s = t->slices;
    size_t faces = t->mesh->face_count, come = 0, open_count = 0;
    uint32_t *open = malloc((faces + 1) * sizeof *open);
    tn_status status = open ? TN_OK : tn_fail_memory(error);
    for (size_t layer = 0; layer < s->layer_count && status == TN_OK; layer++) {
        double height = s->heights[layer];
        size_t kept = 0;
        for (; come < faces && t->lowest[t->order[come]] < height; come++)
            open[open_count++] = t->order[come];
        for (size_t i = 0; i < open_count; i++)
            if (highest_of(t, open[i]) >= height)
                open[kept++] = open[i];
        open_count = kept;
        for (size_t i = 0; i < open_count; i++)
            t->done[open[i]] = false;
        for (size_t i = 0; i < open_count && status == TN_OK; i++)
            if (!t->done[open[i]])
                status = trace_line(t, open[i], height, error);
        s->layer_first[layer + 1] = (uint32_t)s->line_count;
    }
    free(open);
    return status;
}

typedef struct by_height {
    double lowest;
    uint32_t face;
} by_height;

static int lower_first(const void *a, const void *b)
{
    const by_height *x = a, *y = b;
    if (x->lowest != y->lowest)
        return x->lowest < y->lowest ? -1 : 1;
    return x->face < y->face ? -1 : x->face > y->face;
}

static tn_status order_faces(tracing *t, tn_error *error)
{
    size_t faces = t->mesh->face_count;
    by_height *list = malloc((faces + 1) * sizeof *list);
    if (!list)
        return tn_fail_memory(error);
    for (uint32_t f = 0; f < faces; f++) {
        t->lowest[f] = fmin(height_of(t, 3 * f), fmin(height_of(t, 3 * f + 1), height_of(t, 3 * f + 2)));
        list[f] = (by_height){t->lowest[f], f};
    }
    qsort(list, faces, sizeof *list, lower_first);
    for (size_t f = 0; f < faces; f++)
        t->order[f] = list[f].face;
    free(list);
    return TN_OK;
}

static tn_status begin_tracing(tracing *t, double thickness, tn_error *error)
{
    size_t faces = t->mesh->face_count;
    double low = INFINITY, high = -INFINITY;
    for (size_t v = 0; v < t->mesh->vertex_count; v++) {
        low = fmin(low, t->mesh->positions[3 * v + 2]);
        high = fmax(high, t->mesh->positions[3 * v + 2]);
    }
    tn_status status = tn_slices_layers(low, high, thickness, t->slices, error);
    if (status != TN_OK)
        return status;
    t->twin = tn_mesh_twins(t->mesh);
    t->done = malloc(faces + 1);
    t->order = malloc((faces + 1) * sizeof *t->order);
    t->lowest = malloc((faces + 1) * sizeof *t->lowest);
    t->line_room = 16;
    t->slices->line_first = calloc(t->line_room, sizeof *t->slices->line_first);
    if (!t->twin || !t->done || !t->order || !t->lowest || !t->slices->line_first)
        return tn_fail_memory(error);
    return order_faces(t, error);
}

/* Groups do not matter to outlines: only where the mesh bends do they turn. */
static tn_status find_creases(tracing *t, tn_error *error)
{
    tn_mesh plain = *t->mesh;
    plain.face_group = NULL;
    return tn_mesh_creases(&plain, &t->creases, error);
}

tn_status tn_slices_of_mesh(const tn_mesh *mesh, double thickness, tn_slices *slices, tn_error *error)
{
    tracing t = {.mesh = mesh, .slices = slices};
    *slices = (tn_slices){0};
    tn_status status = begin_tracing(&t, thickness, error);
    if (status == TN_OK)
        status = find_creases(&t, error);
    if (status == TN_OK)
        status = trace_layers(&t, error);
    free(t.creases);
    free(t.twin);
    free(t.done);
    free(t.order);
    free(t.lowest);
    return status;
}

/* ==== writes slices to files. SVG 1.1 is by the W3C; CLI by the project "Common Layer Interface (CLI), version 2.0"
 * (Brite- EuRam, 1994) */

static tn_text_out *begin(const tn_slices_style *style, FILE *stream)
{
    tn_text_out *out = malloc(sizeof *out);
    double largest = 1;
    for (int axis = 0; axis < 3; axis++)
        largest = fmax(largest, fmax(fabs(style->low[axis]), fabs(style->high[axis])));
    if (out)
        tn_text_begin(out, stream, largest);
    return out;
}

static tn_status end(tn_text_out *out)
{
    tn_text_flush(out, true);
    free(out);
    return TN_OK;
}

static void add_number(tn_text_out *out, double number)
{
    char text[TN_NUMBER_TEXT_SIZE];
    tn_text_add(out, tn_number_text(number, text));
}

static void add_point(tn_text_out *out, const double point[2], const char *between, double y_sign)
{
    tn_text_decimal(out, point[0]);
    tn_text_add(out, between);
    tn_text_decimal(out, point[1] == 0 ? 0 : y_sign * point[1]);
    tn_text_flush(out, false);
}

/* ---- SVG */

/* A length of the picture: SVG has neither metres nor feet. */
static void add_length(tn_text_out *out, double length, uint32_t unit)
{
    static const struct {
        double factor;
        const char *word;
    } units[TN_UNIT_COUNT] = {{1, ""}, {1, "mm"}, {1, "cm"}, {1000, "mm"}, {1, "in"}, {12, "in"}};
    add_number(out, length * units[unit].factor);
    tn_text_add(out, units[unit].word);
}

static void add_svg_head(tn_text_out *out, const tn_slices_style *style)
{
    double width = style->high[0] - style->low[0], height = style->high[1] - style->low[1];
    tn_text_add(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"");
    add_length(out, width, style->unit);
    tn_text_add(out, "\" height=\"");
    add_length(out, height, style->unit);
    tn_text_add(out, "\" viewBox=\"");
    const double view[4] = {style->low[0], -style->high[1], width, height};
    for (int i = 0; i < 4; i++) {
        tn_text_add(out, i ? " " : "");
        add_number(out, view[i]);
    }
    tn_text_add(out, "\">\n<title>");
    tn_text_add(out, style->name);
    tn_text_add(out, "</title>\n<desc>");
    tn_text_add(out, style->note);
    tn_text_add(out, "</desc>\n");
}

/* y points down in pictures. */
static void add_svg_layer(tn_text_out *out, const tn_slices *slices, const tn_slices_style *style, size_t layer)
{
    char id[64];
    snprintf(id, sizeof id, "<g id=\"layer-%04zu\" fill=\"none\" stroke=\"black\" stroke-width=\"", layer + 1);
    tn_text_add(out, id);
    add_number(out, (style->high[0] - style->low[0]) / 1000);
    tn_text_add(out, "\"><title>z = ");
    add_number(out, slices->heights[layer]);
    tn_text_add(out, "</title>");
    for (uint32_t line = slices->layer_first[layer]; line < slices->layer_first[layer + 1]; line++) {
        tn_text_add(out, line == slices->layer_first[layer] ? "<path fill-rule=\"evenodd\" d=\"" : "\n");
        for (uint32_t i = slices->line_first[line]; i < slices->line_first[line + 1]; i++) {
            tn_text_add(out, i == slices->line_first[line] ? "M" : " ");
            add_point(out, slices->points[i], ",", -1);
        }
        tn_text_add(out, line + 1 == slices->layer_first[layer + 1] ? "Z\"/>" : "Z");
    }
    tn_text_add(out, "</g>\n");
    tn_text_flush(out, false);
}

tn_status tn_slices_write_svg(const tn_slices *slices, const tn_slices_style *style, FILE *stream, tn_error *error)
{
    tn_text_out *out = begin(style, stream);
    if (!out)
        return tn_fail_memory(error);
    add_svg_head(out, style);
    for (size_t layer = style->first; layer < style->last; layer++)
        add_svg_layer(out, slices, style, layer);
    tn_text_add(out, "</svg>\n");
    return end(out);
}

/* ---- DXF, by the writer of meshes: lines in groups */

static tn_status make_lines(const tn_slices *slices, const tn_slices_style *style, tn_mesh *mesh, tn_error *error)
{
    uint32_t from = slices->layer_first[style->first], to = slices->layer_first[style->last];
    uint32_t first = slices->line_first[from], count = slices->line_first[to] - first;
    mesh->positions = malloc(((size_t)count + 1) * 3 * sizeof *mesh->positions);
    mesh->lines = malloc(((size_t)count + 1) * 2 * sizeof *mesh->lines);
    mesh->line_group = malloc(((size_t)count + 1) * sizeof *mesh->line_group);
    mesh->group_names = calloc(style->last - style->first + 1, sizeof *mesh->group_names);
    if (!mesh->positions || !mesh->lines || !mesh->line_group || !mesh->group_names)
        return tn_fail_memory(error);
    mesh->vertex_count = mesh->line_count = count;
    mesh->group_count = (uint32_t)(style->last - style->first);
    for (uint32_t group = 0; group < mesh->group_count; group++) {
        size_t layer = style->first + group;
        snprintf(mesh->group_names[group], sizeof mesh->group_names[group], "layer_%04zu", layer + 1);
        for (uint32_t line = slices->layer_first[layer]; line < slices->layer_first[layer + 1]; line++)
            for (uint32_t i = slices->line_first[line]; i < slices->line_first[line + 1]; i++) {
                uint32_t after = i + 1 < slices->line_first[line + 1] ? i + 1 : slices->line_first[line];
                double *at = mesh->positions + 3 * (size_t)(i - first);
                memcpy(at, slices->points[i], 2 * sizeof *at);
                at[2] = slices->heights[layer];
                mesh->lines[2 * (size_t)(i - first)] = i - first;
                mesh->lines[2 * (size_t)(i - first) + 1] = after - first;
                mesh->line_group[i - first] = group;
            }
    }
    return TN_OK;
}

tn_status tn_slices_write_dxf(const tn_slices *slices, const tn_slices_style *style, FILE *out, tn_error *error)
{
    tn_mesh mesh = {0};
    tn_mesh_style notes = {.notes = &style->note, .note_count = 1};
    tn_status status = make_lines(slices, style, &mesh, error);
    if (status == TN_OK)
        status = tn_mesh_write_dxf(&mesh, &notes, out, error);
    tn_mesh_clear(&mesh);
    return status;
}

/* ---- CLI */

static void add_cli_head(tn_text_out *out, const tn_slices_style *style)
{
    static const double millimetres[TN_UNIT_COUNT] = {1, 1, 10, 1000, 25.4, 304.8};
    char layers[40];
    tn_text_add(out, "$$HEADERSTART\n$$ASCII\n// ");
    tn_text_add(out, style->note);
    tn_text_add(out, " //\n$$UNITS/");
    add_number(out, millimetres[style->unit]);
    tn_text_add(out, "\n$$VERSION/200\n$$LABEL/1,");
    tn_text_add(out, style->name);
    tn_text_add(out, "\n$$DIMENSION/");
    for (int i = 0; i < 6; i++) {
        tn_text_add(out, i ? "," : "");
        add_number(out, i < 3 ? style->low[i] : style->high[i - 3]);
    }
    snprintf(layers, sizeof layers, "\n$$LAYERS/%06zu\n", style->last - style->first);
    tn_text_add(out, layers);
    tn_text_add(out, "$$HEADEREND\n$$GEOMETRYSTART\n");
}

/* Twice the area within a line: above 0 if it runs counter-clockwise. */
static double turn_of(const tn_slices *slices, uint32_t line)
{
    uint32_t first = slices->line_first[line], end = slices->line_first[line + 1];
    double sum = 0;
    for (uint32_t i = first; i < end; i++) {
        const double *a = slices->points[i], *b = slices->points[i + 1 < end ? i + 1 : first];
        sum += (a[0] - slices->points[first][0]) * (b[1] - a[1]) - (a[1] - slices->points[first][1]) * (b[0] - a[0]);
    }
    return sum;
}

static void add_cli_line(tn_text_out *out, const tn_slices *slices, uint32_t line)
{
    uint32_t first = slices->line_first[line], count = slices->line_first[line + 1] - first;
    tn_text_add(out, turn_of(slices, line) > 0 ? "$$POLYLINE/1,1," : "$$POLYLINE/1,0,");
    tn_text_whole(out, count + 1);
    for (uint32_t i = 0; i <= count; i++) {
        tn_text_add(out, ",");
        add_point(out, slices->points[first + i % count], ",", 1);
    }
    tn_text_add(out, "\n");
}

tn_status tn_slices_write_cli(const tn_slices *slices, const tn_slices_style *style, FILE *stream, tn_error *error)
{
    tn_text_out *out = begin(style, stream);
    if (!out)
        return tn_fail_memory(error);
    add_cli_head(out, style);
    for (size_t layer = style->first; layer < style->last; layer++) {
        tn_text_add(out, "$$LAYER/");
        add_number(out, slices->heights[layer]);
        tn_text_add(out, "\n");
        for (uint32_t line = slices->layer_first[layer]; line < slices->layer_first[layer + 1]; line++)
            add_cli_line(out, slices, line);
    }
    tn_text_add(out, "$$GEOMETRYEND\n");
    return end(out);
}
