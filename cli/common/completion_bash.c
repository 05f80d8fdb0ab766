/* Completion for bash. It needs no package beside bash itself; a word is broken at "=", as bash does by default. */
#include "cli/common/completion.h"

static void write_spellings(const tn_option *option, const char *before, const char *between, FILE *out)
{
    fprintf(out, "%s--%s", before, option->name);
    if (option->letter)
        fprintf(out, "%s%s-%c", between, before, option->letter);
}

static void write_options(FILE *out)
{
    fputs("\n_tartan_options() {\n    case $1 in\n", out);
    for (size_t i = 0; i < tn_commands_count; i++) {
        const tn_command *command = tn_commands[i];
        fprintf(out, "    %s) echo '", command->name);
        for (size_t j = 0; j < tn_option_total(command); j++) {
            fputs(j ? " " : "", out);
            write_spellings(tn_option_at(command, j), "", " ", out);
        }
        fputs("' ;;\n", out);
    }
    fputs("    esac\n}\n", out);
}

static void write_argument(const tn_command *command, const tn_option *option, FILE *out)
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

static void write_arguments(FILE *out)
{
    fputs("\n# What follows an option: words, /files, /free for anything; nothing after a flag.\n"
          "_tartan_argument() {\n    case $1/$2 in\n",
          out);
    for (size_t i = 0; i < tn_commands_count; i++)
        for (size_t j = 0; j < tn_option_total(tn_commands[i]); j++)
            write_argument(tn_commands[i], tn_option_at(tn_commands[i], j), out);
    fputs("    esac\n}\n", out);
}

static void write_operands(FILE *out)
{
    fputs("\n# The words that a command's first operand can be, where it is not a file.\n"
          "_tartan_operand() {\n    case $1 in\n",
          out);
    for (size_t i = 0; i < tn_commands_count; i++) {
        if (!tn_operand_words(tn_commands[i], NULL, NULL))
            continue;
        fprintf(out, "    %s) echo '", tn_commands[i]->name);
        tn_operand_words(tn_commands[i], " ", out);
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

void tn_completion_bash(FILE *out)
{
    fputs("# Completion of tartan for bash, written by `tartan help --completion bash`.\n_tartan_commands='", out);
    for (size_t i = 0; i < tn_commands_count; i++)
        fprintf(out, "%s%s", i ? " " : "", tn_commands[i]->name);
    fputs("'\n", out);
    write_options(out);
    write_arguments(out);
    write_operands(out);
    fputs(rest, out);
}
