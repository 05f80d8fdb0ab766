/* tartan runs: looks at runs that were made. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "driver/breed/evolve.h"
#include "runtime/base/file.h"
#include "runtime/base/utf8.h"

typedef struct runs_settings {
    tn_settings common;
    const char *output;
    tn_option_number in_place_of;
    bool json;
} runs_settings;

static const runs_settings *settings_of(const tn_job *job)
{
    return (const runs_settings *)job->settings;
}

static bool writes_json(const tn_job *job)
{
    const runs_settings *s = settings_of(job);
    return s->json || (s->output && tn_file_format_of(s->output) == TN_FILE_JSON);
}

static void show_line(FILE *out, const char *before, const char *text, size_t size)
{
    fputs(before, out);
    tn_write_clean(out, text, size);
    fputc('\n', out);
}

static const char *words_of(const char *kind)
{
    static const struct {
        const char *kind, *words;
    } rows[] = {{"choose", "           chosen: "}, {"insert", "           inserted "},
                {"edit", "           edited, "},   {"remove", "           taken out: "},
                {"left", "           left: "},     {"warning", "           warning: "}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strcmp(rows[i].kind, kind) == 0)
            return rows[i].words;
    return "           changed: ";
}

/* What a person decided before a generation was bred. */
static void show_events(const tn_run_told *run, uint64_t generation, FILE *out)
{
    for (size_t i = 0; i < run->events.count; i++)
        if (run->events.items[i].generation == generation)
            show_line(out, words_of(run->events.items[i].kind), run->events.items[i].text,
                      strlen(run->events.items[i].text));
}

static void show_run(const tn_run_told *run, FILE *out)
{
    fprintf(out, "%s%s\n", run->run, run->settings ? "" : ": not begun");
    for (const char *line = run->settings; line && *line; line += strcspn(line, "\n") + 1)
        show_line(out, "  ", line, strcspn(line, "\n"));
    fprintf(out, "%10s %14s %14s %9s %9s %12s %12s\n", "generation", "best", "mean", "distinct", "not valid",
            "evaluations", "births");
    for (size_t i = 0; i < run->generations.count; i++) {
        const tn_run_generation *g = &run->generations.items[i];
        show_events(run, g->generation, out);
        fprintf(out, "%10" PRIu64 " %14.6g %14.6g %9" PRIu64 " %9" PRIu64 " %12" PRIu64 " %12" PRIu64 "\n",
                g->generation, g->best, g->mean, g->distinct, g->no_sentence + g->failed + g->limited, g->evaluations,
                g->births);
    }
    show_events(run, run->generations.count, out);
}

/* One run a line: where each came, and after how many evaluations it first had its best. */
static void compare_run(const tn_run_told *run, FILE *out)
{
    if (run->generations.count == 0) {
        fprintf(out, "%-30s %10s\n", run->run, "none");
        return;
    }
    const tn_run_generation *last = &run->generations.items[run->generations.count - 1];
    fprintf(out, "%-30s %10" PRIu64 " %14.6g %14.6g %12" PRIu64 " %14" PRIu64 "\n", run->run, last->generation,
            last->best, last->mean, last->evaluations, run->best_first_at);
}

/* Each that is wrong is said, and the others are told. */
static void tell_run(tn_job *job, const char *dir, void (*tell)(const tn_run_told *run, FILE *out), FILE *out)
{
    tn_reply answer;
    if (tn_job_answered(job, tn_ask_runs(&job->session, &(tn_runs_request){.runs = {&dir, 1}}, &answer)))
        tell(&TN_REPLY(runs_told, &answer)->runs.items[0], out);
    tn_reply_clear(&answer);
}

static void write_runs(tn_job *job, FILE *out)
{
    const tn_option_list *words = &job->settings->operands;
    const char **dirs = (const char **)words->items + 1;
    tn_reply answer;
    if (tn_job_answered(job, tn_ask_runs(&job->session, &(tn_runs_request){.runs = {dirs, words->count - 1}}, &answer)))
        tn_job_write_json(&answer, out);
    tn_reply_clear(&answer);
}

static void compare(tn_job *job, FILE *out)
{
    const tn_option_list *dirs = &job->settings->operands;
    if (writes_json(job)) {
        write_runs(job, out);
        return;
    }
    fprintf(out, "%-30s %10s %14s %14s %12s %14s\n", "run", "generation", "best", "mean", "evaluations",
            "best first at");
    for (size_t d = 1; d < dirs->count; d++)
        tell_run(job, dirs->items[d], compare_run, out);
}

static void show_individual(const tn_individual_told *individual, FILE *out)
{
    fprintf(out, "# individual %" PRIu64, individual->individual);
    if (individual->has_parents)
        fprintf(out, ", of %" PRIu64 " and %" PRIu64, individual->parents.items[0], individual->parents.items[1]);
    if (individual->has_score)
        fprintf(out, ", score %.17g", individual->score);
    else
        fputs(", not scored", out);
    fprintf(out, "\n# genome:%s%s\n%s\n", *individual->genome ? " " : "", individual->genome, individual->sentence);
}

static void replay(tn_job *job, FILE *out)
{
    const char *dir = job->settings->operands.items[1], *id_text = job->settings->operands.items[2];
    tn_individual_request request = {.run = dir};
    tn_reply answer;
    if (!tn_number_read(id_text, &request.individual)) {
        tn_job_usage(job, "an individual is a number, not `%.60s`", id_text);
        return;
    }
    if (tn_job_answered(job, tn_ask_individual(&job->session, &request, &answer))) {
        if (writes_json(job))
            tn_job_write_json(&answer, out);
        else
            show_individual(TN_REPLY(individual_told, &answer), out);
    }
    tn_reply_clear(&answer);
}

/* ---- what is left for a run that goes on later */

static void leave(tn_job *job, const tn_change_run_request *request)
{
    tn_reply answer;
    if (tn_job_answered(job, tn_ask_change_run(&job->session, request, &answer)))
        tn_job_note(job, "this is done when the run goes on: --resume");
    tn_reply_clear(&answer);
}

static void insert(tn_job *job)
{
    const tn_option_number *place = &settings_of(job)->in_place_of;
    tn_change_run_request request = {.run = job->settings->operands.items[1],
                                     .file = job->settings->operands.items[2],
                                     .has_in_place_of = place->given,
                                     .in_place_of = place->value};
    uint8_t *bytes;
    size_t size;
    tn_error error;
    if (tn_file_read(request.file, TN_SENTENCE_FILE_MAX, &bytes, &size, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return;
    }
    for (size_t i = 0; i < size; i++) /* a zero byte is in no sentence, and no end of one */
        bytes[i] = bytes[i] ? bytes[i] : '?';
    request.sentence = (const char *)bytes;
    leave(job, &request);
    free(bytes);
}

static void take_out(tn_job *job)
{
    tn_change_run_request request = {.run = job->settings->operands.items[1], .has_remove = true};
    const char *word = job->settings->operands.items[2];
    if (tn_number_read(word, &request.remove))
        leave(job, &request);
    else
        tn_job_usage(job, "an individual is a number, not `%.60s`", word);
}

/* ---- the command */

static void show(tn_job *job, FILE *out)
{
    if (writes_json(job))
        write_runs(job, out);
    else
        tell_run(job, job->settings->operands.items[1], show_run, out);
}

/* What the first word asks for. `writes` has an output, `does` none. */
static const struct task {
    const char *name;
    size_t words; /* behind it; 0: any number, at least one */
    const char *takes;
    void (*writes)(tn_job *job, FILE *out);
    void (*does)(tn_job *job);
} tasks[] = {
    {"show", 1, "one run's folder", show, NULL},
    {"compare", 0, "the folders of runs", compare, NULL},
    {"replay", 2, "a run's folder and the number of an individual", replay, NULL},
    {"insert", 2, "a run's folder and a file with a sentence", NULL, insert},
    {"remove", 2, "a run's folder and the number of an individual", NULL, take_out},
};
enum { TASK_COUNT = sizeof tasks / sizeof *tasks };

static void refuse_task(tn_job *job, const char *what)
{
    const char *known[TASK_COUNT];
    for (size_t i = 0; i < TASK_COUNT; i++)
        known[i] = tasks[i].name;
    const char *near = tn_nearest(what, known, TASK_COUNT);
    tn_diagnostic *d = tn_job_usage(
        job, "`tartan runs` shows, compares or replays, inserts or removes; it does not know `%.60s`", what);
    if (near)
        tn_help(tn_job_diagnostics(job), d, "did you mean `tartan runs %s`?", near);
    else
        tn_help(tn_job_diagnostics(job), d, "write `tartan runs show %.60s` if that is the run's folder", what);
}

static void do_task(tn_job *job, const struct task *task)
{
    const runs_settings *settings = settings_of(job);
    tn_output output;
    if (task->words && job->settings->operands.count != 1 + task->words)
        tn_job_usage(job, "`tartan runs %s` takes %s", task->name, task->takes);
    else if (settings->in_place_of.given && task->does != insert)
        tn_job_usage(job, "--in-place-of is for `tartan runs insert`");
    else if (task->does && settings->output)
        tn_job_usage(job, "`tartan runs %s` has no output: leave -o out", task->name);
    else if (task->does && settings->json)
        tn_job_usage(job, "`tartan runs %s` has no output: leave --json out", task->name);
    else if (task->does)
        task->does(job);
    else if (tn_job_output(job, settings->output, &output)) {
        task->writes(job, output.stream);
        tn_job_commit(job, &output);
    }
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    const char *what = common->operands.items[0];
    const struct task *task = NULL;
    tn_job_begin(&job, common);
    for (size_t i = 0; i < TASK_COUNT; i++)
        if (strcmp(what, tasks[i].name) == 0)
            task = &tasks[i];
    if (task)
        do_task(&job, task);
    else
        refuse_task(&job, what);
    return tn_job_end(&job);
}

#define SETTINGS runs_settings
static const tn_option options[] = {
    NUMBER("in-place-of", 0, "ID", in_place_of, 0, UINT64_MAX - 1,
           "insert: what is inserted was made from this member, and takes its place (default: that of the worst)"),
    FLAG("json", 0, json, "show, compare and replay: write the answer as JSON"),
    OPTION_OUTPUT_BY(TN_WRITES_TEXT | TN_WRITES(JSON), "; .json is JSON"),
};

const tn_command tn_command_runs = {
    .name = "runs",
    .summary = "show, compare, replay and change runs of evolution",
    .usage = "show DIR\ncompare DIR...\nreplay DIR INDIVIDUAL\ninsert DIR FILE [--in-place-of ID]\nremove DIR ID",
    .description =
        "show lists a run's generations. compare puts several runs side by side: how far each came, and when. "
        "replay makes a run again, without scoring, up to the individual with that number, and writes its genome "
        "and its sentence. insert puts the sentence of a file into the newest generation, such as a rewrite system of "
        "your own or one that you have edited; the run's grammar must be able to make it. remove takes a member out. "
        "Both are stored at once and done when the run goes on.",
    .example = "$ tartan runs show hello.run\n$ tartan runs replay hello.run 4711\n"
               "$ tartan runs insert garden.run mine.hemls",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "show, compare, replay, insert or remove, and a run's folder",
    .operands_min = 2,
    .operands_max = SIZE_MAX,
    .run = run,
};
