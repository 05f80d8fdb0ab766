/* slice: the outlines of a surface or of a design of boxes, layer by layer. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "ask/form/form.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "driver/field/field.h"
#include "driver/solid/solid.h"
#include "runtime/field/slices.h"
#include "runtime/geometry/union/union.h"
#include "runtime/slices/slices.h"

typedef struct slicing {
    tn_session *session;
    const tn_slice_request *request;
    tn_made_slices *made;
    tn_slices_style style;
} slicing;

/* ---- written */

static tn_status write_file(const slicing *s, const tn_slices *slices, const char *name, tn_error *error)
{
    static const struct {
        tn_file_format format;
        tn_status (*write)(const tn_slices *, const tn_slices_style *, FILE *, tn_error *);
    } writers[] = {
        {TN_FILE_SVG, tn_slices_write_svg}, {TN_FILE_DXF, tn_slices_write_dxf}, {TN_FILE_CLI, tn_slices_write_cli}};
    tn_making making;
    tn_made_file *file = TN_ADD(made_file, s->made->files, error);
    if (!file)
        return TN_MEMORY;
    unsigned writer = s->request->format;
    tn_status status = tn_making_begin(&making, s->session, writers[writer].format, name, file, error);
    if (status == TN_OK)
        status = tn_making_end(&making, writers[writer].write(slices, &s->style, making.stream, error), error);
    return status;
}

/* A file for each layer: layer-0001.svg and so on. */
static tn_status write_layers(slicing *s, const tn_slices *slices, tn_error *error)
{
    static const char *const endings[] = {"svg", "dxf", "cli"};
    char name[40];
    tn_status status = TN_OK;
    for (size_t layer = 0; status == TN_OK && layer < slices->layer_count; layer++) {
        s->style.first = layer;
        s->style.last = layer + 1;
        snprintf(name, sizeof name, "layer-%04zu.%s", layer + 1, endings[s->request->format]);
        status = write_file(s, slices, name, error);
    }
    return status;
}

static tn_status write(slicing *s, const tn_slices *slices, uint32_t name, tn_error *error)
{
    char note[TN_FORM_NOTE_SIZE];
    tn_form_note(s->session->opened, name, note);
    s->style.note = note;
    s->style.name = tn_text(s->session->opened->module, name);
    s->style.last = slices->layer_count;
    s->made->layers = slices->layer_count;
    return s->request->each ? write_layers(s, slices, error) : write_file(s, slices, NULL, error);
}

/* ---- fields */

static tn_status slice_surface(slicing *s, const tn_open_field *open, tn_error *error)
{
    const tn_field_asked *asked = &s->request->field;
    const tn_contour_options options = tn_contour_asked(asked);
    tn_field_grid grid = tn_field_grid_of(&open->field, (uint32_t)asked->grid);
    tn_field_slices slices;
    tn_status status = tn_field_slices_new(&open->field, &grid, s->request->layer, &options, &slices, error);
    if (status == TN_OK) {
        tn_field_warn_of_contour(s->session->opened, &slices.contour, "there the outline runs between samples");
        s->style.unit = open->field.record->unit;
        memcpy(s->style.low, grid.low, sizeof s->style.low);
        memcpy(s->style.high, grid.high, sizeof s->style.high);
        status = write(s, &slices.slices, open->field.record->name, error);
    }
    tn_field_slices_clear(&slices);
    return status;
}

static tn_status slice_field(slicing *s)
{
    tn_open_field open = {0};
    tn_error error;
    tn_status status = tn_open_field_of(s->session->opened, s->request->field.surface, &open, &error);
    if (status == TN_OK)
        status = slice_surface(s, &open, &error);
    tn_open_field_close(&open);
    return status == TN_OK ? TN_OK : tn_session_fail(s->session, &error);
}

/* ---- designs of boxes */

static void find_bounds(const tn_mesh *mesh, tn_slices_style *style)
{
    for (size_t k = 0; k < 3; k++) {
        style->low[k] = INFINITY;
        style->high[k] = -INFINITY;
        for (size_t v = 0; v < mesh->vertex_count; v++) {
            style->low[k] = fmin(style->low[k], mesh->positions[3 * v + k]);
            style->high[k] = fmax(style->high[k], mesh->positions[3 * v + k]);
        }
    }
}

static tn_status slice_union(slicing *s, tn_union *u, const tn_solid_record *record, tn_error *error)
{
    tn_slices slices = {0};
    tn_solid_turn_up(&u->mesh);
    tn_status status = tn_slices_of_mesh(&u->mesh, s->request->layer, &slices, error);
    s->style.unit = record->model; /* none, mm, cm, m: as units are */
    find_bounds(&u->mesh, &s->style);
    if (status == TN_OK)
        status = write(s, &slices, record->name, error);
    tn_slices_clear(&slices);
    return status;
}

static tn_status slice_solid(slicing *s)
{
    tn_opened *opened = s->session->opened;
    tn_built built = {0};
    tn_union u = {0};
    tn_error error;
    uint32_t solid;
    tn_status status = tn_solid_choose(opened, s->request->solid.solid, &solid);
    if (status != TN_OK)
        return status;
    status = tn_built_make(opened->module, solid, (uint32_t)s->request->solid.max_boxes, &built, &error);
    if (status == TN_OK)
        status = tn_union_make(built.cells, built.cell_count, &u, &error);
    if (status == TN_OK)
        status = slice_union(s, &u, &opened->module->SOLID_records[solid], &error);
    if (status != TN_OK)
        status = tn_solid_fail(opened, solid, &error);
    tn_union_clear(&u);
    tn_built_clear(&built);
    return status;
}

tn_status tn_ask_slice(tn_session *session, const tn_slice_request *request, tn_reply *answer)
{
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = tn_form_options_fit(session, &request->field, &request->solid);
    if (status != TN_OK)
        return status;
    if (tn_reply_new(&tn_message_made_slices, answer, &error) != TN_OK)
        return tn_session_fail(session, &error);
    slicing s = {.session = session, .request = request, .made = answer->value};
    return session->opened->module->SOLID_count ? slice_solid(&s) : slice_field(&s);
}
