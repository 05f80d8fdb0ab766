/* tartan: picks the command, reads its options, runs it. */
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/completion.h"
#include "cli/common/help.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/manual.h"
#include "cli/common/memory_guard.h"
#include "cli/common/options.h"
#include "cli/common/pipes.h"
#include "cli/common/terminal.h"

/* Help and version go to standard output like any result: a full disk is an error, a closed pipe is not. */
static int written(void)
{
    const tn_settings settings = {0};
    tn_job job;
    tn_output output;
    tn_job_begin(&job, &settings);
    if (tn_job_output(&job, NULL, &output))
        tn_job_commit(&job, &output);
    return tn_job_end(&job);
}

static int refuse(const tn_settings *settings, const tn_error *error)
{
    tn_job job;
    tn_job_begin(&job, settings);
    tn_job_fail(&job, error);
    return tn_job_end(&job);
}

static int unknown_command(const char *name, int count, char **words)
{
    const tn_settings settings = {.diagnostics = tn_options_diagnostics(count, words)};
    const char *names[64];
    for (size_t i = 0; i < tn_commands_count; i++)
        names[i] = tn_commands[i]->name;
    tn_error error;
    tn_fail(&error, TN_INVALID, E_USAGE,
            name[0] == '-' ? "`tartan` has no option %.60s" : "there is no command `%.60s`", name);
    const char *near = tn_nearest(name, names, tn_commands_count), *later = NULL;
    for (int i = 0; i < count && !later; i++)
        later = tn_command_find(words[i]) ? words[i] : NULL;
    if (near)
        tn_error_help(&error, "did you mean `tartan %s`?", near);
    else if (later)
        tn_error_help(&error, "the command comes first: tartan %s %.60s", later, name);
    else if (access(name, F_OK) == 0)
        tn_error_help(&error, "the command comes before the file: tartan check %.200s", name);
    else
        tn_error_help(&error, "`tartan help` lists the commands");
    return refuse(&settings, &error);
}

/* `manual`: as a manual page (the build installs them), not for reading here. */
static int help(const char *name, bool manual)
{
    const tn_command *command = name ? tn_command_find(name) : NULL;
    if (name && !command)
        return unknown_command(name, 0, NULL);
    if (manual && command)
        tn_manual_command(command, stdout);
    else if (manual)
        tn_manual_overview(stdout);
    else if (command)
        tn_help_command(command, stdout);
    else
        tn_help_overview(stdout);
    return written();
}

/* Completion for a shell (the build installs them). */
static int completion(const char *name)
{
    const tn_shell *shell = name ? tn_shell_find(name) : NULL;
    if (shell) {
        shell->write(stdout);
        return written();
    }
    const tn_settings settings = {0};
    tn_error error;
    tn_fail(&error, TN_INVALID, E_USAGE, "there is completion for bash, zsh and fish%s%.60s", name ? ", not for " : "",
            name ? name : "");
    tn_error_help(&error, "tartan help --completion bash");
    return refuse(&settings, &error);
}

/* An editor's server has nothing to lose, and ends at once. */
static void watch(const tn_command *command, const tn_settings *settings)
{
    tn_memory_guard_start(command, settings);
    if (strcmp(command->name, "lsp") == 0)
        return;
    tn_interrupt_watch(settings->diagnostics == 1);
    const char *output = tn_settings_output(settings);
    if (output && strcmp(output, "-") != 0)
        tn_interrupt_last_words("interrupted; %.400s is not written", output);
    else
        tn_interrupt_last_words("interrupted before the end");
}

static int run(const tn_command *command, int count, char **words)
{
    tn_settings *settings = tn_settings_new(command);
    tn_error error;
    int exit_code;
    tn_status status = settings ? tn_options_parse(command, count, words, settings, &error) : tn_fail_memory(&error);
    if (status != TN_OK) {
        const tn_settings common = {.diagnostics = tn_options_diagnostics(count, words)};
        exit_code = refuse(&common, &error);
    } else if (settings->help) {
        exit_code = help(command->name, false);
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

int main(int argc, char **argv)
{
    keep_standard_descriptors();
    tn_terminal_guard();
    signal(SIGPIPE, SIG_IGN); /* a closed pipe shows as EPIPE, which commands end on quietly */
    signal(SIGXFSZ, SIG_IGN); /* a file beyond `ulimit -f` shows as EFBIG, an error like that of a full disk */
    if (argc < 2) {
        tn_help_overview(stderr);
        return TN_EXIT_USAGE;
    }
    const char *name = argv[1];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0)
        return help(NULL, false);
    if (strcmp(name, "help") == 0) {
        if (argc > 2 && strcmp(argv[2], "--completion") == 0)
            return completion(argc > 3 ? argv[3] : NULL);
        bool manual = argc > 2 && strcmp(argv[2], "--man") == 0;
        return help(argc > 2 + manual ? argv[2 + manual] : NULL, manual);
    }
    if (strcmp(name, "--version") == 0) {
        puts("tartan " TARTAN_VERSION);
        return written();
    }
    const tn_command *command = tn_command_find(name);
    return command ? run(command, argc - 2, argv + 2) : unknown_command(name, argc - 2, argv + 2);
}
