/* tartan grow: grows a surface from a rewrite system, and writes it. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/growth/grow.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "driver/open/files.h"
#include "driver/open/stdlib.h"
#include "runtime/base/bytes.h"

/* ---- opens what `grow` grows */

/* Compiles the study that the options are, which uses the file. */
static bool open_options(tn_job *job, const char *text, size_t size)
{
    tn_stdlib_dirs dirs;
    tn_files files;
    tn_error error;
    tn_status status = tn_stdlib_dirs_find(&dirs, &error);
    tn_files_begin(&files, &dirs);
    tn_compile_options options = {.resolver = tn_files_resolver(&files), .warnings_are_errors = job->settings->werror};
    if (status == TN_OK)
        tn_job_status(job,
                      tn_open_text(TN_NOTATION(study), &(tn_input){.text = text, .size = size, .name = "<options>"},
                                   &options, &job->opened));
    else
        tn_job_fail(job, &error);
    tn_files_clear(&files);
    tn_stdlib_dirs_clear(&dirs);
    if (job->opened.module)
        job->opened.module->watch = tn_interrupt_waiting();
    return job->opened.module != NULL;
}

static bool open_study(tn_job *job, const char *path, bool has_source, const char *text, size_t size)
{
    if (has_source)
        return open_options(job, text, size);
    if (!tn_job_open(job, path) || job->opened.module->GROWTH_count == 0)
        return job->opened.module != NULL;
    tn_diagnostic *d = tn_job_usage(job, "a module is grown as it was compiled");
    tn_help(tn_job_diagnostics(job), d, "for other steps, scales or surroundings name the .hemls or .study file");
    return false;
}

/* Is the file a rewrite system or a study, of which there is source? *rules: a rewrite system. */
static tn_status look_at(const char *path, bool *has_source, bool *rules, tn_error *error)
{
    tn_stdlib_file found = {0};
    tn_status status = tn_stdlib_may_mean(path) ? tn_stdlib_find(path, &found, error) : TN_OK;
    const tn_notation *notation = tn_notation_of(found.path ? found.recorded : path, "", 0);
    *has_source = notation && tn_notation_takes(notation, "grow");
    *rules = notation == TN_NOTATION(hemls);
    tn_stdlib_file_clear(&found);
    return status;
}

/* Opens the file that grows: with statements, the study that they are, which uses the file. False if that failed. */
static bool grow_open(tn_job *job, const tn_grow_statements *said)
{
    const char *path = job->settings->operands.items[0];
    char *text = NULL;
    size_t size = 0;
    bool has_source, rules;
    tn_error error;
    tn_status status = look_at(path, &has_source, &rules, &error);
    if (status == TN_OK)
        status = tn_grow_study_text(said, path, rules, &text, &size, &error);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
        return false;
    }
    bool opened = text ? open_study(job, path, has_source, text, size) : tn_job_open(job, path);
    free(text);
    return opened;
}

/* ---- shows the steps of `tartan grow`: what each measures as a table, and why branches did not join */

/* Writes a line for each step. */
static void grow_table(const tn_grown_shown *steps, FILE *out)
{
    const tn_growth_system *system = steps->system;
    const tn_study *study = &steps->study;
    fprintf(out, "%5s %10s %10s %10s  %9s %9s %9s %8s %8s  edges\n", "step", "vertices", "edges", "faces", "size",
            "rough", "undul.", "V/E", "symm.");
    for (size_t i = 0; i < steps->count; i++) {
        const tn_stats *s = &steps->stats[i];
        fprintf(out, "%5u %10" PRIu64 " %10" PRIu64 " %10" PRIu64 "  %9.4g %9.4g %9.4g %8.4g %8.4g ", s->step,
                s->vertices, s->edges, s->faces, s->fitness.size, s->fitness.smoothness, s->fitness.undulation,
                s->fitness.subdivisions, s->fitness.symmetry);
        for (uint32_t l = 0; l < system->label_count; l++)
            if (s->labels[l])
                fprintf(out, " %s %" PRIu64, system->labels[l].name, s->labels[l]);
        if (s->fitness.soft_boundary_nodes > 0)
            fprintf(out, ", %.0f past soft boundaries", s->fitness.soft_boundary_nodes);
        for (uint32_t n = 0; n < study->goal.named_count; n++)
            fprintf(out, ", %s %.6g", study->goal.named[n].name,
                    tn_without_sign(tn_named_value(&study->goal.named[n], &s->fitness)));
        if (study->goal.required_count)
            fprintf(out, ", %.6g from what is required",
                    tn_without_sign(tn_fitness_lacking(&s->fitness, &study->goal)));
        if (study->has_goal)
            fprintf(out, ", fitness %.6g",
                    tn_without_sign(tn_fitness_total(&s->fitness, &study->goal, study->options.start_length)));
        fputc('\n', out);
    }
}

/* Says why the branches of a step did not join. */
static void grow_explain(const tn_grown_joins *joins, FILE *out)
{
    fprintf(out, "step %" PRIu64 ": %" PRIu64 " edges replaced, %" PRIu64 " pairs of branches joined\n", joins->step,
            joins->replaced, joins->joined);
    if (joins->kept)
        fprintf(out, "  %" PRIu64 " chains were kept, since a face would have fewer than three edges\n", joins->kept);
    for (size_t i = 0; i < joins->unjoined.count; i++)
        fprintf(out, "  %" PRIu64 " branches %s\n", joins->unjoined.items[i].branches, joins->unjoined.items[i].reason);
}

/* What a study can say too, as the words of its statements. */
typedef struct said_settings {
    const char *steps, *scale, *start, *start_length, *seed, *branch_angle, *branch_length, *edge_limit, *sun,
        *distance_to;
    bool fixed_centre, fixed_perimeter, facing, mirror;
    tn_option_list attractors, repellers, gravity, boundaries, fitness;
} said_settings;

typedef struct grow_settings {
    tn_settings common;
    said_settings said;
    const char *output, *until, *title, *overlay;
    int format;       /* auto, then as the words of the request's; what a file's name ends in is taken for it */
    int engine;       /* 0 templates, 1 vm */
    int stats;        /* 0 not asked for, 1 table, 2 json */
    int up;           /* 0 z, 1 y */
    int surroundings; /* of a picture: 0 where there are any, 1 yes, 2 no */
    bool explain, each_step, sheet, triangulate, groups, lines, normals;
    tn_option_number subdivide, smooth, decimate, threads;
    tn_option_real azimuth, elevation;
    tn_option_number width, columns, dpi, turn; /* of a picture */
} grow_settings;

/* A growth, as its steps are told. */
typedef struct running {
    tn_job *job;
    const grow_settings *settings;
    tn_grow_request request;
    uint64_t overlay[TN_OVERLAY_MAX];
    const char *statement; /* what -n says, if that is no number */
    char *said_steps;      /* the same as a statement; owned */
    tn_made_outputs outputs;
    tn_file_taker each_step; /* of the files of steps, in front of that of the outputs */
    char *step_path;         /* of the file of a step that is open; owned */
    tn_progress progress;
    bool begun, complete;
    uint64_t step, steps; /* the last that stands, and how many there are to be */
    size_t explained;     /* steps */
} running;

static const grow_settings *settings_of(const tn_job *job)
{
    return (const grow_settings *)job->settings;
}

/* ---- the request */

static tn_texts texts_of(const tn_option_list *list)
{
    return (tn_texts){list->items, list->count};
}

/* What the study makes of words for -n that are no number, it says itself. */
static bool set_statements(running *run)
{
    const said_settings *s = &run->settings->said;
    tn_grow_statements *to = &run->request.said;
    *to = (tn_grow_statements){.scale = s->scale,
                               .start = s->start,
                               .start_length = s->start_length,
                               .seed = s->seed,
                               .branch_angle = s->branch_angle,
                               .branch_length = s->branch_length,
                               .edge_limit = s->edge_limit,
                               .sun = s->sun,
                               .distance_to = s->distance_to,
                               .fixed_centre = s->fixed_centre,
                               .fixed_perimeter = s->fixed_perimeter,
                               .facing = s->facing,
                               .mirror = s->mirror,
                               .attractor = texts_of(&s->attractors),
                               .repeller = texts_of(&s->repellers),
                               .gravity = texts_of(&s->gravity),
                               .boundary = texts_of(&s->boundaries),
                               .fitness = texts_of(&s->fitness)};
    to->has_steps = s->steps && tn_number_read(s->steps, &to->steps);
    if (!s->steps || to->has_steps)
        return true;
    if (asprintf(&run->said_steps, "steps %s", s->steps) < 0) {
        run->said_steps = NULL;
        tn_job_fail(run->job, &(tn_error){.status = TN_MEMORY});
        return false;
    }
    run->statement = run->said_steps;
    to->statements = (tn_texts){&run->statement, 1};
    return true;
}

static void set_request(running *run)
{
    const grow_settings *s = run->settings;
    bool folder = s->turn.given && s->output && s->format == 0 && strcmp(s->output, "-") != 0;
    unsigned png = 0;
    while (tn_grow_formats[png] != TN_FILE_PNG)
        png++;
    run->request = (tn_grow_request){
        .format = !s->output ? 0
                  : folder   ? png
                             : (unsigned)s->format,
        .stats = s->stats != 0,
        .measures = s->stats != 2,
        .explain = s->explain,
        .each_step = s->each_step,
        .sheet = s->sheet,
        .has_turn = s->turn.given,
        .turn = s->turn.value,
        .moving = s->turn.given && !folder,
        .rework = {.has_subdivide = s->subdivide.given,
                   .subdivide = s->subdivide.value,
                   .has_smooth = s->smooth.given,
                   .smooth = s->smooth.value,
                   .has_decimate = s->decimate.given,
                   .decimate = s->decimate.value},
        .triangulate = s->triangulate,
        .groups = s->groups,
        .lines = s->lines,
        .normals = s->normals,
        .up = (unsigned)s->up,
        .picture = {.has_azimuth = s->azimuth.given,
                    .azimuth = s->azimuth.value,
                    .has_elevation = s->elevation.given,
                    .elevation = s->elevation.value,
                    .surroundings = (unsigned)s->surroundings,
                    .has_width = s->width.given,
                    .width = s->width.value,
                    .has_columns = s->columns.given,
                    .columns = s->columns.value,
                    .has_dpi = s->dpi.given,
                    .dpi = s->dpi.value,
                    .title = s->title},
        .engine = (unsigned)s->engine,
        .has_threads = s->threads.given,
        .threads = s->threads.value,
    };
}

/* --until faces=N */
static bool read_until(running *run)
{
    const char *text = run->settings->until;
    tn_grow_request *r = &run->request;
    r->has_until_faces = text != NULL;
    if (!text)
        return true;
    if (strncmp(text, "faces=", 6) == 0 && tn_number_read(text + 6, &r->until_faces) && r->until_faces > 0)
        return true;
    tn_diagnostic *d = tn_job_usage(run->job, "--until takes faces=N, not `%.60s`", text);
    tn_help(tn_job_diagnostics(run->job), d, "for example --until faces=10000");
    return false;
}

static bool is_known(const tn_counts *steps, uint64_t step)
{
    for (size_t i = 0; i < steps->count; i++)
        if (steps->items[i] == step)
            return true;
    return false;
}

/* --overlay 1,3,5 */
static bool read_overlay(running *run)
{
    const char *text = run->settings->overlay;
    tn_counts *steps = &run->request.overlay;
    steps->items = run->overlay;
    for (bool more = text != NULL; more; more = *text != '\0') {
        char word[12];
        uint64_t step;
        size_t size = strcspn(text, ",");
        snprintf(word, sizeof word, "%.*s", (int)(size < sizeof word ? size : 0), text);
        if (steps->count == TN_OVERLAY_MAX || !tn_number_read(word, &step) || step > TN_STEPS_MAX) {
            tn_diagnostic *d = tn_job_usage(run->job, "--overlay takes up to %d steps, not `%.60s`", TN_OVERLAY_MAX,
                                            run->settings->overlay);
            tn_help(tn_job_diagnostics(run->job), d, "for example --overlay 1,3,5");
            return false;
        }
        if (!is_known(steps, step))
            steps->items[steps->count++] = step;
        text += size + (text[size] == ',');
    }
    return true;
}

static bool names_format(running *run)
{
    const char *path = run->settings->output;
    if (!path || run->request.format)
        return true;
    tn_diagnostic *d = tn_job_usage(run->job, "%s does not say what is to be written", path);
    tn_help(tn_job_diagnostics(run->job), d,
            "end its name in .obj, .ply, .stl, .off, .om, .glb, .dxf, .svg, .png or .pdf, or say --format");
    return false;
}

static bool check_request(running *run)
{
    const grow_settings *s = run->settings;
    if (!names_format(run) ||
        !tn_job_answered(run->job, tn_grow_request_fits(&run->job->session, &run->request, s->output)))
        return false;
    if (s->format && !s->output) {
        tn_help(tn_job_diagnostics(run->job), tn_job_usage(run->job, "--format does nothing without a file"),
                "name one with -o");
        return false;
    }
    if (s->output && strcmp(s->output, "-") == 0 && (s->each_step || s->stats)) {
        tn_job_usage(run->job, "standard output takes one thing only: name a file with -o");
        return false;
    }
    return true;
}

/* ---- files of steps */

/* NAME-003.obj for NAME.obj and step-003.obj. */
static char *step_path(const char *path, const char *name)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.'), *number = strchr(name, '-');
    size_t stem = dot && (!slash || dot > slash) ? (size_t)(dot - path) : strlen(path);
    char *made;
    return asprintf(&made, "%.*s%.*s%s", (int)stem, path, (int)strcspn(number, "."), number, path + stem) < 0 ? NULL
                                                                                                              : made;
}

static tn_status open_step(void *context, const char *name, FILE **stream, tn_error *error)
{
    running *run = context;
    tn_made_outputs *outputs = &run->outputs;
    free(run->step_path);
    run->step_path = step_path(run->settings->output, name);
    if (!run->step_path)
        return tn_fail_memory(error);
    outputs->paths = (const char *const *)&run->step_path;
    outputs->next = 0;
    return outputs->taker.opens(outputs->taker.context, name, stream, error);
}

static tn_status close_step(void *context, bool whole, tn_error *error)
{
    const tn_file_taker *taker = &((running *)context)->outputs.taker;
    return taker->closes(taker->context, whole, error);
}

/* ---- while it grows */

/* What an interrupt leaves, should one come after this step. */
static void describe_rest(const running *run, char *text, size_t size)
{
    const char *output = run->settings->output;
    unsigned step = (unsigned)run->step, steps = (unsigned)run->steps;
    if (!output)
        snprintf(text, size, "interrupted after step %u of %u", step, steps);
    else if (run->settings->each_step)
        snprintf(text, size, "interrupted after step %u of %u; the files of later steps are not written", step, steps);
    else
        snprintf(text, size, "interrupted after step %u of %u; %.300s is not written", step, steps, output);
}

static void follow(running *run)
{
    char text[480];
    if (!run->begun)
        tn_progress_begin(&run->progress, "steps", 0, run->request.has_until_faces ? 0 : (double)run->steps);
    run->begun = true;
    if (run->complete) {
        tn_progress_end(&run->progress);
        return;
    }
    tn_progress_update(&run->progress, (double)run->step);
    describe_rest(run, text, sizeof text);
    tn_interrupt_last_words("%s", text);
}

/* After each step. */
static void take_step(void *context, const tn_reply *answer)
{
    running *run = context;
    const tn_grown *grown = TN_REPLY(grown, answer);
    const tn_grown_shown *shown = grown->stats.shown.value;
    run->step = grown->steps;
    run->steps = shown->study.steps;
    run->complete = shown->complete;
    for (; run->explained < grown->joins.count; run->explained++)
        grow_explain(&grown->joins.items[run->explained], stderr);
    follow(run);
}

/* ---- the command */

static void show_steps(running *run, const tn_reply *answer)
{
    tn_grown *grown = TN_REPLY(grown, answer);
    tn_grown_steps *steps = grown ? &grown->stats : TN_REPLY(grown_steps, answer);
    tn_output output;
    if (!(run->request.stats || !run->request.format) || !tn_job_output(run->job, NULL, &output))
        return;
    if (run->settings->stats == 2)
        tn_job_write_json(&(tn_reply){&tn_message_grown_steps, steps}, output.stream);
    else
        grow_table(steps->shown.value, output.stream);
    tn_job_commit(run->job, &output);
}

static void grow(running *run)
{
    tn_job *job = run->job;
    const grow_settings *s = run->settings;
    tn_reply answer;
    char text[480];
    run->request.said.has_steps = s->said.steps != NULL; /* which the study took */
    tn_job_files(job, &run->outputs, &s->output, 1, run->request.has_turn && !run->request.moving);
    if (s->each_step) {
        run->each_step = (tn_file_taker){open_step, close_step, run};
        job->session.files = &run->each_step;
    }
    job->session.so_far = take_step;
    job->session.so_far_context = run;
    tn_status status = tn_ask_grow(&job->session, &run->request, &answer);
    if (run->begun && !run->complete)
        tn_progress_end(&run->progress);
    if (status == TN_STOPPED && run->begun && !run->complete) {
        describe_rest(run, text, sizeof text);
        tn_job_interrupted(job, "%s", text);
    } else {
        tn_job_answered(job, status);
    }
    if (answer.message)
        show_steps(run, &answer);
    tn_job_files_end(&run->outputs);
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_job_begin(&job, common);
    running growing = {.job = &job, .settings = settings_of(&job)};
    set_request(&growing);
    if (read_until(&growing) && read_overlay(&growing) && check_request(&growing) && set_statements(&growing) &&
        grow_open(&job, &growing.request.said))
        grow(&growing);
    free(growing.said_steps);
    free(growing.step_path);
    return tn_job_end(&job);
}

#define SETTINGS grow_settings
static const tn_option options[] = {
    OUTPUT(output,
           TN_WRITES_PICTURES | TN_WRITES(OBJ) | TN_WRITES(PLY) | TN_WRITES(STL) | TN_WRITES(OFF) | TN_WRITES(OM) |
               TN_WRITES(GLB) | TN_WRITES(DXF) | TN_WRITES_ASKED,
           "the surface: .obj, .ply, .stl, .off, .om, .glb, its edges: .dxf, or a picture: .svg, .png, .pdf; - is "
           "standard output"),
    CHOICE("format", 'f', "FORMAT", format, "auto|obj|ply|stl|off|om|glb|dxf|svg|png|pdf",
           "what is written, where the name of FILE does not say it"),
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
