/* inspect: what there is to find about a model of parts, whoever made it. */
#include <stdlib.h>
#include <string.h>

#include "ask/place/export.h"
#include "ask/place/place.h"
#include "ask/session/questions.h"
#include "driver/place/asked.h"

typedef struct inspection {
    tn_session *session;
    const tn_inspect_request *request;
    const tn_module *module;
    tn_ldraw ldraw;
    tn_placed_measures measures;
    const tn_kit_model_record *space; /* of the model that it is held to, or NULL */
    uint32_t chosen;                  /* that model */
    tn_opened asked;                  /* the conditions that it is held to */
    tn_inspected *found;              /* the answer */
} inspection;

/* ---- what is said */

static void note_left_out(tn_session *session, size_t count, const char *first, const char *why)
{
    if (count > 0)
        tn_session_note(session, "%zu part%s left out, the first a %.60s: %s", count, count == 1 ? " is" : "s are",
                        first, why);
}

static void note_changes(tn_session *session, const tn_ldraw *ldraw)
{
    note_left_out(session, ldraw->tilted, ldraw->first_tilted, "it is turned in a way in which the kit turns no part");
    note_left_out(session, ldraw->beside, ldraw->first_beside, "it lies beside the kit's cells");
    if (ldraw->snapped)
        tn_session_note(session,
                        "%zu part%s lay a little beside the cells, or were turned a little: this was set right",
                        ldraw->snapped, ldraw->snapped == 1 ? "" : "s");
}

/* A part that the kit lacks. */
typedef struct unknown_part {
    const char *name;
    size_t index;
} unknown_part;

static int by_name(const void *a, const void *b)
{
    const unknown_part *one = a, *other = b;
    int order = strcmp(one->name, other->name);
    return order != 0 ? order : (one->index > other->index) - (one->index < other->index);
}

static int by_index(const void *a, const void *b)
{
    const unknown_part *one = a, *other = b;
    return (one->index > other->index) - (one->index < other->index);
}

/* Each name once, in the order in which they come; not more than anybody reads. */
static tn_status note_unknown(const inspection *n, tn_error *error)
{
    enum { NOTED_MAX = 20 };
    size_t count = 0, kept = 0;
    unknown_part *all = malloc((n->measures.joints.unknown + 1) * sizeof *all);
    if (!all)
        return tn_fail_memory(error);
    for (size_t i = 0; i < n->ldraw.model.count; i++)
        if (!n->measures.joints.kinds[i])
            all[count++] = (unknown_part){n->ldraw.model.parts[i].name, i};
    qsort(all, count, sizeof *all, by_name);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || strcmp(all[i].name, all[kept - 1].name) != 0)
            all[kept++] = all[i];
    qsort(all, kept, sizeof *all, by_index);
    for (size_t i = 0; i < kept && i < NOTED_MAX; i++)
        tn_session_note(n->session, "the kit has no part %.60s: it joins nothing and fills nothing here", all[i].name);
    if (kept > NOTED_MAX)
        tn_session_note(n->session, "and %zu more parts that the kit does not have", kept - NOTED_MAX);
    free(all);
    return TN_OK;
}

/* ---- answered */

/* The first members of the message are the terms of conditions, in their order. */
static void set_terms(const double *terms, tn_measured_parts *measured)
{
    for (size_t i = 0; i < TN_PLACED_X; i++)
        *(double *)((char *)measured + tn_message_measured_parts.members[i].offset) = terms[i];
}

static tn_status set_findings(const inspection *n, tn_measured_parts *measured, tn_error *error)
{
    for (size_t i = 0; i < n->ldraw.model.count; i++) {
        bool unknown = !n->measures.joints.kinds[i];
        if (!n->measures.overlaps[i] && !n->measures.floating[i] && !n->measures.joints.cut[i] && !unknown)
            continue;
        tn_part_finding *finding = TN_ADD(part_finding, measured->findings, error);
        if (!finding)
            return TN_MEMORY;
        *finding = (tn_part_finding){.part = i,
                                     .overlaps = n->measures.overlaps[i],
                                     .floating = n->measures.floating[i],
                                     .cut = n->measures.joints.cut[i],
                                     .unknown = unknown};
    }
    return TN_OK;
}

static tn_status give(inspection *n, tn_reply *answer, tn_error *error)
{
    tn_status status = tn_reply_new(&tn_message_inspected, answer, error);
    if (status != TN_OK)
        return status;
    n->found = answer->value;
    tn_measured_parts *measured = &n->found->measured;
    set_terms(n->measures.terms, measured);
    measured->unknown = n->measures.joints.unknown;
    measured->snapped = n->ldraw.snapped;
    measured->tilted = n->ldraw.tilted;
    measured->beside = n->ldraw.beside;
    status = set_findings(n, measured, error);
    if (status == TN_OK)
        status = tn_parts_by_kind(n->module, &n->ldraw.model, (tn_list *)&n->found->parts, error);
    if (status != TN_OK)
        tn_reply_clear(answer);
    return status;
}

/* ---- pictures */

static tn_status draw_as(const inspection *n, const bool *marked, const char *word, tn_error *error)
{
    const tn_parts_picture picture = {
        .module = n->module, .model = &n->ldraw.model, .measures = &n->measures, .marked = marked};
    tn_file_format format;
    tn_making making;
    tn_made_file *file = TN_ADD(made_file, n->found->files, error);
    tn_status status = file ? tn_file_format_named(word, TN_WRITES_PICTURES, &format, error) : TN_MEMORY;
    if (status == TN_OK)
        status = tn_making_begin(&making, n->session, format, NULL, file, error);
    if (status == TN_OK)
        status = tn_making_end(&making, tn_parts_draw(&picture, format, making.stream, error), error);
    return status;
}

/* Parts that overlap, or float, are red. */
static tn_status draw(inspection *n)
{
    const tn_texts *formats = &n->request->formats;
    tn_error error;
    bool *marked = malloc(n->ldraw.model.count + 1);
    tn_status status = marked ? TN_OK : tn_fail_memory(&error);
    for (size_t i = 0; marked && i < n->ldraw.model.count; i++)
        marked[i] = n->measures.overlaps[i] || n->measures.floating[i];
    n->found->has_files = formats->count > 0;
    for (size_t i = 0; status == TN_OK && i < formats->count; i++)
        status = draw_as(n, marked, formats->items[i], &error);
    free(marked);
    return status == TN_OK ? TN_OK : tn_session_fail(n->session, &error);
}

/* ---- held to conditions */

/* Reads the conditions of the request before the model is read. */
static tn_status read_conditions(inspection *n)
{
    const tn_module *module = n->module;
    tn_error error;
    const char **parts = calloc((size_t)module->KIT_PART_count + 1, sizeof *parts);
    if (!parts) {
        tn_fail_memory(&error);
        return tn_session_fail(n->session, &error);
    }
    for (uint32_t i = 0; i < module->KIT_PART_count; i++)
        parts[i] = tn_text(module, module->KIT_PART_records[i].name);
    tn_status status = tn_kit_ask("--require", n->request->require, parts, module->KIT_PART_count, &n->asked);
    free(parts);
    if (status != TN_OK)
        tn_kit_ask_failed(n->session->opened, &n->asked);
    return status;
}

/* What is not met is said, and is no failure of the question. */
static tn_status hold(inspection *n)
{
    tn_opened *opened = n->session->opened;
    tn_kit_tally tally = {0};
    tn_status asked = TN_OK, model = TN_OK;
    if (n->request->require)
        asked = tn_kit_hold(opened, &n->asked, &n->ldraw.model, &n->measures);
    if (n->space)
        model = tn_kit_conditions(opened, n->chosen, &n->measures, false, false, &tally);
    n->found->has_meets = n->request->require || n->space;
    n->found->meets = asked == TN_OK && model == TN_OK;
    return asked == TN_INVALID ? TN_OK : asked;
}

/* ---- asked */

static tn_status check_request(inspection *n)
{
    const tn_inspect_request *r = n->request;
    tn_file_format format;
    tn_error error;
    if (n->module->KIT_count == 0)
        return tn_session_refuse(n->session, NULL, "%.200s is no kit", n->session->opened->path);
    if (!tn_drawn_given(&r->drawn))
        return tn_session_refuse(n->session, NULL, "say which model is inspected: its text, or the name of its file");
    for (size_t i = 0; i < r->formats.count; i++)
        if (tn_file_format_named(r->formats.items[i], TN_WRITES_PICTURES, &format, &error) != TN_OK)
            return tn_session_fail(n->session, &error);
    return TN_OK;
}

static tn_status choose_space(inspection *n)
{
    if (!n->request->model)
        return TN_OK;
    tn_status status = tn_kit_choose(n->session->opened, n->request->model, &n->chosen);
    n->space = status == TN_OK ? &n->module->KIT_MODEL_records[n->chosen] : NULL;
    return status;
}

static tn_status measure(inspection *n, tn_reply *answer)
{
    tn_watch *watch = n->session->opened->module->watch;
    tn_error error;
    tn_status status = tn_drawn_model(n->session, &n->request->drawn, &n->ldraw, &error);
    if (status == TN_OK)
        status = tn_placed_measure(n->module, n->space, &n->ldraw.model, watch, &n->measures, &error);
    if (status == TN_OK) {
        note_changes(n->session, &n->ldraw);
        status = note_unknown(n, &error);
    }
    if (status == TN_OK)
        status = give(n, answer, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(n->session, &error);
}

tn_status tn_ask_inspect(tn_session *session, const tn_inspect_request *request, tn_reply *answer)
{
    inspection n = {.session = session, .request = request, .module = session->opened->module};
    *answer = (tn_reply){0};
    tn_status status = check_request(&n);
    if (status == TN_OK)
        status = choose_space(&n);
    if (status == TN_OK && request->require)
        status = read_conditions(&n);
    if (status == TN_OK)
        status = measure(&n, answer);
    if (status == TN_OK) {
        tn_status drawn = draw(&n), held = hold(&n);
        status = drawn > held ? drawn : held;
    }
    tn_placed_measures_clear(&n.measures);
    tn_ldraw_clear(&n.ldraw);
    tn_close(&n.asked);
    return status;
}
