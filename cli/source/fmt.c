/* tartan fmt: lays rule files out the canonical way. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/job.h"
#include "cli/common/line_diff.h"
#include "cli/common/options.h"
#include "compiler/format.h"

typedef struct fmt_settings {
    tn_settings common;
    bool check, diff;
    int notation; /* 0: what the file's name says; otherwise one more than a notation that has a layout */
} fmt_settings;

static const fmt_settings *settings_of(const tn_job *job)
{
    return (const fmt_settings *)job->settings;
}

/* What the option says, in the order of its choices; else what the name does; else the first. */
static const tn_notation *notation_of(const fmt_settings *settings, const char *path, const char *text, size_t size)
{
    const char *language = NULL;
    for (size_t i = 0, choice = 0; i < tn_notation_count && settings->notation; i++) {
        choice += tn_notation_is_main(&tn_notations[i]);
        if (choice == (size_t)settings->notation && !language)
            language = tn_notation_language(&tn_notations[i]);
    }
    return language ? tn_notation_of_language(language, text, size) : tn_notation_or_first(path, text, size);
}

/* The others than the first: "hemls, study or bnf". */
static void list_others(char *text, size_t size)
{
    size_t last = tn_notation_count, used = 0;
    while (last > 1 && !tn_notation_is_main(&tn_notations[last - 1]))
        last--;
    for (size_t i = 1; i < last && used < size; i++)
        if (tn_notation_is_main(&tn_notations[i]))
            used += (size_t)snprintf(text + used, size - used, "%s%s",
                                     i == 1          ? ""
                                     : i == last - 1 ? " or "
                                                     : ", ",
                                     tn_notation_language(&tn_notations[i]));
}

static void write_text(tn_job *job, const char *path, const char *text, size_t size)
{
    tn_output output;
    if (!tn_job_output(job, path, &output))
        return;
    fwrite(text, 1, size, output.stream);
    tn_job_commit(job, &output);
}

static void write_diff(tn_job *job, const char *path, const char *old_text, const char *new_text)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    if (tn_line_diff(path, "formatted", old_text, new_text, output.stream)) {
        tn_job_commit(job, &output);
        return;
    }
    tn_error error;
    tn_fail_memory(&error);
    tn_job_fail(job, &error);
    tn_output_discard(&output);
}

/* What to do with a file whose layout is `formatted`. */
static void deliver(tn_job *job, const char *path, const char *text, const char *formatted, size_t size)
{
    const fmt_settings *settings = settings_of(job);
    bool same = strcmp(text, formatted) == 0, report = settings->check || settings->diff;
    if (!report && strcmp(path, "-") == 0)
        write_text(job, NULL, formatted, size);
    else if (!report && !same)
        write_text(job, path, formatted, size);
    if (!report || same)
        return;
    tn_job_status(job, settings->check ? TN_INVALID : TN_OK);
    if (settings->diff)
        write_diff(job, path, text, formatted);
    else
        tn_job_note(job, "%.400s is not in the canonical layout", path);
}

static void format_file(tn_job *job, const char *path)
{
    uint8_t *bytes;
    size_t size, formatted_size;
    char *formatted;
    tn_error error;
    if (tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &size, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return;
    }
    const char *text = (const char *)bytes;
    tn_job_status(job, tn_format_text(tn_job_diagnostics(job), notation_of(settings_of(job), path, text, size), path,
                                      text, size, &formatted, &formatted_size));
    if (!formatted && !settings_of(job)->notation && !tn_notation_of(path, text, size)) {
        char others[160] = "";
        list_others(others, sizeof others);
        tn_job_note(job, "%.200s was read as %s, as its name says nothing else; --notation %s does", path,
                    tn_notations[0].extension, others);
    }
    if (formatted)
        deliver(job, path, text, formatted, formatted_size);
    free(formatted);
    free(bytes);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_job_begin(&job, common);
    for (size_t i = 0; i < common->operands.count; i++) {
        if (i > 0)
            tn_job_next(&job);
        format_file(&job, common->operands.items[i]);
    }
    return tn_job_end(&job);
}

static const char languages[] = "auto"
#define NOTATION(ID, ...) "|" #ID
#define VARIANT(...)
#include "compiler/notations.def"
    ;

#define SETTINGS fmt_settings
static const tn_option options[] = {
    FLAG("check", 0, check, "change nothing; say which files are laid out otherwise, and exit with 1 where one is"),
    FLAG("diff", 0, diff, "change nothing; show what would be changed"),
    CHOICE("notation", 0, "NAME", notation, languages,
           "which notation it is: for standard input, and where a file's name does not say (auto: by the name, else "
           "plan)"),
};

const tn_command tn_command_fmt = {
    .name = "fmt",
    .summary = "format rule files",
    .usage = "FILE...",
    .description =
        "Formats rule files ("
#define FIRST_NOTATION(ID, EXTENSION, ...) EXTENSION
#define NOTATION(ID, EXTENSION, ...) ", " EXTENSION
#define VARIANT(...)
#include "compiler/notations.def"
        ") in place. A file is written beside the old one and then renamed over it. Comments, parentheses and the "
        "spelling of lengths stay, and so does an empty line between two items. The meaning of a file never changes, "
        "and a file with a syntax error is not touched. For - standard input is formatted to standard output.",
    .example = "$ tartan fmt houses.plan\n$ tartan fmt --check *.plan *.study\n"
               "$ tartan fmt --notation hemls - <square.hemls",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "at least one FILE",
    .operands_min = 1,
    .operands_max = SIZE_MAX,
    .run = run,
};
