/* Completion for fish. */
#include <string.h>

#include "cli/common/completion.h"

static void write_quoted(const char *text, size_t size, FILE *out)
{
    fputc('\'', out);
    for (size_t i = 0; i < size; i++) {
        if (text[i] == '\'' || text[i] == '\\')
            fputc('\\', out);
        fputc(text[i], out);
    }
    fputc('\'', out);
}

static void write_option(const tn_command *command, const tn_option *option, FILE *out)
{
    fprintf(out, "complete -c tartan -n '__tartan_command %s' -l %s", command->name, option->name);
    if (option->letter)
        fprintf(out, " -s %c", option->letter);
    tn_completes what = tn_option_completes(option);
    if (what == TN_COMPLETES_FILES)
        fputs(" -r -F", out);
    else if (what != TN_COMPLETES_NOTHING)
        fputs(" -x", out);
    if (what == TN_COMPLETES_WORDS) {
        fputs(" -a '", out);
        tn_choices_write(option->choices, " ", out);
        fputc('\'', out);
    }
    fputs(" -d ", out);
    write_quoted(option->help, tn_description_size(option->help), out);
    fputc('\n', out);
}

static void write_command(const tn_command *command, FILE *out)
{
    fprintf(out, "complete -c tartan -n __tartan_first -f -a %s -d ", command->name);
    write_quoted(command->summary, strlen(command->summary), out);
    fprintf(out, "\ncomplete -c tartan -n '__tartan_command help' -f -a %s -d ", command->name);
    write_quoted(command->summary, strlen(command->summary), out);
    fputc('\n', out);
    if (tn_operand_words(command, NULL, NULL)) {
        fprintf(out, "complete -c tartan -n '__tartan_operand %s' -a '", command->name);
        tn_operand_words(command, " ", out);
        fputs("'\n", out);
    }
    for (size_t i = 0; i < tn_option_total(command); i++)
        write_option(command, tn_option_at(command, i), out);
}

void tn_completion_fish(FILE *out)
{
    fputs("# Completion of tartan for fish, written by `tartan help --completion fish`.\n"
          "function __tartan_first\n"
          "    test (count (commandline -opc)) -eq 1\n"
          "end\n"
          "function __tartan_command\n"
          "    set -l words (commandline -opc)\n"
          "    test (count $words) -ge 2; and test $words[2] = $argv[1]\n"
          "end\n"
          "function __tartan_operand\n"
          "    test (count (commandline -opc)) -eq 2; and __tartan_command $argv[1]\n"
          "end\n"
          "complete -c tartan -n __tartan_first -f -a help -d 'explain a command'\n"
          "complete -c tartan -n __tartan_first -l version -d 'print the version'\n"
          "complete -c tartan -n __tartan_first -l help -s h -d 'list the commands'\n",
          out);
    for (size_t i = 0; i < tn_commands_count; i++)
        write_command(tn_commands[i], out);
}
