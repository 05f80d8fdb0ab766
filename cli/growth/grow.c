/* tartan grow: grows a surface from a rewrite system, and writes it. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/interrupt.h"
#include "cli/common/option_rows.h"
#include "cli/common/progress.h"
#include "cli/growth/grow.h"
#include "runtime/base/array.h"
#include "runtime/growth/faults.h"
#include "runtime/growth/soundness.h"
#include "runtime/mesh/openmesh.h"

#define FORECAST_FACES 10000000.0 /* growths that will pass this many faces are announced */
#define IDLE_STEPS 100u           /* on end without a new face: then no number of faces is waited for any more */

/* A growth under way. */
enum { OVERLAY_MAX = 32 };

typedef struct run_state {
    tn_job *job;
    const tn_grow_settings *settings;
    tn_study study;
    tn_growth_system *system;
    tn_growth *growth;
    tn_file_format format;
    uint64_t until_faces; /* 0: as many steps as the study says */
    tn_stats *stats;
    size_t stats_count;
    tn_view **views;
    size_t view_count, view_room, stats_room;
    tn_faults faults;                 /* of the last step that had any, each kind by itself */
    uint32_t crossed[2], inverted[2]; /* the first and the last step with such faces; 0: none */
    double faces_before;
    bool forecast;                                /* was made */
    uint32_t idle;                                /* steps on end that made no face */
    uint32_t overlay[OVERLAY_MAX], overlay_count; /* steps to be drawn over one another */
    uint32_t overlaid_count;
    tn_sight overlaid;
} run_state;

static void clear(run_state *run)
{
    tn_sight_clear(&run->overlaid);
    for (size_t i = 0; i < run->stats_count; i++)
        tn_stats_clear(&run->stats[i]);
    for (size_t i = 0; i < run->view_count; i++)
        tn_view_free(run->views[i]);
    free(run->stats);
    free(run->views);
    tn_growth_free(run->growth);
    tn_growth_system_free(run->system);
    tn_study_clear(&run->study);
}

/* NAME-003.obj for NAME.obj; the caller frees it. */
static char *step_path(const char *path, uint32_t step)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    size_t stem = dot && (!slash || dot > slash) ? (size_t)(dot - path) : strlen(path), size = strlen(path) + 16;
    char *made = malloc(size);
    if (made)
        snprintf(made, size, "%.*s-%03u%s", (int)stem, path, step, path + stem);
    return made;
}

static bool make_room(run_state *run)
{
    return tn_array_reserve_from(&run->stats, &run->stats_room, 16, run->stats_count, 1, sizeof *run->stats) &&
           tn_array_reserve_from(&run->views, &run->view_room, 16, run->view_count, 1, sizeof *run->views);
}

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
    uint32_t step = tn_growth_steps(run->growth);
    tn_status status = tn_faults_find(run->growth, &found, error);
    if (status != TN_OK)
        return status;
    note_fault(&found.crossed, step, &run->faults.crossed, run->crossed);
    note_fault(&found.inverted, step, &run->faults.inverted, run->inverted);
    return TN_OK;
}

static void warn_of_fault(run_state *run, uint32_t code, const tn_fault *fault, const uint32_t steps[2],
                          const char *what, const char *help)
{
    char since[48] = "";
    if (fault->count == 0)
        return;
    if (steps[0] != steps[1])
        snprintf(since, sizeof since, ", since step %u", steps[0]);
    tn_diagnostics *list = tn_job_diagnostics(run->job);
    tn_diagnostic *d =
        tn_report_bare(list, TN_WARNING, code, "after step %u, %u %s%s; the first is around (%.4g, %.4g, %.4g)",
                       steps[1], fault->count, what, since, fault->place[0], fault->place[1], fault->place[2]);
    tn_help(list, d, "%s", help);
}

static void warn_of_faults(run_state *run)
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

/* JSON has all measures; the table those that the study speaks of. */
static tn_status note_stats(run_state *run, tn_error *error)
{
    tn_stats *stats = &run->stats[run->stats_count++];
    uint64_t asked = run->settings->stats == 2 ? UINT64_MAX : run->study.goal.asked;
    tn_status status = tn_stats_measure(run->growth, stats, error);
    return status == TN_OK ? tn_soundness_measure(run->growth, &run->study.measuring, asked, &stats->fitness, error)
                           : status;
}

/* Is the step one of --overlay? */
static bool overlays(const run_state *run, uint32_t step)
{
    for (uint32_t i = 0; i < run->overlay_count; i++)
        if (run->overlay[i] == step)
            return true;
    return false;
}

/* What there is to do with each step. */
static tn_status note_step(run_state *run, tn_error *error)
{
    const tn_grow_settings *settings = run->settings;
    if (!make_room(run))
        return tn_fail_memory(error);
    if (settings->stats || !settings->output) {
        tn_status status = note_stats(run, error);
        if (status != TN_OK)
            return status;
    }
    if (overlays(run, tn_growth_steps(run->growth))) {
        tn_status status = tn_growth_sight_add(run->growth, &run->overlaid, error);
        if (status != TN_OK)
            return status;
        run->overlaid_count++;
    }
    if (settings->sheet) {
        tn_camera camera = tn_grow_camera(settings);
        tn_status status = tn_growth_view(run->growth, &camera, tn_grow_surrounded(settings, &run->study),
                                          &run->views[run->view_count], error);
        if (status != TN_OK)
            return status;
        run->view_count++;
    } else if (settings->each_step && settings->output) {
        char *path = step_path(settings->output, tn_growth_steps(run->growth));
        if (!path)
            return tn_fail_memory(error);
        tn_grow_write(run->job, run->growth, &run->study, run->format, path);
        free(path);
    }
    if (settings->explain && tn_growth_steps(run->growth) > 0) {
        tn_growth_counts counts = tn_growth_last_counts(run->growth);
        tn_grow_explain(stderr, tn_growth_steps(run->growth), &counts);
    }
    return TN_OK;
}

/* Says what is coming where it is much: the last step's growth, continued. */
static void forecast(run_state *run)
{
    const tn_map *map = tn_growth_map(run->growth);
    double faces = map->face_count - 1, ratio = run->faces_before > 0 ? faces / run->faces_before : 1;
    uint32_t steps = tn_growth_steps(run->growth), left = run->study.steps > steps ? run->study.steps - steps : 0;
    run->faces_before = faces;
    if (run->forecast || steps < 3 || ratio <= 1 || run->until_faces)
        return;
    double coming = faces;
    for (uint32_t i = 0; i < left && coming < 1e15; i++)
        coming *= ratio;
    if (coming <= FORECAST_FACES)
        return;
    run->forecast = true;
    uint64_t limit = run->study.options.edge_limit ? run->study.options.edge_limit : TN_EDGES_MAX;
    if (2 * coming > (double)limit) /* a face has two edges of its own, where four meet */
        tn_job_note(run->job, "%u steps will make more edges than the limit of %llu", run->study.steps,
                    (unsigned long long)limit);
    else
        tn_job_note(run->job, "%u steps will make about %.0f million faces and need about %.1f GB of memory",
                    run->study.steps, coming / 1e6, coming * 170e-9);
    tn_job_show(run->job);
}

/* With --until, steps are counted only where -n says so. */
static bool is_enough(run_state *run)
{
    uint32_t faces = tn_growth_map(run->growth)->face_count - 1, steps = tn_growth_steps(run->growth);
    bool all_steps = steps >= run->study.steps;
    if (!run->until_faces)
        return all_steps;
    if (faces >= run->until_faces)
        return true;
    if (all_steps && run->settings->said.steps)
        tn_job_note(run->job, "after %u steps there are %u faces, fewer than %llu", steps, faces,
                    (unsigned long long)run->until_faces);
    else if (run->idle >= IDLE_STEPS)
        tn_job_note(run->job, "%u steps have made no face: there are %u, fewer than %llu", run->idle, faces,
                    (unsigned long long)run->until_faces);
    return (all_steps && run->settings->said.steps) || run->idle >= IDLE_STEPS;
}

/* What an interrupt leaves, should one come after this step. */
static void describe_rest(const run_state *run, uint32_t step, char *text, size_t size)
{
    const char *output = run->settings->output;
    if (!output)
        snprintf(text, size, "interrupted after step %u of %u", step, run->study.steps);
    else if (run->settings->each_step)
        snprintf(text, size, "interrupted after step %u of %u; the files of later steps are not written", step,
                 run->study.steps);
    else
        snprintf(text, size, "interrupted after step %u of %u; %.300s is not written", step, run->study.steps, output);
}

static void promise(const run_state *run, uint32_t step)
{
    char text[480];
    describe_rest(run, step, text, sizeof text);
    tn_interrupt_last_words("%s", text);
}

/* Grows step by step. A limit or rest ends it at the last complete step. */
static tn_status grow(run_state *run, tn_error *error)
{
    tn_progress progress;
    tn_status status = note_step(run, error);
    tn_progress_begin(&progress, "steps", 0, run->until_faces ? 0 : run->study.steps);
    while (status == TN_OK && !is_enough(run)) {
        uint32_t complete = tn_growth_steps(run->growth), faces = tn_growth_map(run->growth)->face_count;
        tn_progress_update(&progress, complete);
        promise(run, complete);
        status = tn_interrupt_check(error);
        if (status == TN_OK)
            status = tn_growth_step(run->growth, error);
        if (status == TN_LIMIT) {
            tn_job_fail(run->job, error);
            tn_job_note(run->job, "the surface is that of step %u, the last complete one", complete);
            status = tn_growth_regrow(run->growth, complete, error);
            break;
        }
        if (status != TN_OK)
            break;
        run->idle = tn_growth_map(run->growth)->face_count == faces ? run->idle + 1 : 0;
        forecast(run);
        if (tn_growth_at_rest(run->growth)) {
            tn_job_note(run->job, "step %u changes nothing any more: further steps are left out",
                        tn_growth_steps(run->growth));
            break;
        }
        status = note_faults(run, error);
        if (status == TN_OK)
            status = note_step(run, error);
    }
    tn_progress_end(&progress);
    return status;
}

static void draw_overlay(run_state *run)
{
    uint32_t last = tn_growth_steps(run->growth);
    if (run->overlaid_count < run->overlay_count)
        tn_job_note(run->job, "the surface has %u steps: later ones of --overlay are not drawn", last);
    if (run->overlaid_count)
        tn_grow_overlay(run->job, run->growth, &run->study, &run->overlaid, run->format);
    else
        tn_job_usage(run->job, "none of the steps of --overlay is there: the last is %u", last);
}

static void finish(run_state *run)
{
    const tn_grow_settings *settings = run->settings;
    warn_of_faults(run);
    if (settings->sheet)
        tn_grow_sheet(run->job, run->growth, &run->study, run->views, run->view_count, run->format);
    else if (settings->turn.given)
        tn_grow_turn(run->job, run->growth, &run->study, run->format);
    else if (settings->overlay)
        draw_overlay(run);
    else if (settings->output && !settings->each_step)
        tn_grow_write(run->job, run->growth, &run->study, run->format, settings->output);
    if (settings->stats || !settings->output)
        tn_grow_stats(run->job, run->system, &run->study, run->stats, run->stats_count);
}

/* What ended it before the end; an interrupt says what is there and what is not. */
static void fail(run_state *run, const tn_error *error)
{
    char text[480];
    if (error->status != TN_STOPPED || !run->growth) {
        tn_job_fail(run->job, error);
        return;
    }
    describe_rest(run, tn_growth_steps(run->growth), text, sizeof text);
    tn_job_interrupted(run->job, "%s", text);
}

/* --until faces=N */
static bool read_until(run_state *run)
{
    const char *text = run->settings->until;
    if (!text)
        return true;
    if (strncmp(text, "faces=", 6) == 0 && tn_number_read(text + 6, &run->until_faces) && run->until_faces > 0)
        return true;
    tn_diagnostic *d = tn_job_usage(run->job, "--until takes faces=N, not `%.60s`", text);
    tn_help(tn_job_diagnostics(run->job), d, "for example --until faces=10000");
    return false;
}

/* --overlay 1,3,5 */
static bool read_overlay(run_state *run)
{
    const char *text = run->settings->overlay;
    while (text && *text) {
        char word[12];
        uint64_t step;
        size_t size = strcspn(text, ",");
        snprintf(word, sizeof word, "%.*s", (int)(size < sizeof word ? size : 0), text);
        if (run->overlay_count == OVERLAY_MAX || !tn_number_read(word, &step) || step > TN_STEPS_MAX) {
            tn_diagnostic *d = tn_job_usage(run->job, "--overlay takes up to %d steps, not `%.60s`", OVERLAY_MAX,
                                            run->settings->overlay);
            tn_help(tn_job_diagnostics(run->job), d, "for example --overlay 1,3,5");
            return false;
        }
        if (!overlays(run, (uint32_t)step))
            run->overlay[run->overlay_count++] = (uint32_t)step;
        text += size + (text[size] == ',');
    }
    return true;
}

static tn_status prepare(run_state *run, tn_error *error)
{
    const tn_opened *opened = &run->job->opened;
    if (opened->module->GROWTH_count == 0) {
        tn_fail(error, TN_INVALID, E_NOT_IN_FILE, "%.200s has no rewrite system", opened->path);
        tn_error_help(
            error, "%s",
            tn_opened_help(opened, "a surface grows from a .hemls file, or from a .study file that names one").text);
        return TN_INVALID;
    }
    tn_status status = tn_growth_system_read(opened->module, &run->system, error);
    if (status == TN_OK)
        status = tn_study_read(opened->module, opened->path, &tn_openmesh_reader, &run->study, error);
    if (status != TN_OK)
        return status;
    run->study.options.explain = run->settings->explain;
    run->study.options.interpret = run->settings->engine == TN_GROW_VM;
    run->study.options.watch = tn_interrupt_waiting();
    run->study.options.threads = (int)run->settings->threads.value;
    return tn_growth_new(run->system, &run->study.environment, &run->study.options, &run->growth, error);
}

static void warn_of_open_boundaries(const run_state *run)
{
    const tn_module *module = run->job->opened.module;
    tn_diagnostics *list = tn_job_diagnostics(run->job);
    for (uint32_t i = 0; (i = tn_study_open_boundary(&run->study, i)) < module->BOUNDARY_count; i++) {
        const tn_boundary_record *r = &module->BOUNDARY_records[i];
        tn_diagnostic *d = tn_report(list, W_OPEN_BOUNDARY, (tn_span){r->file, r->begin, r->end},
                                     "this mesh is open, or has edges of more than two faces: nothing is inside it");
        tn_help(list, d, "close it, or leave `inside` out: it stops what crosses it from either side");
    }
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_error error;
    tn_job_begin(&job, common);
    run_state state = {.job = &job, .settings = tn_grow_settings_of(&job)};
    if (tn_grow_format_of(&job, &state.format) && read_until(&state) && read_overlay(&state) && tn_grow_open(&job)) {
        tn_status status = prepare(&state, &error);
        if (status == TN_OK)
            warn_of_open_boundaries(&state);
        if (status == TN_OK)
            status = grow(&state, &error);
        if (status == TN_OK)
            finish(&state);
        else
            fail(&state, &error);
    }
    clear(&state);
    return tn_job_end(&job);
}

#define SETTINGS tn_grow_settings
static const tn_option options[] = {
    OUTPUT(output,
           TN_WRITES_PICTURES | TN_WRITES(OBJ) | TN_WRITES(PLY) | TN_WRITES(STL) | TN_WRITES(OFF) | TN_WRITES(OM) |
               TN_WRITES(GLB) | TN_WRITES(DXF) | TN_WRITES_ASKED,
           "the surface: .obj, .ply, .stl, .off, .om, .glb, its edges: .dxf, or a picture: .svg, .png, .pdf; - is "
           "standard output"),
    CHOICE("format", 'f', "FORMAT", format, TN_GROW_FORMATS, "what is written, where the name of FILE does not say it"),
    TEXT("steps", 'n', "N", said.steps, "how many derivation steps (default: the study's, or 4)"),
    TEXT("until", 0, "faces=N", until,
         "stop at the first step with at least N faces, or after the steps of -n where that is given"),
    MAYBE("stats", 0, "[table|json]", stats, "table|json",
          "write counts, labels, ages and fitness of every step to standard output"),
    FLAG("explain", 0, explain, "say for every step why branches did not join"),
    FLAG("each-step", 0, each_step, "write every step, to NAME-000.obj, NAME-001.obj and so on"),
    TEXT("overlay", 0, "N,N,...", overlay, "draw these steps over one another, in one picture"),
    FLAG("sheet", 0, sheet, "draw all steps side by side on one picture"),
    NUMBER("turn", 0, "N", turn, 2, 720,
           "draw N pictures from all around: into the folder that -o names, or as one PNG that moves (-o FILE.png)"),
    FLAG("triangulate", 't', triangulate, "cut faces into triangles"),
    FLAG("groups", 'g', groups,
         "group or colour faces and lines by their edges' label and age (DXF: layers by both, not by label alone)"),
    FLAG("lines", 0, lines, "write the edges too (OBJ, PLY; a DXF has nothing else)"),
    FLAG("normals", 0, normals, "write normals of the vertices (OBJ, PLY, GLB)"),
    CHOICE("up", 0, "AXIS", up, "z|y", "which axis points up in the mesh (default z; GLB is always y)"),
    NUMBER("subdivide", 0, "N", subdivide, 1, 8,
           "subdivide the finished mesh N times (Catmull-Clark, or Loop where all faces are triangles)"),
    NUMBER("smooth", 0, "N", smooth, 1, 10000, "smooth the finished mesh N times (Laplace; the outline stays)"),
    NUMBER("decimate", 0, "FACES", decimate, 1, UINT32_MAX,
           "reduce the finished mesh to about FACES triangles, or to as few as do not fold"),
    TEXT("scale", 0, "S", said.scale, "factor of each step, or \"SX SY SZ\" for each axis"),
    TEXT("start", 0, "\"X Y Z\"", said.start, "centre of the seed"),
    TEXT("start-length", 0, "L", said.start_length, "side of the seed"),
    TEXT("seed", 's', "N", said.seed, "random stream of weighted rules"),
    TEXT("branch-angle", 0, "DEGREES", said.branch_angle,
         "how far from opposite joined branches may point, instead of what the file says"),
    TEXT("branch-length", 0, "L", said.branch_length, "longest join, in sides of the seed as scaled so far"),
    TEXT("edge-limit", 0, "N", said.edge_limit, "the most edges a surface may have"),
    TEXT("sun", 0, "\"X Y Z\"", said.sun, "where the sun stands, for the term sunlit (default: overhead)"),
    TEXT("distance-to", 0, "MESH", said.distance_to, "measure the mean distance to this mesh"),
    FLAG("fixed-centre", 0, said.fixed_centre, "scale about the start instead of the mean of the vertices"),
    FLAG("fixed-perimeter", 0, said.fixed_perimeter, "vertices of the outline stay"),
    FLAG("facing", 0, said.facing, "join branches only where each points towards the other"),
    FLAG("mirror", 0, said.mirror, "`+` turns right, as in files of Genr8"),
    LIST("attractor", 0, "\"at X Y Z ...\"", said.attractors,
         "add an attractor, in the words of a study: \"at 4 4 3 strength 2\"; may be repeated"),
    LIST("repeller", 0, "\"at X Y Z ...\"", said.repellers, "add a repeller"),
    LIST("gravity", 0, "\"X Y Z\"", said.gravity, "add a displacement of every step"),
    LIST("boundary", 0, "SHAPE", said.boundaries,
         "add a boundary, in the words of a study: \"sphere at 0 0 0 radius 2 stop\"; may be repeated"),
    LIST("fitness", 0, "TERM", said.fitness,
         "add a fitness term, in the words of a study: \"size target 10 weight 2\""),
    REAL("azimuth", 0, "DEGREES", azimuth, "where a picture is seen from, about z (default -60)"),
    REAL("elevation", 0, "DEGREES", elevation, "how high from: 90 is straight above (default 30)"),
    CHOICE("surroundings", 0, "WHETHER", surroundings, "auto|yes|no",
           "draw what the surface grows in: attractors, repellers, gravity, boundaries and the ground (default: where "
           "there are forces or boundaries)"),
    NUMBER("width", 0, "POINTS", width, 50, 5000, "width of a picture (default 480)"),
    NUMBER("columns", 0, "N", columns, 1, 1000, "steps in a row of a sheet"),
    NUMBER("dpi", 0, "N", dpi, 10, 2400, "pixels an inch of a PNG (default 150)"),
    TEXT("title", 0, "TEXT", title, "title of a picture (default: the study's)"),
    CHOICE(
        "engine", 0, "ENGINE", engine, "templates|vm",
        "templates (the default) draws each successor once, before it grows; vm interprets the rules' code for every "
        "edge: the same surface, more slowly"),
    OPTION_THREADS(threads),
    OPTION_WERROR,
};

const tn_command tn_command_grow = {
    .name = "grow",
    .summary = "grow a surface from a rewrite system",
    .usage = "FILE.hemls|FILE.study [-n STEPS] -o FILE.obj\nFILE.study --stats\nFILE.study --sheet -o STEPS.svg",
    .description = "Grows a surface: each step enlarges it, lets the surroundings pull and stop it, rewrites its edges "
                   "and joins the "
                   "branches that the rules draw. A .hemls file holds a rewrite system, a .study file says how to grow "
                   "one and in which "
                   "surroundings; what a study says can also be said by options, in the same words. Without -o the "
                   "statistics of every "
                   "step are shown. The same input gives the same bytes at any number of threads.\n\n"
                   "A limit that is reached ends the growth at the last complete step, which is written (exit 4).",
    .example = "$ tartan grow square.hemls -n 5 -o square.obj\n"
               "$ tartan grow draped.study --sheet -o draped.svg\n"
               "$ tartan grow square.hemls --boundary \"sphere at 0 0 -2 radius 1.5\" -o tent.glb",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "take fewer steps with -n",
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
