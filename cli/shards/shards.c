/* tartan shards: a library written by any number of workers, on any machines, with the bytes of one. */
#include "cli/shards/shards.h"

#include <string.h>

#include "cli/common/option_rows.h"
#include "runtime/base/nearest.h"

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
    {"run", " shard part threads for stale ", true, tn_shards_run_set},
    {"status", " stale output ", false, tn_shards_status},
    {"check", " threads output ", true, tn_shards_check_set},
    {"cat", " threads output ", true, tn_shards_cat},
    {"merge", " threads output ", true, tn_shards_merge},
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
    tn_shards_close_library(&open);
    int code = tn_job_end(&job);
    tn_shards_clear(&open);
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
    NUMBER("plans", 0, "N", each, 1, 0, "new: make shards of N plans each"),
    RANK("from", 0, "RANK", from, "new: the first rank (default 0)"),
    RANK("to", 0, "RANK", to, "new: one past the last rank (default: all)"),
    NUMBER("sample", 0, "N", sample, 0, TN_SHARDS_SAMPLE_MAX,
           "new: only N plans, the same that `tartan sample` draws from all of them"),
    NUMBER("seed", 's', "S", seed, 0, 0, "new: which sample: the same seed gives the same plans (default 0)"),
    FLAG("uniform", 0, uniform, "new: the sample has each plan as likely as each, also if the library has weights"),
    CHOICE("format", 'f', "FORMAT", written.format, "auto|lines|json|csv|bin|sqlite|parquet|names|bits|any",
           "new: what the shards are: lines (the default), json, csv, bin or parquet; of a match names (the default), "
           "json, bits or any; of a prune lines (the default) or json"),
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
