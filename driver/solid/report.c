/* What a person who placed boxes may not have meant: boxes squashed, clipped away, facing others or touching none. */
#include <math.h>
#include <stdlib.h>

#include "driver/solid/solid.h"
#include "runtime/geometry/union/contacts.h"

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

static tn_span place_of(const reporting *r, uint32_t box)
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
    tn_span other = place_of(r, s->by);
    tn_diagnostic *d = s->whole ? tn_report(list, W_VOID_BOX, place_of(r, s->box),
                                            "nothing is left of `%.100s`: `%.100s` takes its place", own.text, by.text)
                                : tn_report(list, W_SQUASHED, place_of(r, s->box), "`%.100s` is squashed by `%.100s`",
                                            own.text, by.text);
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
        tn_diagnostic *d = tn_report(&r->opened->compilation.diagnostics, W_GHOST, place_of(r, box),
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
        tn_diagnostic *d = tn_report(&r->opened->compilation.diagnostics, W_INWARD_PLANE, place_of(r, box),
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
        tn_diagnostic *d = tn_report(&r->opened->compilation.diagnostics, W_DETACHED, place_of(r, box),
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
