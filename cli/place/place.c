/* tartan place: places parts by a connection grammar, and writes the model. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/place/place.h"
#include "ask/session/questions.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/place/place.h"

typedef struct place_settings {
    tn_settings common;
    tn_option_list outputs;
    const char *program, *model, *steps, *fitness;
    tn_option_number seed, part_limit, step_limit, frame_limit, lookahead_limit, search_limit, threads;
    int stats, engine;
    bool trace, header, keep_partial, sheet;
} place_settings;

/* The files that are asked for: what each is, and where all go. */
typedef struct wanted_files {
    const char **formats; /* of those by -o */
    const char **paths;   /* in the order in which they are made */
    size_t count;
} wanted_files;

static const place_settings *settings_of(const tn_job *job)
{
    return (const place_settings *)job->settings;
}

static bool check_options(tn_job *job, const tn_place_request *request)
{
    const place_settings *s = settings_of(job);
    uint32_t standard = s->program && strcmp(s->program, "-") == 0;
    for (size_t i = 0; i < s->outputs.count; i++)
        standard += strcmp(s->outputs.items[i], "-") == 0;
    if (standard + (s->trace || s->stats) > 1)
        tn_job_usage(job, "standard output takes one thing only: name a file with -o");
    else if (s->keep_partial && s->outputs.count == 0 && !s->program)
        tn_job_usage(job, "--keep-partial does nothing without a file: name one with -o");
    else
        return tn_job_answered(job, tn_place_check(&job->session, request));
    return false;
}

static void name_files(const place_settings *s, wanted_files *files)
{
    if (s->trace)
        files->paths[files->count++] = "-";
    for (size_t i = 0; i < s->outputs.count; i++) {
        const char *path = s->outputs.items[i];
        files->formats[i] = tn_file_format_word(strcmp(path, "-") == 0 ? TN_FILE_LDR : tn_file_format_of(path));
        files->paths[files->count++] = path;
    }
    if (s->program)
        files->paths[files->count++] = s->program;
}

/* ---- what is printed */

void tn_parts_text(const tn_placed_kind *kinds, size_t count, FILE *out)
{
    uint64_t parts = 0;
    for (size_t i = 0; i < count; i++)
        parts += kinds[i].number;
    fprintf(out, "%" PRIu64 " part%s\n", parts, parts == 1 ? "" : "s");
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%8" PRIu64 "  %s in colour %" PRId64 "\n", kinds[i].number, kinds[i].part, kinds[i].colour);
}

/* In their order. */
static void figures_text(const tn_placing_figures *f, FILE *out)
{
    const struct {
        bool has;
        uint64_t value;
        const char *what;
    } rows[] = {{true, f->elements, "parts placed"},
                {f->has_terminals, f->terminals, "steps taken"},
                {f->has_expansions, f->expansions, "symbols expanded"},
                {f->has_random, f->random, "of these, by a draw"},
                {f->has_tries, f->tries, "alternatives looked at"},
                {f->has_fallbacks, f->fallbacks, "times that none fitted"},
                {f->has_cells, f->cells, "cells filled"},
                {f->has_bounds, f->bounds, "bounds set"},
                {f->has_models, f->models, "models looked at"},
                {f->has_proved, f->proved, "1: the rules allow no better one"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].has)
            fprintf(out, "%12" PRIu64 "  %s\n", rows[i].value, rows[i].what);
}

static void figures_json(const tn_placing_figures *figures, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_TIGHT);
    tn_message_write(&tn_message_placing_figures, figures, NULL, &json);
    tn_json_end_line(&json);
}

static void print_summary(tn_job *job, const tn_placed *placed)
{
    const place_settings *s = settings_of(job);
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    if (s->stats)
        (s->stats == 2 ? figures_json : figures_text)(&placed->figures, output.stream);
    else
        tn_parts_text(placed->parts.items, placed->parts.count, output.stream);
    tn_job_commit(job, &output);
}

/* ---- the run */

/* The best that a search has found is kept, as is said at once. */
static void tell_interrupted(void *context, const tn_reply *answer)
{
    const tn_placed *placed = answer->value;
    if (placed->status != TN_STOPPED)
        return;
    tn_interrupt_answered();
    tn_job_interrupted(context, "interrupted; the best of %" PRIu64 " models that were looked at is kept",
                       placed->figures.models);
}

/* Progress and a trace would mix. */
static void show_alone(void *context, const char *work)
{
    (void)work;
    tn_job_show(context);
}

static tn_place_request request_of(const place_settings *s, const wanted_files *files)
{
    return (tn_place_request){.model = s->model,
                              .has_seed = s->seed.given,
                              .seed = s->seed.value,
                              .fitness = s->fitness,
                              .formats = {files->formats, s->outputs.count},
                              .steps = s->steps,
                              .sheet = s->sheet,
                              .header = s->header,
                              .program = s->program != NULL,
                              .trace = s->trace,
                              .keep_partial = s->keep_partial,
                              .engine = (unsigned)s->engine,
                              .has_part_limit = s->part_limit.given,
                              .part_limit = s->part_limit.value,
                              .has_step_limit = s->step_limit.given,
                              .step_limit = s->step_limit.value,
                              .has_frame_limit = s->frame_limit.given,
                              .frame_limit = s->frame_limit.value,
                              .has_lookahead_limit = s->lookahead_limit.given,
                              .lookahead_limit = s->lookahead_limit.value,
                              .has_search_limit = s->search_limit.given,
                              .search_limit = s->search_limit.value,
                              .has_threads = s->threads.given,
                              .threads = s->threads.value};
}

static void place(tn_job *job, const tn_place_request *request, const wanted_files *files)
{
    const place_settings *s = settings_of(job);
    tn_made_outputs outputs;
    tn_reply answer;
    if (s->trace)
        job->session.listener = (tn_session_listener){.begins = show_alone, .context = job};
    job->session.so_far = tell_interrupted;
    job->session.so_far_context = job;
    tn_job_files(job, &outputs, files->paths, files->count, false);
    tn_job_answered(job, tn_ask_place(&job->session, request, &answer));
    tn_job_files_end(&outputs);
    const tn_placed *placed = TN_REPLY(placed, &answer);
    if (placed)
        tn_job_status(job, (tn_status)placed->status);
    bool silent = s->outputs.count > 0 || s->program || s->trace;
    if (placed && placed->ended && (s->stats || !silent))
        print_summary(job, placed);
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const place_settings *s = (const place_settings *)common;
    tn_job job;
    tn_error error;
    wanted_files files = {.formats = calloc(s->outputs.count + 1, sizeof *files.formats),
                          .paths = calloc(s->outputs.count + 2, sizeof *files.paths)};
    tn_job_begin(&job, common);
    if (!files.formats || !files.paths) {
        tn_fail_memory(&error);
        tn_job_fail(&job, &error);
    } else {
        name_files(s, &files);
        const tn_place_request request = request_of(s, &files);
        if (check_options(&job, &request) && tn_job_open_joined(&job, common->operands.items, common->operands.count))
            place(&job, &request, &files);
    }
    free(files.formats);
    free(files.paths);
    return tn_job_end(&job);
}

#define SETTINGS place_settings
#define WRITES                                                                                                         \
    (TN_WRITES_STANDARD | TN_WRITES_PICTURES | TN_WRITES(LDR) | TN_WRITES(MPD) | TN_WRITES(CSV) | TN_WRITES(OBJ) |     \
     TN_WRITES(PLY) | TN_WRITES(STL) | TN_WRITES(OFF) | TN_WRITES(OM) | TN_WRITES(GLB) | TN_WRITES(3MF) |              \
     TN_WRITES(DXF))
static const tn_option options[] = {
    OUTPUTS(
        outputs, WRITES,
        "write to FILE (beside it, then renamed over it), by its ending: .ldr a model, .csv a list of its parts; - is "
        "a model on standard output; of a kit also .mpd, with a sub-file for each step, a picture (.svg, .png, .pdf) "
        "or a mesh (.obj, .ply, .stl, .off, .om, .glb, .3mf, .dxf)"),
    NUMBER("seed", 's', "N", seed, 0, UINT32_MAX, "which random choices: the same seed gives the same (default 0)"),
    TEXT("model", 'm', "NAME", model, "which model of the kit; may be left out where it has only one"),
    WRITTEN("program", 0, "FILE", program, TN_WRITES_TEXT,
            "write the steps that were taken to FILE, separated by blanks"),
    TEXT("fitness", 0, "EXPR", fitness,
         "of a connection grammar: take the alternative for which this is at least 1, or largest: `elements <= 30`"),
    TEXT("steps", 0, "STEPS", steps,
         "of a kit: the steps in which the model is built: part, layer, or how many parts a step has"),
    FLAG("sheet", 0, sheet, "of a kit: draw a picture for each step, side by side"),
    MAYBE("stats", 0, "[table|json]", stats, "table|json",
          "print figures: parts, steps, alternatives looked at, cells"),
    FLAG("trace", 0, trace, "print of every symbol which alternatives did not fit, and what was in the way"),
    FLAG("header", 0, header, "begin an .ldr file with how it was made (of a kit, it always does)"),
    FLAG("keep-partial", 0, keep_partial, "where the run cannot go on, write what was placed before"),
    CHOICE("engine", 0, "ENGINE", engine, "auto|vm",
           "vm looks ahead step by step; auto, the default, does what can be worked out beforehand once"),
    NUMBER("part-limit", 0, "N", part_limit, 1, UINT32_MAX, "the most parts (default 1000000)"),
    NUMBER("step-limit", 0, "N", step_limit, 1, UINT64_MAX, "the most steps (default 1000000000)"),
    NUMBER("frame-limit", 0, "N", frame_limit, 1, UINT32_MAX, "the most ( that are open at a time (default 1000000)"),
    NUMBER("lookahead-limit", 0, "N", lookahead_limit, 1, UINT64_MAX,
           "the most steps of one lookahead, and of symbols expanded without a step (default 1000000)"),
    NUMBER("search-limit", 0, "N", search_limit, 1, UINT64_MAX,
           "the most models that a search looks at or gives up (default 10000000)"),
    OPTION_THREADS(threads),
    OPTION_LDRAW,
    OPTION_WERROR,
};

const tn_command tn_command_place = {
    .name = "place",
    .summary = "place parts by a connection grammar or a kit",
    .usage =
        "FILE.pcfg... [-o OUT]... [--seed N] [--stats [json]] [--program FILE]\nFILE.pcfg... --fitness EXPR\nFILE.kit "
        "[--model NAME] [-o "
        "OUT]... [--steps part|layer|N] [--sheet]\n"
        "FILE --trace",
    .description =
        "Derives a model from a connection grammar and writes it. The files are one grammar together, in the order "
        "given, and the first rule's symbol is expanded: its alternatives are tried in their order, and the first that "
        "finds room is taken; where their probabilities sum to 1, one is drawn. Without -o a summary is printed.\n\n"
        "Where the published program for these grammars comes to its end, the .ldr file has the same bytes. Where a "
        "part has no room, the run ends with exit code 1, says what is in the way and since when, and writes nothing "
        "unless --keep-partial is given.\n\n"
        "A kit's model is placed inside its space, and then held to what it requires. Its .ldr file begins with how it "
        "was made. With --steps, parts are written in an order in which they can be built: each joins what stands, and "
        "is put in from above; a warning counts those that cannot.",
    .example = "$ tartan place wall.pcfg bricks.pcfg -o wall.ldr -o parts.csv",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "make the bounds smaller",
    .operands = "at least one FILE",
    .operands_min = 1,
    .operands_max = SIZE_MAX,
    .run = run,
};
