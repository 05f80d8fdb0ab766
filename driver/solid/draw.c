/* Draws designs of boxes: each box in its colour, as it is built, apart, before squashing, or step by step. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "driver/solid/solid.h"
#include "runtime/geometry/union/union.h"

enum { VIEWS_MAX = 24 }; /* of a history: more steps than these tell nobody anything */

void tn_solid_turn_up(tn_mesh *mesh)
{
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        double *p = mesh->positions + 3 * v, y = p[1];
        p[1] = -p[2];
        p[2] = y;
    }
}

typedef struct drawing {
    const tn_module *module;
    uint32_t solid;
    const tn_solid_drawing *how;
    const tn_built *built;
    tn_view *views[VIEWS_MAX + 1];
    char labels[VIEWS_MAX + 1][sizeof(tn_squash_words)];
    uint32_t count;
} drawing;

/* ---- views */

/* Takes a view of a mesh whose groups are cells: all images of a box have its colour. */
static tn_status take_view(const tn_built *built, tn_mesh *mesh, const tn_camera *camera, tn_view **view,
                           tn_error *error)
{
    tn_display_list display;
    tn_solid_turn_up(mesh);
    tn_status status = tn_display_list_of_mesh(mesh, &display, error);
    for (uint32_t f = 0; status == TN_OK && f < display.face_count; f++)
        display.groups[f] %= built->built.box_count;
    display.closed = true;
    if (status == TN_OK)
        status = tn_view_take(&display, camera, view, error);
    tn_display_list_clear(&display);
    return status;
}

tn_status tn_built_view(const tn_built *built, const tn_camera *camera, tn_view **view, tn_error *error)
{
    tn_union u;
    *view = NULL;
    tn_status status = tn_union_make(built->cells, built->cell_count, &u, error);
    if (status == TN_OK)
        status = take_view(built, &u.mesh, camera, view, error);
    tn_union_clear(&u);
    return status;
}

static void name_view(drawing *d, const char *label)
{
    snprintf(d->labels[d->count++], sizeof *d->labels, "%s", label);
}

static tn_status add_union(drawing *d, const tn_camera *camera, const char *label, tn_error *error)
{
    tn_status status = tn_built_view(d->built, camera, &d->views[d->count], error);
    if (status == TN_OK)
        name_view(d, label);
    return status;
}

static tn_status add_cells(drawing *d, const tn_cut_box *cells, const char *label, tn_error *error)
{
    tn_mesh mesh = {0};
    tn_status status = tn_union_cells(cells, d->built->cell_count, &mesh, error);
    if (status == TN_OK)
        status = take_view(d->built, &mesh, &d->how->camera, &d->views[d->count], error);
    if (status == TN_OK)
        name_view(d, label);
    tn_mesh_clear(&mesh);
    return status;
}

/* The boxes of a design before all squashing is done: they may overlap. */
static tn_status add_design(drawing *d, const tn_design *design, const char *label, tn_error *error)
{
    uint32_t n = design->box_count;
    tn_cut_box *cells = malloc((d->built->cell_count + 1) * sizeof *cells);
    if (!cells)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < d->built->cell_count; i++)
        tn_design_cell(design, i % n, tn_design_image(design, i / n), &cells[i]);
    tn_status status = add_cells(d, cells, label, error);
    free(cells);
    return status;
}

/* Boxes move away from the middle of all, by half of their distance from it. */
static tn_status add_exploded(drawing *d, tn_error *error)
{
    const tn_built *built = d->built;
    double middle[3] = {0};
    size_t left = 0;
    tn_cut_box *cells = malloc((built->cell_count + 1) * sizeof *cells);
    if (!cells)
        return tn_fail_memory(error);
    memcpy(cells, built->cells, built->cell_count * sizeof *cells);
    for (size_t i = 0; i < built->cell_count; i++) {
        left += cells[i].face_count > 0;
        for (int k = 0; k < 3 && cells[i].face_count; k++)
            middle[k] += (cells[i].low[k] + cells[i].high[k]) / 2;
    }
    for (size_t i = 0; i < built->cell_count; i++)
        for (uint32_t v = 0; v < cells[i].corner_count; v++)
            for (int k = 0; k < 3; k++)
                cells[i].at[v][k] += 0.5 * ((cells[i].low[k] + cells[i].high[k]) / 2 - middle[k] / (double)left);
    tn_status status = add_cells(d, cells, "apart", error);
    free(cells);
    return status;
}

static tn_status add_sheet(drawing *d, tn_error *error)
{
    static const struct {
        double azimuth, elevation;
        const char *label;
    } sides[] = {{-90, 0, "front"}, {0, 0, "right side"}, {-90, 90, "plan"}};
    tn_status status = TN_OK;
    tn_camera camera = d->how->camera;
    for (size_t i = 0; i < sizeof sides / sizeof *sides && status == TN_OK; i++) {
        camera.azimuth = sides[i].azimuth;
        camera.elevation = sides[i].elevation;
        status = add_union(d, &camera, sides[i].label, error);
    }
    return status == TN_OK ? add_union(d, &d->how->camera, "view", error) : status;
}

static void squash(tn_design *design, const tn_squash *s)
{
    tn_solid_box *box = &design->boxes[s->box];
    box->void_ |= s->whole;
    *(s->high ? &box->high[s->axis] : &box->low[s->axis]) = s->after;
}

/* As written, then what each step leaves. */
static tn_status add_history(drawing *d, tn_error *error)
{
    const tn_history *history = &d->built->history;
    tn_design design;
    tn_status status = tn_design_copy(&d->built->written, &design, error);
    if (status == TN_OK)
        status = add_design(d, &design, "as written", error);
    for (size_t i = 0; i < history->count && status == TN_OK; i++) {
        squash(&design, &history->items[i]);
        if (i + 1 < VIEWS_MAX)
            status = add_design(d, &design, tn_squash_told(d->module, d->solid, &history->items[i]).text, error);
    }
    if (status == TN_OK && history->count >= VIEWS_MAX) {
        char label[64];
        snprintf(label, sizeof label, "after all %zu steps", history->count);
        status = add_design(d, &design, label, error);
    }
    tn_design_clear(&design);
    return status;
}

static tn_status add_views(drawing *d, tn_error *error)
{
    tn_status status;
    switch (d->how->views) {
    case TN_SOLID_EXPLODED:
        return add_exploded(d, error);
    case TN_SOLID_BEFORE:
        status = add_design(d, &d->built->written, "as written", error);
        return status == TN_OK ? add_union(d, &d->how->camera, "as built", error) : status;
    case TN_SOLID_SHEET:
        return add_sheet(d, error);
    case TN_SOLID_HISTORY:
        return add_history(d, error);
    case TN_SOLID_VIEW:
    default:
        return add_union(d, &d->how->camera, "", error);
    }
}

/* ---- the sheet */

typedef struct box_names {
    tn_box_words *words; /* [box] */
} box_names;

static const char *name_of_box(const void *names, uint32_t box)
{
    return ((const box_names *)names)->words[box].text;
}

static void describe(const drawing *d, char title[200], char caption[240])
{
    const tn_module *module = d->module;
    const tn_solid_record *record = &module->SOLID_records[d->solid];
    const tn_producer_record *producer = module->PRODUCER_count ? &module->PRODUCER_records[0] : NULL;
    const char *name = tn_text(module, record->name), *text = record->doc ? tn_text(module, record->doc) : "";
    snprintf(title, 200, "%.60s%s%.120s", name, *text ? ": " : "", text);
    snprintf(caption, 240, "%.60s, rules %016" PRIx64 ", %.40s", name, producer ? (uint64_t)producer->sources_hash : 0,
             producer ? tn_text(module, producer->version) : "tartan");
}

static tn_status draw_sheet(const drawing *d, tn_picture *to, tn_error *error)
{
    char title[200], caption[240];
    const char *labels[VIEWS_MAX + 1];
    uint32_t n = d->built->built.box_count, listed = 0;
    box_names names = {calloc(n + 1u, sizeof *names.words)};
    if (!names.words)
        return tn_fail_memory(error);
    describe(d, title, caption);
    for (uint32_t i = 0; i < d->count; i++)
        labels[i] = d->labels[i];
    for (uint32_t i = 0; i < n; i++) {
        names.words[i] = tn_box_named(d->module, d->solid, i, 0);
        if (tn_text(d->module, d->module->BOX_records[d->module->SOLID_records[d->solid].box_first + i].name)[0])
            listed = i + 1; /* boxes without names are told apart by their colours alone */
    }
    const tn_view_options options = {.title = d->how->title ? d->how->title : title,
                                     .caption = caption,
                                     .columns = d->how->columns,
                                     .labels = d->count > 1 ? labels : NULL,
                                     .dpi = d->how->dpi,
                                     .legend = {name_of_box, &names, listed, true}};
    tn_status status = tn_views_draw(d->views, d->count, &options, to, error);
    free(names.words);
    return status;
}

tn_status tn_solid_draw(tn_opened *opened, uint32_t solid, const tn_solid_drawing *how, tn_picture *to)
{
    tn_built built;
    tn_error error;
    drawing *d = calloc(1, sizeof *d);
    tn_status status = d ? tn_built_make(opened->module, solid, how->most, &built, &error) : tn_fail_memory(&error);
    if (d) {
        *d = (drawing){.module = opened->module, .solid = solid, .how = how, .built = &built};
        if (status == TN_OK)
            status = add_views(d, &error);
        if (status == TN_OK)
            status = draw_sheet(d, to, &error);
        for (uint32_t i = 0; i < d->count; i++)
            tn_view_free(d->views[i]);
        tn_built_clear(&built);
    }
    free(d);
    return status == TN_OK ? TN_OK : tn_solid_fail(opened, solid, &error);
}
