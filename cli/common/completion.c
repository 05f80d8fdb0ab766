/* Writes completion for shells from the tables of commands and options. */
#include "cli/common/completion.h"

#include <ctype.h>
#include <string.h>

#include "cli/common/options.h"

/* ---- completion for bash */

static void write_spellings(const tn_option *option, const char *before, const char *between, FILE *out)
{
    fprintf(out, "%s--%s", before, option->name);
    if (option->letter)
        fprintf(out, "%s%s-%c", between, before, option->letter);
}

static void write_options(const tn_commands *commands, FILE *out)
{
    fputs("\n_tartan_options() {\n    case $1 in\n", out);
    for (size_t i = 0; i < commands->count; i++) {
        const tn_command *command = commands->items[i];
        fprintf(out, "    %s) echo '", command->name);
        for (size_t j = 0; j < tn_option_total(command); j++) {
            fputs(j ? " " : "", out);
            write_spellings(tn_option_at(command, j), "", " ", out);
        }
        fputs("' ;;\n", out);
    }
    fputs("    esac\n}\n", out);
}

static void write_bash_argument(const tn_command *command, const tn_option *option, FILE *out)
{
    char before[80];
    snprintf(before, sizeof before, "%s/", command->name);
    tn_completes what = tn_option_completes(option);
    if (what == TN_COMPLETES_NOTHING)
        return;
    fputs("    ", out);
    write_spellings(option, before, " | ", out);
    fputs(") echo '", out);
    if (what == TN_COMPLETES_WORDS)
        tn_choices_write(option->choices, " ", out);
    else
        fputs(what == TN_COMPLETES_FILES ? "/files" : "/free", out);
    fputs("' ;;\n", out);
}

static void write_arguments(const tn_commands *commands, FILE *out)
{
    fputs("\n# What follows an option: words, /files, /free for anything; nothing after a flag.\n"
          "_tartan_argument() {\n    case $1/$2 in\n",
          out);
    for (size_t i = 0; i < commands->count; i++)
        for (size_t j = 0; j < tn_option_total(commands->items[i]); j++)
            write_bash_argument(commands->items[i], tn_option_at(commands->items[i], j), out);
    fputs("    esac\n}\n", out);
}

static void write_bash_operands(const tn_commands *commands, FILE *out)
{
    fputs("\n# The words that a command's first operand can be, where it is not a file.\n"
          "_tartan_operand() {\n    case $1 in\n",
          out);
    for (size_t i = 0; i < commands->count; i++) {
        if (!tn_operand_words(commands->items[i], NULL, NULL))
            continue;
        fprintf(out, "    %s) echo '", commands->items[i]->name);
        tn_operand_words(commands->items[i], " ", out);
        fputs("' ;;\n", out);
    }
    fputs("    help) echo \"$_tartan_commands\" ;;\n    esac\n}\n", out);
}

static const char rest[] =
    "\n_tartan_offer() {\n"
    "    local found\n"
    "    if found=$(compgen \"$@\"); then\n"
    "        mapfile -t COMPREPLY <<<\"$found\"\n"
    "    fi\n"
    "}\n"
    "\n_tartan_files() {\n"
    "    compopt -o filenames 2>/dev/null\n"
    "    _tartan_offer -f -- \"$1\"\n"
    "}\n"
    "\n_tartan() {\n"
    "    local current=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} words\n"
    "    COMPREPLY=()\n"
    "    if ((COMP_CWORD == 1)); then\n"
    "        _tartan_offer -W \"$_tartan_commands help --help --version\" -- \"$current\"\n"
    "        return\n"
    "    fi\n"
    "    if [[ $current == = ]]; then\n"
    "        current=\n"
    "    elif [[ $option == = ]]; then\n"
    "        option=${COMP_WORDS[COMP_CWORD - 2]}\n"
    "    fi\n"
    "    words=\n"
    "    [[ $option != -* ]] || words=$(_tartan_argument \"$command\" \"$option\")\n"
    "    case $words in\n"
    "    /free) return ;;\n"
    "    /files)\n"
    "        _tartan_files \"$current\"\n"
    "        return\n"
    "        ;;\n"
    "    '')\n"
    "        if [[ $current == -* ]]; then\n"
    "            words=$(_tartan_options \"$command\")\n"
    "        elif ((COMP_CWORD == 2)); then\n"
    "            words=$(_tartan_operand \"$command\")\n"
    "        fi\n"
    "        ;;\n"
    "    esac\n"
    "    if [[ -n $words ]]; then\n"
    "        _tartan_offer -W \"$words\" -- \"$current\"\n"
    "    elif [[ $command != help && $current != -* ]]; then\n"
    "        _tartan_files \"$current\"\n"
    "    fi\n"
    "}\n"
    "complete -F _tartan tartan\n";

void tn_completion_bash(const tn_commands *commands, FILE *out)
{
    fputs("# Completion of tartan for bash, written by `tartan help --completion bash`.\n_tartan_commands='", out);
    for (size_t i = 0; i < commands->count; i++)
        fprintf(out, "%s%s", i ? " " : "", commands->items[i]->name);
    fputs("'\n", out);
    write_options(commands, out);
    write_arguments(commands, out);
    write_bash_operands(commands, out);
    fputs(rest, out);
}

/* ---- completion for fish */

static void write_fish_quoted(const char *text, size_t size, FILE *out)
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
    write_fish_quoted(option->help, tn_description_size(option->help), out);
    fputc('\n', out);
}

static void write_fish_command(const tn_command *command, FILE *out)
{
    fprintf(out, "complete -c tartan -n __tartan_first -f -a %s -d ", command->name);
    write_fish_quoted(command->summary, strlen(command->summary), out);
    fprintf(out, "\ncomplete -c tartan -n '__tartan_command help' -f -a %s -d ", command->name);
    write_fish_quoted(command->summary, strlen(command->summary), out);
    fputc('\n', out);
    if (tn_operand_words(command, NULL, NULL)) {
        fprintf(out, "complete -c tartan -n '__tartan_operand %s' -a '", command->name);
        tn_operand_words(command, " ", out);
        fputs("'\n", out);
    }
    for (size_t i = 0; i < tn_option_total(command); i++)
        write_option(command, tn_option_at(command, i), out);
}

void tn_completion_fish(const tn_commands *commands, FILE *out)
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
    for (size_t i = 0; i < commands->count; i++)
        write_fish_command(commands->items[i], out);
}

/* ---- completion for zsh */

/* Writes text inside single quotes, with a backslash before what has a meaning in a row of _arguments or _describe. */
static void write_zsh_quoted(const char *text, size_t size, FILE *out)
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

static void write_zsh_argument(const tn_option *option, FILE *out)
{
    tn_completes what = tn_option_completes(option);
    if (what == TN_COMPLETES_NOTHING)
        return;
    fputc(':', out);
    write_zsh_quoted(option->argument, strlen(option->argument), out);
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
    write_zsh_quoted(option->help, tn_description_size(option->help), out);
    fputc(']', out);
    write_zsh_argument(option, out);
    fputc('\'', out);
}

static void write_zsh_command(const tn_command *command, FILE *out)
{
    fprintf(out, "    %s)\n      _arguments -s -S", command->name);
    for (size_t i = 0; i < tn_option_total(command); i++)
        write_row(tn_option_at(command, i), out);
    fputs(" \\\n        '1:operand:_tartan_operand'", out);
    fputs(" \\\n        '*:file:_files'\n      ;;\n", out);
}

static void write_zsh_operands(const tn_commands *commands, FILE *out)
{
    fputs("_tartan_operand() {\n  local -a known\n  case $command in\n", out);
    for (size_t i = 0; i < commands->count; i++) {
        if (!tn_operand_words(commands->items[i], NULL, NULL))
            continue;
        fprintf(out, "    %s) known=(", commands->items[i]->name);
        tn_operand_words(commands->items[i], " ", out);
        fputs(") ;;\n", out);
    }
    fputs("  esac\n  if (( $#known )); then\n    compadd -a known\n  else\n    _files\n  fi\n}\n\n", out);
}

void tn_completion_zsh(const tn_commands *commands, FILE *out)
{
    fputs("#compdef tartan\n# Completion of tartan for zsh, written by `tartan help --completion zsh`.\n\n", out);
    write_zsh_operands(commands, out);
    fputs("_tartan() {\n  local -a commands\n  commands=(\n", out);
    for (size_t i = 0; i < commands->count; i++) {
        fprintf(out, "    '%s:", commands->items[i]->name);
        write_zsh_quoted(commands->items[i]->summary, strlen(commands->items[i]->summary), out);
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
    for (size_t i = 0; i < commands->count; i++)
        write_zsh_command(commands->items[i], out);
    /* Autoloaded, the file is the function's body; sourced, it registers the function. */
    fputs("  esac\n}\n\n"
          "if [[ $funcstack[1] == _tartan ]]; then\n  _tartan \"$@\"\nelse\n  compdef _tartan tartan\nfi\n",
          out);
}

static const tn_shell shells[] = {
    {"bash", tn_completion_bash},
    {"zsh", tn_completion_zsh},
    {"fish", tn_completion_fish},
};

const tn_shell *tn_shell_find(const char *name)
{
    for (size_t i = 0; i < OPTION_COUNT(shells); i++)
        if (strcmp(shells[i].name, name) == 0)
            return &shells[i];
    return NULL;
}

tn_completes tn_option_completes(const tn_option *option)
{
    if (!option->argument)
        return TN_COMPLETES_NOTHING;
    if (option->kind == TN_OPTION_CHOICE)
        return TN_COMPLETES_WORDS;
    bool file = strstr(option->argument, "FILE") || strstr(option->argument, "DIR");
    return file ? TN_COMPLETES_FILES : TN_COMPLETES_FREE;
}

size_t tn_operand_words(const tn_command *command, const char *between, FILE *out)
{
    size_t words = 0;
    for (const char *line = command->usage; line; words++) {
        size_t size = 0;
        while (islower((unsigned char)line[size]))
            size++;
        if (size == 0 || (line[size] && !isspace((unsigned char)line[size])))
            break;
        if (out)
            fprintf(out, "%s%.*s", words ? between : "", (int)size, line);
        line = strchr(line, '\n');
        line = line ? line + 1 : NULL;
    }
    return words;
}

void tn_choices_write(const char *choices, const char *between, FILE *out)
{
    for (; *choices; choices++) {
        if (*choices == '|')
            fputs(between, out);
        else
            fputc(*choices, out);
    }
}

size_t tn_description_size(const char *help)
{
    enum { LEAST = 20 };
    size_t size = strcspn(help, ";");
    const char *bracket = strstr(help, " (");
    if (bracket && (size_t)(bracket - help) >= LEAST && (size_t)(bracket - help) < size)
        size = (size_t)(bracket - help);
    const char *colon = strstr(help, ": ");
    if (colon && (size_t)(colon - help) >= LEAST && (size_t)(colon - help) < size)
        size = (size_t)(colon - help);
    return size;
}
