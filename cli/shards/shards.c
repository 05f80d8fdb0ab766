/* tartan shards: a library written by any number of workers, on any machines, with the bytes of one. */
#include "cli/shards/shards.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/options.h"
#include "cli/common/progress.h"
#include "driver/shards/gather.h"
#include "driver/shards/manifest.h"
#include "driver/shards/run.h"
#include "runtime/base/nearest.h"

/* ---- opening a set */

#define STALE_DEFAULT 600.0

/* How many threads the options ask for: by default as many as there are processors, and one on each of several ranks.
 */
static unsigned shards_threads(const tn_job *job)
{
    const tn_plan_settings *plans = &tn_shards_settings_of(job)->plans;
    return job->settings->ranks && !plans->threads.given ? 1 : tn_job_threads(plans);
}

/* Houses of a library are counted by one thread: several processes write several shards at a time. */
static unsigned writing_threads(const tn_job *job, const tn_shard_set *set)
{
    return tn_shard_set_houses(set) ? 1 : shards_threads(job);
}

/* Reads the manifest of the set that the second operand names. False where that failed (then end the job). */
static bool tn_shards_read(tn_job *job, tn_shards_open *open)
{
    tn_error error;
    tn_status status = tn_shard_set_read(job->settings->operands.items[1], &open->set, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

static bool make_ready(tn_job *job, tn_shards_open *open)
{
    tn_library_options options = open->set.options;
    tn_progress progress;
    options.threads = shards_threads(job);
    tn_progress_watch(&progress, "clauses combined", tn_interrupt_waiting());
    tn_status status = tn_library_ready(&job->opened, open->set.library, &options, &open->ready);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    tn_job_status(job, status);
    return status == TN_OK;
}

static tn_status ready_rules(tn_job *job, tn_shards_open *open, const tn_rules_options *options, tn_error *error)
{
    const tn_shard_inputs *inputs = &open->set.inputs;
    tn_status status = tn_matched_new(job->opened.module, open->rules.indices, open->rules.count, open->rules.schema,
                                      options, inputs->answer, &open->matched, error);
    open->answering = tn_matched_answering(&open->matched);
    return status;
}

static tn_status ready_clauses(tn_job *job, tn_shards_open *open, const tn_rules_options *options, tn_error *error)
{
    tn_status status = tn_pruned_new(job->opened.module, &open->ready, &open->set.options, options,
                                     open->set.inputs.answer, &open->pruned, error);
    open->answering = tn_pruned_answering(&open->pruned);
    return status;
}

bool tn_shards_ready_answers(tn_job *job, tn_shards_open *open)
{
    const tn_shard_set *set = &open->set;
    const tn_texts asked = {(void *)set->inputs.rules, set->inputs.rule_count};
    const tn_rules_options options = {.max_states = set->options.max_states, .max_length = set->options.max_length};
    bool matches = set->task == TN_TASK_MATCH;
    tn_error error;
    if (matches && !tn_job_answered(job, tn_session_rules(&job->session, &asked,
                                                          "name one of those it uses with --rule", &open->rules)))
        return false;
    if (!matches) {
        tn_status chosen = tn_library_ready(&job->opened, set->library, NULL, &open->ready);
        tn_job_status(job, chosen);
        if (chosen != TN_OK)
            return false;
    }
    tn_status status = matches ? ready_rules(job, open, &options, &error) : ready_clauses(job, open, &options, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

static bool make_ready_for(tn_job *job, tn_shards_open *open)
{
    if (tn_shard_set_houses(&open->set))
        return tn_shards_ready_houses(job, open);
    return tn_shard_set_answers(&open->set) ? tn_shards_ready_answers(job, open) : make_ready(job, open);
}

bool tn_shards_open_rules(tn_job *job, tn_shards_open *open)
{
    tn_error error;
    open->module = tn_shard_set_path(&open->set, TN_MODULE_NAME);
    tn_status status = open->module ? tn_shard_set_module_same(&open->set, &error) : tn_fail_memory(&error);
    if (status == TN_OK) {
        if (!tn_job_open(job, open->module) || !make_ready_for(job, open))
            return false;
        bool houses = tn_shard_set_houses(&open->set);
        const tn_schema *schema = houses               ? open->houses.schema
                                  : open->ready.schema ? open->ready.schema
                                                       : open->matched.schema;
        status = tn_shard_set_agrees(&open->set, schema, houses ? open->houses.plans : open->ready.library, &error);
    }
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

static void shards_close_library(tn_shards_open *open)
{
    tn_matched_clear(&open->matched);
    tn_pruned_clear(&open->pruned);
    tn_chosen_rules_clear(&open->rules);
    tn_library_close(&open->ready);
    if (open->houses.session)
        tn_numbered_close(&open->houses);
}

static void shards_clear(tn_shards_open *open)
{
    tn_shard_set_clear(&open->set);
    free(open->module);
}

/* ---- times */

/* Reads a time: 90, 90s, 55m, 2h or 1d, in seconds. False where the text is none. */
static bool time_read(const char *text, double *seconds)
{
    static const struct {
        const char *unit;
        double seconds;
    } units[] = {{"", 1}, {"s", 1}, {"m", 60}, {"h", 3600}, {"d", 86400}};
    size_t digits = strspn(text, "0123456789.");
    char *end;
    *seconds = strtod(text, &end);
    if (digits == 0 || end != text + digits || !isfinite(*seconds) || *seconds <= 0)
        return false;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strcmp(end, units[i].unit) == 0) {
            *seconds *= units[i].seconds;
            return true;
        }
    }
    return false;
}

bool tn_shards_stale(tn_job *job, double *seconds)
{
    const char *text = tn_shards_settings_of(job)->stale;
    *seconds = STALE_DEFAULT;
    if (!text || time_read(text, seconds))
        return true;
    tn_diagnostic *d = tn_job_usage(job, "--stale needs a time, not `%.60s`", text);
    tn_help(tn_job_diagnostics(job), d, "write 90s, 10m or 2h");
    return false;
}

/* ---- cat, merge */

static void gather(tn_job *job, tn_shards_open *open, const char *output, tn_plan_format format)
{
    const tn_gathering gathering = {&open->set, &job->opened,          &open->ready, output ? output : "-",
                                    format,     tn_interrupt_waiting()};
    tn_progress progress;
    tn_error error;
    tn_progress_watch(&progress, "shards read", gathering.watch);
    tn_status status = tn_shards_gather(&gathering, &error);
    tn_progress_unwatch(&progress, gathering.watch);
    if (status != TN_OK)
        tn_job_fail(job, &error);
}

/* What the shards hold is written as it is. */
static tn_file_formats format_of(const tn_shard_set *set)
{
    static const tn_file_formats formats[TN_FORMAT_COUNT] = {[TN_FORMAT_LINES] = TN_WRITES_TEXT,
                                                             [TN_FORMAT_JSON] = TN_WRITES(JSON),
                                                             [TN_FORMAT_CSV] = TN_WRITES(CSV),
                                                             [TN_FORMAT_BIN] = TN_WRITES(BIN),
                                                             [TN_FORMAT_PARQUET] = TN_WRITES(PARQUET)};
    if (tn_shard_set_answers(set))
        return TN_WRITES_TEXT | (set->inputs.answer == TN_ANSWER_JSON ? TN_WRITES(JSON) : 0);
    return TN_WRITES_TEXT | formats[set->format];
}

static void shards_cat(tn_job *job, tn_shards_open *open)
{
    const char *output = tn_shards_settings_of(job)->written.output;
    if (!tn_job_writes(job, "what this set holds", output, format_of(&open->set)))
        return;
    if (tn_shard_set_houses(&open->set))
        tn_shards_gather_houses(job, open, output, TN_FORMAT_CSV);
    else
        gather(job, open, output, open->set.format);
}

static void shards_merge(tn_job *job, tn_shards_open *open)
{
    const char *output = tn_shards_settings_of(job)->written.output;
    if (tn_shard_set_answers(&open->set))
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "the shards hold answers, of which no database is made"),
                "`tartan shards cat SET -o FILE` writes all of them");
    else if (output && strcmp(output, "-") != 0) {
        if (!tn_job_writes(job, "a database", output, TN_WRITES(SQLITE) | TN_WRITES_ASKED))
            return;
        if (tn_shard_set_houses(&open->set))
            tn_shards_gather_houses(job, open, output, TN_FORMAT_SQLITE);
        else
            gather(job, open, output, TN_FORMAT_SQLITE);
    } else
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "a database is a file, and none is named"),
                "name it: -o FILE.sqlite; `tartan shards cat` writes to standard output");
}

/* ---- run */

/* Reads I/N of --part: 1 <= I <= N. */
static bool read_part(const char *text, uint64_t *part, uint64_t *parts)
{
    char first[24];
    size_t digits = strcspn(text, "/");
    if (text[digits] != '/' || digits >= sizeof first)
        return false;
    memcpy(first, text, digits);
    first[digits] = '\0';
    return tn_number_read(first, part) && tn_number_read(text + digits + 1, parts) && *part >= 1 && *part <= *parts &&
           *parts <= UINT32_MAX;
}

/* Which shards: all, one, or one of several equal parts. */
static bool choose_shards(tn_job *job, tn_shards_job *work)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    uint64_t part = 1, parts = 1, count = work->set->count;
    tn_diagnostic *d = NULL;
    if (settings->shard.given && settings->part)
        d = tn_job_usage(job, "--shard and --part cannot be given together");
    else if (settings->shard.given && settings->shard.value >= count)
        tn_help(tn_job_diagnostics(job), d = tn_job_usage(job, "there is no shard %" PRIu64, settings->shard.value),
                "the shards are 0 to %" PRIu64, count - 1);
    else if (settings->part && !read_part(settings->part, &part, &parts))
        tn_help(tn_job_diagnostics(job), d = tn_job_usage(job, "--part needs I/N, not `%.60s`", settings->part),
                "the first of four parts is 1/4, the last 4/4");
    bool one = settings->shard.given;
    work->begin = one ? (uint32_t)settings->shard.value : (uint32_t)(count * (part - 1) / parts);
    work->end = one ? work->begin + 1 : (uint32_t)(count * part / parts);
    return !d;
}

static bool choose_time(tn_job *job, tn_shards_job *work)
{
    const char *text = tn_shards_settings_of(job)->time;
    if (!tn_shards_stale(job, &work->stale))
        return false;
    if (!text || time_read(text, &work->seconds))
        return true;
    tn_help(tn_job_diagnostics(job), tn_job_usage(job, "--for needs a time, not `%.60s`", text),
            "write 90s, 55m or 2h");
    return false;
}

static void tell(tn_job *job, const tn_shards_done *done)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    const char *plural = done->written == 1 ? "" : "s",
               *asked = settings->part || settings->shard.given ? " that were asked for" : "";
    if (done->unread > 0)
        tn_job_status(job, TN_INVALID);
    job->said = true; /* also on ranks that leave it to the first */
    if (!tn_ranks_lead(job->settings->ranks))
        return;
    if (job->stopped)
        tn_job_interrupted(job, "interrupted; %u shard%s written, %u to go: `tartan shards run` goes on with them",
                           done->written, plural, done->left);
    else if (done->left > 0)
        tn_job_note(job, "%u shard%s written, %u to go%s", done->written, plural, done->left,
                    done->ended         ? ": a signal asked for the end; `tartan shards run` goes on with them"
                    : done->out_of_time ? ": time is up"
                                        : "");
    else if (done->written == 0)
        tn_job_note(job, "all shards%s are there already; `tartan shards check` reads whether they are whole", asked);
    else
        tn_job_note(job, "%u shard%s written; all%s are there", done->written, plural, asked);
    if (done->unread > 0)
        tn_job_note(job, "%" PRIu64 " plan%s could not be read; `tartan shards status` lists them", done->unread,
                    done->unread == 1 ? "" : "s");
}

/* Do all ranks work on the same set? */
static bool same_set(tn_job *job, const tn_shard_set *set)
{
    tn_error error;
    if (tn_ranks_same(job->settings->ranks, "the shard set", set->hash, &error) == TN_OK)
        return true;
    tn_job_fail(job, &error);
    return false;
}

static void shards_run_set(tn_job *job, tn_shards_open *open)
{
    const tn_ranks *ranks = job->settings->ranks;
    const tn_shard_houses houses = {open, tn_shards_write_houses};
    tn_shards_job work = {.set = &open->set,
                          .opened = &job->opened,
                          .ready = &open->ready,
                          .answering = &open->answering,
                          .houses = &houses,
                          .threads = writing_threads(job, &open->set),
                          .watch = tn_interrupt_waiting(),
                          .last = tn_interrupt_gently(ranks != NULL, false),
                          .ranks = ranks};
    tn_progress progress;
    tn_shards_done done;
    tn_error error;
    if (!choose_shards(job, &work) || !choose_time(job, &work) || !same_set(job, &open->set))
        return;
    tn_interrupt_last_words("interrupted; shards are there whole or not at all: `tartan shards run` goes on");
    tn_progress_begin(&progress, "shards", 0, 0);
    if (tn_ranks_lead(ranks))
        tn_progress_watch(&progress, "shards", work.watch);
    tn_status status = tn_shards_run(&work, &done, &error);
    if (tn_ranks_lead(ranks))
        tn_progress_unwatch(&progress, work.watch);
    if (status == TN_STOPPED)
        tn_interrupt_answered();
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tell(job, &done);
}

/* ---- the command */

/* What the command does, by its first word. */
typedef struct shards_part {
    const char *name;
    const char *options; /* those that it takes, with blanks around each */
    bool opens;          /* the module and the library of the set */
    void (*run)(tn_job *job, tn_shards_open *open);
} shards_part;

static void run_new(tn_job *job, tn_shards_open *open)
{
    if (tn_shards_settings_of(job)->task == TN_TASK_ENUMERATE)
        tn_shards_new(job);
    else
        tn_shards_new_answers(job, open);
}

static const shards_part parts[] = {
    {"new",
     " task input rule input-format on-error library where set trays max-length max-states threads shards plans from "
     "to "
     "sample seed uniform "
     "format compress plan-lines row-group output ",
     false, run_new},
    {"run", " shard part threads for stale ", true, shards_run_set},
    {"status", " stale output ", false, tn_shards_status},
    {"check", " threads output ", true, tn_shards_check_set},
    {"cat", " threads output ", true, shards_cat},
    {"merge", " threads output ", true, shards_merge},
};
#define PARTS (sizeof parts / sizeof *parts)

static const shards_part *find_part(tn_job *job)
{
    const char *word = job->settings->operands.items[0], *names[PARTS];
    for (size_t i = 0; i < PARTS; i++) {
        names[i] = parts[i].name;
        if (strcmp(parts[i].name, word) == 0)
            return &parts[i];
    }
    const char *near = tn_nearest(word, names, PARTS);
    tn_diagnostic *d = tn_job_usage(job, "`tartan shards` does not know `%.60s`", word);
    if (near)
        tn_help(tn_job_diagnostics(job), d, "did you mean `tartan shards %s`?", near);
    else
        tn_help(tn_job_diagnostics(job), d, "it knows new, run, status, check, cat and merge");
    return NULL;
}

/* Is every option that was given one that the part takes? */
static bool takes_options(tn_job *job, const shards_part *part)
{
    const tn_command *command = job->settings->command;
    for (size_t i = 0; i < command->option_count; i++) {
        char wanted[40];
        snprintf(wanted, sizeof wanted, " %s ", command->options[i].name);
        if (strstr(part->options, wanted) || !tn_option_given(&command->options[i], job->settings))
            continue;
        tn_diagnostic *d = tn_job_usage(job, "`tartan shards %s` takes no --%s", part->name, command->options[i].name);
        if (strcmp(command->options[i].name, "set") == 0)
            tn_help(tn_job_diagnostics(job), d, "params keep the values with which `tartan shards new` made the set");
        return false;
    }
    return true;
}

/* Words behind --input FILE are inputs too. */
static bool takes_operands(tn_job *job, const shards_part *part)
{
    size_t count = job->settings->operands.count;
    if (count == 2 || (count > 2 && tn_shards_settings_of(job)->inputs.count > 0))
        return true;
    bool makes = strcmp(part->name, "new") == 0;
    tn_diagnostic *d = tn_job_usage(job, "`tartan shards %s` takes one %s", part->name, makes ? "rule file" : "set");
    if (count < 2)
        tn_help(tn_job_diagnostics(job), d, "name it: tartan shards %s %s", part->name,
                makes ? "FILE -o SET --shards N" : "SET");
    else if (makes && tn_shards_settings_of(job)->compress) /* a word behind it that it does not know is an operand */
        tn_help(tn_job_diagnostics(job), d,
                "--compress knows zstd alone, which need not be written; `%.60s` and "
                "`%.60s` are taken for rule files",
                job->settings->operands.items[1], job->settings->operands.items[2]);
    else if (makes)
        tn_help(tn_job_diagnostics(job), d, "files of plans come behind --input, with --task match or --task prune");
    else
        tn_help(tn_job_diagnostics(job), d, "run it once for each: tartan shards %s %.200s", part->name,
                job->settings->operands.items[1]);
    return false;
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    tn_shards_open open = {0};
    tn_job_begin(&job, settings);
    const shards_part *part = find_part(&job);
    if (part && takes_operands(&job, part) && takes_options(&job, part)) {
        bool reads = strcmp(part->name, "new") != 0;
        bool well = !reads || (tn_shards_read(&job, &open) && (!part->opens || tn_shards_open_rules(&job, &open)));
        if (tn_job_agree(&job, well))
            part->run(&job, &open);
    }
    shards_close_library(&open);
    int code = tn_job_end(&job);
    shards_clear(&open);
    return code;
}

#define SETTINGS tn_shards_settings
static const tn_option options[] = {
    CHOICE("task", 0, "TASK", task, "enumerate|match|prune",
           "new: what the shards hold: the plans of a library (the default), or what `tartan match` or `tartan prune` "
           "says of the plans of --input"),
    LIST("input", 'i', "FILE", inputs, "new: a file of plans to match or prune; more of them may follow"),
    LIST("rule", 'r', "NAME", rules, "new: match this rule; may be repeated (default: all rules of the file itself)"),
    OPTION_INPUT_FORMAT,
    OPTION_ON_ERROR,
    OPTIONS_LIBRARY,
    NUMBER("shards", 0, "N", shards, 1, 0, "new: divide the plans among N shards; inputs among about N"),
    NUMBER("plans", 0, "N", each, 1, 0, "new: make shards of N plans, or houses, each"),
    RANK("from", 0, "RANK", from, "new: the first rank (default 0)"),
    RANK("to", 0, "RANK", to, "new: one past the last rank (default: all)"),
    NUMBER("sample", 0, "N", sample, 0, TN_SHARDS_SAMPLE_MAX,
           "new: only N plans, the same that `tartan sample` draws from all of them"),
    NUMBER("seed", 's', "S", seed, 0, 0, "new: which sample: the same seed gives the same plans (default 0)"),
    FLAG("uniform", 0, uniform, "new: the sample has each plan as likely as each, also if the library has weights"),
    CHOICE("format", 'f', "FORMAT", written.format, "auto|lines|json|csv|bin|sqlite|parquet|names|bits|any",
           "new: what the shards are: lines (the default), json, csv, bin or parquet; of a match names (the default), "
           "json, bits or any; of a prune lines (the default) or json; of houses csv (the default) or parquet"),
    MAYBE("compress", 0, "HOW", compress, "zstd", "new: compress the shards"),
    FLAG("plan-lines", 0, written.plan_lines, "new: in Parquet, add a column of plan lines"),
    NUMBER("row-group", 0, "N", written.row_group, 1, UINT32_MAX,
           "new: in Parquet, plans of a row group (default 1000000)"),
    TEXT("output", 'o', "FILE", written.output,
         "new: the folder of the set; merge: the database to make, a .sqlite; otherwise the file to write, a .csv of a "
         "set in "
         "CSV"),
    NUMBER("shard", 0, "I", shard, 0, 0, "run: write only shard I; the first is 0"),
    TEXT("part", 0, "I/N", part, "run: write only the I-th of N equal parts of the shards"),
    TEXT("for", 0, "TIME", time, "run: begin no shard that would end after TIME: 90s, 55m, 2h"),
    TEXT("stale", 0, "TIME", stale, "take a shard over from a worker that was silent for TIME (default 10m)"),
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_shards = {
    .name = "shards",
    .summary = "write a library by many workers, on many machines",
    .usage = "new FILE -o SET (--shards N | --plans N) [--from RANK] [--to RANK] [--format FORMAT]\n"
             "new FILE -o SET --sample N [--seed S] --shards N\n"
             "new FILE -o SET --library HOUSES (--shards N | --plans N) [--format csv|parquet]\n"
             "new FILE -o SET --task match --input PLANS... --shards N [--rule NAME]...\n"
             "new FILE -o SET --task prune --input PLANS... --shards N [--library NAME]\n"
             "run SET [--shard I | --part I/N] [--threads N] [--for TIME]\nstatus SET\ncheck SET\ncat SET [-o FILE]\n"
             "merge SET -o FILE.sqlite",
    .description =
        "A shard set is a folder. new makes it: manifest.json says which ranks of the library are in which shard, and "
        "rules.tnb is the compiled rule file. run writes the shards that are not there yet, until none is left. Start "
        "it as often as you like, at the same time, on any machines that share the folder. Each shard appears whole or "
        "not at all, so a worker may be killed at any moment, and run again. SIGUSR1 ends it after the shards that it "
        "has begun.\n\n"
        "status says how many shards are there, and who writes which. check reads all of them, and compares them with "
        "the manifest. cat writes the bytes that one `tartan enumerate`, `match` or `prune` would write, or one "
        "`tartan sample`. merge makes "
        "one database of all "
        "shards.\n\n"
        "With --sample the shards hold the plans that `tartan sample` would draw, for samples that one machine has no "
        "room for: each worker draws all numbers and keeps those of its shard, so choose about as many shards as "
        "workers.\n\n"
        "If --library names a library of houses, a shard is three tables, as `tartan enumerate --columns` writes them: "
        "000000.houses.csv, 000000.rooms.csv and 000000.faces.csv. Each worker writes one shard at a time. cat and "
        "merge put tables of CSV together; those of Parquet are read where they are.\n\n"
        "With --task match or prune the shards hold answers about the plans of large files. Lines are divided near "
        "equal numbers of bytes, packed plans between plans, and Parquet between row groups. CSV, databases and "
        "compressed files have one shard each. A file may not change until all shards are there. status lists plans "
        "that could not be read.",
    .example =
        "$ tartan shards new terrace -o terrace.set --plans 1000000 --to 8000000\n$ tartan shards run terrace.set\n$ "
        "tartan shards cat terrace.set -o terrace.plans",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "give fewer trays with --trays",
    .operands = "new, run, status, check, cat or merge, and a rule file or a set",
    .operands_min = 1,
    .operands_max = SIZE_MAX,
    .run = run,
};
