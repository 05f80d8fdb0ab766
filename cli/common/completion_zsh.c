/* Completion for zsh. */
#include <string.h>

#include "cli/common/completion.h"

/* Writes text inside single quotes, with a backslash before what has a meaning in a row of _arguments or _describe. */
static void write_quoted(const char *text, size_t size, FILE *out)
{
    for (size_t i = 0; i < size; i++) {
        if (text[i] == '\'')
            fputs("'\\''", out);
        else if (strchr(":[]\\", text[i]))
            fprintf(out, "\\%c", text[i]);
        else
            fputc(text[i], out);
    }
}

static void write_argument(const tn_option *option, FILE *out)
{
    tn_completes what = tn_option_completes(option);
    if (what == TN_COMPLETES_NOTHING)
        return;
    fputc(':', out);
    write_quoted(option->argument, strlen(option->argument), out);
    fputc(':', out);
    if (what == TN_COMPLETES_WORDS) {
        fputc('(', out);
        tn_choices_write(option->choices, " ", out);
        fputc(')', out);
    } else if (what == TN_COMPLETES_FILES) {
        fputs("_files", out);
    } else {
        fputc(' ', out);
    }
}

static void write_row(const tn_option *option, FILE *out)
{
    bool again = option->kind == TN_OPTION_LIST || option->kind == TN_OPTION_WISH;
    const char *end = option->argument ? "=" : "", *letter_end = option->argument ? "+" : "";
    fputs(" \\\n        ", out);
    if (!option->letter)
        fprintf(out, "'%s--%s%s", again ? "*" : "", option->name, end);
    else if (again)
        fprintf(out, "'*'{-%c%s,--%s%s}'", option->letter, letter_end, option->name, end);
    else
        fprintf(out, "'(-%c --%s)'{-%c%s,--%s%s}'", option->letter, option->name, option->letter, letter_end,
                option->name, end);
    fputc('[', out);
    write_quoted(option->help, tn_description_size(option->help), out);
    fputc(']', out);
    write_argument(option, out);
    fputc('\'', out);
}

static void write_command(const tn_command *command, FILE *out)
{
    fprintf(out, "    %s)\n      _arguments -s -S", command->name);
    for (size_t i = 0; i < tn_option_total(command); i++)
        write_row(tn_option_at(command, i), out);
    fputs(" \\\n        '1:operand:_tartan_operand'", out);
    fputs(" \\\n        '*:file:_files'\n      ;;\n", out);
}

static void write_operands(FILE *out)
{
    fputs("_tartan_operand() {\n  local -a known\n  case $command in\n", out);
    for (size_t i = 0; i < tn_commands_count; i++) {
        if (!tn_operand_words(tn_commands[i], NULL, NULL))
            continue;
        fprintf(out, "    %s) known=(", tn_commands[i]->name);
        tn_operand_words(tn_commands[i], " ", out);
        fputs(") ;;\n", out);
    }
    fputs("  esac\n  if (( $#known )); then\n    compadd -a known\n  else\n    _files\n  fi\n}\n\n", out);
}

void tn_completion_zsh(FILE *out)
{
    fputs("#compdef tartan\n# Completion of tartan for zsh, written by `tartan help --completion zsh`.\n\n", out);
    write_operands(out);
    fputs("_tartan() {\n  local -a commands\n  commands=(\n", out);
    for (size_t i = 0; i < tn_commands_count; i++) {
        fprintf(out, "    '%s:", tn_commands[i]->name);
        write_quoted(tn_commands[i]->summary, strlen(tn_commands[i]->summary), out);
        fputs("'\n", out);
    }
    fputs("    'help:explain a command'\n  )\n"
          "  if (( CURRENT == 2 )); then\n"
          "    _describe -t commands command commands\n"
          "    compadd -- --help --version\n"
          "    return\n"
          "  fi\n"
          "  local command=$words[2]\n"
          "  shift words\n"
          "  (( CURRENT-- ))\n"
          "  case $command in\n"
          "    help) (( CURRENT == 2 )) && _describe -t commands command commands ;;\n",
          out);
    for (size_t i = 0; i < tn_commands_count; i++)
        write_command(tn_commands[i], out);
    /* Autoloaded, the file is the function's body; sourced, it registers the function. */
    fputs("  esac\n}\n\n"
          "if [[ $funcstack[1] == _tartan ]]; then\n  _tartan \"$@\"\nelse\n  compdef _tartan tartan\nfi\n",
          out);
}
