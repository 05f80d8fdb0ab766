/* Writes completion for shells from the tables of commands and options. */
#include "cli/common/completion.h"

#include <ctype.h>
#include <string.h>

#include "cli/common/option_rows.h"

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
