/* Reads a command's options and runs it. */
#include "cli/common/program.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/common/help.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/memory_guard.h"
#include "cli/common/pipes.h"
#include "cli/common/terminal.h"

int tn_program_printed(void)
{
    const tn_settings settings = {0};
    tn_job job;
    tn_output output;
    tn_job_begin(&job, &settings);
    if (tn_job_output(&job, NULL, &output))
        tn_job_commit(&job, &output);
    return tn_job_end(&job);
}

int tn_program_refuse(const tn_settings *settings, const tn_error *error)
{
    tn_job job;
    tn_job_begin(&job, settings);
    tn_job_fail(&job, error);
    return tn_job_end(&job);
}

static void watch(const tn_command *command, const tn_settings *settings)
{
    tn_memory_guard_start(command, settings);
    if (command->serves)
        return;
    tn_interrupt_watch(settings->diagnostics == 1);
    const char *output = tn_settings_output(settings);
    if (output && strcmp(output, "-") != 0)
        tn_interrupt_last_words("interrupted; %.400s is not written", output);
    else
        tn_interrupt_last_words("interrupted before the end");
}

/* The library is asked for by its variable, wherever a kit is read. */
static tn_status use_library(const tn_settings *settings, tn_error *error)
{
    struct stat found;
    if (!settings->ldraw)
        return TN_OK;
    if (stat(settings->ldraw, &found) != 0 || !S_ISDIR(found.st_mode)) {
        tn_fail(error, TN_IO, E_CANNOT_READ, "there is no folder %.300s", settings->ldraw);
        tn_error_help(error, "--ldraw is the folder of an LDraw library, which has the folders parts and p");
        return TN_IO;
    }
    return setenv("LDRAWDIR", settings->ldraw, true) == 0 ? TN_OK : tn_fail_memory(error);
}

int tn_program_run(const tn_command *command, int count, char **words, const tn_ranks *ranks)
{
    tn_settings *settings = tn_settings_new(command);
    if (settings)
        settings->ranks = ranks;
    tn_error error;
    int exit_code;
    tn_status status = settings ? tn_options_parse(command, count, words, settings, &error) : tn_fail_memory(&error);
    if (status != TN_OK) {
        const tn_settings common = {.diagnostics = tn_options_diagnostics(count, words), .ranks = ranks};
        exit_code = tn_program_refuse(&common, &error);
    } else if (settings->help) {
        if (tn_ranks_lead(ranks))
            tn_help_command(command, stdout);
        exit_code = tn_program_printed();
    } else if (use_library(settings, &error) != TN_OK) {
        exit_code = tn_program_refuse(settings, &error);
    } else {
        watch(command, settings);
        tn_pipes_announce(settings);
        exit_code = command->run(command, settings);
    }
    tn_settings_free(command, settings);
    return exit_code;
}

/* Standard input, output and error, where they are closed, are not to be the next files that are opened: they become
 * ones that reading and writing fails on. */
static void keep_standard_descriptors(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
            return;
}

void tn_program_begin(void)
{
    keep_standard_descriptors();
    tn_terminal_guard();
    signal(SIGPIPE, SIG_IGN); /* a closed pipe shows as EPIPE, which commands end on quietly */
    signal(SIGXFSZ, SIG_IGN); /* a file beyond `ulimit -f` shows as EFBIG, an error like that of a full disk */
}
