/* tartan new: a rule file to start from. */
#include <errno.h>
#include <string.h>

#include "cli/common/job.h"
#include "cli/common/option_rows.h"
#include "cli/source/starts.h"

typedef struct new_settings {
    tn_settings common;
    int schema; /* of the starts */
} new_settings;

/* Writes the file, where there is none of the name: two who begin at the same moment do not overwrite each other. */
static tn_status create(const char *path, const char *text, tn_error *error)
{
    FILE *file = fopen(path, "wx");
    if (!file && errno == EEXIST) {
        tn_fail(error, TN_IO, E_CANNOT_WRITE, "there is a file %.300s already, and it stays as it is", path);
        tn_error_help(error, "give another name");
        return TN_IO;
    }
    bool good = file && fputs(text, file) >= 0;
    int reason = errno;
    if (file && fclose(file) != 0 && good) {
        good = false;
        reason = errno;
    }
    if (good)
        return TN_OK;
    if (file)
        remove(path);
    return tn_fail(error, TN_IO, E_CANNOT_WRITE, "cannot write %.300s: %s", path, strerror(reason));
}

static bool is_plan(const char *path)
{
    size_t size = strlen(path);
    return size > 5 && strcmp(path + size - 5, ".plan") == 0 && path[size - 6] != '/';
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const new_settings *settings = (const new_settings *)common;
    const char *path = common->operands.items[0], *text = tn_starts[settings->schema];
    tn_job job;
    tn_output output;
    tn_error error;
    tn_job_begin(&job, common);
    if (strcmp(path, "-") == 0) {
        if (tn_job_output(&job, NULL, &output)) {
            fputs(text, output.stream);
            tn_job_commit(&job, &output);
        }
    } else if (!is_plan(path)) {
        tn_diagnostic *d = tn_job_usage(&job, "a file of rules for plans ends with .plan, and %.300s does not", path);
        tn_help(tn_job_diagnostics(&job), d, "`tartan new houses.plan`");
    } else if (create(path, text, &error) != TN_OK) {
        tn_job_fail(&job, &error);
    } else {
        tn_job_note(&job,
                    "%.300s is written; `tartan check --test %.300s` and `tartan count %.300s` are the next steps",
                    path, path, path);
    }
    return tn_job_end(&job);
}

#define SETTINGS new_settings
static const tn_option options[] = {
    CHOICE("schema", 0, "NAME", schema, TN_START_NAMES,
           "whose trays: own (a small schema of the file's own, in metres), lahave or terrace"),
};

const tn_command tn_command_new = {
    .name = "new",
    .summary = "write a rule file to start from",
    .usage = "FILE [--schema NAME]",
    .description =
        "Writes a short .plan file with comments: a schema or the use of one, rules, a measure, a library and tests. "
        "It "
        "compiles, counts and passes its tests as it is; change what you need. A file that exists is not overwritten. "
        "For - it is written to standard output.",
    .example = "$ tartan new clinic.plan\n$ tartan new houses.plan --schema lahave",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
