/* tartan place: places parts by a connection grammar, and writes the model. */
#include "cli/place/placing.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "driver/place/kit.h"
#include "runtime/place/search/search.h"

static bool check_options(tn_job *job)
{
    const place_settings *s = (const place_settings *)job->settings;
    uint32_t standard = s->program && strcmp(s->program, "-") == 0;
    bool ldraw = false, picture = false;
    tn_steps_wish wish;
    for (size_t i = 0; i < s->outputs.count; i++) {
        const char *path = s->outputs.items[i];
        standard += strcmp(path, "-") == 0;
        ldraw |= tn_place_format(path) == OUT_LDRAW;
        picture |= tn_place_format(path) == OUT_PICTURE;
    }
    if (standard + (s->trace || s->stats) > 1)
        tn_job_usage(job, "standard output takes one thing only: name a file with -o");
    else if (s->header && !ldraw)
        tn_job_usage(job, "--header is of an .ldr file: name one with -o");
    else if (s->steps && !tn_place_read_steps(s->steps, &wish))
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "--steps cannot be %.100s", s->steps),
                "write `--steps part`, `--steps layer`, or how many parts a step has: `--steps 5`");
    else if (s->fitness && s->trace)
        tn_job_usage(job, "--trace shows what does not fit, and --fitness chooses by value: leave one out");
    else if (s->sheet && !picture)
        tn_job_usage(job, "--sheet is of a picture: name one with -o");
    else if (s->keep_partial && s->outputs.count == 0 && !s->program)
        tn_job_usage(job, "--keep-partial does nothing without a file: name one with -o");
    else
        return true;
    return false;
}

/* ---- the run */

static void report(void *context, const tn_place_event *event)
{
    const placing *p = context;
    tn_place_trace(p->job, &p->rules, event, stdout);
}

static double value_of(void *context, const tn_placed_model *model, const char *const *ahead, size_t ahead_count)
{
    return tn_place_fitness_value(&((placing *)context)->fitness, model, ahead, ahead_count);
}

/* --fitness, before the run. */
static bool make_fitness(placing *p)
{
    const char *text = p->settings->fitness;
    if (!text)
        return true;
    if (p->rules.space) {
        tn_help(tn_job_diagnostics(p->job), tn_job_usage(p->job, "--fitness is of connection grammars"),
                "what is better of two models of a kit, the model says: `minimize elements;`");
        return false;
    }
    tn_status status = tn_place_fitness_make(&p->rules, text, &p->fitness);
    if (status == TN_OK)
        return true;
    tn_kit_ask_failed(&p->job->opened, &p->fitness.asked);
    tn_job_status(p->job, status);
    return false;
}

static tn_place_options options_of(placing *p)
{
    const place_settings *s = p->settings;
    return (tn_place_options){.seed = (uint32_t)s->seed.value,
                              .part_limit = s->part_limit.value,
                              .step_limit = s->step_limit.value,
                              .frame_limit = s->frame_limit.value,
                              .lookahead_limit = s->lookahead_limit.value,
                              .search_limit = s->search_limit.value,
                              .threads = (unsigned)s->threads.value,
                              .keep_steps = s->program != NULL,
                              .keep_filled = s->trace,
                              .interpret = s->engine == 1,
                              .value = s->fitness ? value_of : NULL,
                              .watch = p->watch,
                              .report = s->trace ? report : NULL,
                              .context = p};
}

/* The rules of the grammar, or of one model of a kit. */
static tn_status make_rules(placing *p, tn_error *error)
{
    const tn_module *module = p->job->opened.module;
    if (!module->KIT_count && p->settings->model) {
        tn_job_usage(p->job, "--model is about a kit, and %.200s is none", p->settings->common.operands.items[0]);
        return TN_STOPPED;
    }
    if (module->KIT_count) {
        tn_status status = tn_kit_choose(&p->job->opened, p->settings->model, &p->chosen);
        tn_job_status(p->job, status);
        return status == TN_OK ? tn_place_rules_of_model(module, p->chosen, &p->rules, error) : TN_STOPPED;
    }
    return tn_place_rules_make(module, &p->rules, error);
}

/* Does what was placed meet what its model requires? */
static tn_status check_conditions(placing *p)
{
    tn_placed_measures measured;
    tn_error error;
    tn_kit_tally tally = {0};
    bool required;
    tn_status status = tn_kit_measure_required(&p->rules, &p->model, p->watch, &required, &measured, &error);
    if (status == TN_OK && required)
        status = tn_kit_conditions(&p->job->opened, p->chosen, &measured, false, true, &tally);
    else if (status != TN_OK)
        tn_job_fail(p->job, &error);
    tn_placed_measures_clear(&measured);
    return status;
}

/* The statement by which a model is placed in another way than by deriving it. */
static const char *search_reason(const tn_kit_model_record *model)
{
    return model->search != TN_SEARCH_GREEDY     ? "search"
           : model->symmetry != TN_SYMMETRY_NONE ? "symmetry"
           : model->stock_count > 0              ? "stock"
                                                 : "order breadth";
}

/* A search looks at many models: what one derivation did is not asked for. */
static bool check_search(placing *p)
{
    const place_settings *s = p->settings;
    const char *option = s->trace ? "--trace" : s->program ? "--program" : s->engine ? "--engine" : NULL;
    bool search = tn_place_needs_search(&p->rules);
    if (search && option) {
        const char *reason = search_reason(p->rules.space);
        tn_diagnostic *d = tn_job_usage(
            p->job, "%s is of models that are derived from the start on, and this one has `%s`", option, reason);
        tn_help(tn_job_diagnostics(p->job), d, "leave `%s` out of the model to see it", reason);
    } else if (!search && (s->search_limit.given || s->threads.given)) {
        tn_job_usage(p->job, "--%s is of a search, and the model has none",
                     s->search_limit.given ? "search-limit" : "threads");
    } else {
        return true;
    }
    return false;
}

/* The best until then is a model like any other. */
static void interrupted(placing *p)
{
    tn_interrupt_answered();
    p->watch = NULL;
    tn_job_interrupted(p->job, "interrupted; the best of %" PRIu64 " models that were looked at is kept",
                       p->model.counts.looked_at);
}

static void run_placing(placing *p)
{
    tn_error error;
    tn_status status = make_rules(p, &error);
    if (status == TN_STOPPED)
        return; /* has been said */
    if (status != TN_OK) {
        tn_fail(&error, status, E_NOT_PLACING, "%.200s holds nothing to place", p->settings->common.operands.items[0]);
        tn_error_help(&error, "%s",
                      tn_opened_help(&p->job->opened, "connection grammars are .pcfg files, kits .kit files").text);
        tn_job_fail(p->job, &error);
        return;
    }
    if (!check_search(p) || !make_fitness(p))
        return;
    tn_place_options options = options_of(p);
    tn_job_show(p->job);
    status = tn_place_model(&p->job->opened, &p->rules, &options, &p->model);
    bool found = p->model.counts.looked_at > 0 && p->model.count > 0 && (status == TN_LIMIT || status == TN_STOPPED);
    if (status == TN_STOPPED && found)
        interrupted(p);
    tn_job_status(p->job, status);
    if (status == TN_OK || found)
        status = check_conditions(p);
    tn_job_status(p->job, status);
    if (status == TN_OK || (p->settings->keep_partial && status != TN_MEMORY && p->model.count > 0)) {
        if (tn_place_find_steps(p))
            tn_place_write_all(p);
    } else if (p->model.count > 0)
        tn_job_note(p->job, "%zu part%s placed before; nothing was written", p->model.count,
                    p->model.count == 1 ? " was" : "s were");
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    placing p = {.job = &job, .settings = (const place_settings *)common, .watch = tn_interrupt_waiting()};
    tn_job_begin(&job, common);
    if (check_options(&job) && tn_job_open_joined(&job, common->operands.items, common->operands.count))
        run_placing(&p);
    tn_placed_steps_clear(&p.steps);
    tn_placed_model_clear(&p.model);
    tn_place_fitness_clear(&p.fitness);
    tn_place_rules_clear(&p.rules);
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
