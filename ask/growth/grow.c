/* grow: a surface that grows from a rewrite system, step by step. */
#include "ask/growth/grow.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/growth/faults.h"
#include "runtime/growth/soundness.h"

/* ---- which requests make sense */

const tn_file_format tn_grow_formats[TN_GROW_FORMAT_COUNT] = {TN_FILE_OTHER, TN_FILE_OBJ, TN_FILE_PLY, TN_FILE_STL,
                                                              TN_FILE_OFF,   TN_FILE_OM,  TN_FILE_GLB, TN_FILE_DXF,
                                                              TN_FILE_SVG,   TN_FILE_PNG, TN_FILE_PDF};

enum { MESH = 1, SURFACE = 2, LINES = 4, NORMALS = 8, GROUPS = 16, AXIS = 32, PICTURE = 64 };

static const unsigned format_can[TN_FILE_FORMATS + 1] = {
    [TN_FILE_OBJ] = MESH | SURFACE | LINES | NORMALS | GROUPS | AXIS,
    [TN_FILE_PLY] = MESH | SURFACE | LINES | NORMALS | GROUPS | AXIS,
    [TN_FILE_STL] = MESH | SURFACE | AXIS,
    [TN_FILE_OFF] = MESH | SURFACE | AXIS,
    [TN_FILE_OM] = MESH | SURFACE | AXIS,
    [TN_FILE_GLB] = MESH | SURFACE | NORMALS | GROUPS,
    [TN_FILE_DXF] = MESH | LINES | GROUPS | AXIS,
    [TN_FILE_SVG] = PICTURE,
    [TN_FILE_PNG] = PICTURE,
    [TN_FILE_PDF] = PICTURE,
};

/* Used with another format they would do nothing. */
static tn_status check_uses(tn_session *session, const tn_grow_request *r)
{
    static const char surface[] = "write a surface: .obj, .ply, .stl, .off, .om or .glb",
                      picture[] = "write a picture: .svg, .png or .pdf";
    const tn_grow_picture *p = &r->picture;
    const struct {
        bool given;
        unsigned needs;
        const char *name, *help;
    } uses[] = {
        {r->rework.has_subdivide, SURFACE, "subdivide", surface},
        {r->rework.has_decimate, SURFACE, "decimate", surface},
        {r->rework.has_smooth, MESH, "smooth", "write a mesh: .obj, .ply, .stl, .off, .om, .glb or .dxf"},
        {r->triangulate, SURFACE, "triangulate", surface},
        {r->lines, LINES, "lines", "only .obj, .ply and .dxf hold lines"},
        {r->normals, NORMALS, "normals", "only .obj, .ply and .glb hold normals of vertices"},
        {r->groups, GROUPS, "groups", "only .obj, .ply, .glb and .dxf hold groups"},
        {r->up != 0, AXIS, "up", "a .glb has y up always; a picture is turned with --azimuth and --elevation"},
        {p->has_azimuth, PICTURE, "azimuth", picture},
        {p->has_elevation, PICTURE, "elevation", picture},
        {p->has_width, PICTURE, "width", picture},
        {p->has_columns, PICTURE, "columns", "write a --sheet: .svg, .png or .pdf"},
        {p->has_dpi, PICTURE, "dpi", "write a picture: .png"},
        {p->surroundings != 0, PICTURE, "surroundings", picture},
        {r->has_turn, PICTURE, "turn", "name a folder, as -o turn, or one moving picture, as -o turn.png"},
        {p->title != NULL, PICTURE, "title", picture},
        {r->sheet, PICTURE, "sheet", picture},
        {r->overlay.count > 0, PICTURE, "overlay", picture},
        {r->each_step, PICTURE | MESH, "each-step", "name one with -o"},
    };
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++) {
        if (!uses[i].given || (format_can[tn_grow_formats[r->format]] & uses[i].needs))
            continue;
        return r->format
                   ? tn_session_refuse(session, uses[i].help, "--%s does nothing for this kind of file", uses[i].name)
                   : tn_session_refuse(session, "name one with -o", "--%s does nothing without a file", uses[i].name);
    }
    return TN_OK;
}

static tn_status check_turn(tn_session *session, const tn_grow_request *r, const char *output)
{
    if (!r->has_turn && r->moving)
        return tn_session_refuse(session, "say of how many pictures: `turn`", "what moves is a turn");
    if (!r->has_turn)
        return TN_OK;
    if (tn_grow_formats[r->format] != TN_FILE_PNG)
        return tn_session_refuse(session, "name a folder, as -o turn, or one moving picture, as -o turn.png",
                                 "--turn writes PNG pictures, and %s is none",
                                 output ? output : tn_file_format_word(tn_grow_formats[r->format]));
    if (r->sheet || r->overlay.count > 0 || r->each_step)
        return tn_session_refuse(session, NULL,
                                 "--turn shows the last step: leave --sheet, --overlay and --each-step out");
    return TN_OK;
}

static tn_status check_overlay(tn_session *session, const tn_grow_request *r)
{
    bool fits = r->overlay.count <= TN_OVERLAY_MAX;
    for (size_t i = 0; fits && i < r->overlay.count; i++)
        fits = r->overlay.items[i] <= TN_STEPS_MAX;
    if (!fits)
        return tn_session_refuse(session, "for example --overlay 1,3,5", "--overlay takes up to %d steps",
                                 TN_OVERLAY_MAX);
    if (r->overlay.count > 0 && (r->sheet || r->each_step))
        return tn_session_refuse(session, NULL, "--overlay draws one picture: leave --sheet and --each-step out");
    return TN_OK;
}

tn_status tn_grow_request_fits(tn_session *session, const tn_grow_request *r, const char *output)
{
    tn_status status = check_uses(session, r);
    if (status == TN_OK && (r->rework.has_subdivide || r->rework.has_decimate) && (r->lines || r->groups))
        status = tn_session_refuse(session, "leave one or the other out",
                                   "--subdivide and --decimate make new faces, which have no edges of the rules: "
                                   "--lines and --groups have nothing to show");
    if (status == TN_OK)
        status = check_turn(session, r, output);
    if (status == TN_OK)
        status = check_overlay(session, r);
    if (status == TN_OK && r->sheet && r->each_step)
        status = tn_session_refuse(session, NULL, "a --sheet has every step already: leave --each-step out");
    return status;
}

/* ---- steps as rows of an answer */

static tn_status add_count(tn_list *to, uint64_t value, tn_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static tn_status add_count(tn_list *to, uint64_t value, tn_error *error, const char *format, ...)
{
    tn_named_count *added = tn_message_add(&tn_message_named_count, to, error);
    if (!added)
        return TN_MEMORY;
    va_list args;
    va_start(args, format);
    added->value = value;
    if (vasprintf(&added->name, format, args) < 0)
        added->name = NULL;
    va_end(args);
    return added->name ? TN_OK : tn_fail_memory(error);
}

static tn_status add_real(tn_list *to, const char *name, double value, tn_error *error)
{
    tn_named_real *added = tn_message_add(&tn_message_named_real, to, error);
    if (!added)
        return TN_MEMORY;
    *added = (tn_named_real){name, value};
    return TN_OK;
}

static tn_status set_edges(const tn_growth_system *system, const tn_stats *stats, tn_grown_step *to, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < system->label_count && status == TN_OK; i++)
        if (stats->labels[i])
            status = add_count((tn_list *)&to->labels, stats->labels[i], error, "Edge%u",
                               (unsigned)system->labels[i].number);
    for (size_t i = 0; i < stats->age_count && status == TN_OK; i++)
        status = add_count((tn_list *)&to->ages, stats->ages[i].count, error, "Edge%u_%d",
                           (unsigned)system->labels[stats->ages[i].label].number, (int)stats->ages[i].age);
    for (size_t i = 0; i < stats->side_count && status == TN_OK; i++)
        status =
            add_count((tn_list *)&to->face_sides, stats->sides[i].count, error, "%u", (unsigned)stats->sides[i].sides);
    return status;
}

static tn_status set_fitness(const tn_fitness_goal *goal, const tn_fitness *fitness, tn_grown_step *to, tn_error *error)
{
    tn_list *list = (tn_list *)&to->fitness;
    tn_status status = TN_OK;
    for (int t = 0; t < TN_FITNESS_TERM_COUNT && status == TN_OK; t++)
        status = add_real(list, tn_fitness_term_name((tn_measured)t), tn_fitness_value(fitness, (tn_measured)t), error);
    for (uint32_t i = 0; i < goal->named_count && status == TN_OK; i++)
        status = add_real(list, goal->named[i].name, tn_named_value(&goal->named[i], fitness), error);
    to->has_lacking = goal->required_count > 0;
    to->lacking = to->has_lacking ? tn_fitness_lacking(fitness, goal) : 0;
    return status;
}

static tn_status set_measures(const tn_fitness *fitness, tn_grown_step *to, tn_error *error)
{
    tn_status status = TN_OK;
    to->has_measures = true;
    for (int i = TN_MEASURED_WIDTH; i < TN_MEASURED_COUNT && status == TN_OK; i++) {
        double value = fitness->further[i - TN_MEASURED_WIDTH];
        if (isfinite(value)) /* no distance without a target */
            status = add_real((tn_list *)&to->measures, tn_names_MEASURED[i], value, error);
    }
    return status;
}

static tn_status add_row(tn_growing *g, const tn_stats *stats, bool all, tn_error *error)
{
    tn_grown_step *row = TN_ADD(grown_step, g->grown->stats.steps, error);
    if (!row)
        return TN_MEMORY;
    row->step = stats->step;
    row->V = stats->vertices;
    row->E = stats->edges;
    row->F
    = stats->faces;
    tn_status status = set_edges(g->shown->system, stats, row, error);
    if (status == TN_OK)
        status = set_fitness(&g->shown->study.goal, &stats->fitness, row, error);
    return status == TN_OK && all ? set_measures(&stats->fitness, row, error) : status;
}

/* Measures the step that the growth is at, and adds it to the answer. */
static tn_status grown_measure(tn_growing *g, tn_error *error)
{
    tn_grown_shown *shown = g->shown;
    bool all = g->request->measures == 0;
    if (!tn_array_reserve_from(&shown->stats, &shown->room, 16, shown->count, 1, sizeof *shown->stats))
        return tn_fail_memory(error);
    tn_stats *stats = &shown->stats[shown->count++];
    tn_status status = tn_stats_measure(g->growth, stats, error);
    if (status == TN_OK)
        status = tn_soundness_measure(g->growth, &shown->study.measuring, all ? UINT64_MAX : shown->study.goal.asked,
                                      &stats->fitness, error);
    return status == TN_OK ? add_row(g, stats, all, error) : status;
}

/* ---- why branches did not join */

/* Adds why its branches did not join. */
static tn_status grown_explain(tn_growing *g, tn_error *error)
{
    static const char *const reasons[TN_JOIN_FAILURE_COUNT] = {
        "leave along the path or straight out of the surface",
        "point out of the surface",
        "find no branch of their label in their region",
        "find none that points against them within BranchAngle",
        "find none in front of them",
        "find none near enough",
        "find one only at a vertex that an edge leads to already",
        "find only ones that joined others, or that a join cut off",
    };
    const tn_growth_counts counts = tn_growth_last_counts(g->growth);
    tn_grown_joins *row = TN_ADD(grown_joins, g->grown->joins, error);
    if (!row)
        return TN_MEMORY;
    row->step = tn_growth_steps(g->growth);
    row->replaced = counts.rewrites;
    row->joined = counts.joins;
    row->kept = counts.refused;
    for (int i = 0; i < TN_JOIN_FAILURE_COUNT; i++) {
        if (counts.failures[i] == 0)
            continue;
        tn_unjoined_branches *some = TN_ADD(unjoined_branches, row->unjoined, error);
        if (!some)
            return TN_MEMORY;
        *some = (tn_unjoined_branches){counts.failures[i], reasons[i]};
    }
    return TN_OK;
}

/* ---- what a request says of growing, as a study of its own: so both mean the same and are checked alike */

static void say_quoted(tn_buffer *out, const char *text)
{
    tn_buffer_append(out, "\"", 1);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            tn_buffer_append(out, "\\", 1);
        tn_buffer_append(out, text, 1);
    }
    tn_buffer_append(out, "\"\n", 2);
}

/* Words of studies have hyphens. */
static void say_word(tn_buffer *out, const char *member)
{
    for (; *member; member++)
        tn_buffer_append(out, *member == '_' ? "-" : member, 1);
}

static void say_texts(tn_buffer *out, const char *member, const tn_texts *texts)
{
    bool whole = strcmp(member, "statements") == 0;
    for (size_t i = 0; i < texts->count; i++) {
        if (!whole)
            say_word(out, member);
        tn_buffer_printf(out, "%s%s\n", whole ? "" : " ", texts->items[i]);
    }
}

static void say_text(tn_buffer *out, const char *member, const char *text)
{
    if (!text)
        return;
    say_word(out, member);
    tn_buffer_append(out, " ", 1);
    if (strcmp(member, "distance_to") == 0)
        say_quoted(out, text);
    else
        tn_buffer_printf(out, "%s\n", text);
}

static void say_member(tn_buffer *out, const tn_message_member *m, const tn_grow_statements *said)
{
    const char *value = (const char *)said + m->offset;
    switch (m->kind) {
    case TN_MESSAGE_TEXTS:
        say_texts(out, m->name, (const tn_texts *)(const void *)value);
        break;
    case TN_MESSAGE_TEXT:
        say_text(out, m->name, *(const char *const *)(const void *)value);
        break;
    case TN_MESSAGE_COUNT:
        if (*((const char *)said + m->has))
            tn_buffer_printf(out, "%s %" PRIu64 "\n", m->name, *(const uint64_t *)(const void *)value);
        break;
    default: /* a flag */
        if (*(const bool *)(const void *)value) {
            say_word(out, m->name);
            tn_buffer_append(out, "\n", 1);
        }
    }
}

tn_status tn_grow_study_text(const tn_grow_statements *said, const char *path, bool rules, char **text, size_t *size,
                             tn_error *error)
{
    const tn_message *message = &tn_message_grow_statements;
    tn_buffer out = {0};
    *text = NULL;
    tn_buffer_printf(&out, "%s", rules ? "rules " : "use ");
    say_quoted(&out, path);
    size_t begun = out.size;
    for (size_t i = 0; i < message->member_count; i++)
        say_member(&out, &message->members[i], said);
    if (out.failed || out.size == begun) {
        free(out.data);
        return out.failed ? tn_fail_memory(error) : TN_OK;
    }
    *text = out.data;
    *size = out.size;
    return TN_OK;
}

/* ---- the question */

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
    tn_status status = g->grown->has_stats ? grown_measure(g, error) : TN_OK;
    size_t overlaid = overlays(run, step);
    if (status == TN_OK && overlaid > 0)
        status = tn_growth_display_add(g->growth, &run->overlaid, error);
    run->overlaid_count += overlaid;
    if (status == TN_OK && g->request->sheet)
        status = note_view(run, error);
    else if (status == TN_OK && g->request->each_step)
        status = write_step(run, error);
    return status == TN_OK && g->grown->has_joins && step > 0 ? grown_explain(g, error) : status;
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
