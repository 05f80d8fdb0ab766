/* Writes slices to files. SVG 1.1 is by the W3C; CLI by the project "Common Layer Interface (CLI), version 2.0" (Brite-
 * EuRam, 1994). */
#include "runtime/slices/write.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/buffer.h"
#include "runtime/geometry/write.h"
#include "runtime/geometry/write_text.h"

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

/* Twice the area within a line: above 0 where it runs counter-clockwise. */
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
