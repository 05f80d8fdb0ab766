/* Designs of a file: which is asked for, what each measures and requires, what its boxes may not have been meant to do,
 * and its pictures. */
#include "driver/solid/solid.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/geometry/union/contacts.h"
#include "runtime/geometry/union/union.h"
#include "runtime/number/run.h"

/* ---- finds the design that is asked for, and names boxes */

tn_box_words tn_box_named(const tn_module *module, uint32_t solid, uint32_t box, uint32_t image)
{
    const tn_solid_record *record = &module->SOLID_records[solid];
    const char *name = tn_text(module, module->BOX_records[record->box_first + box].name);
    tn_box_words words;
    size_t used = name[0] ? (size_t)snprintf(words.text, sizeof words.text, "%.*s", (int)TN_NAME_MAX, name)
                          : (size_t)snprintf(words.text, sizeof words.text, "box %u", box + 1);
    if (image)
        words.text[used++] = '\'';
    for (unsigned axis = 0; axis < 3; axis++)
        if (image >> axis & 1)
            words.text[used++] = "xyz"[axis];
    words.text[used] = '\0';
    return words;
}

static tn_span place_of(const tn_solid_record *record)
{
    return (tn_span){record->file, record->begin, record->begin + (uint32_t)strlen("solid")};
}

tn_status tn_solid_fail(tn_opened *opened, uint32_t solid, const tn_error *error)
{
    tn_diagnostic *diagnostic = tn_report_error(&opened->compilation.diagnostics, error, NULL, NULL, 0);
    diagnostic->has_span = error->status != TN_IO; /* of a file that cannot be written the design is not to blame */
    diagnostic->span = place_of(&opened->module->SOLID_records[solid]);
    return error->status;
}

static void list_names(const tn_module *module, char *text, size_t size)
{
    size_t used = 0;
    for (size_t i = 0; i < module->SOLID_count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s`%.60s`", i ? ", " : "",
                                 tn_text(module, module->SOLID_records[i].name));
}

static tn_status unknown(tn_opened *opened, const char *what, const char *name)
{
    char names[300] = "";
    tn_diagnostics *list = &opened->compilation.diagnostics;
    list_names(opened->module, names, sizeof names);
    tn_diagnostic *d =
        name ? tn_report_bare(list, TN_ERROR, E_UNKNOWN_SOLID, "%s has no design `%.100s`", opened->path, name)
             : tn_report_bare(list, TN_ERROR, E_UNKNOWN_SOLID, "%s %s", opened->path, what);
    tn_help(list, d, "name one with --solid: %s", names);
    return TN_INVALID;
}

tn_status tn_solid_choose(tn_opened *opened, const char *name, uint32_t *solid)
{
    const tn_module *module = opened->module;
    uint32_t own = 0;
    for (uint32_t i = 0; i < module->SOLID_count; i++) {
        const tn_solid_record *record = &module->SOLID_records[i];
        bool imported = record->flags & TN_SOLID_IMPORTED;
        if (name ? strcmp(tn_text(module, record->name), name) != 0 : imported)
            continue;
        own++;
        *solid = i;
    }
    if (own == 1)
        return TN_OK;
    return unknown(opened, own ? "has several designs" : "has no design of its own", name);
}

tn_squash_words tn_squash_told(const tn_module *module, uint32_t solid, const tn_squash *s)
{
    tn_box_words box = tn_box_named(module, solid, s->box, 0), by = tn_box_named(module, solid, s->by, s->image);
    tn_squash_words told;
    if (s->whole)
        snprintf(told.text, sizeof told.text, "%s  by %s  nothing is left", box.text, by.text);
    else
        snprintf(told.text, sizeof told.text, "%s  by %s  %s %c  %.10g -> %.10g", box.text, by.text,
                 s->high ? "high" : "low", "xyz"[s->axis], s -> before, s -> after);
    return told;
}

/* ---- measures designs, and holds them to what they require */

#define BARELY 1e-9 /* how far a strict comparison of equal values is from holding: no distance to tell anybody */

typedef struct testing {
    tn_opened *opened;
    const tn_module *module;
    uint32_t solid, most;
    tn_solid_measured_take *measured;
    void *context;
    double values[TN_SOLID_MEASURED_COUNT];
    const tn_solid_measure_record **listed; /* what the design asks for, each once; owned */
    size_t listed_count;
} testing;

static double value_of(const testing *t, uint32_t function)
{
    return tn_number_run(t->module->code, t->module->FUNCTION_records[function].code_begin, t->values);
}

/* Everything that the design's measures and requirements speak of. */
static uint64_t asked_of(const tn_module *module, const tn_solid_record *record)
{
    uint64_t asked = 0;
    for (uint32_t i = 0; i < record->asked_count; i++)
        asked |= tn_number_asked(module, module->SOLID_MEASURE_records[record->asked_first + i].function);
    for (uint32_t i = 0; i < record->requirement_count; i++)
        asked |= tn_number_asked(module, module->REQUIREMENT_records[record->requirement_first + i].holds);
    return asked;
}

/* A design and the one that it begins with may both ask for a measure: names are keys. Equal texts are one string of
 * the module. */
static tn_status list_measures(testing *t, tn_error *error)
{
    const tn_solid_record *record = &t->module->SOLID_records[t->solid];
    bool *seen = calloc(t->module->strings_size + 1, sizeof *seen);
    t->listed = malloc((record->asked_count + 1) * sizeof(const tn_solid_measure_record *));
    for (uint32_t i = 0; seen && t->listed && i < record->asked_count; i++) {
        const tn_solid_measure_record *asked = &t->module->SOLID_MEASURE_records[record->asked_first + i];
        if (!seen[asked->name])
            t->listed[t->listed_count++] = asked;
        seen[asked->name] = true;
    }
    bool fine = seen && t->listed;
    free(seen);
    return fine ? TN_OK : tn_fail_memory(error);
}

static tn_status tell_measures(const testing *t, tn_error *error)
{
    const char **names = malloc((t->listed_count + 1) * sizeof *names);
    double *values = malloc((t->listed_count + 1) * sizeof *values);
    tn_status status = names && values ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < t->listed_count; i++) {
        names[i] = tn_text(t->module, t->listed[i]->name);
        values[i] = value_of(t, t->listed[i]->function);
    }
    if (status == TN_OK)
        status = t->measured(t->context, tn_text(t->module, t->module->SOLID_records[t->solid].name), t->listed_count,
                             names, values, error);
    free(names);
    free(values);
    return status;
}

/* What was found of each measure that the requirement names: "parts is 3, height is 7.5". */
static void write_found(const testing *t, uint32_t function, char *text, size_t size)
{
    uint64_t asked = tn_number_asked(t->module, function);
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < TN_SOLID_MEASURED_COUNT && used < size; i++)
        if (asked >> i & 1)
            used += (size_t)snprintf(text + used, size - used, "%s%s is %.10g", used ? ", " : "",
                                     tn_solid_measured_names[i], tn_without_sign(t->values[i]));
}

static bool holds(const testing *t, uint32_t index)
{
    const tn_requirement_record *r = &t->module->REQUIREMENT_records[index];
    double value = value_of(t, r->holds), lacks = value_of(t, r->violation);
    char found[360];
    if (value - value == 0 && value != 0)
        return true;
    write_found(t, r->holds, found, sizeof found);
    tn_diagnostics *list = &t->opened->compilation.diagnostics;
    tn_diagnostic *d =
        tn_report(list, E_REQUIREMENT_FAILED, (tn_span){r->file, r->begin, r->end}, "`%.100s` does not meet this%s%s",
                  tn_text(t->module, t->module->SOLID_records[t->solid].name), *found ? ": " : "", found);
    if (lacks - lacks == 0 && lacks > BARELY)
        tn_note(list, d, NULL, "it is %.10g away from holding", lacks);
    return false;
}

static tn_status test_design(testing *t, tn_solid_tally *tally)
{
    const tn_solid_record *record = &t->module->SOLID_records[t->solid];
    tn_built built;
    tn_error error;
    tn_status status = tn_built_make(t->module, t->solid, t->most, &built, &error);
    if (status == TN_OK)
        status = tn_built_measure(&built, asked_of(t->module, record), t->values, &error);
    tn_built_clear(&built);
    if (status == TN_OK)
        status = list_measures(t, &error);
    if (status == TN_OK)
        status = tell_measures(t, &error);
    if (status != TN_OK)
        return tn_solid_fail(t->opened, t->solid, &error);
    for (uint32_t i = 0; i < record->requirement_count; i++) {
        bool held = holds(t, record->requirement_first + i);
        tally->passed += held;
        tally->failed += !held;
        status = held ? status : TN_INVALID;
    }
    return status;
}

tn_status tn_solid_tests_run(tn_opened *opened, uint32_t most, tn_solid_measured_take *measured, void *context,
                             tn_solid_tally *tally)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < opened->module->SOLID_count; i++) {
        if (opened->module->SOLID_records[i].flags & TN_SOLID_IMPORTED)
            continue;
        testing t = {.opened = opened,
                     .module = opened->module,
                     .solid = i,
                     .most = most,
                     .measured = measured,
                     .context = context};
        tn_status one = test_design(&t, tally);
        free(t.listed);
        status = status == TN_OK ? one : status;
    }
    return status;
}

/* ---- what a person who placed boxes may not have meant */

typedef struct reporting {
    tn_opened *opened;
    const tn_module *module;
    uint32_t solid;
    const tn_built *built;
} reporting;

static const tn_box_record *box_record(const reporting *r, uint32_t box)
{
    return &r->module->BOX_records[r->module->SOLID_records[r->solid].box_first + box];
}

/* Only boxes with names were placed by a person. */
static bool is_named(const reporting *r, uint32_t box)
{
    return tn_text(r->module, box_record(r, box)->name)[0] != '\0';
}

static tn_span place_of_box(const reporting *r, uint32_t box)
{
    const tn_box_record *record = box_record(r, box);
    return (tn_span){record->file, record->begin, record->end};
}

static void warn_squashed(const reporting *r, const tn_squash *s)
{
    static const char *const sides[3][2] = {{"low x", "high x"}, {"low y", "high y"}, {"low z", "high z"}};
    const tn_solid_box *written = &r->built->written.boxes[s->box];
    if (!is_named(r, s->box))
        return;
    if (s->box == s->by && written->low[s->axis] == -written->high[s->axis])
        return; /* it is its own image: half of it is made anew by the other */
    tn_box_words by = tn_box_named(r->module, r->solid, s->by, s->image);
    tn_diagnostics *list = &r->opened->compilation.diagnostics;
    tn_box_words own = tn_box_named(r->module, r->solid, s->box, 0);
    tn_span other = place_of_box(r, s->by);
    tn_diagnostic *d = s->whole ? tn_report(list, W_VOID_BOX, place_of_box(r, s->box),
                                            "nothing is left of `%.100s`: `%.100s` takes its place", own.text, by.text)
                                : tn_report(list, W_SQUASHED, place_of_box(r, s->box),
                                            "`%.100s` is squashed by `%.100s`", own.text, by.text);
    if (!s->whole)
        tn_note(list, d, &other, "its %s face goes from %.6g to %.6g, %.6g inward", sides[s->axis][s->high], s->before,
                s->after, fabs(s->after - s->before));
    if (s->box == s->by)
        tn_help(list, d, "it crosses the plane of symmetry: end it there, at %c = 0", "xyz"[s->axis]);
    else if (s->whole && r->built->written.boxes[s->by].rigid)
        tn_help(list, d, "it lies inside `%.100s`, which is rigid: let it stick out, or leave it out", by.text);
    else if (r->built->written.boxes[s->by].rigid)
        tn_help(list, d, "`%.100s` is rigid, so that this box gives way: end it at %c = %.15g", by.text, "xyz"[s->axis],
                s -> after);
    else
        tn_help(list, d,
                "boxes that overlap are squashed: end one where the other begins, or make one of them `rigid`");
}

static void warn_ghosts(const reporting *r)
{
    for (uint32_t box = 0; box < r->built->built.box_count; box++) {
        if (!is_named(r, box) || r->built->built.boxes[box].void_ || r->built->cells[box].face_count > 0)
            continue;
        tn_diagnostic *d = tn_report(&r->opened->compilation.diagnostics, W_GHOST, place_of_box(r, box),
                                     "all of `%.100s` is clipped away, though it still squashes others",
                                     tn_box_named(r->module, r->solid, box, 0).text);
        tn_help(&r->opened->compilation.diagnostics, d,
                "turn the normal round, or move the point that the plane goes through");
    }
}

static tn_status warn_inward(const reporting *r, tn_error *error)
{
    uint32_t *others, n = r->built->built.box_count;
    tn_status status = tn_built_inward(r->built, &others, error);
    if (status != TN_OK)
        return status;
    for (uint32_t box = 0; box < n; box++) {
        if (others[box] == UINT32_MAX || !is_named(r, box))
            continue;
        tn_box_words other =
            tn_box_named(r->module, r->solid, others[box] % n, tn_design_image(&r->built->built, others[box] / n));
        tn_diagnostic *d = tn_report(&r->opened->compilation.diagnostics, W_INWARD_PLANE, place_of_box(r, box),
                                     "the clipped face of `%.100s` lies against `%.100s`",
                                     tn_box_named(r->module, r->solid, box, 0).text, other.text);
        tn_help(&r->opened->compilation.diagnostics, d, "what is clipped there leaves a hollow: clip the other side");
    }
    free(others);
    return TN_OK;
}

static tn_status warn_detached(const reporting *r, tn_error *error)
{
    uint32_t n = r->built->built.box_count, left = 0;
    bool *touches = calloc(n + 1u, sizeof *touches);
    tn_contacts contacts = {0};
    tn_status status = touches
                           ? tn_contacts_find(r->built->cells, r->built->cell_count, TN_CONTACT_LEAST, &contacts, error)
                           : tn_fail_memory(error);
    for (size_t i = 0; i < contacts.count && status == TN_OK; i++)
        touches[contacts.items[i].a % n] = touches[contacts.items[i].b % n] = true;
    for (size_t i = 0; i < r->built->cell_count; i++)
        left += r->built->cells[i].face_count > 0;
    for (uint32_t box = 0; box < n && status == TN_OK && left > 1; box++) {
        if (touches[box] || r->built->cells[box].face_count == 0 || !is_named(r, box))
            continue;
        tn_diagnostic *d = tn_report(&r->opened->compilation.diagnostics, W_DETACHED, place_of_box(r, box),
                                     "`%.100s` touches no other box", tn_box_named(r->module, r->solid, box, 0).text);
        tn_help(&r->opened->compilation.diagnostics, d, "boxes that share a face's area are one part: let them meet");
    }
    tn_contacts_clear(&contacts);
    free(touches);
    return status;
}

static tn_status report_design(tn_opened *opened, uint32_t solid, uint32_t most)
{
    tn_built built;
    tn_error error;
    reporting r = {opened, opened->module, solid, &built};
    tn_status status = tn_built_make(opened->module, solid, most, &built, &error);
    bool empty = status == TN_INVALID;
    for (size_t i = 0; i < built.history.count && (status == TN_OK || empty); i++)
        warn_squashed(&r, &built.history.items[i]);
    if (status == TN_OK) {
        warn_ghosts(&r);
        status = warn_inward(&r, &error);
    }
    if (status == TN_OK)
        status = warn_detached(&r, &error);
    if (status != TN_OK)
        tn_solid_fail(opened, solid, &error);
    tn_built_clear(&built);
    return status;
}

tn_status tn_solid_report(tn_opened *opened, uint32_t most)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < opened->module->SOLID_count; i++) {
        if (opened->module->SOLID_records[i].flags & TN_SOLID_IMPORTED)
            continue;
        tn_status one = report_design(opened, i, most);
        status = status == TN_OK ? one : status;
    }
    return status;
}

/* ---- draws designs of boxes */

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
