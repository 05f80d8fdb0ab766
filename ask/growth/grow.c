/* grow: a surface that grows from a rewrite system, step by step. */
#include "ask/growth/grow.h"

#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/growth/faults.h"

#define FORECAST_FACES 10000000.0 /* growths that will pass this many faces are announced */
#define IDLE_STEPS 100u           /* on end without a new face: then no number of faces is waited for any more */

/* A growth under way. */
typedef struct run_state {
    tn_growing g;
    tn_reply answer; /* a `grown` */
    tn_view **views; /* of a sheet */
    size_t view_count, view_room;
    tn_display_list overlaid; /* of the steps that are drawn over one another */
    size_t overlaid_count;
    tn_faults faults;                 /* of the last step that had any, each kind by itself */
    uint32_t crossed[2], inverted[2]; /* the first and the last step with such faces; 0: none */
    double faces_before;
    bool forecast; /* was made */
    uint32_t idle; /* steps on end that made no face */
} run_state;

static void free_shown(void *value)
{
    tn_grown_shown *shown = value;
    for (size_t i = 0; i < shown->count; i++)
        tn_stats_clear(&shown->stats[i]);
    free(shown->stats);
    tn_growth_system_free(shown->system);
    tn_study_clear(&shown->study);
    free(shown);
}

/* All but the answer. */
static void clear(run_state *run)
{
    tn_display_list_clear(&run->overlaid);
    for (size_t i = 0; i < run->view_count; i++)
        tn_view_free(run->views[i]);
    free(run->views);
    tn_growth_free(run->g.growth);
}

/* ---- faults */

static void note_fault(const tn_fault *found, uint32_t step, tn_fault *kept, uint32_t steps[2])
{
    if (found->count == 0)
        return;
    *kept = *found;
    steps[0] = steps[0] ? steps[0] : step;
    steps[1] = step;
}

static tn_status note_faults(run_state *run, tn_error *error)
{
    tn_faults found;
    uint32_t step = tn_growth_steps(run->g.growth);
    tn_status status = tn_faults_find(run->g.growth, &found, error);
    if (status != TN_OK)
        return status;
    note_fault(&found.crossed, step, &run->faults.crossed, run->crossed);
    note_fault(&found.inverted, step, &run->faults.inverted, run->inverted);
    return TN_OK;
}

static void warn_of_fault(const run_state *run, uint32_t code, const tn_fault *fault, const uint32_t steps[2],
                          const char *what, const char *help)
{
    char since[48] = "";
    if (fault->count == 0)
        return;
    if (steps[0] != steps[1])
        snprintf(since, sizeof since, ", since step %u", steps[0]);
    tn_diagnostics *list = &run->g.session->opened->compilation.diagnostics;
    tn_diagnostic *d =
        tn_report_bare(list, TN_WARNING, code, "after step %u, %u %s%s; the first is around (%.4g, %.4g, %.4g)",
                       steps[1], fault->count, what, since, fault->place[0], fault->place[1], fault->place[2]);
    tn_help(list, d, "%s", help);
}

static void warn_of_faults(const run_state *run)
{
    bool one = run->faults.crossed.count == 1;
    warn_of_fault(run, W_FACES_CROSSED, &run->faults.crossed, run->crossed,
                  one ? "face's outline crosses itself" : "faces' outlines cross themselves",
                  "turns of the rules, or forces, carry edges past others there; take a smaller angle or strength");
    one = run->faults.inverted.count == 1;
    warn_of_fault(
        run, W_FACES_INVERTED, &run->faults.inverted, run->inverted,
        one ? "face is turned over onto its neighbours" : "faces are turned over onto their neighbours",
        "forces that overshoot what they pull towards do that: take a smaller strength, or stop steps earlier");
}

/* ---- each step */

/* How often is the step one of those that are drawn over one another? */
static size_t overlays(const run_state *run, uint32_t step)
{
    const tn_counts *steps = &run->g.request->overlay;
    size_t count = 0;
    for (size_t i = 0; i < steps->count; i++)
        count += steps->items[i] == step;
    return count;
}

static tn_status note_view(run_state *run, tn_error *error)
{
    const tn_camera camera = tn_grown_camera(&run->g);
    if (!tn_array_reserve_from(&run->views, &run->view_room, 16, run->view_count, 1, sizeof *run->views))
        return tn_fail_memory(error);
    tn_status status =
        tn_growth_view(run->g.growth, &camera, tn_grown_surrounded(&run->g), &run->views[run->view_count], error);
    run->view_count += status == TN_OK;
    return status;
}

static tn_status write_step(const run_state *run, tn_error *error)
{
    char name[40];
    snprintf(name, sizeof name, "step-%03u.%s", tn_growth_steps(run->g.growth), tn_file_format_word(run->g.format));
    return tn_grown_write(&run->g, name, error);
}

/* What there is to do with each step. */
static tn_status note_step(run_state *run, tn_error *error)
{
    tn_growing *g = &run->g;
    uint32_t step = tn_growth_steps(g->growth);
    tn_status status = g->grown->has_stats ? tn_grown_measure(g, error) : TN_OK;
    size_t overlaid = overlays(run, step);
    if (status == TN_OK && overlaid > 0)
        status = tn_growth_display_add(g->growth, &run->overlaid, error);
    run->overlaid_count += overlaid;
    if (status == TN_OK && g->request->sheet)
        status = note_view(run, error);
    else if (status == TN_OK && g->request->each_step)
        status = write_step(run, error);
    return status == TN_OK && g->grown->has_joins && step > 0 ? tn_grown_explain(g, error) : status;
}

/* Tells whoever waits for the steps which one stands. */
static void tell(run_state *run)
{
    const tn_growing *g = &run->g;
    const tn_map *map = tn_growth_map(g->growth);
    g->grown->steps = tn_growth_steps(g->growth);
    g->grown->vertices = map->vertex_count;
    g->grown->edges = map->edge_count;
    g->grown->faces = map->face_count - 1;
    tn_watch_tell(g->session->opened->module->watch, (double)g->grown->steps,
                  g->request->has_until_faces ? 0 : (double)g->shown->study.steps);
    if (g->session->so_far)
        g->session->so_far(g->session->so_far_context, &run->answer);
}

/* Says what is coming if it is much: the last step's growth, continued. */
static void forecast(run_state *run)
{
    const tn_study *study = &run->g.shown->study;
    const tn_map *map = tn_growth_map(run->g.growth);
    double faces = map->face_count - 1, ratio = run->faces_before > 0 ? faces / run->faces_before : 1;
    uint32_t steps = tn_growth_steps(run->g.growth), left = study->steps > steps ? study->steps - steps : 0;
    run->faces_before = faces;
    if (run->forecast || steps < 3 || ratio <= 1 || run->g.request->has_until_faces)
        return;
    double coming = faces;
    for (uint32_t i = 0; i < left && coming < 1e15; i++)
        coming *= ratio;
    if (coming <= FORECAST_FACES)
        return;
    run->forecast = true;
    uint64_t limit = study->options.edge_limit ? study->options.edge_limit : TN_EDGES_MAX;
    if (2 * coming > (double)limit) /* a face has two edges of its own, where four meet */
        tn_session_note(run->g.session, "%u steps will make more edges than the limit of %llu", study->steps,
                        (unsigned long long)limit);
    else
        tn_session_note(run->g.session, "%u steps will make about %.0f million faces and need about %.1f GB of memory",
                        study->steps, coming / 1e6, coming * 170e-9);
    tn_session_shows(run->g.session);
}

/* With a number of faces, steps are counted only if the request says how many. */
static bool is_enough(const run_state *run)
{
    const tn_grow_request *r = run->g.request;
    uint32_t faces = tn_growth_map(run->g.growth)->face_count - 1, steps = tn_growth_steps(run->g.growth);
    bool all_steps = steps >= run->g.shown->study.steps;
    if (!r->has_until_faces)
        return all_steps;
    if (faces >= r->until_faces)
        return true;
    if (all_steps && r->said.has_steps)
        tn_session_note(run->g.session, "after %u steps there are %u faces, fewer than %llu", steps, faces,
                        (unsigned long long)r->until_faces);
    else if (run->idle >= IDLE_STEPS)
        tn_session_note(run->g.session, "%u steps have made no face: there are %u, fewer than %llu", run->idle, faces,
                        (unsigned long long)r->until_faces);
    return (all_steps && r->said.has_steps) || run->idle >= IDLE_STEPS;
}

/* Back at the last complete step. */
static tn_status end_at_limit(run_state *run, uint32_t complete, bool *limited, tn_error *error)
{
    tn_session_fail(run->g.session, error);
    tn_session_note(run->g.session, "the surface is that of step %u, the last complete one", complete);
    *limited = true;
    return tn_growth_regrow(run->g.growth, complete, error);
}

/* Grows step by step. A limit (*limited) or rest ends it at the last complete step. */
static tn_status grow(run_state *run, bool *limited, tn_error *error)
{
    tn_growth *growth = run->g.growth;
    tell(run);
    tn_status status = note_step(run, error);
    while (status == TN_OK && !is_enough(run)) {
        uint32_t complete = tn_growth_steps(growth), faces = tn_growth_map(growth)->face_count;
        status = tn_watch_check(run->g.session->opened->module->watch, error);
        if (status == TN_OK)
            status = tn_growth_step(growth, error);
        if (status == TN_LIMIT)
            return end_at_limit(run, complete, limited, error);
        if (status != TN_OK)
            return status;
        tell(run);
        run->idle = tn_growth_map(growth)->face_count == faces ? run->idle + 1 : 0;
        forecast(run);
        if (tn_growth_at_rest(growth)) {
            tn_session_note(run->g.session, "step %u changes nothing any more: further steps are left out",
                            tn_growth_steps(growth));
            return TN_OK;
        }
        status = note_faults(run, error);
        if (status == TN_OK)
            status = note_step(run, error);
        if (status == TN_OK)
            tell(run);
    }
    return status;
}

/* ---- the whole */

/* TN_INVALID, which is said, if none of the steps is there. */
static tn_status draw_overlay(run_state *run, bool *said, tn_error *error)
{
    uint32_t last = tn_growth_steps(run->g.growth);
    if (run->overlaid_count < run->g.request->overlay.count)
        tn_session_note(run->g.session, "the surface has %u steps: later ones of --overlay are not drawn", last);
    if (run->overlaid_count)
        return tn_grown_overlay(&run->g, &run->overlaid, error);
    *said = true;
    return tn_session_refuse(run->g.session, NULL, "none of the steps of --overlay is there: the last is %u", last);
}

static tn_status finish(run_state *run)
{
    const tn_growing *g = &run->g;
    const tn_grow_request *r = g->request;
    bool said = false;
    tn_error error;
    tn_status status = TN_OK;
    warn_of_faults(run);
    if (r->sheet)
        status = tn_grown_sheet(g, run->views, run->view_count, &error);
    else if (r->has_turn)
        status = tn_grown_turn(g, &error);
    else if (r->overlay.count > 0)
        status = draw_overlay(run, &said, &error);
    else if (g->format != TN_FILE_OTHER && !r->each_step)
        status = tn_grown_write(g, NULL, &error);
    return status == TN_OK || said ? status : tn_session_fail(g->session, &error);
}

static tn_status prepare(run_state *run, tn_error *error)
{
    tn_growing *g = &run->g;
    const tn_opened *opened = g->session->opened;
    tn_study *study = &g->shown->study;
    if (opened->module->GROWTH_count == 0) {
        tn_fail(error, TN_INVALID, E_NOT_IN_FILE, "%.200s has no rewrite system", opened->path);
        tn_error_help(
            error, "%s",
            tn_opened_help(opened, "a surface grows from a .hemls file, or from a .study file that names one").text);
        return TN_INVALID;
    }
    tn_status status = tn_growth_system_read(opened->module, &g->shown->system, error);
    if (status == TN_OK)
        status = tn_study_read(opened->module, opened->path, tn_opened_meshes(opened), study, error);
    if (status != TN_OK)
        return status;
    study->options.explain = g->request->explain;
    study->options.interpret = g->request->engine == 1;
    study->options.watch = opened->module->watch;
    study->options.threads = (int)g->request->threads;
    return tn_growth_new(g->shown->system, &study->environment, &study->options, &g->growth, error);
}

static void warn_of_open_boundaries(const tn_growing *g)
{
    tn_opened *opened = g->session->opened;
    const tn_module *module = opened->module;
    tn_diagnostics *list = &opened->compilation.diagnostics;
    for (uint32_t i = 0; (i = tn_study_open_boundary(&g->shown->study, i)) < module->BOUNDARY_count; i++) {
        const tn_boundary_record *r = &module->BOUNDARY_records[i];
        tn_diagnostic *d = tn_report(list, W_OPEN_BOUNDARY, (tn_span){r->file, r->begin, r->end},
                                     "this mesh is open, or has edges of more than two faces: nothing is inside it");
        tn_help(list, d, "close it, or leave `inside` out: it stops what crosses it from either side");
    }
}

static tn_status begin_answer(run_state *run, tn_error *error)
{
    tn_growing *g = &run->g;
    tn_status status = tn_reply_new(&tn_message_grown, &run->answer, error);
    if (status != TN_OK)
        return status;
    g->grown = TN_REPLY(grown, &run->answer);
    g->shown = calloc(1, sizeof *g->shown);
    if (!g->shown)
        return tn_fail_memory(error);
    g->grown->stats.shown = (tn_boxed){g->shown, free_shown};
    g->grown->has_stats = g->request->stats || g->format == TN_FILE_OTHER;
    g->grown->has_joins = g->request->explain;
    return TN_OK;
}

/* The steps alone, if nothing else was asked for. */
static tn_status end_answer(run_state *run, tn_reply *answer)
{
    tn_growing *g = &run->g;
    tn_error error;
    if (g->format != TN_FILE_OTHER || g->request->explain) {
        *answer = run->answer;
        return TN_OK;
    }
    tn_status status = tn_reply_new(&tn_message_grown_steps, answer, &error);
    if (status == TN_OK) {
        *TN_REPLY(grown_steps, answer) = g->grown->stats;
        g->grown->stats = (tn_grown_steps){0};
    }
    tn_reply_clear(&run->answer);
    return status == TN_OK ? TN_OK : tn_session_fail(g->session, &error);
}

/* All steps; the surface of the last stands. */
static tn_status take_steps(run_state *run, bool *limited)
{
    tn_error error;
    tn_status status = begin_answer(run, &error);
    if (status == TN_OK)
        status = prepare(run, &error);
    if (status == TN_OK) {
        warn_of_open_boundaries(&run->g);
        status = grow(run, limited, &error);
    }
    if (status != TN_OK)
        return tn_session_fail(run->g.session, &error);
    run->g.shown->complete = true;
    tell(run);
    return TN_OK;
}

tn_status tn_ask_grow(tn_session *session, const tn_grow_request *request, tn_reply *answer)
{
    bool limited = false;
    *answer = (tn_reply){0};
    tn_status status = tn_grow_request_fits(session, request, NULL);
    if (status != TN_OK)
        return status;
    run_state run = {.g = {.session = session, .request = request, .format = tn_grow_formats[request->format]}};
    status = take_steps(&run, &limited);
    if (status == TN_OK) {
        status = finish(&run);
        clear(&run);
        tn_status ended = end_answer(&run, answer);
        status = status == TN_OK ? ended : status;
        return limited && status != TN_STOPPED ? TN_LIMIT : status;
    }
    clear(&run);
    tn_reply_clear(&run.answer);
    return status;
}
