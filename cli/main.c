/* tartan: picks the command, reads its options, runs it. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "ask/questions.h"
#include "cli/commands.h"
#include "cli/common/completion.h"
#include "cli/common/help.h"
#include "cli/common/job.h"
#include "cli/common/program.h"

/* Questions that a command of another name asks. */
static const struct {
    const char *question, *command;
} asked_otherwise[] = {
    {"format", "`tartan fmt`"},
    {"coverage", "`tartan test --coverage`"},
    {"relations", "`tartan check --relations`"},
    {"invert", "`tartan map --invert`"},
    {"rule_tree", "`tartan rule`"},
    {"rule_draw", "`tartan rule -o`"},
    {"rule_edit", "`tartan rule --edit`"},
    {"individual", "`tartan runs replay`"},
    {"change_run", "`tartan runs insert` and `tartan runs remove`"},
};

static const char *command_that_asks(const char *question)
{
    for (size_t i = 0; i < sizeof asked_otherwise / sizeof *asked_otherwise; i++)
        if (strcmp(asked_otherwise[i].question, question) == 0)
            return asked_otherwise[i].command;
    return NULL;
}

static int unknown_command(const char *name, int count, char **words)
{
    const tn_settings settings = {.diagnostics = tn_options_diagnostics(count, words)};
    const char *names[64];
    for (size_t i = 0; i < tn_all_commands.count; i++)
        names[i] = tn_all_commands.items[i]->name;
    tn_error error;
    tn_fail(&error, TN_INVALID, E_USAGE,
            name[0] == '-' ? "`tartan` has no option %.60s" : "there is no command `%.60s`", name);
    const char *near = tn_nearest(name, names, tn_all_commands.count), *later = NULL;
    const char *otherwise = command_that_asks(name);
    for (int i = 0; i < count && !later; i++)
        later = tn_command_find(&tn_all_commands, words[i]) ? words[i] : NULL;
    if (otherwise)
        tn_error_help(&error, "that is what %s is for", otherwise);
    else if (near)
        tn_error_help(&error, "did you mean `tartan %s`?", near);
    else if (later)
        tn_error_help(&error, "the command comes first: tartan %s %.60s", later, name);
    else if (access(name, F_OK) == 0)
        tn_error_help(&error, "the command comes before the file: tartan check %.200s", name);
    else
        tn_error_help(&error, "`tartan help` lists the commands");
    return tn_program_refuse(&settings, &error);
}

/* `manual`: as a manual page (the build installs them), not for reading here. */
static int help(const char *name, bool manual)
{
    const tn_command *command = name ? tn_command_find(&tn_all_commands, name) : NULL;
    if (name && !command)
        return unknown_command(name, 0, NULL);
    if (manual && command)
        tn_manual_command(command, stdout);
    else if (manual)
        tn_manual_overview(&tn_all_commands, stdout);
    else if (command)
        tn_help_command(command, stdout);
    else
        tn_help_overview(&tn_all_commands, stdout);
    return tn_program_printed();
}

/* Completion for a shell (the build installs them). */
static int completion(const char *name)
{
    const tn_shell *shell = name ? tn_shell_find(name) : NULL;
    if (shell) {
        shell->write(&tn_all_commands, stdout);
        return tn_program_printed();
    }
    const tn_settings settings = {0};
    tn_error error;
    tn_fail(&error, TN_INVALID, E_USAGE, "there is completion for bash, zsh and fish%s%.60s", name ? ", not for " : "",
            name ? name : "");
    tn_error_help(&error, "tartan help --completion bash");
    return tn_program_refuse(&settings, &error);
}

/* The questions described for programs (the build installs it). */
static int requests(const char *form)
{
    if (form && strcmp(form, "schema") == 0) {
        tn_describe_schema(stdout);
    } else if (form && strcmp(form, "types") == 0) {
        tn_describe_types(stdout);
    } else if (form && strcmp(form, "page") == 0) {
        tn_describe_page(stdout);
    } else {
        const tn_settings settings = {0};
        tn_error error;
        tn_fail(&error, TN_INVALID, E_USAGE, "requests are described as schema, types or page%s%.60s",
                form ? ", not as " : "", form ? form : "");
        tn_error_help(&error, "tartan help --requests schema");
        return tn_program_refuse(&settings, &error);
    }
    return tn_program_printed();
}

int main(int argc, char **argv)
{
    tn_program_begin();
    if (argc < 2) {
        tn_help_overview(&tn_all_commands, stderr);
        return TN_EXIT_USAGE;
    }
    const char *name = argv[1];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0)
        return help(NULL, false);
    if (strcmp(name, "help") == 0) {
        if (argc > 2 && strcmp(argv[2], "--completion") == 0)
            return completion(argc > 3 ? argv[3] : NULL);
        if (argc > 2 && strcmp(argv[2], "--requests") == 0)
            return requests(argc > 3 ? argv[3] : NULL);
        bool manual = argc > 2 && strcmp(argv[2], "--man") == 0;
        return help(argc > 2 + manual ? argv[2 + manual] : NULL, manual);
    }
    if (strcmp(name, "--version") == 0) {
        puts("tartan " TARTAN_VERSION);
        return tn_program_printed();
    }
    const tn_command *command = tn_command_find(&tn_all_commands, name);
    return command ? tn_program_run(&tn_all_commands, command, argc - 2, argv + 2, NULL)
                   : unknown_command(name, argc - 2, argv + 2);
}
