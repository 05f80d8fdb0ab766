/* tartan studio: runs the server of the studio, which is a program of its own beside this one: it needs a library that
 * takes longer to load than most commands take. */
#include "cli/studio/studio.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/job.h"
#include "cli/common/options.h"

enum { WORDS_MAX = 12, NUMBER_SIZE = 48 };

/* The words of the server's command line. */
typedef struct command_line {
    const char *words[WORDS_MAX + 1];
    size_t count;
    char port[NUMBER_SIZE], memory[NUMBER_SIZE];
} command_line;

static void add_number(command_line *line, const char *option, const tn_option_number *number, char text[NUMBER_SIZE])
{
    if (!number->given)
        return;
    snprintf(text, NUMBER_SIZE, "%s=%llu", option, (unsigned long long)number->value);
    line->words[line->count++] = text;
}

static void write_line(command_line *line, const char *program, const tn_studio_settings *settings)
{
    const tn_settings *common = &settings->common;
    line->words[line->count++] = program;
    add_number(line, "--port", &settings->port, line->port);
    add_number(line, "--memory-limit", &common->memory_limit, line->memory);
    if (settings->no_open)
        line->words[line->count++] = "--no-open";
    if (settings->read_only)
        line->words[line->count++] = "--read-only";
    if (common->diagnostics == 1)
        line->words[line->count++] = "--diagnostics=json";
    if (common->operands.count > 0) {
        line->words[line->count++] = "--";
        line->words[line->count++] = common->operands.items[0];
    }
    line->words[line->count] = NULL;
}

/* The server lies where this program does. False: that is not known. */
static bool find_program(char path[PATH_MAX])
{
    static const char name[] = "tartan-studio";
    ssize_t size = readlink("/proc/self/exe", path, PATH_MAX - 1);
    if (size <= 0)
        return false;
    path[size] = '\0';
    char *end = strrchr(path, '/') + 1;
    if ((size_t)(end - path) + sizeof name > PATH_MAX)
        return false;
    memcpy(end, name, sizeof name);
    return true;
}

/* Comes back only if it cannot be run. */
static void run_program(const tn_studio_settings *settings, tn_error *error)
{
    char path[PATH_MAX];
    command_line line = {.count = 0};
    errno = ENOENT;
    if (find_program(path)) {
        write_line(&line, path, settings);
        fflush(NULL);
        execv(path, (char *const *)(uintptr_t)line.words);
    }
    if (errno == ENOENT || errno == EACCES) {
        tn_fail(error, TN_INVALID, E_PROGRAM_MISSING, "the program tartan-studio does not lie beside this one");
        tn_error_help(error, "it is in the package tartan-studio: `apt install` the file of that name that "
                             "`make package` makes; a build has it with -DTARTAN_WITH_STUDIO=ON");
    } else {
        tn_fail(error, TN_IO, E_PROGRAM_MISSING, "the program %.300s cannot be run: %s", path, strerror(errno));
    }
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    tn_error error;
    run_program((const tn_studio_settings *)settings, &error);
    tn_job_begin(&job, settings);
    tn_job_fail(&job, &error);
    return tn_job_end(&job);
}

#define SETTINGS tn_studio_settings
static const tn_option options[] = {
    NUMBER("port", 0, "N", port, 1, 65535, "the port of the address (default: one that is free)"),
    FLAG("no-open", 0, no_open, "do not open the browser; the address is printed in any case"),
    FLAG("read-only", 0, read_only, "write no files"),
};

const tn_command tn_command_studio = {
    .name = "studio",
    .summary = "show rules and what they make in a browser, while you write",
    .usage = "[FOLDER | FILE] [--port N] [--read-only] [--no-open]",
    .description =
        "Serves a folder of rule files to your browser: a page on which you write rules and see at once which plans "
        "they keep. It prints the address, opens it, and ends at Ctrl-C. FILE is shown first, and its folder is "
        "served; without either it is the current folder.\n\n"
        "Only this machine can reach the address, and only who knows the whole of it: whoever does can read the "
        "folder's files and, without --read-only, write its rule files. Nothing outside of the folder is read or "
        "written.",
    .example = "$ tartan studio houses.plan",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "one FOLDER or FILE",
    .operands_max = 1,
    .serves = true,
    .run = run,
};
