/* tartan runs: looks at runs that were made. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/job.h"
#include "cli/common/option_rows.h"
#include "driver/breed/evolve.h"
#include "runtime/base/utf8.h"

typedef struct runs_settings {
    tn_settings common;
    const char *output;
    tn_option_number in_place_of;
} runs_settings;

/* What a run's database says of it. */
typedef struct record {
    tn_generation_stats *stats;
    size_t count;
    tn_run_event *events;
    size_t event_count;
    char *identity; /* NULL: not begun */
} record;

static void clear_record(record *r)
{
    free(r->stats);
    free(r->identity);
    tn_run_events_free(r->events, r->event_count);
}

static bool read_run(tn_job *job, const char *dir, record *r)
{
    tn_run_store *store = NULL;
    tn_error error;
    char *path = tn_run_database(dir);
    *r = (record){0};
    tn_status status = path ? tn_run_store_open(path, false, true, &store, &error) : tn_fail_memory(&error);
    if (status == TN_OK)
        status = tn_run_store_get_meta(store, "identity", &r->identity, &error);
    if (status == TN_OK)
        status = tn_run_store_stats(store, &r->stats, &r->count, &error);
    if (status == TN_OK)
        status = tn_run_store_events(store, &r->events, &r->event_count, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tn_run_store_free(store);
    free(path);
    return status == TN_OK;
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
static void show_events(const record *r, uint32_t generation, FILE *out)
{
    for (size_t i = 0; i < r->event_count; i++)
        if (r->events[i].generation == generation)
            show_line(out, words_of(r->events[i].kind), r->events[i].text, strlen(r->events[i].text));
}

static void show(tn_job *job, const char *dir, FILE *out)
{
    record r;
    if (read_run(job, dir, &r)) {
        fprintf(out, "%s%s\n", dir, r.identity ? "" : ": not begun");
        for (const char *line = r.identity; line && *line; line += strcspn(line, "\n") + 1)
            show_line(out, "  ", line, strcspn(line, "\n"));
        fprintf(out, "%10s %14s %14s %9s %9s %12s %12s\n", "generation", "best", "mean", "distinct", "not valid",
                "evaluations", "births");
        for (size_t i = 0; i < r.count; i++) {
            const tn_generation_stats *s = &r.stats[i];
            show_events(&r, s->generation, out);
            fprintf(out, "%10u %14.6g %14.6g %9u %9u %12" PRIu64 " %12" PRIu64 "\n", s->generation, s->best[0], s->mean,
                    s->distinct, s->no_sentence + s->failed + s->limited, s->evaluations, s->births);
        }
        show_events(&r, (uint32_t)r.count, out);
    }
    clear_record(&r);
}

/* One run a line: where each came, and after how many evaluations it first had its best. */
static void compare(tn_job *job, FILE *out)
{
    const tn_option_list *dirs = &job->settings->operands;
    fprintf(out, "%-30s %10s %14s %14s %12s %14s\n", "run", "generation", "best", "mean", "evaluations",
            "best first at");
    for (size_t d = 1; d < dirs->count; d++) {
        record r;
        size_t first = 0;
        bool read = read_run(job, dirs->items[d], &r);
        if (read && r.count == 0)
            fprintf(out, "%-30s %10s\n", dirs->items[d], "none");
        if (read && r.count) {
            const tn_generation_stats *last = &r.stats[r.count - 1];
            while (first + 1 < r.count && r.stats[first].best[0] > last->best[0])
                first++;
            fprintf(out, "%-30s %10u %14.6g %14.6g %12" PRIu64 " %14u\n", dirs->items[d], last->generation,
                    last->best[0], last->mean, last->evaluations, r.stats[first].generation);
        }
        clear_record(&r);
    }
}

static void replay(tn_job *job, const char *dir, const char *id_text, FILE *out)
{
    tn_evolution_job evolved = {0};
    tn_run run = {0};
    tn_opened opened = {0};
    const tn_individual *individual;
    tn_error error = {0};
    uint64_t id;
    if (!tn_number_read(id_text, &id)) {
        tn_job_usage(job, "an individual is a number, not `%.60s`", id_text);
        return;
    }
    if (tn_run_replay(dir, id, &opened, &evolved, &run, &individual, &error) != TN_OK) {
        tn_job_fail(job, &error);
    } else {
        fprintf(out, "# individual %" PRIu64, id);
        if (individual->parents[0] != TN_NO_PARENT)
            fprintf(out, ", of %" PRIu64 " and %" PRIu64, individual->parents[0], individual->parents[1]);
        if (individual->score.state == TN_SCORED)
            fprintf(out, ", score %.17g", individual->score.objectives[0]);
        else
            fputs(", not scored", out);
        fputs("\n# genome:", out);
        for (size_t i = 0; i < individual->genome.count; i++)
            fprintf(out, " %" PRIu64, individual->genome.codons[i]);
        fprintf(out, "\n%s\n", individual->sentence);
    }
    tn_run_clear(&run);
    tn_evolution_job_clear(&evolved);
    tn_close(&opened);
}

/* ---- what is left for a run that goes on later */

/* A file's sentence goes into the run, or (NULL) the member is taken out. */
static void leave(tn_job *job, const char *kind, const char *file, uint64_t member)
{
    tn_evolution_job evolved = {0};
    tn_run run = {0};
    tn_opened opened = {0};
    tn_error error = {0};
    char *sentence = NULL;
    const char *dir = job->settings->operands.items[1];
    tn_status status = tn_run_leave(dir, kind, file, member, &opened, &evolved, &run, &sentence, &error);
    if (status == TN_OK) {
        tn_job_note(job, "this is done when the run goes on: --resume");
    } else if (sentence && error.line) {
        tn_job_status(job, status);
        tn_report_error(tn_job_diagnostics(job), &error, file, sentence, strlen(sentence));
    } else {
        tn_job_fail(job, &error);
    }
    free(sentence);
    tn_run_clear(&run);
    tn_evolution_job_clear(&evolved);
    tn_close(&opened);
}

static void insert(tn_job *job)
{
    const tn_option_number *place = &((const runs_settings *)job->settings)->in_place_of;
    leave(job, place->given ? "edit" : "insert", job->settings->operands.items[2],
          place->given ? place->value : TN_NO_PARENT);
}

static void take_out(tn_job *job)
{
    uint64_t id;
    const char *word = job->settings->operands.items[2];
    if (tn_number_read(word, &id))
        leave(job, "remove", NULL, id);
    else
        tn_job_usage(job, "an individual is a number, not `%.60s`", word);
}

/* ---- the command */

static void show_one(tn_job *job, FILE *out)
{
    show(job, job->settings->operands.items[1], out);
}

static void replay_one(tn_job *job, FILE *out)
{
    replay(job, job->settings->operands.items[1], job->settings->operands.items[2], out);
}

/* What the first word asks for. `writes` has an output, `does` none. */
static const struct task {
    const char *name;
    size_t words; /* behind it; 0: any number, at least one */
    const char *takes;
    void (*writes)(tn_job *job, FILE *out);
    void (*does)(tn_job *job);
} tasks[] = {
    {"show", 1, "one run's folder", show_one, NULL},
    {"compare", 0, "the folders of runs", compare, NULL},
    {"replay", 2, "a run's folder and the number of an individual", replay_one, NULL},
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
    const runs_settings *settings = (const runs_settings *)job->settings;
    tn_output output;
    if (task->words && job->settings->operands.count != 1 + task->words)
        tn_job_usage(job, "`tartan runs %s` takes %s", task->name, task->takes);
    else if (settings->in_place_of.given && task->does != insert)
        tn_job_usage(job, "--in-place-of is for `tartan runs insert`");
    else if (task->does && settings->output)
        tn_job_usage(job, "`tartan runs %s` has no output: leave -o out", task->name);
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
    OPTION_OUTPUT(TN_WRITES_TEXT),
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
